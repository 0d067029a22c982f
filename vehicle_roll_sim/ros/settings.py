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
from rclpy.parameter import Parameter as RosParameter

from vehicle_roll_sim.declaration import (
    InputError,
    Parameter,
    parameter,
    parameters_of,
    unknown_name,
    validated,
)
from vehicle_roll_sim.model.events import MINIMUM_SPEED
from vehicle_roll_sim.simulation.command_inbox import CENTRE, DEFAULT_TIMEOUT, HOLD
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import (
    DEFAULT_ROLLOVER_ANGLE,
    DEFAULT_SPEED,
    DEFAULT_STEP,
    LONGEST_STEP,
    MAXIMUM_SPEED,
    SHORTEST_STEP,
)
from vehicle_roll_sim.simulation.speed_controller import DEFAULT_BRAKE_LIMIT, DEFAULT_DRIVE_LIMIT
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
    step: float = parameter(
        "integration step", "s", SHORTEST_STEP, LONGEST_STEP, default=DEFAULT_STEP
    )
    initial_speed: float = parameter(
        "forward speed after a reset",
        "m/s",
        0.0,
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
        default=DEFAULT_TIMEOUT,
    )
    steering_timeout_policy: str = parameter(
        "what a given-up steering command does", choices=(HOLD, CENTRE), tunable=True, default=HOLD
    )
    speed_drive_limit: float = parameter(
        "largest torque of each wheel's drive that speed_cmd may use",
        "N m",
        0.0,
        1e5,
        default=DEFAULT_DRIVE_LIMIT,
    )
    speed_brake_limit: float = parameter(
        "largest torque of each wheel's brake that speed_cmd may use",
        "N m",
        0.0,
        1e5,
        default=DEFAULT_BRAKE_LIMIT,
    )
    publish_clock: bool = parameter(
        "publish /clock, and stamp messages with simulated time from 0", default=False
    )
    frame_prefix: str = parameter("put before the frames in all messages", default="")
    vehicle_file: str = parameter("vehicle file (YAML); empty: the reference vehicle", default="")


@dataclasses.dataclass(frozen=True)
class TireFile:
    """The one entry of a vehicle file that is no number."""

    tire: str = parameter("tire file (.tir)", default="")


@dataclasses.dataclass(frozen=True)
class Declared:
    """Everything the parameters said."""

    settings: Settings
    options: Options
    road: Road
    vehicle: Vehicle


def declare(node: Node) -> Declared:
    """Declare all parameters on `node` and read them; raises InputError naming one."""
    _refuse_unknown(node)
    settings = Settings(**_declare_class(node, Settings))
    options = Options(**_declare_class(node, Options))
    _check_speed(settings.initial_speed, options)
    road = Road(**_declare_class(node, Road))
    vehicle = load_vehicle(settings.vehicle_file) if settings.vehicle_file else preset()
    tire = _declare(node, TIRE, vehicle.tire.file)
    if tire != vehicle.tire.file:
        vehicle = dataclasses.replace(vehicle, tire=load_tire(tire))
    values = {
        name: _declare(node, VEHICLE_PREFIX + name, getattr(vehicle, name))
        for name in parameters_of(Vehicle)
    }
    return Declared(settings, options, road, vehicle.with_values(values, VEHICLE_PREFIX))


def _check_speed(speed: float, options: Options) -> None:
    """Raise InputError if the model cannot start at a speed (m/s)."""
    if options.steady_state_slip and speed < MINIMUM_SPEED:
        allowed = f"at least {MINIMUM_SPEED:g} m/s with steady_state_slip"
        raise InputError("initial_speed", speed, allowed)


def follow_changes(node: Node, settings: Settings, options: Options) -> None:
    """Keep `settings` up to date with the tunable parameters; refuse values out of range."""
    known = parameters_of(Settings)

    def check(changes) -> SetParametersResult:
        try:
            checked = validated(
                Settings, {change.name: change.value for change in changes if change.name in known}
            )
            _check_speed(checked.get("initial_speed", settings.initial_speed), options)
        except InputError as error:
            return SetParametersResult(successful=False, reason=str(error))
        for name, value in checked.items():
            setattr(settings, name, value)
        return SetParametersResult(successful=True)

    node.add_pre_set_parameters_callback(_numbers_for_integers)
    node.add_on_set_parameters_callback(check)


def _numbers_for_integers(changes: list) -> list:
    """An integer serves where a number is wanted, and is kept as a number."""
    return [
        RosParameter(change.name, value=float(change.value))
        if type(change.value) is int
        and change.name in PARAMETERS
        and PARAMETERS[change.name].kind is float
        else change
        for change in changes
    ]


def _all_parameters() -> dict[str, Parameter]:
    vehicle = parameters_of(Vehicle) | parameters_of(TireFile)
    return {
        **parameters_of(Settings),
        **parameters_of(Options),
        **parameters_of(Road),
        **{VEHICLE_PREFIX + name: declared for name, declared in vehicle.items()},
    }


def _refuse_unknown(node: Node) -> None:
    """Every parameter that was given must be known."""
    for name in node._parameter_overrides:  # rclpy shows them nowhere else
        if name not in PARAMETERS and not name.startswith(OF_EVERY_NODE):
            raise unknown_name(name, PARAMETERS, "parameter")


def _declare_class(node: Node, declaring) -> dict:
    defaults = {name: p.default for name, p in parameters_of(declaring).items()}
    return {name: _declare(node, name, default) for name, default in defaults.items()}


def _declare(node: Node, name: str, default):
    """Declare a parameter; its value, checked, an integer for a number made a number."""
    declared, given = PARAMETERS[name], node._parameter_overrides.get(name)
    value = declared.validate(default if given is None else given.value, name)
    return node.declare_parameter(name, value, _descriptor(declared), ignore_override=True).value


def _descriptor(declared: Parameter) -> ParameterDescriptor:
    """What ROS is told of a parameter.

    Typed dynamically, so that an integer serves for a number; the type is checked here.
    """
    unit = f" ({declared.unit})" if declared.unit else ""
    choices = f": {' or '.join(declared.choices)}" if declared.choices else ""
    descriptor = ParameterDescriptor(
        type=ROS_TYPES[declared.kind],
        description=declared.description + choices + unit,
        read_only=not declared.tunable,
        dynamic_typing=True,
    )
    if declared.kind is float:
        allowed = FloatingPointRange(from_value=declared.minimum, to_value=declared.maximum)
        descriptor.floating_point_range.append(allowed)
    return descriptor


PARAMETERS = _all_parameters()
"""Every parameter of the simulator, by its ROS name."""
