"""`vehicle_roll_sim linearize`: A, B, C, D of the model about steady driving, and its poles."""

import argparse
import dataclasses
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from vehicle_roll_sim.arguments import OneLineParser, add_declared, declared_values, named_file
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.command_line.vehicle_options import (
    add_vehicle_options,
    as_option,
    chosen_options,
    chosen_vehicle,
)
from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.files.output_file import check_writable
from vehicle_roll_sim.manoeuvres.catalogue import STEEPEST
from vehicle_roll_sim.model.records import ROLL, WHEELS
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.limits import DEFAULT_SPEED, MAXIMUM_SPEED
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

if TYPE_CHECKING:
    from vehicle_roll_sim.analysis.modes import Mode  # scipy takes 0.25 s to import

HARDEST = 30.0
"""m/s^2: no tire can hold a turn this hard."""
HEADER = f"{'real':>10}{'imaginary':>12}{'frequency':>11}{'damping':>9}{'time const.':>13}"
UNITS = f"{'1/s':>10}{'1/s':>12}{'Hz':>11}{'':9}{'s':>13}"


@dataclasses.dataclass(frozen=True)
class SteadyDriving:
    """The steady driving condition about which the model is linearised."""

    speed: float = parameter(
        "forward speed, held by torque at the rear wheels",
        "m/s",
        0.0,
        MAXIMUM_SPEED,
        default=DEFAULT_SPEED,
    )
    steering: float = parameter(
        "front road-wheel angle, left positive", "deg", -STEEPEST, STEEPEST, default=0.0
    )
    lateral_acceleration: float = parameter(
        "solve for the steering that gives this steady lateral acceleration, left positive",
        "m/s^2",
        -HARDEST,
        HARDEST,
        default=0.0,
    )


def linearize_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser(program).parse_args(words)
    given = declared_values(arguments, SteadyDriving)
    if len(given.keys() & {"steering", "lateral_acceleration"}) > 1:
        turn = given["lateral_acceleration"]
        raise InputError("--lateral-acceleration", turn, "not together with --steering")
    file = named_file(arguments.npz, "--npz")
    if file:
        check_writable(file, "--npz")
    vehicle = chosen_vehicle(arguments)
    options = chosen_options(arguments, vehicle)
    with signals.exit_on_signal():
        model = _linear_model(vehicle, options, given)
    if file:
        model.write_npz(file)
    lines = [*_trim_lines(model), *_pole_lines(model)]
    print("\n".join([*lines, *([line("NPZ", file)] if file else [])]))
    return 0


def _linear_model(vehicle: Vehicle, options: Options, given: dict):
    """The model linearised about the steady driving that the options describe."""
    compile_model()
    from vehicle_roll_sim.offline.linearizing import linearize  # scipy takes 0.25 s to import

    driving = dict(given)
    if "steering" in driving:
        driving["steering"] = math.radians(driving["steering"])
    try:
        return linearize(vehicle, options=options, **driving)
    except InputError as error:
        if error.field == "steering":
            error.value = given["steering"]
        raise as_option(error) from None


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(prog=program, description=COMMANDS["linearize"])
    add_declared(parser, SteadyDriving, "steady driving")
    add_declared(parser, Options, "model")
    add_vehicle_options(parser)
    group = parser.add_argument_group("results")
    group.add_argument("--npz", metavar="FILE", help="write the matrices, names and trim state")
    return parser


def _trim_lines(model) -> list[str]:
    """The trim state, one quantity per line."""
    trim = model.trim
    loads = ", ".join(
        f"{wheel} {load:.1f}" for wheel, load in zip(WHEELS, trim.outputs.normal_force, strict=True)
    )
    now = dict(zip(model.output_names, model.trim_output, strict=True))
    state = dict(zip(model.state_names, model.trim_state, strict=True))
    return [
        line("speed", f"{state['u']:.3f} m/s"),
        line("steering", f"{math.degrees(trim.inputs[0]):.4f} deg"),
        line("lateral acceleration", f"{now['lateral_acceleration']:.4f} m/s^2"),
        line("roll angle", f"{math.degrees(trim.state[ROLL]):.4f} deg"),
        line("yaw rate", f"{math.degrees(now['yaw_rate']):.4f} deg/s"),
        line("sideslip angle", f"{math.degrees(now['sideslip_angle']):.4f} deg"),
        line("torque at each rear wheel", f"{trim.drive_torque:.3f} N m"),
        line("tire loads", f"{loads} N"),
        line("states", _in_short(model.state_names)),
        line("inputs", _in_short(model.input_names)),
        line("outputs", _in_short(model.output_names)),
        line("finite-difference check", f"twice the step changes slopes by {model.step_error:.1e}"),
    ]


def _in_short(names: tuple[str, ...]) -> str:
    """The number of names and the names, with those of the four wheels abbreviated."""
    first, *others = (f"_{wheel}" for wheel in WHEELS)
    kept = [name for name in names if not name.endswith(tuple(others))]
    shown = (f"{name} … {WHEELS[-1]}" if name.endswith(first) else name for name in kept)
    return f"{len(names)}: {', '.join(shown)}"


def _pole_lines(model) -> list[str]:
    """The poles as a table, slowest first; a complex pair takes one line."""
    from vehicle_roll_sim.analysis.modes import modes_of

    modes = modes_of(model.a, model.state_names)
    return pole_table("states", ((mode, ", ".join(mode.states)) for mode in modes))


def pole_table(about: str, modes: "Iterable[tuple[Mode, str]]") -> list[str]:
    """Modes as a table, each with what is said of it in the last column, named `about`."""
    rows = ["", f"{HEADER}  {about}", UNITS]
    for mode, said in modes:
        pole = mode.pole
        swing = f"±{pole.imag:.4f}" if pole.imag else "0"
        damping = "-" if math.isnan(mode.damping) else f"{mode.damping:.4f}"
        constant = "-" if math.isinf(mode.time_constant) else f"{mode.time_constant:.4f}"
        numbers = f"{pole.real:10.4f}{swing:>12}{mode.frequency:11.4f}{damping:>9}{constant:>13}"
        rows.append(f"{numbers}  {said}")
    return [*rows, ""]
