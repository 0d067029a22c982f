"""From a session to messages: one object per topic, filled anew for every set."""

from array import array

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped, WrenchStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64, Float64MultiArray, MultiArrayDimension, UInt8MultiArray

from vehicle_roll_sim.analysis.metrics import load_transfer_ratio
from vehicle_roll_sim.model.advance import NANOSECONDS
from vehicle_roll_sim.model.frames import quaternion
from vehicle_roll_sim.model.records import WHEEL_COUNT, WHEELS
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


def labelled(kind: type, labels: tuple[str, ...]):
    """A multi-array whose layout names every element: dim[i].label is the name of data[i]."""
    message = kind()
    message.layout.dim = [MultiArrayDimension(label=name, size=1, stride=1) for name in labels]
    return message


class Messages:
    """The messages of a set; each method fills its own message and returns it.

    The messages are reused: what a method returned last changes with its next call. All stamped
    messages share `stamp`, set by `set_time`.
    """

    def __init__(self, session: Session, frame_prefix: str):
        self.simulation, self.session = session.simulation, session
        self.stamp = Time()
        body, odom = f"{frame_prefix}base_link", f"{frame_prefix}odom"
        footprint = f"{frame_prefix}base_footprint"
        self._whole_body = not session.simulation.options.has_eight_dof
        self._state = labelled(Float64MultiArray, ("time", *session.simulation.state_names))
        self._command = labelled(Float64MultiArray, COMMAND_LABELS)
        self._loads = labelled(Float64MultiArray, WHEELS)
        self._lift_off = labelled(UInt8MultiArray, WHEELS)
        self._odom = self._stamped(Odometry, odom)
        self._odom.child_frame_id = body
        self._imu = self._stamped(Imu, body)
        self._joints = self._stamped(JointState, "")
        self._joints.name = [*(SUSPENSION if self._whole_body else ()), *STEERING, *SPINNING]
        self._forces = [self._stamped(WrenchStamped, footprint) for _ in WHEELS]
        self._transforms = [self._stamped(TransformStamped, odom) for _ in range(2)]
        self._transforms[0].child_frame_id = footprint
        self._transforms[1].child_frame_id = body
        self._ratio = Float64()

    def _stamped(self, kind: type, frame: str):
        message = kind()
        message.header.frame_id = frame
        message.header.stamp = self.stamp
        return message

    def set_time(self, nanoseconds: int) -> None:
        """The stamp of the set (ns since the epoch of the stamps)."""
        self.stamp.sec, self.stamp.nanosec = divmod(nanoseconds, NANOSECONDS)

    def state(self) -> Float64MultiArray:
        simulation = self.simulation
        self._state.data = array("d", [simulation.time])
        self._state.data.frombytes(simulation.model_state.tobytes())
        return self._state

    def applied_command(self) -> Float64MultiArray:
        command = self.session.applied
        self._command.data = array(
            "d",
            (
                self.simulation.time,
                command.steering,
                command.rear_steering,
                *command.wheel_torque,
                *command.brake_torque,
                *command.normal_force,
            ),
        )
        return self._command

    def odom(self) -> Odometry:
        state, pose, twist = self.simulation.state, self._odom.pose.pose, self._odom.twist.twist
        motion = self.simulation.cg_motion
        _set_vector(pose.position, *motion[:3])
        _set_attitude(pose.orientation, state)
        _set_vector(twist.linear, *motion[3:])
        _set_rates(twist.angular, state)
        return self._odom

    def imu(self) -> Imu:
        state = self.simulation.state
        _set_attitude(self._imu.orientation, state)
        _set_rates(self._imu.angular_velocity, state)
        _set_vector(self._imu.linear_acceleration, *self.simulation.outputs["specific_force"])
        return self._imu

    def joint_states(self) -> JointState:
        state, outputs = self.simulation.state, self.simulation.outputs
        position = [outputs["steering"], state["wheel_angle"]]
        velocity = [np.zeros(WHEEL_COUNT), state["wheel_speed"]]
        if self._whole_body:
            at_rest = self.simulation.static_suspension_compression
            position.insert(0, state["suspension_compression"] - at_rest)
            velocity.insert(0, outputs["suspension_rate"])
        self._joints.position = array("d", np.concatenate(position).tobytes())
        self._joints.velocity = array("d", np.concatenate(velocity).tobytes())
        return self._joints

    def tire_normal_forces(self) -> Float64MultiArray:
        self._loads.data = array("d", self.simulation.outputs["normal_force"].tobytes())
        return self._loads

    def tire_force(self, wheel: int) -> WrenchStamped:
        outputs, message = self.simulation.outputs, self._forces[wheel]
        quantities = ("longitudinal_force", "lateral_force", "normal_force")
        _set_vector(message.wrench.force, *(outputs[name][wheel] for name in quantities))
        return message

    def lift_off(self) -> UInt8MultiArray:
        flags = self.simulation.outputs["normal_force"] == 0.0
        self._lift_off.data = array("B", flags.tobytes())
        return self._lift_off

    def load_transfer_ratio(self) -> Float64:
        loads = self.simulation.outputs["normal_force"]
        self._ratio.data = float(load_transfer_ratio(loads))
        return self._ratio

    def transforms(self) -> list[TransformStamped]:
        """odom to base_footprint: on the ground, yaw only; and to base_link, if it has a height."""
        state = self.simulation.state
        footprint, body = (message.transform for message in self._transforms)
        _set_vector(footprint.translation, state["x"], state["y"], 0.0)
        _set_quaternion(footprint.rotation, *quaternion(0.0, 0.0, float(state["yaw"])))
        if not self._whole_body:
            return self._transforms[:1]
        _set_vector(body.translation, state["x"], state["y"], state["z"])
        _set_attitude(body.rotation, state)
        return self._transforms


def _set_vector(vector, x: float, y: float, z: float) -> None:
    vector.x, vector.y, vector.z = float(x), float(y), float(z)


def _set_rates(vector, state: np.record) -> None:
    _set_vector(vector, state["roll_rate"], state["pitch_rate"], state["yaw_rate"])


def _set_attitude(orientation, state: np.record) -> None:
    """Roll, pitch and yaw; of a model that does not pitch, roll and yaw."""
    pitch = 0.0 if np.isnan(state["pitch"]) else float(state["pitch"])
    _set_quaternion(orientation, *quaternion(float(state["roll"]), pitch, float(state["yaw"])))


def _set_quaternion(orientation, x: float, y: float, z: float, w: float) -> None:
    orientation.x, orientation.y, orientation.z, orientation.w = x, y, z, w
