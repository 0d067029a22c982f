"""The simulator's ROS parameters: declared once, checked, described to whoever asks."""

import dataclasses
import math

from rcl_interfaces.msg import (
    FloatingPointRange,
    ParameterDescriptor,
    ParameterType,
    SetParametersResult,
)
from rclpy.node import Node

from vehicle_roll_sim.declaration import (
    InputError,
    Parameter,
    parameter,
    parameters_of,
    unknown_name,
    validated,
)
from vehicle_roll_sim.model.events import MINIMUM_SPEED
from vehicle_roll_sim.simulation.command_inbox import CENTRE, HOLD
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import (
    DEFAULT_ROLLOVER_ANGLE,
    DEFAULT_SPEED,
    DEFAULT_STEP,
    MAXIMUM_SPEED,
)
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire_file import load_tire
from vehicle_roll_sim.vehicle.vehicle_file import load_vehicle, preset

VEHICLE_PREFIX = "vehicle."
TIRE = VEHICLE_PREFIX + "tire"
OF_EVERY_NODE = ("use_sim_time", "start_type_description_service", "qos_overrides.")
"""Parameters, or beginnings of their names, that rclpy itself knows."""
ROS_TYPES = {
    float: ParameterType.PARAMETER_DOUBLE,
    bool: ParameterType.PARAMETER_BOOL,
    str: ParameterType.PARAMETER_STRING,
}


@dataclasses.dataclass
class Settings:
    """How the simulator runs; the options of the model and the vehicle are declared beside it."""

    publish_rate: float = parameter("sets published a second", "Hz", 0.1, 10_000.0, default=100.0)
    step: float = parameter("integration step", "s", 1e-6, 0.1, default=DEFAULT_STEP)
    initial_speed: float = parameter(
        "forward speed after a reset",
        "m/s",
        MINIMUM_SPEED,
        MAXIMUM_SPEED,
        tunable=True,
        default=DEFAULT_SPEED,
    )
    rollover_angle: float = parameter(
        "roll angle at which the integration stops",
        "rad",
        0.01,
        math.pi / 2,
        default=DEFAULT_ROLLOVER_ANGLE,
    )
    command_timeout: float = parameter(
        "simulated time without a message after which a command is given up, 0: never",
        "s",
        0.0,
        3600.0,
        tunable=True,
        default=0.5,
    )
    steering_timeout_policy: str = parameter(
        "what a given-up steering command does", choices=(HOLD, CENTRE), tunable=True, default=HOLD
    )
    publish_clock: bool = parameter(
        "publish /clock, and stamp messages with simulated time from 0", default=False
    )
    frame_prefix: str = parameter("put before the frames in all messages", default="")
    vehicle_file: str = parameter("vehicle file (YAML); empty: the reference vehicle", default="")


@dataclasses.dataclass(frozen=True)
class Declared:
    """Everything the parameters said."""

    settings: Settings
    options: Options
    vehicle: Vehicle


def declare(node: Node) -> Declared:
    """Declare all parameters on `node` and read them; raises InputError naming one."""
    _refuse_unknown(node)
    settings = Settings(**_declare_class(node, Settings))
    options = Options(**_declare_class(node, Options))
    vehicle = load_vehicle(settings.vehicle_file) if settings.vehicle_file else preset()
    tire = _declare(node, TIRE, vehicle.tire.file, _descriptor(str, "tire file (.tir)"))
    if tire != vehicle.tire.file:
        vehicle = dataclasses.replace(vehicle, tire=load_tire(tire))
    values = {
        name: _declare(node, VEHICLE_PREFIX + name, getattr(vehicle, name), _described(parameter))
        for name, parameter in parameters_of(Vehicle).items()
    }
    return Declared(settings, options, vehicle.with_values(values, VEHICLE_PREFIX))


def follow_changes(node: Node, settings: Settings) -> None:
    """Keep `settings` up to date with the tunable parameters; refuse values out of range."""
    known = parameters_of(Settings)

    def check(changes) -> SetParametersResult:
        try:
            checked = validated(
                Settings, {change.name: change.value for change in changes if change.name in known}
            )
        except InputError as error:
            return SetParametersResult(successful=False, reason=str(error))
        for name, value in checked.items():
            setattr(settings, name, value)
        return SetParametersResult(successful=True)

    node.add_on_set_parameters_callback(check)


def names() -> tuple[str, ...]:
    """Every parameter of the simulator."""
    vehicle = (VEHICLE_PREFIX + name for name in parameters_of(Vehicle))
    return (*parameters_of(Settings), *parameters_of(Options), TIRE, *vehicle)


def _refuse_unknown(node: Node) -> None:
    for name in node._parameter_overrides:  # rclpy has no public way to see them undeclared
        if name not in names() and not name.startswith(OF_EVERY_NODE):
            raise unknown_name(name, names(), "parameter")


def _declare_class(node: Node, declaring) -> dict:
    values = {
        name: _declare(node, name, parameter.default, _described(parameter))
        for name, parameter in parameters_of(declaring).items()
    }
    return validated(declaring, values)


def _declare(node: Node, name: str, default, descriptor: ParameterDescriptor):
    return node.declare_parameter(name, default, descriptor).value


def _described(parameter: Parameter) -> ParameterDescriptor:
    unit = f" ({parameter.unit})" if parameter.unit else ""
    choices = f": {' or '.join(parameter.choices)}" if parameter.choices else ""
    text = parameter.description + choices + unit
    descriptor = _descriptor(parameter.kind, text, not parameter.tunable)
    if parameter.kind is float:
        allowed = FloatingPointRange(from_value=parameter.minimum, to_value=parameter.maximum)
        descriptor.floating_point_range.append(allowed)
    return descriptor


def _descriptor(kind: type, description: str, read_only: bool = True) -> ParameterDescriptor:
    """Typed dynamically, so that an integer serves for a number; the type is checked here."""
    return ParameterDescriptor(
        type=ROS_TYPES[kind], description=description, read_only=read_only, dynamic_typing=True
    )
