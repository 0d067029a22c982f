"""From a session to messages: the bytes of one per topic, brought up to date for every set."""

import math

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64, Float64MultiArray, MultiArrayDimension, UInt8MultiArray

from vehicle_roll_sim.analysis.metrics import load_transfer_ratio
from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.advance import NANOSECONDS
from vehicle_roll_sim.model.frames import quaternion
from vehicle_roll_sim.model.records import WHEEL_COUNT, WHEELS
from vehicle_roll_sim.ros.encoded import MARK, Encoded
from vehicle_roll_sim.simulation.session import Session

COMMAND_LABELS = (
    *("time", "steering", "rear_steering"),
    *(f"wheel_torque_{wheel}" for wheel in WHEELS),
    *(f"brake_torque_{wheel}" for wheel in WHEELS),
    *(f"normal_force_{wheel}" for wheel in WHEELS),
)
SUSPENSION, STEERING, SPINNING = (
    tuple(f"{wheel}_{kind}_joint" for wheel in WHEELS)
    for kind in ("suspension", "steering", "wheel")
)
"""Names of the joints."""
ANGLES, RATES = slice(at.ROLL, at.YAW + 1), slice(at.ROLL_RATE, at.YAW_RATE + 1)
"""Where the state has the Euler angles and the body rates."""
OF_ODOMETRY = 85
POSITION, ATTITUDE, VELOCITY, TURNING = slice(3), slice(3, 7), slice(43, 46), slice(46, 49)
"""Numbers of an Odometry: a pose and a twist, 7 and 6, with a covariance of 36 behind each."""
OF_IMU = 37
IMU_ATTITUDE, IMU_RATES, SPECIFIC_FORCE = slice(4), slice(13, 16), slice(25, 28)
"""Numbers of an Imu: 4, 3 and 3, with a covariance of 9 behind each."""
OF_WRENCH = 6
FORCE = slice(3)
"""Numbers of a Wrench: force and torque."""
FLAGS_MARK = (250, 251, 252, 253)
"""Flags that no lift-off has."""


def labelled(kind: type, labels: tuple[str, ...]):
    """A multi-array whose layout names every element: dim[i].label is the name of data[i]."""
    message = kind()
    message.layout.dim = [MultiArrayDimension(label=name, size=1, stride=1) for name in labels]
    return message


class Messages:
    """The messages of a set, encoded; each method brings its own up to date and returns it.

    All stamped messages of a set share the time that `set_time` is told.
    """

    def __init__(self, session: Session, frame_prefix: str):
        self.simulation, self.session = session.simulation, session
        self.stamp = Time()
        body, odom = f"{frame_prefix}base_link", f"{frame_prefix}odom"
        footprint = f"{frame_prefix}base_footprint"
        self._whole_body = not session.simulation.options.has_eight_dof
        self._state = self._labelled("time", *session.simulation.state_names)
        self._command = self._labelled(*COMMAND_LABELS)
        self._loads = self._labelled(*WHEELS)
        flags = labelled(UInt8MultiArray, WHEELS)
        flags.data = bytes(FLAGS_MARK)
        self._lift_off = Encoded(flags, WHEEL_COUNT, FLAGS_MARK, kind="u1")
        self._ratio = Encoded(Float64(data=MARK), 1)
        self._clock = Encoded(Clock())
        odometry = self._stamped(Odometry, odom)
        odometry.child_frame_id = body
        odometry.pose.pose.position.x = MARK
        self._odom = Encoded(odometry, OF_ODOMETRY)
        imu = self._stamped(Imu, body)
        imu.orientation.x = MARK
        self._imu = Encoded(imu, OF_IMU)
        self._joints = self._joint_states()
        force = self._stamped(WrenchStamped, footprint)
        force.wrench.force.x = MARK
        self._forces = [Encoded(force, OF_WRENCH) for _ in WHEELS]
        self._transforms = [self._stamped(TransformStamped, odom) for _ in range(2)]
        self._transforms[0].child_frame_id = footprint
        self._transforms[1].child_frame_id = body

    @staticmethod
    def _labelled(*labels: str) -> Encoded:
        message = labelled(Float64MultiArray, labels)
        message.data = [MARK] * len(labels)
        return Encoded(message, len(labels))

    def _stamped(self, kind: type, frame: str):
        message = kind()
        message.header.frame_id = frame
        message.header.stamp = self.stamp
        return message

    def _joint_states(self) -> Encoded:
        """Positions and velocities lie one behind the other, but for the count of the latter."""
        message = self._stamped(JointState, "")
        message.name = [*(SUSPENSION if self._whole_body else ()), *STEERING, *SPINNING]
        count = len(message.name)
        message.position = message.velocity = [MARK] * count
        return Encoded(message, count + 1 + count)

    def set_time(self, nanoseconds: int) -> None:
        """The stamp of the set (ns since the epoch of the stamps)."""
        self.stamp.sec, self.stamp.nanosec = divmod(nanoseconds, NANOSECONDS)

    def clock(self) -> bytes:
        return self._dated(self._clock)

    def _dated(self, message: Encoded) -> bytes:
        message.stamp(self.stamp.sec, self.stamp.nanosec)
        return bytes(message)

    def state(self) -> bytes:
        self._state.numbers[0] = self.simulation.time
        self._state.numbers[1:] = self.simulation.model_state
        return bytes(self._state)

    def applied_command(self) -> bytes:
        command = self.session.applied
        self._command.numbers[:] = (
            self.simulation.time,
            command.steering,
            command.rear_steering,
            *command.wheel_torque,
            *command.brake_torque,
            *command.normal_force,
        )
        return bytes(self._command)

    def odom(self) -> bytes:
        numbers, motion = self._odom.numbers, self.simulation.cg_motion
        numbers[POSITION], numbers[VELOCITY] = motion[:3], motion[3:]
        numbers[ATTITUDE] = self._attitude()
        numbers[TURNING] = self.simulation.state_vector[RATES]
        return self._dated(self._odom)

    def imu(self) -> bytes:
        numbers = self._imu.numbers
        numbers[IMU_ATTITUDE] = self._attitude()
        numbers[IMU_RATES] = self.simulation.state_vector[RATES]
        numbers[SPECIFIC_FORCE] = self.simulation.outputs["specific_force"]
        return self._dated(self._imu)

    def joint_states(self) -> bytes:
        state, outputs = self.simulation.state, self.simulation.outputs
        position = [outputs["steering"], state["wheel_angle"]]
        velocity = [np.zeros(WHEEL_COUNT), state["wheel_speed"]]
        if self._whole_body:
            at_rest = self.simulation.static_suspension_compression
            position.insert(0, state["suspension_compression"] - at_rest)
            velocity.insert(0, outputs["suspension_rate"])
        count = len(position) * WHEEL_COUNT
        self._joints.numbers[:count] = np.concatenate(position)
        self._joints.numbers[-count:] = np.concatenate(velocity)
        return self._dated(self._joints)

    def tire_normal_forces(self) -> bytes:
        self._loads.numbers[:] = self.simulation.outputs["normal_force"]
        return bytes(self._loads)

    def tire_force(self, wheel: int) -> bytes:
        outputs, message = self.simulation.outputs, self._forces[wheel]
        quantities = ("longitudinal_force", "lateral_force", "normal_force")
        message.numbers[FORCE] = [outputs[name][wheel] for name in quantities]
        return self._dated(message)

    def lift_off(self) -> bytes:
        self._lift_off.numbers[:] = self.simulation.outputs["normal_force"] == 0.0
        return bytes(self._lift_off)

    def load_transfer_ratio(self) -> bytes:
        loads = self.simulation.outputs["normal_force"]
        self._ratio.numbers[0] = load_transfer_ratio(loads)
        return bytes(self._ratio)

    def _attitude(self) -> tuple[float, ...]:
        """As a quaternion (x, y, z, w); of a model that does not pitch, roll and yaw."""
        roll, pitch, yaw = self.simulation.state_vector[ANGLES].tolist()
        return quaternion(roll, 0.0 if math.isnan(pitch) else pitch, yaw)

    def transforms(self) -> list[TransformStamped]:
        """odom to base_footprint: on the ground, yaw only; and to base_link, if it has a height."""
        state = self.simulation.state
        footprint, body = (message.transform for message in self._transforms)
        _set_vector(footprint.translation, state["x"], state["y"], 0.0)
        _set_quaternion(footprint.rotation, *quaternion(0.0, 0.0, float(state["yaw"])))
        if not self._whole_body:
            return self._transforms[:1]
        _set_vector(body.translation, state["x"], state["y"], state["z"])
        _set_quaternion(body.rotation, *self._attitude())
        return self._transforms


def _set_vector(vector, x: float, y: float, z: float) -> None:
    vector.x, vector.y, vector.z = float(x), float(y), float(z)


def _set_quaternion(orientation, x: float, y: float, z: float, w: float) -> None:
    orientation.x, orientation.y, orientation.z, orientation.w = x, y, z, w
