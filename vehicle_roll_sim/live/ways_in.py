"""Messages of other packages as commands: what each asks of the channels of the inbox.

The functions take a message, or anything with its fields, and the wheelbase (m). They return values
by channel, and raise InputError for a message that asks for what the simulator does not do.
"""

import math
from collections.abc import Callable, Mapping, Sequence

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.model.records import WHEELS

Parts = Mapping[str, Sequence[float]]
STEERED = {"steering_cmd": WHEELS[:2], "rear_steering_cmd": WHEELS[2:]}
"""The wheels of each steering command."""
TORQUE, FORCE = "wheel_torque_cmd", "normal_force_cmd"
FIELD_OF = {"steering": "position", "wheel": "effort", "suspension": "effort"}
"""What is commanded of each kind of joint."""
SIGNS = {"wheel": (TORQUE, 1.0), "suspension": (FORCE, -1.0)}
"""Channel of the efforts of a kind of joint, and its sign: a suspension joint moves the wheel up,
an active force pushes it down."""
JOINTS = {f"{wheel}_{kind}_joint": (wheel, kind) for kind in FIELD_OF for wheel in WHEELS}


def ackermann_parts(message, _: float) -> Parts:
    """Of an ackermann_msgs/AckermannDriveStamped: the angle of the front wheels and the speed."""
    drive = message.drive
    for name in ("steering_angle_velocity", "acceleration", "jerk"):
        _refuse_unless_zero(f"drive.{name}", getattr(drive, name), "0, as quickly as possible")
    return {"steering_cmd": (drive.steering_angle,), "speed_cmd": (drive.speed,)}


def twist_parts(message, wheelbase: float) -> Parts:
    """Of a geometry_msgs/TwistStamped: the speed, and the angle that gives the yaw rate with it.

    That of the kinematic bicycle: tan(angle) = wheelbase * yaw rate / speed.
    """
    linear, angular = message.twist.linear, message.twist.angular
    others = {"linear.y": linear.y, "linear.z": linear.z}
    others |= {"angular.x": angular.x, "angular.y": angular.y}
    for name, value in others.items():
        _refuse_unless_zero(name, value, "0: only linear.x and angular.z are commands")
    speed, rate = linear.x, angular.z
    if not speed:
        _refuse_unless_zero("angular.z", rate, "0 at standstill: it cannot turn on the spot")
        return {"steering_cmd": (0.0,), "speed_cmd": (speed,)}
    return {"steering_cmd": (math.atan(wheelbase * rate / speed),), "speed_cmd": (speed,)}


def joint_parts(message, _: float) -> Parts:
    """Of a sensor_msgs/JointState: positions of steering joints, efforts of the others.

    The angle of an axle is the mean of the positions of its wheels that are given. Efforts that are
    not given are 0 if one of their kind is.
    """
    names = list(message.name)
    for name in names:
        if name not in JOINTS or names.count(name) > 1:
            allowed = "each once, of the steering, wheel and suspension joints of joint_states"
            raise InputError("name", name, allowed)
    for value in message.velocity:
        if not math.isnan(value):
            raise InputError("velocity", value, "none: joints take positions and efforts")
    positions, efforts = (_given(message, names, field) for field in ("position", "effort"))
    parts = {}
    for channel, wheels in STEERED.items():
        angles = [positions[name] for name in positions if JOINTS[name][0] in wheels]
        if angles:
            parts[channel] = (sum(angles) / len(angles),)
    for kind, (channel, sign) in SIGNS.items():
        of_kind = {JOINTS[n][0]: value for n, value in efforts.items() if JOINTS[n][1] == kind}
        if of_kind:
            parts[channel] = tuple(sign * of_kind.get(wheel, 0.0) for wheel in WHEELS)
    if not parts:
        raise InputError("name", names, "at least one joint with a command", "nothing is commanded")
    return parts


def _given(message, names: list[str], field: str) -> dict[str, float]:
    """The values of a field that are given, by joint; nan is none.

    There are none, one for each name, or one for each joint that takes them, in order: hardware of
    ros2_control sends either of the latter.
    """
    values = list(getattr(message, field))
    taking = [name for name in names if FIELD_OF[JOINTS[name][1]] == field]
    if values and len(values) not in (len(names), len(taking)):
        allowed = f"{len(taking)} of the joints that take it, {len(names)} of all, or none"
        raise InputError(field, "", allowed, f"{len(values)} values")
    pairs = zip(taking if len(values) == len(taking) else names, values, strict=False)
    given = {name: value for name, value in pairs if not math.isnan(value)}
    for name in given.keys() - set(taking):
        allowed = f"nan: its command is the {FIELD_OF[JOINTS[name][1]]}"
        raise InputError(f"{field} of {name}", given[name], allowed)
    return given


def _refuse_unless_zero(field: str, value: float, allowed: str) -> None:
    if value != 0.0:
        raise InputError(field, value, allowed)


PARTS: dict[str, Callable[[object, float], Parts]] = {
    "ackermann_cmd": ackermann_parts,
    "cmd_vel": twist_parts,
    "joint_commands": joint_parts,
}
"""The function for the messages on each topic."""
