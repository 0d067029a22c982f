"""`vehicle_roll_sim tire`: what a tire file contains, and how the tire behaves."""

import argparse
import dataclasses
import math
import sys
from pathlib import Path

from vehicle_roll_sim.arguments import OneLineParser, named_file, number
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.declaration import InputError, parameter, parameters_of
from vehicle_roll_sim.files.output_file import check_distinct, check_figure_format, check_writable
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.vehicle.tire_file import Tire, load_tire

MOST_LOADS, MOST_OTHERS = 6, 4
"""As many as the figure has colours and line styles."""
HEADER = (
    f"{'load':>8}{'incl.':>8}{'pressure':>10}{'slip stiffn.':>14}{'cornering st.':>15}"
    f"{'braking':>10}{'driving':>9}{'α > 0':>8}{'α < 0':>8}"
)
UNITS = f"{'N':>8}{'rad':>8}{'kPa':>10}{'kN':>14}{'kN/rad':>15}{'peak force over load':>35}"
KILO = 1e3
VERSION, UNITS_READ, WARNING = "Magic Formula", "converted to SI units: ", "warning: "
"""The beginnings of notes on version and units, and of warnings."""
LABELS = (VERSION, UNITS_READ)


@dataclasses.dataclass(frozen=True)
class TireConditions:
    """The conditions of the table, the figure and its data."""

    load: float = parameter("tire loads (default: 0.5, 1, 1.5 and 2 times nominal)", "N", 1.0, 1e6)
    camber: float = parameter("inclination angles of the wheel (default 0)", "rad", -1.0, 1.0)
    pressure: float = parameter("inflation pressures (default: that of the file)", "Pa", 1e3, 1e7)


def tire_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser(program).parse_args(words)
    plot, table, asked = _files(arguments)
    asked_for = _conditions(arguments)
    tire = load_tire(named_file(arguments.file, "FILE"))
    if asked_for["pressure"] and tire.version == "5.2":
        wanted = "no pressure for a file of Magic Formula 5.2, which has none"
        raise InputError("--pressure", asked_for["pressure"][0], wanted)
    with signals.exit_on_signal():
        compile_model()
    signals.import_interruptibly("offline.tire_points", *(["analysis.tire_figure"] if plot else []))
    from vehicle_roll_sim.analysis import tire_curves
    from vehicle_roll_sim.offline import tire_points

    points = tire_points.read_points(asked, tire) if asked else None
    loads, cambers, pressures = asked_for.values()
    conditions = tire_curves.conditions(tire, loads, cambers, pressures)
    lines = [*_read_lines(tire), "", *_table_lines(tire, conditions), ""]
    if plot or (table and not asked):
        _write_curves(tire, conditions, plot, None if asked else table)
    if asked:
        _write_answers(tire, points, table, arguments.as_simulated)
        for label, count in tire_points.outside(tire, points).items():
            said = f"{count} of {len(points['speed'])} points"
            lines.append(line(f"outside {label} range", said))
    written = [line(label, path) for label, path in (("plot", plot), ("CSV", table)) if path]
    print("\n".join([*lines, *written]))
    return 0


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=program,
        usage=f"{program} FILE [options]",
        description=COMMANDS["tire"],
        epilog="Axes of the contact patch as in ISO 8855 (TYDEX W): x forward, y left, z up.",
    )
    parser.add_argument("file", metavar="FILE", help="tire file (.tir)")
    group = parser.add_argument_group("conditions (every combination is shown)")
    for declared in parameters_of(TireConditions).values():
        group.add_argument(
            f"--{declared.name}",
            metavar=declared.unit.upper(),
            nargs="+",
            action="extend",
            default=[],
            help=declared.description,
        )
    group = parser.add_argument_group("results")
    group.add_argument(
        "--plot",
        metavar="FILE",
        help="figure of Fx, Fy and Mz over slip, and of combined forces: PNG, SVG or PDF",
    )
    group.add_argument(
        "--csv", metavar="FILE", help="write the curves of the figure, or the answers to --points"
    )
    group.add_argument(
        "--points",
        metavar="FILE",
        help="CSV file of points to evaluate: normal_force (N), slip_ratio, slip_angle (rad), and "
        "optionally inclination (rad), pressure (Pa), speed (m/s), side (left or right)",
    )
    group.add_argument(
        "--as-simulated",
        action="store_true",
        help="evaluate --points as in the simulation, which limits the weights of combined slip to "
        "at least 0; in the published formula they can become negative far beyond the peak",
    )
    return parser


def _files(arguments: argparse.Namespace) -> tuple[Path | None, Path | None, Path | None]:
    """The figure and table to write and the points to read, checked as far as possible."""
    options = ("--plot", "--csv", "--points")
    plot, table, asked = (named_file(getattr(arguments, each[2:]), each) for each in options)
    if asked and not table:
        raise InputError("--csv", None, "required with --points: the file for the answers")
    if arguments.as_simulated and not asked:
        raise InputError("--as-simulated", "", "together with --points", "given alone")
    if plot:
        check_figure_format(plot, "--plot")
        check_writable(plot, "--plot")
    if table:
        check_writable(table, "--csv")
    read = {"FILE": named_file(arguments.file, "FILE"), "--points": asked}
    check_distinct(read | {"--plot": plot, "--csv": table})
    return plot, table, asked


def _conditions(arguments: argparse.Namespace) -> dict[str, list[float]]:
    """The requested loads, inclinations and pressures, without duplicates."""
    asked_for = {}
    for name, declared in parameters_of(TireConditions).items():
        field = f"--{name}"
        values = (number(text, field, declared) for text in getattr(arguments, name))
        checked = [declared.validate(value, field) for value in values]
        asked_for[name] = list(dict.fromkeys(checked))
    if len(asked_for["load"]) > MOST_LOADS:
        raise InputError("--load", f"{len(asked_for['load'])} loads", f"at most {MOST_LOADS}")
    others = max(len(asked_for["camber"]), 1) * max(len(asked_for["pressure"]), 1)
    if others > MOST_OTHERS:
        wanted = f"at most {MOST_OTHERS} combinations with --pressure"
        raise InputError("--camber", f"{others} combinations", wanted)
    return asked_for


def _write_answers(tire: Tire, points: dict, table: Path, as_simulated: bool) -> None:
    """Write the answers to points; report at how many the simulation would differ."""
    from vehicle_roll_sim.offline import tire_points

    simulated = tire_points.answers(tire, points)
    published = tire_points.answers(tire, points, as_published=True)
    tire_points.write_answers(table, points, simulated if as_simulated else published)
    count = tire_points.reversed_points(published, simulated)
    if count and not as_simulated:
        print(
            f"{signals.PROGRAM}: a weight of combined slip is negative at {count} of "
            f"{len(points['side'])} points; the simulation limits it to 0 (--as-simulated)",
            file=sys.stderr,
        )


def _write_curves(tire: Tire, conditions: list, plot: Path | None, table: Path | None) -> None:
    """Write the figure, its data, or both."""
    from vehicle_roll_sim.analysis import drawing, tire_curves, tire_figure
    from vehicle_roll_sim.offline import tire_points

    curves = tire_curves.curves_of(tire, conditions)
    if plot:
        title = f"{Path(tire.file).name}: Magic Formula {tire.version}"
        drawing.save_figure(tire_figure.tire_figure(curves, tire, title), plot)
    if table:
        every = [each for set_ in curves for each in set_]
        tire_points.write_curves(table, tire, every)


def _read_lines(tire: Tire) -> list[str]:
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
        said = f"{pressure:g} Pa (nominal {given['NOMPRES']:g} Pa)"
        lines.append(line("inflation pressure", said))
    for label, lowest, highest, unit in tire_points.LIMITS.values():
        if label != "pressure" or tire.version != "5.2":
            lines.append(line(f"{label} range", _range(given[lowest], given[highest], unit)))
    return [*lines, *(_note(each) for each in tire.notes if not _has_line(each))]


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


def _table_lines(tire: Tire, conditions: list) -> list[str]:
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
