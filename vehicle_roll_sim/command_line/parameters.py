"""`vehicle_roll_sim parameters`: the vehicle's parameters as a Markdown table."""

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.command_line.commands import COMMANDS
from vehicle_roll_sim.command_line.vehicle_options import add_vehicle_options, chosen_vehicle
from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.vehicle.derived_values import AXLES
from vehicle_roll_sim.vehicle.parameters import Vehicle

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
        value = f"{_value(vehicle, name):.10g}"
        meaning = parameter.description
        rows.append((f"`{name}`", parameter.symbol, value, parameter.unit, allowed, meaning))
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def _value(vehicle: Vehicle, name: str) -> float:
    """The value of a parameter; a roll centre height also if its alternative was given."""
    if name in vehicle.given:
        return vehicle.given[name]
    axle, _, measure = name.partition("_")
    return float(getattr(vehicle, measure)[AXLES[axle]])
