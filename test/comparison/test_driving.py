"""What the model did is what a run of the same commands did, in the frame of the sensor."""

import numpy as np
import pytest
from made_logs import gentle_log

from vehicle_roll_sim import Simulation, compare, preset
from vehicle_roll_sim.vehicle.derived_values import GRAVITY


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return gentle_log().write(tmp_path_factory.mktemp("log") / "log.csv")


def test_an_accelerometer_feels_gravity_by_the_roll_angle(path):
    mapped = gentle_log().map(lateral_acceleration={"frame": "body"})
    felt = compare(path, mapped, drive_by="torques", run_up=0.0)["lateral_acceleration_simulated"]
    log = gentle_log().columns
    roll, level = log["roll"], log["lateral_acceleration"]
    expected = np.cos(roll) * level + np.sin(roll) * GRAVITY
    # without heave (below 0.4 m/s^2 times sin of 6 deg) and pitch; the filter takes 0.3 %
    np.testing.assert_allclose(felt, expected, atol=0.07)
    assert np.abs(felt - level).max() > 0.5


def test_a_handwheel_turns_the_road_wheels_by_the_gear_of_the_vehicle(tmp_path):
    log = gentle_log()
    vehicle = preset()
    handwheel = vehicle.steering_ratio * log.columns["steering"]
    by_hand = log.with_(handwheel=handwheel, steering=None)
    result = compare(
        by_hand.write(tmp_path / "log.csv"), by_hand.map(), drive_by="torques", run_up=0.0
    )
    assert result.agreements["yaw_rate"].rms < 2e-4 * result.agreements["yaw_rate"].peak


def test_rear_steering_is_that_of_the_log(tmp_path):
    log = gentle_log()
    rear = log.with_(rear_steering=0.5 * log.columns["steering"])
    result = compare(rear.write(tmp_path / "log.csv"), rear.map(), drive_by="torques", run_up=0.0)
    assert not result.accepted  # the log was made without
    assert result.agreements["yaw_rate"].gain < 0.7


def test_the_same_log_gives_the_same_bytes(path, tmp_path):
    for name in ("one.csv", "other.csv"):
        compare(path, gentle_log().map(), simulation=Simulation(preset())).write_csv(
            tmp_path / name
        )
    assert (tmp_path / "one.csv").read_bytes() == (tmp_path / "other.csv").read_bytes()
