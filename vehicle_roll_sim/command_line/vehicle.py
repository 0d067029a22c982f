"""`vehicle_roll_sim vehicle`: what a vehicle file contains, and what follows from it."""

import argparse
import math
from collections.abc import Iterator

from vehicle_roll_sim.arguments import OneLineParser, add_declared, declared_values
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.command_line.linearize import SteadyDriving, pole_table
from vehicle_roll_sim.command_line.parameters import value_of
from vehicle_roll_sim.command_line.plausibility_option import add_strict, warn_or_refuse
from vehicle_roll_sim.command_line.vehicle_options import (
    add_changes,
    chosen_options,
    read_vehicle,
)
from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.axle_tires import vertical_stiffness
from vehicle_roll_sim.vehicle.combinations import combinations
from vehicle_roll_sim.vehicle.derived_values import AXLES, GRAVITY
from vehicle_roll_sim.vehicle.figures import figures_of
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.plausibility import plausibility

TURNING = ("steering", "lateral_acceleration")
"""What the options do not offer: the driving is straight ahead."""
AXLE_ROWS = {
    "wheel load": ("wheel_load", 1.0, "N"),
    "static spring compression": ("spring_compression", 1e3, "mm"),
    "static tire compression": ("tire_compression", 1e3, "mm"),
    "ride rate, at a wheel": ("ride_rate", 1e-3, "kN/m"),
    "ride frequency": ("ride_frequency", 1.0, "Hz"),
    "wheel hop frequency": ("hop_frequency", 1.0, "Hz"),
    "damping ratio": ("damping_ratio", 1.0, ""),
    "roll stiffness of springs": ("spring_roll_stiffness", 1e-3, "kN m/rad"),
    "of the anti-roll bar": ("bar_roll_stiffness", 1e-3, "kN m/rad"),
    "of the tires": ("tire_roll_stiffness", 1e-3, "kN m/rad"),
    "of all in series": ("roll_stiffness", 1e-3, "kN m/rad"),
    "roll centre height": ("roll_centre_height", 1e3, "mm"),
}
"""Rows of the table of axles: fields of AxleFigures, with factor and unit as shown."""


def vehicle_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    arguments = _parser(program).parse_args(words)
    speed = SteadyDriving(**declared_values(arguments, SteadyDriving)).speed
    vehicle = read_vehicle(arguments)
    options = chosen_options(arguments, vehicle)
    doubts = [*plausibility(vehicle), *combinations(vehicle)]
    if arguments.refuse_warnings:
        warn_or_refuse(doubts, arguments)
    options = options.for_vehicle(vehicle)
    with signals.exit_on_signal():
        compile_model()
    signals.import_interruptibly("offline.linearizing", "analysis.handling")
    name = arguments.vehicle or "the reference vehicle"
    lines = [
        line("vehicle", name),
        line("model", options.model),
        *_tire_lines(vehicle),
        "",
        *_read_lines(vehicle),
        "",
    ]
    lines += [*_figure_lines(vehicle), *_turning_lines(vehicle, options, speed), ""]
    lines += [*_axle_lines(vehicle), *_mode_lines(vehicle, options, speed)]
    lines += [line("warning", doubt) for doubt in doubts]
    print("\n".join(lines))
    return 0


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=program, usage=f"{program} [FILE] [options]", description=COMMANDS["vehicle"]
    )
    parser.add_argument(
        "vehicle",
        metavar="FILE",
        nargs="?",
        help="vehicle file, or name of a shipped vehicle (default: the reference vehicle)",
    )
    group = parser.add_argument_group("vehicle")
    add_changes(group)
    add_strict(group)
    add_declared(parser, SteadyDriving, "gradients and modes", without=TURNING)
    add_declared(parser, Options, "model")
    return parser


def _tire_lines(vehicle: Vehicle) -> Iterator[str]:
    for name, tire in vehicle.own_tires.items():
        label = "tires" if name == "tire" else f"{name}s".replace("_", " ")
        yield line(label, f"{tire.file}: Magic Formula {tire.version}")


def _read_lines(vehicle: Vehicle) -> Iterator[str]:
    """Every value that the vehicle has, and its origin unless the file gives it."""
    for name, declared in parameters_of(Vehicle).items():
        value, source = value_of(vehicle, name)
        if value is None:
            continue
        if not source and name in vehicle.given and value == declared.default:
            source = "default"
        source = source or _of_tire_file(vehicle, name)
        shown = f"{len(value)} points" if isinstance(value, tuple) else f"{value:.6g}"
        yield _value_line(name, shown, declared.unit, source)
    for load in vehicle.payload:
        place = f"{load.behind_front_axle:g} m behind the front axle, {load.height:g} m high, "
        place += f"{load.left_of_middle:g} m to the left"
        yield _value_line("payload", f"{load.mass:.6g}", "kg", place)
    if vehicle.payload:
        yield "with this payload:"
        for name, value in vehicle.origin.derived.items():
            if value is not None:
                yield _value_line(name, f"{value:.6g}", parameters_of(Vehicle)[name].unit, "")


def _of_tire_file(vehicle: Vehicle, name: str) -> str:
    """What the tire files have in place of a radius or stiffness that the vehicle file gives."""
    found = {}
    for axle, tire in vehicle.axle_tires.items():
        if name in ("tire_radius", f"{axle}_tire_radius"):
            found["UNLOADED_RADIUS", tire.coefficients["UNLOADED_RADIUS"]] = None
        elif name == f"{axle}_tire_stiffness":
            stiffness = vertical_stiffness(tire, vehicle.at_axle(axle, "tire_pressure"))
            found["VERTICAL_STIFFNESS", stiffness] = None
    shown = [f"{key} of the tire file: {value:.6g}" for key, value in found if value]
    return "; ".join(shown)


def _value_line(name: str, shown: str, unit: str, about: str) -> str:
    return f"{name:33}{shown:>12} {unit}{f'  ({about})' if about else ''}".rstrip()


def _figure_lines(vehicle: Vehicle) -> list[str]:
    figures = figures_of(vehicle)
    unsprung = figures.mass - vehicle.sprung_mass
    behind, height = figures.cg_to_front_axle, figures.cg_height
    gradient = math.degrees(figures.roll_gradient) * GRAVITY
    on_left = [line("load on the left wheels", f"{100 * figures.left_share:.3g} %")]
    return [
        line("mass", f"{figures.mass:.6g} kg, {unsprung:.6g} kg of it unsprung"),
        line("wheelbase", f"{figures.wheelbase:.4g} m"),
        line("c.g. of the whole", f"{behind:.4g} m behind the front axle, {height:.4g} m high"),
        line("load on the front axle", f"{100 * (1 - behind / figures.wheelbase):.3g} %"),
        *(on_left if vehicle.cg_offset else []),
        line("static stability factor", f"{figures.static_stability_factor:.4g}"),
        line("roll axis", f"{figures.roll_axis_depth:.4g} m below the sprung c.g."),
        line("roll stiffness", f"{figures.roll_stiffness / 1e3:.4g} kN m/rad, tires included"),
        line("share of the front", f"{100 * figures.front_share:.3g} %"),
        line("roll gradient, at rest", f"{gradient:.3g} deg/g, in closed form"),
    ]


def _turning_lines(vehicle: Vehicle, options: Options, speed: float) -> list[str]:
    from vehicle_roll_sim.analysis.handling import gradients_of

    try:
        gradients = gradients_of(vehicle, options, speed=speed)
    except InputError as error:
        return [line("steady turn", f"none at {speed:g} m/s: {error}")]
    slopes = {"understeer gradient": gradients.understeer, "roll gradient": gradients.roll}
    return [
        *(
            line(label, f"{math.degrees(slope) * GRAVITY:.3g} deg/g at {speed:.4g} m/s")
            for label, slope in slopes.items()
        ),
        line(*_limit_of_speed(vehicle, gradients.understeer)),
    ]


def _limit_of_speed(vehicle: Vehicle, understeer: float) -> tuple[str, str]:
    """Characteristic or critical speed: at which L = |K| u^2 (K in rad/(m/s^2))."""
    wheelbase = vehicle.wheelbase
    label = "critical speed" if understeer < 0.0 else "characteristic speed"
    speed = math.sqrt(wheelbase / abs(understeer)) if understeer else math.inf
    return label, f"{speed:.4g} m/s"


def _axle_lines(vehicle: Vehicle) -> list[str]:
    axles = figures_of(vehicle).axles
    rows = [f"{'axle':28}" + "".join(f"{axle:>12}" for axle in AXLES)]
    for label, (field, factor, unit) in AXLE_ROWS.items():
        values = (f"{factor * getattr(axles[axle], field):12.4g}" for axle in AXLES)
        rows.append(f"{label:28}{''.join(values)}  {unit}".rstrip())
    return rows


def _mode_lines(vehicle: Vehicle, options: Options, speed: float) -> list[str]:
    """The oscillations of the body and the wheels, driving straight ahead."""
    from vehicle_roll_sim.analysis.modes import modes_of, natural_modes
    from vehicle_roll_sim.offline.linearizing import linearize

    try:
        model = linearize(vehicle, options=options, speed=speed)
    except InputError as error:
        return ["", line("modes", f"none at {speed:g} m/s: {error}"), ""]
    modes = natural_modes(modes_of(model.a, model.state_names))
    return pole_table("motion", ((mode, motion) for motion, mode in modes.items()))
