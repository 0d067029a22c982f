"""Which samples of a long run the page gets: enough for its motion, every peak and every event."""

from collections.abc import Iterable

import numpy as np

from vehicle_roll_sim.runs.history import History

MOST_ROWS = 20_000
"""Most rows of a run that is not thinned; a longer run is thinned to about this many."""


def kept_rows(
    history: History,
    signals: Iterable[np.ndarray],
    times: Iterable[float],
    most: int = MOST_ROWS,
) -> np.ndarray:
    """Places of the rows to keep, in order: all of them if there are at most `most`.

    Else half as many at equal distances; the smallest and largest value of each of the signals
    (n,) in as many intervals as the other half allows; the rows around each change between a
    loaded and an unloaded wheel; and those around `times` (s; nan for none).
    """
    count = len(history.rows)
    if count <= most:
        return np.arange(count)
    signals = list(signals)
    regular = np.linspace(0, count - 1, most // 2).round().astype(int)
    intervals = max(most // (4 * max(len(signals), 1)), 1)
    edges = np.linspace(0, count, intervals + 1).round().astype(int)
    found = [regular, _changes(history.wheels("normal_force") <= 0.0)]
    found += [_extremes(signal, edges) for signal in signals]
    wanted = np.array([time for time in times if not np.isnan(time)])
    after = np.searchsorted(history["time"], wanted).clip(0, count - 1)
    found += [after, (after - 1).clip(0)]
    return np.unique(np.concatenate(found))


def _extremes(signal: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Places of the smallest and the largest value in each interval, nan left out."""
    low, high = np.nan_to_num(signal, nan=np.inf), np.nan_to_num(signal, nan=-np.inf)
    pairs = [
        (begin + low[begin:end].argmin(), begin + high[begin:end].argmax())
        for begin, end in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True)
    ]
    return np.array(pairs).ravel()


def _changes(flags: np.ndarray) -> np.ndarray:
    """Rows before and after each change in one of the columns, shape (n, 4)."""
    before = np.flatnonzero((flags[1:] != flags[:-1]).any(axis=1))
    return np.concatenate((before, before + 1))
