"""Fields of messages as columns: of a bag that the library wrote, and of a run of our own."""

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from vehicle_roll_sim import InputError, compare, run
from vehicle_roll_sim.bags.topic_columns import read_topics

TYPES = get_typestore(Stores.ROS2_HUMBLE)
SECOND = 10**9


@pytest.fixture(scope="module")
def foreign(tmp_path_factory):
    """A bag with an IMU that was recorded 0.5 s after its stamps, and numbers without stamps."""
    message = TYPES.types
    path = tmp_path_factory.mktemp("bag") / "foreign"
    zero = message["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
    upright = message["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as bag:
        imu, number = "sensor_msgs/msg/Imu", "std_msgs/msg/Float64"
        of_imu = bag.add_connection("/car/imu", imu, typestore=TYPES)
        of_number = bag.add_connection("/wheel", number, typestore=TYPES)
        for k in range(30):
            stamp = message["builtin_interfaces/msg/Time"](7, k * 10_000_000)
            header = message["std_msgs/msg/Header"](stamp, "base")
            turning = message["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.1 * k)
            covariance = np.zeros(9)
            fields = (header, upright, covariance, turning, covariance, zero, covariance)
            sent = 7 * SECOND + k * 10_000_000 + SECOND // 2
            bag.write(of_imu, sent, TYPES.serialize_cdr(message[imu](*fields), imu))
            bag.write(of_number, sent, TYPES.serialize_cdr(message[number](2.0 * k), number))
    return path


def test_messages_are_timed_by_their_stamps_and_others_by_the_recorder(foreign):
    names = ("/car/imu:angular_velocity.z", "/wheel:data")
    found, unstamped = read_topics(foreign, dict.fromkeys(names, "x"))
    stamps = 7.0 + 0.01 * np.arange(30)
    np.testing.assert_allclose(found[names[0]][0], stamps, atol=1e-9)
    np.testing.assert_allclose(found[names[0]][1], 0.1 * np.arange(30), atol=1e-15)
    np.testing.assert_allclose(found[names[1]][0], stamps + 0.5, atol=1e-9)
    np.testing.assert_allclose(found[names[1]][1], 2.0 * np.arange(30), atol=0.0)
    assert unstamped == ["/wheel"]


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("imu", "x: column: 'imu' is not allowed: TOPIC:FIELD, such as"),
        ("/imu:angular_velocity.z", "x: column: topic: '/imu' is unknown: did you mean /car/imu"),
        ("/car/imu:angular_velocity.w", "'w' is unknown: one of x, y, z"),
        ("/car/imu:angular_velocity", "x: column: '/car/imu:angular_velocity' is not allowed: a f"),
        ("/car/imu:header.frame_id", "x: column: '/car/imu:header.frame_id' is not allowed: a fi"),
    ],
)
def test_what_a_bag_does_not_have_is_named(foreign, name, problem):
    with pytest.raises(InputError, match=problem):
        read_topics(foreign, {name: "x"})


def test_a_folder_that_is_no_bag_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"LOG: .* a complete bag"):
        read_topics(tmp_path, {"/imu:a": "x"})


COLUMNS = {
    "speed": ("/odom:twist.twist.linear.x", "m/s"),
    "steering": ("/applied_command:steering", "rad"),
    "yaw_rate": ("/imu:angular_velocity.z", "rad/s"),
    "lateral_acceleration": ("/imu:linear_acceleration.y", "m/s^2"),
    "roll": ("/state:roll", "rad"),
    "normal_force_lf": ("/tire_normal_forces:lf", "N"),
}


def test_the_bag_of_a_run_agrees_with_the_model_that_made_it(tmp_path):
    run("step_steer", duration=3.0, amplitude=2.0, speed=20.0, bag=tmp_path / "turn")
    columns = {name: {"column": column, "unit": unit} for name, (column, unit) in COLUMNS.items()}
    result = compare(tmp_path / "turn", {"columns": columns})
    assert result.accepted
    for name, found in result.agreements.items():
        # commands are recorded at the end of the 10 ms for which they are held
        assert found.shift == pytest.approx(-0.005, abs=0.004), name
        assert found.gain == pytest.approx(1.0, abs=0.02), name
    assert "recorder's times" in result.summary
    with pytest.raises(
        InputError, match="columns: time: 't' is not allowed: nothing: the file has"
    ):
        compare(tmp_path / "turn", {"columns": columns | {"time": {"column": "t", "unit": "s"}}})
