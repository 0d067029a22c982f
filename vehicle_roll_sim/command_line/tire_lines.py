"""What `vehicle_roll_sim tire` prints about a tire file: what it contains, and a table."""

import math

from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.vehicle.axle_tires import pressure_change, vertical_stiffness
from vehicle_roll_sim.vehicle.tire.vertical import compression, progression
from vehicle_roll_sim.vehicle.tire_file import Tire

HEADER = (
    f"{'load':>8}{'incl.':>8}{'pressure':>10}{'slip stiffn.':>14}{'cornering st.':>15}"
    f"{'braking':>10}{'driving':>9}{'α > 0':>8}{'α < 0':>8}"
)
UNITS = f"{'N':>8}{'rad':>8}{'kPa':>10}{'kN':>14}{'kN/rad':>15}{'peak force over load':>35}"
KILO = 1e3
MILLIMETRES = 1e3
"""In a metre."""
VERSION, UNITS_READ, WARNING = "Magic Formula", "converted to SI units: ", "warning: "
"""The beginnings of notes on version and units, and of warnings."""
LABELS = (VERSION, UNITS_READ)


def read_lines(tire: Tire) -> list[str]:
    """The contents of the file, one quantity per line, and the notes on how it was read."""
    from vehicle_roll_sim.offline import tire_points

    given = tire.coefficients
    lines = [
        line("tire file", tire.file),
        *_version_and_units(tire),
        line("side", tire.side),
        line("combined slip", "yes" if tire.combined else "no: switched off by USE_MODE"),
        line("nominal load", f"{given['FNOMIN']:g} N"),
    ]
    pressure = tire_points.own_pressure(tire)
    if not math.isnan(pressure):
        nominal = f"{given['NOMPRES']:g} Pa" if given["NOMPRES"] else "not given"
        lines.append(line("inflation pressure", f"{pressure:g} Pa (nominal: {nominal})"))
    lines += _vertical_lines(tire)
    for label, lowest, highest, unit in tire_points.LIMITS.values():
        if label != "pressure" or tire.version != "5.2":
            lines.append(line(f"{label} range", _range(given[lowest], given[highest], unit)))
    return [*lines, *(_note(each) for each in tire.notes if not _has_line(each))]


def _vertical_lines(tire: Tire) -> list[str]:
    """The vertical stiffness and its progression, and the compression at nominal load."""
    given, stiffness = tire.coefficients, vertical_stiffness(tire, None)
    if not stiffness:
        return [line("vertical stiffness", "not given; the vehicle file must give it")]
    load, change = given["FNOMIN"], pressure_change(tire, None)
    at = " at the inflation pressure" if given["PFZ1"] * change else ""
    grows = progression(given)
    by_file = compression(given, load, change) * MILLIMETRES
    linear = load / stiffness * MILLIMETRES
    said = f"{by_file if grows else linear:.4g} mm at nominal load"
    if given["Q_FZ2"] < 0.0:
        said += f"; by the formula of the file, at standstill, {by_file:.4g} mm"
    elif grows:
        said += f", {linear:.4g} mm without progression"
    under = " at nominal load" if grows else ""
    stated = f"{stiffness:g} N/m{under}{at}, unless the vehicle file gives another"
    lines = [line("vertical stiffness", stated), line("tire compression", said)]
    if grows:
        lines.insert(1, line("progression", f"{grows:.4g} 1/m"))
    return lines


def _version_and_units(tire: Tire) -> list[str]:
    """The version and the reason for it, and the units, from the notes."""
    given = {label: each for each in tire.notes for label in LABELS if each.startswith(label)}
    version = given.get(VERSION, f"{VERSION} {tire.version}")
    converted = given.get(UNITS_READ, "").removeprefix(UNITS_READ)
    units = f"SI, converted from {converted}" if converted else "SI"
    return [line("version", version), line("units", units)]


def _has_line(note: str) -> bool:
    return note.startswith(LABELS)


def _note(note: str) -> str:
    is_warning = note.startswith(WARNING)
    return line("warning" if is_warning else "note", note.removeprefix(WARNING))


def _range(low: float, high: float, unit: str) -> str:
    if math.isinf(low) and math.isinf(high):
        return "not given"
    return f"{low:g} to {high:g} {unit}".rstrip()


def table_lines(tire: Tire, conditions: list) -> list[str]:
    """Stiffnesses and peak friction under each condition."""
    from vehicle_roll_sim.analysis.tire_curves import figures
    from vehicle_roll_sim.offline.tire_points import own_pressure

    rows = [HEADER, UNITS]
    for each in conditions:
        pressure = (each.pressure or own_pressure(tire)) / KILO
        shown = "-" if math.isnan(pressure) else f"{pressure:.4g}"
        its = figures(tire, each)
        rows.append(
            f"{each.normal_force:8.5g}{each.inclination:8.3g}{shown:>10}"
            f"{its.slip_stiffness / KILO:14.2f}{its.cornering_stiffness / KILO:15.2f}"
            f"{its.braking:10.3f}{its.driving:9.3f}"
            f"{its.positive_angle:8.3f}{its.negative_angle:8.3f}"
        )
    return rows
