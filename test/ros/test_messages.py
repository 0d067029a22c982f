"""Each message holds what its documentation says, without a middleware in between."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from vehicle_roll_sim import LF, LR, RF, RR, Command, Simulation, preset
from vehicle_roll_sim.ros.messages import COMMAND_LABELS, Messages
from vehicle_roll_sim.simulation.command_inbox import CommandInbox
from vehicle_roll_sim.simulation.session import Session

ROUNDING = 1e-12
"""Of a few operations in double precision on numbers of order 1."""


@pytest.fixture
def session():
    """A vehicle in a hard left turn with two wheels in the air."""
    session = Session(Simulation(preset()), CommandInbox(), 10_000_000, 13.9)
    session.applied = Command(steering=0.2, wheel_torque=(1.0, 2.0, 3.0, 4.0))
    session.simulation.step(session.applied, 0.8)
    assert session.simulation.outputs.normal_force[LR] == 0.0
    return session


@pytest.fixture
def messages(session):
    messages = Messages(session, "car/")
    messages.set_time(12_345_678_901)
    return messages


def body_in_ground(state):
    """The attitude by another library: intrinsic rotations about z, y, x."""
    return Rotation.from_euler("ZYX", [state.yaw, state.pitch, state.roll])


def vector(message):
    return np.array([message.x, message.y, message.z])


def test_stamps_are_simulated_time(messages):
    for message in (messages.odom(), messages.imu(), messages.joint_states()):
        assert (message.header.stamp.sec, message.header.stamp.nanosec) == (12, 345_678_901)
    assert messages.tire_force(RF).header.stamp.sec == 12


def test_odometry_is_the_pose_and_twist_of_the_sprung_cg(session, messages):
    odom, state = messages.odom(), session.simulation.state
    assert (odom.header.frame_id, odom.child_frame_id) == ("car/odom", "car/base_link")
    assert vector(odom.pose.pose.position) == pytest.approx([state.x, state.y, state.z])
    q = odom.pose.pose.orientation
    expected = body_in_ground(state).as_quat(canonical=True)
    assert [q.x, q.y, q.z, q.w] == pytest.approx(expected, abs=ROUNDING)
    assert vector(odom.twist.twist.linear) == pytest.approx([state.u, state.v, state.w])
    rates = [state.roll_rate, state.pitch_rate, state.yaw_rate]
    assert vector(odom.twist.twist.angular) == pytest.approx(rates)


def test_imu_reads_g_upwards_at_rest():
    at_rest = Session(Simulation(preset()), CommandInbox(), 10_000_000, 13.9)
    imu = Messages(at_rest, "").imu()
    assert vector(imu.linear_acceleration) == pytest.approx([0, 0, 9.81], abs=ROUNDING)


def test_imu_reads_the_acceleration_less_gravity(session, messages):
    """Against the finite difference of the velocity in the ground frame."""
    imu, state = messages.imu(), session.simulation.state.copy()

    def velocity(s):
        return body_in_ground(s).apply([s.u, s.v, s.w])

    before, attitude, step = velocity(state), body_in_ground(state), 0.001
    session.simulation.step(session.applied, step)
    acceleration = (velocity(session.simulation.state) - before) / step
    specific = attitude.inv().apply(acceleration + np.array([0, 0, 9.81]))
    # first order in the step: the jerk of this manoeuvre is some 100 m/s^3
    assert vector(imu.linear_acceleration) == pytest.approx(specific, abs=100 * step)


def test_joints_hold_travel_steering_and_spin(session, messages):
    joints, state = messages.joint_states(), session.simulation.state
    position = dict(zip(joints.name, joints.position, strict=True))
    velocity = dict(zip(joints.name, joints.velocity, strict=True))
    static = 1440 * 9.81 * 1.524 / (2 * 2.54 * 35000)  # equation 19 with the source's numbers
    travel = state.suspension_compression[RF] - static
    assert position["rf_suspension_joint"] == pytest.approx(travel, abs=ROUNDING)
    assert position["lf_steering_joint"] == 0.2
    assert position["rr_steering_joint"] == 0.0
    assert position["rr_wheel_joint"] == state.wheel_angle[RR]
    assert velocity["rr_wheel_joint"] == state.wheel_speed[RR]


def test_tire_forces_are_those_on_the_ground(session, messages):
    outputs = session.simulation.outputs
    for wheel in (LF, RF, LR, RR):
        message = messages.tire_force(wheel)
        expected = [
            outputs.longitudinal_force[wheel],
            outputs.lateral_force[wheel],
            outputs.normal_force[wheel],
        ]
        assert message.header.frame_id == "car/base_footprint"
        assert vector(message.wrench.force) == pytest.approx(expected)
        assert vector(message.wrench.torque) == pytest.approx([0, 0, 0])


def test_lift_off_is_1_exactly_where_there_is_no_load(session, messages):
    flags = list(messages.lift_off().data)
    assert flags == [int(fz == 0.0) for fz in messages.tire_normal_forces().data]
    assert flags[LR] == 1
    assert flags[RR] == 0


def test_applied_command_names_every_element(messages):
    message = messages.applied_command()
    assert [dimension.label for dimension in message.layout.dim] == list(COMMAND_LABELS)
    values = dict(zip(COMMAND_LABELS, message.data, strict=True))
    assert values["time"] == pytest.approx(0.8)
    assert values["steering"] == 0.2
    assert values["wheel_torque_rr"] == 4.0
    assert values["brake_torque_lf"] == 0.0


def test_the_footprint_is_below_the_body_and_turned_by_yaw_only(session, messages):
    footprint, body = messages.transforms()
    state = session.simulation.state
    assert (body.child_frame_id, footprint.child_frame_id) == (
        "car/base_link",
        "car/base_footprint",
    )
    assert vector(footprint.transform.translation) == pytest.approx([state.x, state.y, 0.0])
    q = footprint.transform.rotation
    yaw = Rotation.from_quat([q.x, q.y, q.z, q.w]).as_euler("ZYX")
    assert yaw == pytest.approx([state.yaw, 0.0, 0.0], abs=ROUNDING)
