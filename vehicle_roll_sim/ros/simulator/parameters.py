"""The simulator's ROS parameters: declared, validated and described from one table."""

import dataclasses
import threading

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter as RosParameter

from vehicle_roll_sim.declaration import InputError, Parameter, parameter, parameters_of
from vehicle_roll_sim.live.command_limits import CommandLimits
from vehicle_roll_sim.messages.covariances import Covariances, ImuCovariances, OdomCovariances
from vehicle_roll_sim.model.integration.events import MINIMUM_SPEED
from vehicle_roll_sim.ros.node_main import refuse_unknown_parameters
from vehicle_roll_sim.ros.simulator.descriptors import descriptor_of
from vehicle_roll_sim.ros.simulator.settings import Settings
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.actuator_parameters import has_actuators
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.plausibility import plausibility
from vehicle_roll_sim.vehicle.sensor_parameters import devices_of
from vehicle_roll_sim.vehicle.shipped import vehicle_named
from vehicle_roll_sim.vehicle.vehicle_file import (
    LONGITUDINAL,
    NO_NUMBERS,
    TIRES,
    no_parameter,
    on_tires,
    preset,
)

VEHICLE_PREFIX, IMU_PREFIX, ODOM_PREFIX = "vehicle.", "imu.", "odom."
TIRE_PARAMETERS = tuple(VEHICLE_PREFIX + name for name in TIRES)
OF_FILES = (*TIRES, LONGITUDINAL)
SIM_TIME = "use_sim_time"
"""A parameter that every node has."""


@dataclasses.dataclass(frozen=True)
class TireFile:
    """The tires, which a vehicle file names and which are no numbers."""

    tire: str = parameter("path of the tire file (.tir) of all wheels", default="")
    front_tire: str = parameter("path of the tire file (.tir) of the front wheels", default="")
    rear_tire: str = parameter("path of the tire file (.tir) of the rear wheels", default="")
    longitudinal: str = parameter(
        "from_lateral: a tire file without longitudinal coefficients gets those of its lateral "
        "force",
        default="",
    )


@dataclasses.dataclass(frozen=True)
class Declared:
    """The values of all parameters, grouped by what they configure."""

    settings: Settings
    limits: CommandLimits
    options: Options
    road: Road
    vehicle: Vehicle
    covariances: Covariances


def declare(node: Node) -> Declared:
    """Declare all parameters on `node` and read them; raises InputError naming a wrong one."""
    _refuse_keys_of_files(node)
    refuse_unknown_parameters(node, PARAMETERS)
    _check_makes_time(node.get_parameter(SIM_TIME).value)
    settings = Settings(**_declare_class(node, Settings))
    limits = CommandLimits(**_declare_class(node, CommandLimits))
    road = _road(node, settings.road_file)
    vehicle = vehicle_named(settings.vehicle_file) if settings.vehicle_file else preset()
    vehicle = _on_tires(node, vehicle)
    vehicle = vehicle.with_values(_given_of_vehicle(node), VEHICLE_PREFIX)
    for name, value in vehicle.given.items():  # a dump with both alternatives could not be loaded
        _declare(node, VEHICLE_PREFIX + name, value)
    options = options_for(vehicle, **_given_of(node, Options)).for_vehicle(vehicle)
    _check_speed(settings.initial_speed, options)
    settings.check(options, devices_of(vehicle), has_actuators(vehicle))
    for name, value in dataclasses.asdict(options).items():
        _declare(node, name, value, is_resolved=True)
    _heed(plausibility(vehicle), node, settings.strict)
    imu = ImuCovariances(**_declare_class(node, ImuCovariances, IMU_PREFIX))
    odom = OdomCovariances(**_declare_class(node, OdomCovariances, ODOM_PREFIX))
    return Declared(settings, limits, options, road, vehicle, Covariances(imu, odom))


def _road(node: Node, file: str) -> Road:
    """The road of a file, or a plane, with the slopes given as parameters."""
    road = Road.from_file(file) if file else Road()
    slopes = {name: _declare(node, name, getattr(road, name)) for name in parameters_of(Road)}
    return dataclasses.replace(road, **slopes)


def _refuse_keys_of_files(node: Node) -> None:
    """Raise InputError for a key of vehicle files that is no parameter, or one of another name."""
    for name in node._parameter_overrides:
        key = name.removeprefix(VEHICLE_PREFIX)
        if key in NO_NUMBERS and name not in PARAMETERS:
            others = [other for other in (key, VEHICLE_PREFIX + key) if other in PARAMETERS]
            raise no_parameter(name, "parameter", "".join(others), "vehicle_file")


def _on_tires(node: Node, vehicle: Vehicle) -> Vehicle:
    """The vehicle on the tires given as parameters; declares those of its tires that it has."""
    reading = _declare(node, VEHICLE_PREFIX + LONGITUDINAL, vehicle.longitudinal)
    given = {}
    for name, parameter_name in zip(TIRES, TIRE_PARAMETERS, strict=True):
        if parameter_name in node._parameter_overrides:
            path = node._parameter_overrides[parameter_name].value
            given[name] = PARAMETERS[parameter_name].validate(path, parameter_name)
    own = {name: tire.file for name, tire in vehicle.own_tires.items()}
    if given != {name: file for name, file in own.items() if name in given}:
        try:
            vehicle = on_tires(dataclasses.replace(vehicle, longitudinal=reading), given)
        except InputError as error:
            field = VEHICLE_PREFIX + error.field if error.field in OF_FILES else error.field
            raise InputError(field, error.value, error.allowed, error.problem) from None
    for name, tire in vehicle.own_tires.items():
        _declare(node, VEHICLE_PREFIX + name, tire.file)
    return vehicle


def _check_makes_time(use_sim_time) -> None:
    """Raise InputError if the simulator, the source of time, is told to take it from /clock."""
    if use_sim_time:
        allowed = "false, because the simulator is the source of time; see publish_clock"
        raise InputError(SIM_TIME, use_sim_time, allowed, "true is not allowed")


def _given_of_vehicle(node: Node) -> dict:
    """The vehicle parameters given as ROS parameters, which override the vehicle file."""
    overrides = node._parameter_overrides
    return {
        name: overrides[VEHICLE_PREFIX + name].value
        for name in parameters_of(Vehicle)
        if VEHICLE_PREFIX + name in overrides
    }


def _heed(doubts: list[str], node: Node, strict: bool) -> None:
    """Log a warning for each implausible vehicle parameter; if strict, raise InputError."""
    doubts = [VEHICLE_PREFIX + doubt for doubt in doubts]
    if doubts and strict:
        raise InputError("strict", strict, "; ".join(doubts), "the vehicle is not plausible")
    for doubt in doubts:
        node.get_logger().warning(doubt)


def _check_speed(speed: float, options: Options) -> None:
    """Raise InputError if the model cannot start at this speed (m/s)."""
    if options.steady_state_slip and speed < MINIMUM_SPEED:
        allowed = f"at least {MINIMUM_SPEED:g} m/s with steady_state_slip"
        raise InputError("initial_speed", speed, allowed)


def follow_changes(node: Node, declared: Declared, lock: threading.Lock) -> None:
    """Apply changes of tunable parameters to `declared`; refuse wrong values.

    lock: held while values change, so that they change between two periods only.
    """
    settings, tunable = declared.settings, _tunable(declared)

    def check(changes) -> SetParametersResult:
        values = {change.name: change.value for change in changes if change.name in tunable}
        try:
            _check_makes_time(any(c.name == SIM_TIME and c.value for c in changes))
            checked = {name: PARAMETERS[name].validate(value) for name, value in values.items()}
            _check_speed(checked.get("initial_speed", settings.initial_speed), declared.options)
        except InputError as error:
            return SetParametersResult(successful=False, reason=str(error))
        with lock:
            for name, value in checked.items():
                setattr(tunable[name], name, value)
        return SetParametersResult(successful=True)

    node.add_pre_set_parameters_callback(_numbers_for_integers)
    node.add_on_set_parameters_callback(check)


def _tunable(declared: Declared) -> dict[str, Settings | CommandLimits]:
    """The object that has each parameter that may change."""
    parts = (declared.settings, declared.limits)
    return {name: part for part in parts for name, p in parameters_of(part).items() if p.tunable}


def show_changes(node: Node, declared: Declared) -> None:
    """Set the ROS parameters to values that have changed with a snapshot. Call without the lock."""
    now = {name: getattr(part, name) for name, part in _tunable(declared).items()}
    changed = [
        RosParameter(name, value=value)
        for name, value in now.items()
        if node.get_parameter(name).value != value
    ]
    if changed:
        node.set_parameters_atomically(changed)


def _numbers_for_integers(changes: list) -> list:
    """Convert integers to floating-point numbers where these are expected."""
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
        **parameters_of(CommandLimits),
        **parameters_of(Options),
        **parameters_of(Road),
        **{VEHICLE_PREFIX + name: declared for name, declared in vehicle.items()},
        **{IMU_PREFIX + name: each for name, each in parameters_of(ImuCovariances).items()},
        **{ODOM_PREFIX + name: each for name, each in parameters_of(OdomCovariances).items()},
    }


def _declare_class(node: Node, declaring, prefix: str = "") -> dict:
    defaults = {name: p.default for name, p in parameters_of(declaring).items()}
    return {name: _declare(node, prefix + name, default) for name, default in defaults.items()}


def _given_of(node: Node, declaring) -> dict:
    """The validated values of a class's parameters that are given, by name."""
    overrides = node._parameter_overrides
    given = {name: overrides[name].value for name in parameters_of(declaring) if name in overrides}
    return {name: PARAMETERS[name].validate(value, name) for name, value in given.items()}


def _declare(node: Node, name: str, default, is_resolved: bool = False):
    """Declare a parameter and return its validated value, with integers converted to numbers.

    is_resolved: `default` counts even if the parameter is given.
    """
    declared, given = PARAMETERS[name], node._parameter_overrides.get(name)
    value = default if given is None or is_resolved else given.value
    value = declared.validate(value, name)
    if declared.is_curve and isinstance(value, tuple):
        value = [number for point in value for number in point]
    return node.declare_parameter(name, value, descriptor_of(declared), ignore_override=True).value


PARAMETERS = _all_parameters()
"""Every parameter of the simulator, by its ROS name."""
