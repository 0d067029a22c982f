"""Evaluates a tire at the points of a CSV file, one per row, and writes the results to another."""

import dataclasses
import itertools
import math
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.tire_curves import Condition, Curve, reference_speed
from vehicle_roll_sim.declaration import InputError, parameter, parameters_of, unknown_name
from vehicle_roll_sim.files.table_file import read_table, write_rows
from vehicle_roll_sim.input_errors import number_in
from vehicle_roll_sim.vehicle.tire_evaluation import TireForces, evaluate
from vehicle_roll_sim.vehicle.tire_file import Tire

LARGEST_FILE = 200_000_000
"""Bytes: a few million points."""
RIGHT_ANGLE = math.pi / 2
SIDES = ("left", "right")
LIMITS = {
    "normal_force": ("tire load", "FZMIN", "FZMAX", "N"),
    "slip_ratio": ("slip ratio", "KPUMIN", "KPUMAX", ""),
    "slip_angle": ("slip angle", "ALPMIN", "ALPMAX", "rad"),
    "inclination": ("inclination", "CAMMIN", "CAMMAX", "rad"),
    "pressure": ("pressure", "PRESMIN", "PRESMAX", "Pa"),
}
"""Name, lower and upper coefficient, and unit of the ranges of a tire file, by column."""


@dataclasses.dataclass(frozen=True)
class TirePoint:
    """A point at which a tire is evaluated, in the W axes of ISO 8855: x forward, y left, z up."""

    normal_force: float = parameter("load of the tire", "N", 0.0, 1e6)
    slip_ratio: float = parameter("-1 for a locked wheel", "", -1e3, 1e3)
    slip_angle: float = parameter(
        "positive if the tire slides to the left", "rad", -RIGHT_ANGLE, RIGHT_ANGLE
    )
    inclination: float = parameter(
        "of the wheel to the road, positive if its top leans to the right",
        "rad",
        -RIGHT_ANGLE,
        RIGHT_ANGLE,
        default=0.0,
    )
    pressure: float = parameter("inflation pressure", "Pa", 1e3, 1e7, default=math.nan)
    speed: float = parameter("forward speed of the wheel", "m/s", 0.0, 200.0, default=math.nan)
    side: str = parameter("of the vehicle", choices=SIDES, default="left")


COLUMNS = tuple(parameters_of(TirePoint))
REQUIRED = COLUMNS[:3]
EVALUATED = (*REQUIRED, "inclination", "speed")
ANSWERS = TireForces._fields


def read_points(path: Path, tire: Tire) -> dict[str, np.ndarray]:
    """The columns of a file of points by name, each of shape (n,); missing ones take defaults.

    By default, pressure is that of the tire file (nan if its version has none), speed its LONGVL.
    Raises InputError naming file, line and column.
    """
    header, lines = read_table(path, LARGEST_FILE)
    _check_header(path, header, tire)
    rows = list(lines)
    if not rows:
        raise InputError(f"file {path}", "", "a header and at least one row", "no rows")
    declared = parameters_of(TirePoint)
    columns = {name: [] for name in header}
    for number, row in rows:
        for name, text in zip(header, row, strict=True):
            where = f"{path}: line {number}: {name}"
            columns[name].append(_value(where, text, declared[name]))
            if name == "pressure":
                tire.check_pressure(columns[name][-1], where)
    given = {name: np.array(values) for name, values in columns.items()}
    defaults = {"pressure": own_pressure(tire), "speed": reference_speed(tire)}
    missing = {n: defaults.get(n, declared[n].default) for n in COLUMNS if n not in given}
    return given | {name: np.full(len(rows), value) for name, value in missing.items()}


def own_pressure(tire: Tire) -> float:
    """The pressure (Pa) at which a tire is evaluated by default; nan for 5.2."""
    if tire.version == "5.2":
        return math.nan
    return tire.coefficients["INFLPRES"] or tire.coefficients["NOMPRES"] or math.nan


def columns_of(conditions: Sequence[Condition]) -> dict[str, np.ndarray]:
    """Load and inclination of conditions, and the pressures that they give, by column."""
    names = ("normal_force", "inclination", "pressure")
    given = {name: [getattr(each, name) for each in conditions] for name in names}
    return {name: np.array(values) for name, values in given.items() if None not in values}


def outside(tire: Tire, points: dict[str, np.ndarray]) -> dict[str, int]:
    """The number of points outside each range of the tire file, by name; zeros are omitted."""
    given = tire.coefficients
    counts = {
        label: int(((points[name] < given[low]) | (points[name] > given[high])).sum())
        for name, (label, low, high, _) in LIMITS.items()
        if name in points
    }
    return {label: count for label, count in counts.items() if count}


def answers(tire: Tire, points: dict[str, np.ndarray], *, as_published: bool = False) -> TireForces:
    """Forces, moments and radii at points as `read_points` gives them, each of shape (n,).

    as_published: allow negative weights of combined slip, as in the published formula.
    """
    found = np.empty((len(ANSWERS), len(points["side"])))
    for pressure, side in _kinds(points):
        is_same = points["pressure"] == pressure if pressure else np.isnan(points["pressure"])
        chosen = is_same & (points["side"] == side)
        at = {name: points[name][chosen] for name in EVALUATED}
        kind = {"pressure": pressure, "side": side, "as_published": as_published}
        found[:, chosen] = evaluate(tire, **at, **kind)
    return TireForces(*found)


def _kinds(points: dict[str, np.ndarray]) -> set[tuple[float | None, str]]:
    """The pressures (None for nan) and sides among points."""
    pressures = (None if math.isnan(each) else each for each in points["pressure"].tolist())
    return set(zip(pressures, points["side"].tolist(), strict=True))


def reversed_points(published: TireForces, simulated: TireForces) -> int:
    """The number of points at which the formula has a negative weight of combined slip."""
    pairs = zip(published[:2], simulated[:2], strict=True)
    return int(np.any([mine != theirs for mine, theirs in pairs], axis=0).sum())


def write_answers(path: Path, points: dict[str, np.ndarray], forces: TireForces) -> None:
    """Write points and answers as CSV in full precision; quantities a version lacks are empty."""
    columns = [*(points[name].tolist() for name in COLUMNS), *(each.tolist() for each in forces)]
    write_rows(path, (*COLUMNS, *ANSWERS), _without_nan(zip(*columns, strict=True)))


def write_curves(path: Path, tire: Tire, curves: Iterable[Curve]) -> None:
    """Write curves as points and answers, with the name of the curve in the first column."""
    rows = itertools.chain.from_iterable(_rows_of(tire, curve) for curve in curves)
    write_rows(path, ("curve", *COLUMNS, *ANSWERS), list(rows))


def _rows_of(tire: Tire, curve: Curve) -> list[list]:
    at = curve.condition
    pressure = own_pressure(tire) if at.pressure is None else at.pressure
    others = at.inclination, pressure, at.speed, at.side
    slips = curve.slip_ratio.tolist(), curve.slip_angle.tolist()
    values = zip(*slips, *(each.tolist() for each in curve.forces), strict=True)
    rows = ((at.normal_force, *row[:2], *others, *row[2:]) for row in values)
    return [[curve.name, *row] for row in _without_nan(rows)]


def _without_nan(rows: Iterable[Sequence]) -> list[list]:
    """Rows with empty fields in place of nan."""
    return [["" if value != value else value for value in row] for row in rows]


def _check_header(path: Path, header: list[str], tire: Tire) -> None:
    where = f"{path}: line 1: column"
    for name in header:
        if name not in COLUMNS:
            raise unknown_name(name, COLUMNS, where)
        if header.count(name) > 1:
            raise InputError(where, name, "each column once")
    for name in REQUIRED:
        if name not in header:
            raise InputError(f"{where} {name}", None, "required, as are " + ", ".join(REQUIRED))
    if "pressure" in header and tire.version == "5.2":
        raise InputError(where, "pressure", "not for Magic Formula 5.2, which has no pressure")


def _value(where: str, text: str, declared):
    """The value of a field; raises InputError."""
    try:
        given = text.strip() if declared.kind is str else number_in(text)
    except ValueError:
        raise InputError(where, text, declared.allowed) from None
    return declared.validate(given, where)
