"""From a simulation to messages: one encoded message per topic, updated for every set."""

import functools
import math
from collections.abc import Callable

from vehicle_roll_sim.live.channels import OF_ROAD
from vehicle_roll_sim.messages.covariances import Covariances
from vehicle_roll_sim.messages.joints import joint_kinds, joint_motion, joint_names
from vehicle_roll_sim.messages.message_template import Encode, MessageTemplate
from vehicle_roll_sim.messages.set_templates import (
    ATTITUDE,
    FORCE,
    IMU_ATTITUDE,
    IMU_RATES,
    POSITION,
    ROTATION,
    SPECIFIC_FORCE,
    TRANSLATION,
    TURNING,
    VELOCITY,
    Templates,
)
from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.frames import quaternion
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.layout import CORNERS, WHEELS
from vehicle_roll_sim.runs.columns import ROLL_CENTRES, WIND, roll_centres_of
from vehicle_roll_sim.runs.metrics import load_transfer_ratio
from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.simulation.simulation import Simulation

COMMAND_LABELS = (
    *("time", "steering", "rear_steering"),
    *(f"wheel_torque_{wheel}" for wheel in WHEELS),
    *(f"brake_torque_{wheel}" for wheel in WHEELS),
    *(f"normal_force_{wheel}" for wheel in WHEELS),
)
"""Those of vehicles with air forces are followed by WIND, those on a road that is commanded by
ROAD_LABELS, those of vehicles with actuators by DEMAND_LABELS at last."""
ROAD_LABELS = tuple(f"{name}_{wheel}" for name in OF_ROAD for wheel in WHEELS)
DEMAND_LABELS = tuple(f"demanded_{name}" for name in COMMAND_LABELS[1:])
"""What was demanded of the actuators in the period that ends with the set."""
MOTION_LABELS = (
    *("time", "steering", "rear_steering", "u", "v", "yaw_rate"),
    *("roll", "roll_rate", "lateral_acceleration"),
)
"""What vehicle dynamics controllers need. The names mean the same as in `state`, `applied_command`
and the CSV."""
ANGLES, RATES = slice(at.ROLL, at.YAW + 1), slice(at.ROLL_RATE, at.YAW_RATE + 1)
"""Indices of the Euler angles and of the body rates in the state."""
FLAGS_MARK = (250, 251, 252, 253)
"""A placeholder that no lift-off flags contain otherwise."""
ACTUATOR_LABELS = (
    "time",
    *(f"{kind}_{name}" for kind in ("limited", "lag", "lag_rate") for name in COMMAND_LABELS[1:]),
)


class Messages:
    """The messages of a set, encoded by `encode`; each has a method that updates and returns it.

    applied: the command given for the last period, to be updated by the owner. All stamped messages
    of a set share the time passed to `set_time`. named: for each topic without a header, the names
    of its numbers and a view of the numbers, which are as recent as its message.
    """

    def __init__(
        self,
        simulation: Simulation,
        frame_prefix: str,
        encode: Encode,
        covariances: Covariances = Covariances(),  # noqa: B008 - it cannot be changed
    ):
        self.simulation, self.applied = simulation, Command()
        self.stamp = (0, 0)
        self._templates = Templates(frame_prefix, encode)
        self._whole_body = not simulation.options.has_eight_dof
        self.named = self._templates.named
        further = (
            *(WIND if simulation.feels_wind else ()),
            *(ROAD_LABELS if simulation.road.is_commanded else ()),
            *(DEMAND_LABELS if simulation.has_actuators else ()),
        )
        encoded, labelled = self._templates, self._templates.labelled
        self._state = labelled("state", ("time", *simulation.state_names))
        self._command = labelled("applied_command", (*COMMAND_LABELS, *further))
        self._loads = labelled("tire_normal_forces", WHEELS)
        self._motion = labelled("motion", MOTION_LABELS)
        self._roll_centre = labelled("roll_centre", ROLL_CENTRES)
        self._body_loads = labelled("body_loads", CORNERS)
        self._actuators = labelled("actuators", ACTUATOR_LABELS)
        self._lift_off = labelled("lift_off", WHEELS, FLAGS_MARK, kind="u1")
        self._single = encoded.single_numbers()
        self._clock = encoded.clock()
        self._odom = encoded.odometry(covariances.odom)
        self._imu = encoded.inertial("base_link", covariances.imu)
        self._joints = encoded.joint_states(joint_names(joint_kinds(simulation)))
        self._forces = [encoded.force() for _ in WHEELS]

    def builder(self, topic: str) -> Callable[[], bytes]:
        """The method that updates the message of a topic of the set and returns its bytes."""
        family, _, wheel = topic.lstrip("/").partition("/")
        if wheel:
            return functools.partial(self.tire_force, WHEELS.index(wheel))
        return getattr(self, family)

    @functools.cached_property
    def _transforms(self) -> MessageTemplate:
        """From odom to base_footprint, on the ground, and to base_link, if the model has heave.

        Created on first use, since not every ROS installation has the message type.
        """
        frames = ("base_footprint", "base_link") if self._whole_body else ("base_footprint",)
        return self._templates.transforms(frames)

    def set_time(self, nanoseconds: int) -> None:
        """Set the stamp of the next set (ns since the epoch of the stamps)."""
        self.stamp = divmod(nanoseconds, NANOSECONDS)

    def clock(self) -> bytes:
        return self._dated(self._clock)

    def _dated(self, message: MessageTemplate) -> bytes:
        message.stamp(*self.stamp)
        return bytes(message)

    def state(self) -> bytes:
        self._state.numbers[0] = self.simulation.time
        self._state.numbers[1:] = self.simulation.model_state
        return bytes(self._state)

    def applied_command(self) -> bytes:
        demand = self.applied
        self._command.numbers[:] = (
            self.simulation.time,
            *_numbers(self.simulation.acting(demand)),
            *(demand.wind if self.simulation.feels_wind else ()),
            *(_of_road(demand) if self.simulation.road.is_commanded else ()),
            *(_numbers(demand) if self.simulation.has_actuators else ()),
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
        return self._dated_joints(self._joints, *joint_motion(self.simulation))

    def _dated_joints(self, message: MessageTemplate, position, velocity) -> bytes:
        message.numbers[: len(position)] = position
        message.numbers[-len(velocity) :] = velocity
        return self._dated(message)

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
        return self._number("load_transfer_ratio", load_transfer_ratio(loads))

    def _number(self, topic: str, value: float) -> bytes:
        """The message of a topic of type Float64."""
        message = self._single[topic]
        message.numbers[0] = value
        return bytes(message)

    def motion(self) -> bytes:
        state, command = self.simulation.state_vector, self.simulation.acting(self.applied)
        self._motion.numbers[:] = (
            self.simulation.time,
            command.steering,
            command.rear_steering,
            *state[[at.U, at.V, at.YAW_RATE, at.ROLL, at.ROLL_RATE]],
            self.simulation.outputs["acceleration"][1],
        )
        return bytes(self._motion)

    def roll_centre(self) -> bytes:
        self._roll_centre.numbers[:] = roll_centres_of(self.simulation)
        return bytes(self._roll_centre)

    def body_loads(self) -> bytes:
        self._body_loads.numbers[:] = self.simulation.outputs["body_load"]
        return bytes(self._body_loads)

    def actuators(self) -> bytes:
        self._actuators.numbers[0] = self.simulation.time
        self._actuators.numbers[1:] = self.simulation.actuation.states().ravel()
        return bytes(self._actuators)

    def _attitude(self) -> tuple[float, ...]:
        roll, pitch, yaw = self.simulation.state_vector[ANGLES].tolist()
        return quaternion(roll, 0.0 if math.isnan(pitch) else pitch, yaw)

    def tf(self) -> bytes:
        state = self.simulation.state
        heights = (0.0, float(state["z"]))
        turns = (quaternion(0.0, 0.0, float(state["yaw"])), self._attitude())
        for numbers, height, turn in zip(self._transforms.groups, heights, turns, strict=False):
            numbers[TRANSLATION] = state["x"], state["y"], height
            numbers[ROTATION] = turn
        return self._dated(self._transforms)


def _of_road(command: Command) -> tuple[float, ...]:
    """The values named by ROAD_LABELS."""
    return (*command.road_height, *command.road_friction)


def _numbers(command: Command) -> tuple[float, ...]:
    """What COMMAND_LABELS name after the time."""
    forces = (*command.wheel_torque, *command.brake_torque, *command.normal_force)
    return (command.steering, command.rear_steering, *forces)
