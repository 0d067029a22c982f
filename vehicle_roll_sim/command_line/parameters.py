"""`vehicle_roll_sim parameters`: the vehicle's parameters as a Markdown table."""

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.vehicle_options import add_vehicle_options, chosen_vehicle
from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.vehicle.actuator_parameters import OF_ACTUATORS
from vehicle_roll_sim.vehicle.derived_values import AXLES
from vehicle_roll_sim.vehicle.parameters import Vehicle

UNKNOWN = "–"
"""Value of a parameter that is not given and has no default."""
HEADER = ("name", "symbol", "value", "unit", "allowed", "meaning")


def parameters_command(words: list[str], program: str) -> int:
    """Run the command with the arguments after its name; return the exit status."""
    parser = OneLineParser(prog=program, description=COMMANDS["parameters"])
    add_vehicle_options(parser)
    print(parameter_table(chosen_vehicle(parser.parse_args(words))))
    return 0


def parameter_table(vehicle: Vehicle) -> str:
    """A Markdown table of the parameters of `vehicle`."""
    rows = [HEADER, ("---",) * len(HEADER)]
    for name, parameter in parameters_of(Vehicle).items():
        allowed = f"{parameter.minimum:g} … {parameter.maximum:g}"
        value, source = value_of(vehicle, name)
        shown = UNKNOWN if value is None else in_words(value)
        meaning = parameter.description + (f" (here: {source})" if source else "")
        rows.append((f"`{name}`", parameter.symbol, shown, parameter.unit, allowed, meaning))
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def in_words(value: float | tuple) -> str:
    """A number, or the points of a table over wheel travel."""
    if isinstance(value, tuple):
        return "[" + ", ".join(f"[{travel:.10g}, {at:.10g}]" for travel, at in value) + "]"
    return f"{value:.10g}"


def value_of(vehicle: Vehicle, name: str) -> tuple[float | tuple | None, str]:
    """The value of a parameter and, if it was not given, where it comes from; None without value.

    A roll centre height has a value also if its alternative was given, and the tires of an axle
    have what was given for all.
    """
    taken = vehicle.from_tires | vehicle.lateral_stiffness_from_tires
    if name in vehicle.given:
        return vehicle.given[name], ""
    if name in taken:
        return taken[name]
    if vehicle.origin and vehicle.origin.derived.get(name) is not None:
        return vehicle.origin.derived[name], "from the mass of the whole vehicle and its payload"
    axle, _, measure = name.partition("_")
    if axle not in AXLES or name in OF_ACTUATORS:
        return None, ""
    if "roll_centre" in measure:
        other = "height" if measure.endswith("depth") else "depth"
        source = f"cg_height less {axle}_roll_centre_{other}"
        return float(getattr(vehicle, measure)[AXLES[axle]]), source
    if measure == "anti_roll_bar_rate" and f"{axle}_anti_roll_bar_stiffness" in vehicle.given:
        source = f"{axle}_anti_roll_bar_stiffness over the square of {axle}_track"
        return float(vehicle.bar_rate[AXLES[axle]]), source
    value = vehicle.at_axle(axle, measure)
    return value, "" if value is None else measure
