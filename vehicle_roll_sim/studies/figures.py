"""Figures of a study: maps over two factors, curves over one, histograms and scatter."""

import collections
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.drawing import DrawnFigure, add_title, new_figure, save_figure
from vehicle_roll_sim.analysis.pens import COLOURS
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.studies.quantities import unit_of
from vehicle_roll_sim.studies.results import Results
from vehicle_roll_sim.studies.statistics import probability
from vehicle_roll_sim.studies.study import NEVER

WIDTH, HEIGHT = 6.4, 4.2
"""Inches."""
MOST_OUTPUTS = 6
MOST_FACTORS = 9
"""Panels of a scatter figure."""
MOST_DOTS = 20_000
"""Most runs in a scatter figure; of more, a random sample is drawn, always the same."""
OUTER = (0.05, 0.95)
"""Quantiles of the band about a curve."""


def draw(results: Results, folder: Path) -> list[Path]:
    """Write all figures for which the study has the factors, as PNG; returns the files."""
    files = []
    for name, figure in _figures(results):
        files.append(folder / f"{name}.png")
        save_figure(figure, files[-1])
    return files


def _figures(results: Results) -> Iterator[tuple[str, DrawnFigure]]:
    study = results.study
    if study.rare or not len(results.runs):
        return
    if study.search:
        if results.brackets is not None:
            values = np.array([each.threshold for each in results.brackets])
            points = {n: [each.point[n] for each in results.brackets] for n in study.factors}
            unit = unit_of(study.search.factor, study)
            label = labelled(f"lowest {study.search.factor} with {study.search.event}", unit)
            yield from _of_values(results, points, values, "thresholds", label)
        return
    columns = results.columns
    for name, happened in columns.happened.items():
        label = f"probability of {name}" if study.drawn else f"{name} (1: happened)"
        if study.gridded:
            yield from _of_values(results, columns.inputs, happened, name, label, is_event=True)
    for name in study.outputs[:MOST_OUTPUTS]:
        label = magnitude_label(name)
        yield from _of_values(results, columns.inputs, columns.magnitudes[name], name, label)


def magnitude_label(name: str) -> str:
    """How an axis names the magnitude of a metric."""
    magnitude = f"|{name}|" if name.startswith("peak_") and name not in NEVER else name
    return labelled(magnitude, METRIC_UNITS[name])


def labelled(name: str, unit: str) -> str:
    """A name with its unit, if it has one."""
    return f"{name} ({unit})" if unit else name


def _of_values(
    results: Results,
    points: dict[str, Sequence],
    values: np.ndarray,
    name: str,
    label: str,
    is_event: bool = False,
) -> Iterator[tuple[str, DrawnFigure]]:
    """The figures of one value of each point: of an event 0 or 1, nan for none.

    points: the values of the factors, by name.
    """
    study = results.study
    if np.isnan(values).all():
        return
    numeric = [factor for factor in study.gridded if study.kinds[factor] is float]
    texts = [factor for factor in study.gridded if factor not in numeric]
    labels = {each: labelled(each, unit_of(each, study)) for each in study.factors}
    groups = _grouped([points[each] for each in (*numeric, *texts)], values)
    if len(numeric) == 2 and not texts:
        yield f"map_{name}", _map([labels[each] for each in numeric], groups, label, is_event)
    elif len(numeric) == 1 and len(texts) <= 1:
        axes = [labels[each] for each in (*numeric, *texts)]
        yield f"curve_{name}", _curves(axes, groups, label, is_event)
    elif not is_event:
        factors = [factor for factor in study.factors if study.kinds[factor] is float]
        across = {labels[each]: points[each] for each in factors[:MOST_FACTORS]}
        if across:
            yield f"scatter_{name}", _scatter(across, values, label)
    if not study.gridded:
        yield f"histogram_{name}", _histogram(values[~np.isnan(values)], label)


def _grouped(factors: list[Sequence], values: np.ndarray) -> dict[tuple, list[float]]:
    """The values by those of the factors, without nan; nothing without factors."""
    groups = collections.defaultdict(list)
    for key, value in zip(zip(*factors, strict=True), values, strict=bool(factors)):
        group = groups[key]
        if not np.isnan(value):
            group.append(value)
    return groups


def _centre(group: list[float], is_event: bool) -> float:
    """The mean for an event, the median for anything else; nan without values."""
    if not group:
        return np.nan
    return float(np.mean(group) if is_event else np.median(group))


def _map(axis_labels: list[str], groups: dict, label: str, is_event: bool) -> DrawnFigure:
    across, up = (sorted({values[i] for values in groups}) for i in range(2))
    field = np.full((len(up), len(across)), np.nan)
    for (x, y), group in groups.items():
        field[up.index(y), across.index(x)] = _centre(group, is_event)
    figure = new_figure(WIDTH, HEIGHT)
    axes = figure.add_subplot()
    axes.set_facecolor("0.85")
    limits = {"vmin": 0.0, "vmax": 1.0} if is_event else {}
    mesh = axes.pcolormesh(across, up, field, shading="nearest", cmap="viridis", **limits)
    figure.colorbar(mesh, ax=axes, label=label)
    axes.set(xlabel=axis_labels[0], ylabel=axis_labels[1])
    if np.isnan(field).any():
        add_title(figure, "grey: never or unknown")
    return figure


def _curves(axis_labels: list[str], groups: dict, label: str, is_event: bool) -> DrawnFigure:
    """A curve over the first factor for each value of the second, if there is one."""
    figure = new_figure(WIDTH, HEIGHT)
    axes = figure.add_subplot()
    names = list(dict.fromkeys(values[1:] for values in groups))[: len(COLOURS)]
    for colour, name in zip(COLOURS, names, strict=False):
        across = sorted(values[0] for values in groups if values[1:] == name)
        found = [groups[(x, *name)] for x in across]
        centres = [_centre(group, is_event) for group in found]
        text = str(name[0]) if name else None
        axes.plot(across, centres, ".-", color=colour, label=text)
        if any(len(group) > 1 for group in found):
            low, high = np.transpose([_band(group, is_event) for group in found])
            axes.fill_between(across, low, high, color=colour, alpha=0.15, linewidth=0)
    if names != [()]:
        axes.legend(title=axis_labels[1])
    axes.set(xlabel=axis_labels[0], ylabel=label)
    axes.grid(alpha=0.3)
    return figure


def _band(group: list[float], is_event: bool) -> tuple[float, float]:
    """The 95 % interval of an event's probability, outer quantiles of anything else."""
    if not group:
        return np.nan, np.nan
    if is_event:
        found = probability(round(sum(group)), len(group))
        return found.low, found.high
    low, high = np.quantile(group, OUTER)
    return float(low), float(high)


def _scatter(across: dict[str, Sequence], values: np.ndarray, label: str) -> DrawnFigure:
    """A panel for each factor. across: its values, by the label of its axis."""
    columns = min(len(across), 3)
    rows = -(-len(across) // columns)
    figure = new_figure(3.0 * columns + 1.0, 2.6 * rows)
    shown = np.arange(len(values))
    if len(values) > MOST_DOTS:
        generator = np.random.default_rng(0)
        shown = generator.choice(len(values), MOST_DOTS, replace=False)
        add_title(figure, f"{MOST_DOTS} of {len(values)} runs")
    panels = figure.subplots(rows, columns, sharey=True, squeeze=False)
    for axes, (name, places) in zip(panels.flat, across.items(), strict=False):
        axes.plot(
            np.take(places, shown), values[shown], ".", color=COLOURS[2], markersize=3, alpha=0.6
        )
        axes.set_xlabel(name)
        axes.grid(alpha=0.3)
    for axes in panels.flat[len(across) :]:
        axes.set_visible(False)
    for axes in panels[:, 0]:
        axes.set_ylabel(label)
    return figure


def _histogram(values: np.ndarray, label: str) -> DrawnFigure:
    figure = new_figure(WIDTH, HEIGHT)
    axes = figure.add_subplot()
    axes.hist(values, bins="auto" if np.ptp(values) else 1, color=COLOURS[2], alpha=0.7)
    low, high = OUTER
    for share, style in ((low, ":"), (0.5, "-"), (high, ":")):
        text = f"{100 * share:g} %"
        axes.axvline(np.quantile(values, share), color="black", linestyle=style, label=text)
    axes.set(xlabel=label, ylabel="runs")
    axes.legend(title="quantiles")
    return figure
