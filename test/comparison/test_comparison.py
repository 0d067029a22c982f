"""The simulator's own logs with known faults give back these faults; wrong models are rejected."""

import numpy as np
import pytest
from made_logs import gentle_log, made, overturning, severe

from vehicle_roll_sim import (
    Condition,
    InputError,
    Options,
    PlausibilityWarning,
    Simulation,
    compare,
    preset,
)

FREE = {"drive_by": "torques", "run_up": 0.0}
"""As the logs were made: rolling freely."""


@pytest.fixture(scope="module")
def result_of(tmp_path_factory):
    """result_of(log, …): the comparison of a log with the reference vehicle."""

    def call(log, simulation=None, mapped=None, **settings):
        path = log.write(tmp_path_factory.mktemp("log") / "log.csv")
        chosen = FREE | settings
        return compare(path, mapped or log.map(), simulation=simulation, **chosen)

    return call


@pytest.fixture(scope="module")
def faultless(result_of):
    return result_of(gentle_log())


def test_a_log_of_the_simulator_itself_agrees_to_the_interpolation_of_its_steering(faultless):
    assert faultless.accepted
    for name, found in faultless.agreements.items():
        # steering is read every 10 ms and held for 2 ms about its middle
        assert found.rms < 2e-4 * found.peak, name
        assert found.shift == pytest.approx(0.0, abs=1e-4), name
        assert found.gain == pytest.approx(1.0, abs=1e-4), name


def test_its_gradients_are_those_of_the_log(faultless):
    measured, simulated = (faultless.gradients[side] for side in ("measured", "simulated"))
    assert measured.understeer == pytest.approx(simulated.understeer, rel=1e-5)
    assert measured.roll == pytest.approx(simulated.roll, rel=1e-5)
    assert measured.roll > 0.0


def test_known_delay_gain_and_noise_come_back(result_of):
    noise = np.random.default_rng(3)
    log = gentle_log().late("yaw_rate", 0.037)
    roll = 1.08 * log.columns["roll"] + noise.normal(0.0, 1e-3, len(log.columns["roll"]))
    found = result_of(log.with_(roll=roll)).agreements
    # linear interpolation of the delayed signal, and the parabola of the correlation
    assert found["yaw_rate"].shift == pytest.approx(0.037, abs=3e-4)
    assert found["yaw_rate"].gain == pytest.approx(1.0, abs=1e-3)
    assert found["roll"].gain == pytest.approx(1 / 1.08, rel=2e-3)  # noise of 1 % of the peak
    assert found["roll"].shift == pytest.approx(0.0, abs=1e-3)
    assert found["roll_rate"].shift == pytest.approx(0.0, abs=1e-4)


@pytest.mark.usefixtures("unplaced")
def test_aligning_removes_a_delay_that_would_be_rejected(result_of, tmp_path):
    log = gentle_log().late("yaw_rate", 0.2)
    assert not result_of(log).accepted
    aligned = result_of(log, align=True)
    assert aligned.accepted
    assert aligned.agreements["yaw_rate"].shift == pytest.approx(0.2, abs=1e-3)
    assert np.isnan(aligned["yaw_rate_measured"][-10:]).all()
    assert aligned.gradients["measured"].roll > 0.0
    aligned.plot(tmp_path / "aligned.svg")
    assert (tmp_path / "aligned.svg").stat().st_size > 0


def test_a_sensor_away_from_the_cg_agrees_once_its_place_is_named(result_of):
    log = gentle_log()
    x, z = 1.5, -0.4
    time, of = log.columns["time"], log.columns
    turning = np.gradient(of["yaw_rate"], time) * x - np.gradient(of["roll_rate"], time) * z
    inward = of["pitch_rate"] * (of["roll_rate"] * x + of["yaw_rate"] * z)
    lateral = np.tan(of["sideslip_angle"]) * of["speed"] + of["yaw_rate"] * x - of["roll_rate"] * z
    moved = log.with_(
        lateral_acceleration=of["lateral_acceleration"] + turning + inward,
        sideslip_angle=np.arctan2(lateral, of["speed"]),
    )
    place = {"place": [x, 0.0, z]}
    at_sensor = result_of(moved).agreements
    mapped = moved.map(lateral_acceleration={"frame": "level"} | place, sideslip_angle=dict(place))
    at_cg = result_of(moved, mapped=mapped).agreements
    for name in ("lateral_acceleration", "sideslip_angle"):
        assert at_sensor[name].rms > 0.05 * at_sensor[name].peak
        assert at_cg[name].rms < 0.005 * at_cg[name].peak  # derivatives over 20 ms


def test_the_speed_of_the_log_is_held(result_of):
    log = gentle_log()
    slower = log.with_(speed=np.linspace(22.0, 18.0, len(log.columns["speed"])), brake=None)
    result = result_of(slower, drive_by="speed", run_up=2.0)
    assert result.compared.driven.speed_error < 0.15  # m/s: of a controller on a ramp
    assert "speed_measured" not in result.compared.judged


def test_what_does_not_drive_the_model_is_named(result_of):
    result = result_of(gentle_log(), drive_by="speed")
    assert "not used: brake" in result.summary


@pytest.fixture(scope="module")
def lifting():
    """A log in which the inner wheels lift off."""
    log = made(Simulation(preset()), severe, duration=3.5)
    assert min(log.columns["normal_force_lf"]) == 0.0
    return log


def test_the_right_model_is_accepted_beyond_lift_off(result_of, lifting):
    assert result_of(lifting).accepted


@pytest.mark.parametrize("options", [{"model": "8dof"}, {"no_roll_centre": True}])
def test_a_wrong_model_is_rejected_beyond_lift_off(result_of, lifting, options):
    result = result_of(lifting, Simulation(preset(), Options(**options)))
    assert result.accepted is False
    assert result.inside["roll"] < 0.8


def test_a_rollover_of_both_at_the_same_time_is_accepted(result_of):
    log = made(Simulation(preset()), overturning, duration=2.5)
    assert np.degrees(log.columns["roll"][-1]) > 80.0
    longer = {name: np.append(each, each[-1]) for name, each in log.columns.items()}
    longer["time"][-1] += 0.01
    result = result_of(log.with_(**longer))
    assert result.compared.driven.condition is Condition.ROLLED_OVER
    assert result.accepted


def test_a_model_that_rolls_over_where_the_vehicle_does_not_is_rejected(result_of, lifting):
    tall = Simulation(preset().with_values({"cg_height": 1.3}))
    result = result_of(lifting, tall)
    assert result.accepted is False
    assert "rejected: the model stopped at" in result.summary
    assert "s of the log: rolled over" in result.summary


def test_a_log_without_motion_has_no_verdict(result_of):
    log = gentle_log()
    still = {name: 0.0 * log.columns[name] for name in ("steering", "yaw_rate", "roll")}
    lines = {name: None for name in log.columns if name not in ("time", "speed", *still)}
    result = result_of(log.with_(**(lines | still)), drive_by="speed")
    assert result.accepted is None
    assert "too small to judge" in result.summary
    assert result.gradients is None


def test_steering_that_no_vehicle_has_is_warned_of(result_of):
    log = gentle_log()
    turned = log.with_(steering=30.0 * log.columns["steering"])
    with pytest.warns(PlausibilityWarning, match="steering of the log: .* give the angle in rad"):
        result_of(turned)


def test_torques_that_the_log_does_not_have_are_refused(result_of):
    with pytest.raises(InputError, match="drive_by: 'torques' is not allowed: drive_torque, brake"):
        result_of(gentle_log().with_(brake=None))


def test_a_total_and_a_wheel_are_refused_together(result_of):
    log = gentle_log()
    both = log.with_(brake_torque_lf=log.columns["brake"])
    mapped = both.map(brake_torque_lf={"unit": "N m"})
    with pytest.raises(InputError, match="columns: brake: brake together with brake_torque_lf"):
        result_of(both, mapped=mapped)


def test_the_summary_and_the_columns_are_those_of_the_comparison(faultless, tmp_path):
    faultless.write_csv(tmp_path / "out.csv")
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert len(lines) == 1 + len(faultless["time"])
    assert lines[0].split(",")[:3] == ["time", "speed_measured", "speed_simulated"]
    for name in faultless.quantities:
        assert name in faultless.summary
    with pytest.raises(KeyError, match="no column 'x'"):
        faultless["x"]
