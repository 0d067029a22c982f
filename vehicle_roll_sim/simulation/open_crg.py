"""Grids from OpenCRG files, which the library PyOpenCRG reads and evaluates.

A file has heights over u, along a reference line, and v, to the left of it. They are taken at the
points of a grid with the coordinates s and n: along the direction in which the reference line
begins, and to the left. The surface has the height 0 there, and keeps the height of its edge beyond
the data. A file of friction has factors in place of heights.
"""

import math
import warnings
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, validated
from vehicle_roll_sim.files.text_file import WANTED
from vehicle_roll_sim.roads.feature import MOST_POINTS
from vehicle_roll_sim.roads.grid import Grid
from vehicle_roll_sim.roads.iso8608 import PRECISION
from vehicle_roll_sim.vehicle.plausibility import warn

LARGEST_FILE = 1_000_000_000
"""Bytes: a hundred million heights in text."""
SPACINGS = ("spacing", "side_spacing")
MOST_MEANS = 5
"""Points in each direction of which the mean is taken where a grid is coarser than its file."""
SAME = 1e-3
"""m: largest distance between the reference lines of heights and of friction."""
ROUNDING = 1e-6
"""Of a spacing."""
HELD = 2
"""Border mode of OpenCRG: beyond the edges the height is that of the edge."""


def grid_values(values: Mapping, heights: Path, frictions: Path | None, where: str) -> dict:
    """The keys of a grid with the heights, and the factors of friction, of OpenCRG files.

    values: keys that are given; spacings (m) among them replace those of the file. where: names the
    feature in messages. Issues a PlausibilityWarning for doubtful files. Raises InputError.
    """
    given = {name: values[name] for name in SPACINGS if name in values}
    chosen = validated(Grid, given, f"{where}: ")
    road = _read(heights)
    steps = [chosen.get(name, own) for name, own in zip(SPACINGS, _steps(road), strict=True)]
    s, n = _places(road, steps, heights)
    found = dict(zip(SPACINGS, steps, strict=True))
    found |= {"ahead": float(s[0]), "right": float(n[0])}
    found["heights"] = _means(road, s, n, steps)
    if frictions is not None:
        other = _read(frictions)
        _check_line(other, road, frictions, heights)
        found["frictions"] = _means(other, s, n, steps, grid_only=True)
    return found


def _read(path: Path):
    """The road of a file, its reference line from the origin on along x; raises InputError."""
    try:
        import pyopencrg  # optional
    except ImportError:
        allowed = "pip install 'vehicle_roll_sim[crg]'"
        raise InputError(f"file {path}", "", allowed, "no Python package pyopencrg") from None
    try:
        if (size := path.stat().st_size) > LARGEST_FILE:
            problem = f"it has {size} bytes"
            raise InputError(f"file {path}", "", f"at most {LARGEST_FILE} bytes", problem)
        with path.open("rb"), warnings.catch_warnings(record=True) as doubts:
            warnings.simplefilter("always")
            stored = pyopencrg.read(path)
            road = stored.apply_mods().move_to(0.0, 0.0, 0.0, 0.0)
    except OSError as error:
        wanted = WANTED.get(type(error), "give a file that can be read")
        problem = error.strerror or _in_one_line(str(error), path)
        raise InputError(f"file {path}", "", wanted, problem) from None
    except pyopencrg.CrgCheckError as error:
        raise _refused(path, [*error.report.errors, *error.report.warnings][0]) from None
    except InputError:
        raise
    except Exception as error:  # of the library, for a damaged file
        raise _refused(path, str(error)) from None
    if not (np.isfinite([*road.x, *road.y, *road.v]).all() and min(_steps(road)) > 0.0):
        raise _refused(path, "a reference line or cross-sections of no finite size")
    _check_gaps(stored, road, path)
    warn(f"{path}: {line}" for doubt in doubts for line in _doubts(str(doubt.message), path))
    for option in ("border_mode_u", "border_mode_v"):
        road.set_option(option, HELD)
    return road


def _refused(path: Path, problem: str) -> InputError:
    return InputError(f"file {path}", "", "an OpenCRG file", _in_one_line(problem, path))


def _doubts(message: str, path: Path) -> list[str]:
    """The lines of a warning, each about one doubt, or the warning as one line."""
    listed = [line.strip(" -") for line in message.splitlines() if line.startswith("  - ")]
    return listed or [_in_one_line(message, path)]


def _in_one_line(text: str, path: Path) -> str:
    return " ".join(text.replace(f"{path}: ", "").split())


def _check_gaps(stored, road, path: Path) -> None:
    """Raise InputError for a gap within a cross-section as it is stored, or if it is not filled."""
    known = np.pad(~np.isnan(stored.z), ((0, 0), (1, 1))).astype(int)
    gaps = np.abs(np.diff(known)).sum(axis=1) != 2
    gaps |= np.isnan(road.z).any(axis=1)
    if gaps.any():
        allowed = "no gap between heights, and gaps at the edges only with GRID_NAN_MODE 1 or 2"
        problem = f"heights are missing at u = {stored.u[np.argmax(gaps)]:g} m"
        raise InputError(f"file {path}", "", allowed, problem)


def _steps(road) -> list[float]:
    """The distances of the points of a file along and across, the smallest if they differ (m)."""
    return [round(float(np.diff(each).min()), PRECISION) for each in (road.u, road.v)]


def _places(road, steps: list[float], path: Path) -> tuple[np.ndarray, np.ndarray]:
    """s and n of the rows and columns of a grid that covers a road; raises InputError."""
    edges = [road.uv_to_xy(road.u, np.full_like(road.u, v)) for v in (road.v[0], road.v[-1])]
    reached = np.round(np.concatenate(edges, axis=1), PRECISION)
    first, size = reached.min(axis=1), np.ptp(reached, axis=1)
    counts = [max(2, math.ceil(x / h - ROUNDING) + 1) for x, h in zip(size, steps, strict=True)]
    if math.prod(counts) > MOST_POINTS:
        fitting = float(f"{1.1 * math.sqrt(math.prod(size) / MOST_POINTS):.2g}")
        allowed = f"at most {MOST_POINTS}, as with {' and '.join(SPACINGS)} of {fitting:g} m"
        raise InputError(f"file {path}", "", allowed, f"{counts[0]} x {counts[1]} points")
    s, n = (a + h * np.arange(k) for a, h, k in zip(first, steps, counts, strict=True))
    return s, n


def _means(
    road, s: np.ndarray, n: np.ndarray, steps: list[float], grid_only: bool = False
) -> list[list[float]]:
    """Heights at the points of a grid, or their means over its steps if these are longer (m).

    grid_only: without those of the reference line.
    """
    x, y = np.meshgrid(s, n, indexing="ij")
    shifts = [
        step * _middles(min(MOST_MEANS, max(1, math.ceil(step / own - ROUNDING))))
        for step, own in zip(steps, _steps(road), strict=True)
    ]
    places = [road.xy_to_uv(x + dx, y + dy) for dx in shifts[0] for dy in shifts[1]]
    found = [road.uv_to_z(*place, grid_only=grid_only) for place in places]
    return np.round(np.mean(found, axis=0), PRECISION).tolist()


def _middles(count: int) -> np.ndarray:
    """The middles of equal parts of the length from -1/2 to 1/2."""
    return (np.arange(count) + 0.5) / count - 0.5


def _check_line(road, other, path: Path, of: Path) -> None:
    """Raise InputError unless the reference lines of two roads have the same ends."""
    lines = [each.uv_to_xy(each.u[[0, -1]], 0.0) for each in (road, other)]
    if not np.abs(np.subtract(*lines)).max() < SAME:
        raise InputError(f"file {path}", "", f"that of {of}", "another reference line")
