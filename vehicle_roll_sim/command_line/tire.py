"""`vehicle_roll_sim tire`: what a tire file contains, and how the tire behaves."""

import argparse
import dataclasses
import sys
from pathlib import Path

from vehicle_roll_sim.arguments import OneLineParser, named_file, number
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.command_line.tire_lines import read_lines, table_lines
from vehicle_roll_sim.declaration import InputError, parameter, parameters_of
from vehicle_roll_sim.files.output_file import check_distinct, check_figure_format, check_writable
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.vehicle.tire.lateral_only import FROM_LATERAL
from vehicle_roll_sim.vehicle.tire_file import Tire, load_tire

MOST_LOADS, MOST_OTHERS = 6, 4
"""As many as the figure has colours and line styles."""


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
    tire = load_tire(named_file(arguments.file, "FILE"), _longitudinal(arguments))
    for pressure in asked_for["pressure"]:
        tire.check_pressure(pressure, "--pressure")
    with signals.exit_on_signal():
        compile_model()
    signals.import_interruptibly("offline.tire_points", *(["analysis.tire_figure"] if plot else []))
    from vehicle_roll_sim.analysis import tire_curves
    from vehicle_roll_sim.offline import tire_points

    points = tire_points.read_points(asked, tire) if asked else None
    loads, cambers, pressures = asked_for.values()
    conditions = tire_curves.conditions(tire, loads, cambers, pressures)
    lines = [*read_lines(tire), "", *table_lines(tire, conditions), ""]
    if plot or (table and not asked):
        _write_curves(tire, conditions, plot, None if asked else table)
    if asked:
        _write_answers(tire, points, table, arguments.as_simulated)
    shown = points if asked else tire_points.columns_of(conditions)
    kind = "points" if asked else "conditions"
    for label, count in tire_points.outside(tire, shown).items():
        said = f"{count} of {len(shown['normal_force'])} {kind}"
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
    parser.add_argument(
        "--longitudinal",
        metavar=FROM_LATERAL,
        default="",
        help="derive the longitudinal force of a file that has none from its lateral force",
    )
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


def _longitudinal(arguments: argparse.Namespace) -> str:
    """How a missing longitudinal force is replaced."""
    if arguments.longitudinal not in ("", FROM_LATERAL):
        raise InputError("--longitudinal", arguments.longitudinal, FROM_LATERAL)
    return arguments.longitudinal


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
