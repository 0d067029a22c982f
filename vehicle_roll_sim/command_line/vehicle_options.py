"""The options that define the simulation: vehicle, model, road and integration."""

import argparse
import dataclasses
import math

from vehicle_roll_sim.arguments import add_declared, declared_values, named_file, number
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.compiling import compile_model
from vehicle_roll_sim.command_line.plausibility_option import add_strict, warn_or_refuse
from vehicle_roll_sim.declaration import InputError, Table, parameters_of, unknown_name
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.on_roads.own_road import road_for
from vehicle_roll_sim.simulation.integration import Integration
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.plausibility import plausibility
from vehicle_roll_sim.vehicle.shipped import vehicle_named
from vehicle_roll_sim.vehicle.vehicle_file import NO_NUMBERS, TIRES, no_parameter, on_tires, preset


def add_simulation_options(parser: argparse.ArgumentParser) -> None:
    """Add all options that `chosen_simulation` reads."""
    add_declared(parser, Options, "model")
    add_road_options(parser)
    add_vehicle_options(parser)
    add_declared(parser, Integration, "integration")


def chosen_simulation(
    arguments: argparse.Namespace, manoeuvre: Manoeuvre | None = None
) -> Simulation:
    """The simulation that the options of `add_simulation_options` describe.

    manoeuvre: to be driven; if it brings a road, the simulation has this road. Raises InputError if
    the options then describe a road too.
    """
    integration = Integration(**declared_values(arguments, Integration))
    vehicle = chosen_vehicle(arguments)
    options = chosen_options(arguments, vehicle)
    road = chosen_road(arguments)
    if manoeuvre:
        try:
            road = road_for(manoeuvre, road)
        except InputError as error:
            raise as_option(error) from None
    with signals.exit_on_signal():
        compile_model()
    return Simulation(
        vehicle,
        options,
        step=integration.step,
        rollover_angle=math.radians(integration.stop_roll),
        road=road,
    )


def add_road_options(parser: argparse.ArgumentParser) -> None:
    """Add all options that `chosen_road` reads."""
    group = parser.add_argument_group("road")
    about = "road file (YAML) with grade, bank and features; --grade and --bank override its values"
    group.add_argument("--road", metavar="FILE", help=about)
    add_declared(parser, Road, "road")


def chosen_road(arguments: argparse.Namespace) -> Road:
    """The road that the options of `add_road_options` describe; raises InputError."""
    file = named_file(arguments.road, "--road")
    road = Road.from_file(file) if file else Road()
    try:
        return dataclasses.replace(road, **declared_values(arguments, Road))
    except InputError as error:
        raise as_option(error) from None


def add_vehicle_options(parser: argparse.ArgumentParser) -> None:
    """Add all options that `chosen_vehicle` reads."""
    group = parser.add_argument_group("vehicle")
    group.add_argument(
        "--vehicle",
        metavar="FILE",
        help="vehicle file, or name of a shipped vehicle (default: the reference vehicle)",
    )
    add_changes(group)
    add_strict(group)


def add_changes(group: argparse._ArgumentGroup) -> None:
    """Add the options that change the vehicle of a file."""
    for name, whose in zip(TIRES, ("the vehicle's own", *("that of this axle",) * 2), strict=True):
        about = f"tire file to use instead of {whose}"
        group.add_argument(_option(name), metavar="FILE.tir", help=about)
    group.add_argument(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="override one value of the vehicle file; repeatable",
    )


def chosen_vehicle(arguments: argparse.Namespace) -> Vehicle:
    """The vehicle that the options of `add_vehicle_options` describe; raises InputError.

    Warns of values that are not plausible, or refuses them.
    """
    vehicle = read_vehicle(arguments)
    warn_or_refuse(plausibility(vehicle), arguments)
    return vehicle


def read_vehicle(arguments: argparse.Namespace) -> Vehicle:
    """The same vehicle, plausible or not."""
    vehicle_file = named_file(arguments.vehicle, "--vehicle")
    tires = {name: named_file(getattr(arguments, name), _option(name)) for name in TIRES}
    vehicle = vehicle_named(vehicle_file) if vehicle_file else preset()
    try:
        vehicle = on_tires(vehicle, {name: file for name, file in tires.items() if file})
    except InputError as error:
        raise as_option(error) if error.field in TIRES else error from None
    known = parameters_of(Vehicle)
    values = {}
    for assignment in arguments.set:
        name, equals, text = assignment.partition("=")
        if not equals:
            raise InputError("--set", assignment, "NAME=VALUE")
        if name in NO_NUMBERS:
            has_option = name in (*TIRES, *parameters_of(Options))
            raise no_parameter(name, "--set", _option(name) if has_option else "", "--vehicle")
        if name not in known:
            raise unknown_name(name, (*known, *NO_NUMBERS), "--set")
        if name in values:
            raise InputError(f"--set {name}", text, "each name once", "given twice")
        if known[name].kind is Table:
            allowed = "write it into a vehicle file (--vehicle)"
            raise InputError(f"--set {name}", text, allowed, "a table is no number")
        values[name] = number(text, f"--set {name}", known[name])
    return vehicle.with_values(values, "--set ")


def _option(name: str) -> str:
    return "--" + name.replace("_", "-")


def chosen_options(arguments: argparse.Namespace, vehicle: Vehicle) -> Options:
    """The options of the model, which is that of the vehicle file unless another is given.

    Raises InputError under the option's name for a bad combination.
    """
    values = declared_values(arguments, Options)
    try:
        return options_for(vehicle, **values)
    except InputError as error:
        raise as_option(error) from None


def as_option(error: InputError) -> InputError:
    """The same error, reported for the command-line option of that name.

    An error that already says where the value was given, such as a line of a file, stays as it is.
    """
    if not error.field.isidentifier():
        return error
    return type(error)(_option(error.field), error.value, error.allowed, error.problem)
