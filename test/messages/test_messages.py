"""Each message has the documented content, tested without middleware."""

from xml.etree import ElementTree

import numpy as np
import pytest
from rclpy.serialization import deserialize_message
from scipy.spatial.transform import Rotation

from vehicle_roll_sim import LF, LR, RF, RR, WHEELS, Command, Options, Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.messages.covariances import Covariances, ImuCovariances, OdomCovariances
from vehicle_roll_sim.messages.sets import COMMAND_LABELS, Messages
from vehicle_roll_sim.messages.stamped import SIGNAL_UNITS, builder
from vehicle_roll_sim.messages.topic import WRENCH
from vehicle_roll_sim.messages.topics import (
    CLOCK,
    PUBLISHED,
    SIGNALS,
    STAMPED,
    TRANSFORMS,
    set_of,
)
from vehicle_roll_sim.messages.urdf import robot_description
from vehicle_roll_sim.ros.encoding import encode
from vehicle_roll_sim.ros.topics import message_class
from vehicle_roll_sim.runs.columns import row_of
from vehicle_roll_sim.runs.derived_signals import SIGNALS as DERIVED
from vehicle_roll_sim.runs.history import History

OTHERS = ("measurements_stamped", "actuators_stamped", "signals_stamped")
"""Of other vehicles, and the one without a plain version: see the tests of each."""
OF_FOUR = ("wheel_torque", "brake_torque", "normal_force")
ROUNDING = 1e-12
"""Of a few operations in double precision on numbers of order 1."""


@pytest.fixture
def encoding():
    """The encoding of bags, whose library is optional."""
    pytest.importorskip("rosbags", reason="bags need the library rosbags")
    from vehicle_roll_sim.bags import encoding

    return encoding


@pytest.fixture
def session():
    """A vehicle in a hard left turn with two wheels in the air."""
    session = Session(Simulation(preset()), CommandInbox(), 10_000_000, 13.9)
    session.applied = Command(
        steering=0.2,
        wheel_torque=(1.0, 2.0, 3.0, 4.0),
        brake_torque=(5.0, 6.0, 7.0, 8.0),
        normal_force=(9.0, 10.0, 11.0, 12.0),
    )
    session.simulation.step(session.applied, 0.8)
    assert session.simulation.outputs.normal_force[LR] == 0.0
    return session


TYPES = {topic.name: topic.type for topic in PUBLISHED} | {"tire_force": WRENCH}


class Decoded:
    """The messages of a session, each by the name of its method, as ROS's own decoder has them."""

    def __init__(self, session, frame_prefix="", covariances=Covariances()):  # noqa: B008
        self._messages = Messages(session.simulation, frame_prefix, encode, covariances)
        self._messages.applied = session.applied
        self._messages.set_time(12_345_678_901)

    def __getattr__(self, name):
        method = getattr(self._messages, name)
        return lambda *arguments: deserialize_message(
            method(*arguments), message_class(TYPES[name])
        )


@pytest.fixture
def messages(session):
    return Decoded(session, "car/")


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


@pytest.mark.parametrize("model", ["1", "8dof"])
def test_motion_has_steering_speed_and_yaw_rate_in_one_message(model):
    command = Command(steering=0.05, rear_steering=-0.01)
    session = Session(Simulation(preset(), Options(model=model)), CommandInbox(), 10_000_000, 20.0)
    session.applied = command
    session.simulation.step(command, 0.8)
    motion, simulation = Decoded(session).motion(), session.simulation
    state = simulation.state
    expected = {
        "time": simulation.time,
        "steering": 0.05,
        "rear_steering": -0.01,
        **{name: state[name] for name in ("u", "v", "yaw_rate", "roll", "roll_rate")},
        "lateral_acceleration": simulation.outputs.acceleration[1],
    }
    assert abs(expected["v"] * expected["yaw_rate"] * expected["roll"]) > 0.0
    labels = [dimension.label for dimension in motion.layout.dim]
    assert dict(zip(labels, motion.data, strict=True)) == expected


def test_imu_reads_g_upwards_at_rest():
    at_rest = Session(Simulation(preset()), CommandInbox(), 10_000_000, 13.9)
    imu = Decoded(at_rest).imu()
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
    torques = [values[f"{name}_{w}"] for name in OF_FOUR for w in WHEELS]
    assert torques == list(range(1, 13))


@pytest.mark.parametrize("topic", [each for each in STAMPED if each.name not in OTHERS])
def test_what_is_stamped_has_every_number_of_the_plain_one_by_name(session, topic):
    messages = Messages(session.simulation, "", encode)
    messages.applied = session.applied
    messages.set_time(12_345_678_901)
    build = builder(messages, encode, topic)
    plain = getattr(Decoded(session), topic.name.removesuffix("_stamped"))()
    stamped = deserialize_message(build(), message_class(topic.type))
    assert (stamped.header.stamp.sec, stamped.header.stamp.nanosec) == (12, 345_678_901)
    data = [plain.data] if isinstance(plain.data, float) else list(plain.data)
    np.testing.assert_array_equal(stamped.position, data)
    assert len(data) == len(stamped.name)
    if hasattr(plain, "layout"):
        assert stamped.name == [dimension.label for dimension in plain.layout.dim]
    assert (len(stamped.velocity), len(stamped.effort)) == (0, 0)


def test_the_stamped_signals_are_those_of_the_csv_by_name(session):
    """Also the loads and the other columns among them."""
    simulation = session.simulation
    build = builder(Messages(simulation, "", encode), encode, SIGNALS)
    simulation.step(Command(steering=0.2), 0.3)
    message = deserialize_message(build(), message_class(SIGNALS.type))
    found = dict(zip(message.name, message.position, strict=True))
    history = History([row_of(simulation)])
    signals = dict(zip(DERIVED, history.signals()[0], strict=True))
    assert {*DERIVED} < {*found}
    for name, value in found.items():
        assert value == (signals[name] if name in signals else history[name][0]), name
    assert found["wheel_lift_lf"] > 0.01
    assert found["wheel_lift_rf"] == 0.0
    assert {*SIGNAL_UNITS} == {*found}


def test_covariances_have_the_diagonals_that_were_given_and_0_beside_them(session):
    imu = ImuCovariances((1.0, 2.0, 3.0), (4.0, 5.0, 6.0), (7.0, 8.0, 9.0))
    odom = OdomCovariances(tuple(range(1, 7)), tuple(range(7, 13)))
    given, plain = Decoded(session, covariances=Covariances(imu, odom)), Decoded(session)
    told = given.imu()
    for name, diagonal in vars(imu).items():
        found = getattr(told, name.removesuffix("_diagonal"))
        assert found.reshape(3, 3).tolist() == np.diag(diagonal).tolist()
    pose, twist = given.odom().pose, given.odom().twist
    assert pose.covariance.reshape(6, 6).tolist() == np.diag(odom.pose_covariance_diagonal).tolist()
    assert twist.covariance.reshape(6, 6).tolist() == np.diag(range(7, 13)).tolist()
    assert not np.any([getattr(plain.imu(), name.removesuffix("_diagonal")) for name in vars(imu)])
    assert told.linear_acceleration == plain.imu().linear_acceleration
    assert (pose.pose, twist.twist) == (plain.odom().pose.pose, plain.odom().twist.twist)


def test_the_footprint_is_below_the_body_and_turned_by_yaw_only(session, encoding):
    messages = Messages(session.simulation, "car/", encoding.encode)
    messages.set_time(12_345_678_901)
    footprint, body = encoding.decode(messages.tf(), TRANSFORMS.type).transforms
    for transform in (footprint, body):
        assert transform.header.frame_id == "car/odom"
        stamp = transform.header.stamp
        assert (stamp.sec, stamp.nanosec) == (12, 345_678_901)
    state = session.simulation.state
    assert (body.child_frame_id, footprint.child_frame_id) == (
        "car/base_link",
        "car/base_footprint",
    )
    assert vector(footprint.transform.translation) == pytest.approx([state.x, state.y, 0.0])
    q = footprint.transform.rotation
    yaw = Rotation.from_quat([q.x, q.y, q.z, q.w]).as_euler("ZYX")
    assert yaw == pytest.approx([state.yaw, 0.0, 0.0], abs=ROUNDING)
    assert list(vector(body.transform.translation)) == [state.x, state.y, state.z]
    q = body.transform.rotation
    attitude = Rotation.from_quat([q.x, q.y, q.z, q.w]).as_euler("ZYX")
    assert attitude == pytest.approx([state.yaw, state.pitch, state.roll], abs=ROUNDING)


def test_without_heave_there_is_no_transform_to_the_body(encoding):
    messages = Messages(Simulation(preset(), Options(model="8dof")), "", encoding.encode)
    found = encoding.decode(messages.tf(), TRANSFORMS.type).transforms
    assert [transform.child_frame_id for transform in found] == ["base_footprint"]


@pytest.mark.parametrize("model", ["1", "2", "8dof"])
def test_ros_and_the_library_of_bags_encode_every_message_alike(model, encoding):
    simulation = Simulation(preset(), Options(model=model))
    encoders = (encode, encoding.encode)
    both = [Messages(simulation, "car/", code) for code in encoders]
    simulation.step(Command(steering=0.1), 0.5)
    for messages in both:
        messages.set_time(500_000_000)
    for topic in (*set_of(simulation.options, stamped=True), CLOCK):
        ours, theirs = (builder(*each, topic)() for each in zip(both, encoders, strict=True))
        without_padding = encoding.TYPES.serialize_cdr(
            encoding.decode(ours, topic.type), topic.type
        )
        assert bytes(without_padding) == theirs, topic.name


def test_without_heave_and_pitch_odom_still_has_the_sprung_cg():
    """Where the 8 DOF model has its c.g. is known from the acceleration that it measures there."""
    simulation = Simulation(preset(), Options(model="8dof"))
    messages = Decoded(Session(simulation, CommandInbox(), 1_000_000, 13.9))
    step, course, places = 0.001, [], []  # s
    for _ in range(300):
        simulation.step(Command(steering=0.1), step)
        odom = messages.odom()
        course.append(odom.twist.twist.linear.y / np.cos(simulation.state.roll))  # level again
        places.append(odom.pose.pose.position.y)
    state, outputs = simulation.state, simulation.outputs
    rate = (course[-1] - course[-3]) / (2 * step)  # of the step before the last
    turning = state.yaw_rate * state.u
    # between neighbouring steps the acceleration changes by some 0.05 m/s^2
    assert rate + turning == pytest.approx(outputs.acceleration[1], abs=0.15)
    assert abs(outputs.body_acceleration[3]) > 0.5  # rad/s^2: the c.g. moves unlike the axis
    depth = (0.65 * 1.524 + 0.6 * 1.016) / 2.54  # m, equation 81
    beside = -depth * state.roll * np.cos(state.yaw)
    assert places[-1] == pytest.approx(state.y + beside, rel=1e-9)
    assert np.isnan([odom.pose.pose.position.z, odom.twist.twist.linear.z]).all()


@pytest.mark.parametrize(
    ("model", "kind", "limited"),
    [("1", "prismatic", True), ("2", "prismatic", True), ("8dof", "fixed", False)],
)
def test_the_description_has_the_joints_that_joint_states_moves(model, kind, limited):
    options = Options(model=model)
    session = Session(Simulation(preset(), options), CommandInbox(), 10_000_000, 13.9)
    description = robot_description(session.simulation)
    joints = ElementTree.fromstring(description.encode()).findall("joint")
    moving = [joint.get("name") for joint in joints if joint.get("type") != "fixed"]
    assert sorted(moving) == sorted(Decoded(session).joint_states().name)
    struts = [joint for joint in joints if "suspension" in joint.get("name")]
    assert {joint.get("type") for joint in struts} == {kind}
    assert all((joint.find("limit") is not None) == limited for joint in struts)
