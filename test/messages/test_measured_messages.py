"""Messages of a vehicle with sensors: what these say, and the truth beside it."""

from xml.etree import ElementTree

import numpy as np
import pytest
from measured import measured

pytest.importorskip("rosbags", reason="bags need the library rosbags")

from vehicle_roll_sim import Command, Simulation, preset
from vehicle_roll_sim.bags.encoding import decode, encode
from vehicle_roll_sim.messages.covariances import Covariances, ImuCovariances
from vehicle_roll_sim.messages.measured import messages_of
from vehicle_roll_sim.messages.stamped import builder
from vehicle_roll_sim.messages.topics import GROUND_TRUTH, MEASURED_BY, TRUTH, set_of
from vehicle_roll_sim.messages.urdf import urdf
from vehicle_roll_sim.vehicle.sensor_parameters import DEVICES

TURN = Command(steering=0.0515)
STAMPS_NS = 12_000_000_000
"""Where the clock of the stamps is ahead of simulated time."""


def driven(vehicle, until: float = 0.5) -> Simulation:
    simulation = Simulation(vehicle)
    simulation.step(TURN, until)
    return simulation


class Set:
    """The messages of the present set of a simulation, as bytes and decoded."""

    def __init__(self, simulation: Simulation, covariances=Covariances()):  # noqa: B008
        messages = messages_of(simulation, "car/", encode, covariances)
        messages.set_time(STAMPS_NS + simulation.time_ns)
        topics = set_of(simulation.options, True, simulation.sensors.devices)
        self.bytes = {each.name: builder(messages, encode, each)() for each in topics}
        self._types = {each.name: each.type for each in topics}

    def __getitem__(self, name: str):
        return decode(self.bytes[name], self._types[name])


@pytest.fixture(scope="module")
def simulation():
    return driven(measured())


@pytest.fixture(scope="module")
def found(simulation):
    return Set(simulation)


def numbers(message, *names: str) -> list[float]:
    return [getattr(message, name) for name in names]


def test_imu_and_odom_and_joints_are_what_the_sensors_say(simulation, found):
    said, imu, odom = simulation.sensors, found["imu"], found["odom"]
    assert imu.header.frame_id == "car/imu_link"
    assert (odom.header.frame_id, odom.child_frame_id) == ("car/odom", "car/base_link")
    assert numbers(imu.linear_acceleration, *"xyz") == said["accelerometer"].tolist()
    assert numbers(imu.angular_velocity, *"xyz") == said["gyro"].tolist()
    assert numbers(imu.orientation, *"xyzw") == said["imu_orientation"].tolist()
    assert numbers(odom.pose.pose.position, *"xyz") == said["odom_position"].tolist()
    assert numbers(odom.pose.pose.orientation, *"xyzw") == said["odom_orientation"].tolist()
    assert numbers(odom.twist.twist.linear, *"xyz") == said["odom_velocity"].tolist()
    assert numbers(odom.twist.twist.angular, *"xyz") == said["odom_rate"].tolist()
    joints = found["joint_states"]
    position = dict(zip(joints.name, joints.position, strict=True))
    speed = dict(zip(joints.name, joints.velocity, strict=True))
    assert position["lf_steering_joint"] == said["steering"][0] != simulation.outputs.steering[0]
    assert speed["rr_wheel_joint"] == said["wheel_speed"][3] != simulation.state.wheel_speed[3]
    assert position["rr_wheel_joint"] == simulation.state.wheel_angle[3]


def test_measurements_has_all_of_it_by_name(simulation, found):
    message = found["measurements"]
    labels = [dimension.label for dimension in message.layout.dim]
    assert labels == ["time", *simulation.sensors.labels]
    assert list(message.data) == [0.5, *simulation.sensors.readings()]
    assert list(found["measurements_stamped"].position) == list(message.data)


def test_everything_else_and_the_ground_truth_are_the_bytes_of_a_vehicle_without_sensors(found):
    plain = Set(driven(preset()))
    assert plain.bytes.keys() < found.bytes.keys()
    changed = {name for name in plain.bytes if plain.bytes[name] != found.bytes[name]}
    assert changed == MEASURED_BY.keys()
    for topic in GROUND_TRUTH:
        assert found.bytes[topic.name] == plain.bytes[topic.name.removeprefix(TRUTH)]


@pytest.mark.parametrize("device", DEVICES)
def test_only_what_a_device_measures_has_a_ground_truth(device):
    simulation = Simulation(preset().with_values({f"{device}_period": 0.01}))
    names = {topic.name for topic in set_of(simulation.options, False, simulation.sensors.devices)}
    expected = {TRUTH + name for name, devices in MEASURED_BY.items() if device in devices}
    assert {name for name in names if name.startswith(TRUTH)} == expected


def test_a_sample_that_does_not_arrive_leaves_the_message_before_with_its_stamp():
    simulation = Simulation(measured(imu_delay=0.0, imu_dropout=0.5))
    stamps, repeated, before = [], 0, None
    for _ in range(60):
        simulation.step(TURN, 0.01)
        message = Set(simulation)
        stamp = message["imu"].header.stamp
        stamps.append(stamp.sec * 10**9 + stamp.nanosec - STAMPS_NS)
        if stamps[-1] != simulation.time_ns:
            assert message.bytes["imu"] == before
            repeated += 1
        before = message.bytes["imu"]
    assert stamps == sorted(stamps)
    assert 15 <= repeated <= 45  # of 60: four standard deviations of a fair coin


def diagonal(covariance) -> np.ndarray:
    size = round(len(covariance) ** 0.5)
    return np.diag(np.reshape(covariance, (size, size)))


def test_covariances_are_those_of_the_noise_unless_they_are_given(simulation, found):
    sample = 0.01  # s
    imu, odom = found["imu"], found["odom"]
    np.testing.assert_allclose(
        diagonal(imu.linear_acceleration_covariance), 0.002**2 / sample, rtol=1e-12
    )
    np.testing.assert_allclose(diagonal(imu.orientation_covariance), 1e-8 / sample, rtol=1e-12)
    assert not np.any(imu.angular_velocity_covariance)  # it walks, without noise: unknown
    expected = [0.1**2 / 0.05] * 3 + [0.0] * 3
    np.testing.assert_allclose(diagonal(odom.pose.covariance), expected, rtol=1e-12)
    given = ImuCovariances(linear_acceleration_covariance_diagonal=(1.0, 2.0, 3.0))
    told = Set(simulation, Covariances(imu=given))["imu"]
    assert diagonal(told.linear_acceleration_covariance).tolist() == [1.0, 2.0, 3.0]
    np.testing.assert_allclose(diagonal(told.orientation_covariance), 1e-8 / sample, rtol=1e-12)


def test_the_robot_description_has_the_imu_where_it_is_said_to_be():
    robot = ElementTree.fromstring(urdf(measured()).encode())
    origin = robot.find("joint[@name='imu_joint']/origin")
    assert (origin.get("xyz"), origin.get("rpy")) == ("0.4 -0.3 0.2", "0 0 1.5")
    assert robot.find("link[@name='imu_link']") is not None
    assert b"imu" not in urdf(preset()).encode()
