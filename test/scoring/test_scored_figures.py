"""Figures of runs and costs, against closed forms of runs that are put together."""

import math

import numpy as np
import pytest
from constructed import INTERVAL, history, outcome

from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.scoring.alarms import Alarms, alarm_of
from vehicle_roll_sim.scoring.figures import actuator_energy, cost_of, figures_of, lift_time

ROUNDING = 1e-9
"""Of sums over some hundred samples."""
LIFTED = -0.06
"""m: tire compression of a wheel more than 2 inches above the ground."""


def test_peaks_are_the_largest_of_either_sign():
    time = np.arange(201) * INTERVAL
    run = history(2.0, {"brake_torque_rf": 700.0 * time}, roll=-0.2 * time, roll_rate=-0.2)
    found = figures_of(outcome(run))
    assert found.peak_roll == pytest.approx(0.4, rel=ROUNDING)
    assert found.peak_roll_rate == 0.2
    assert found.brake_torque == pytest.approx(1400.0, rel=ROUNDING)
    assert (found.active_force, found.load_transfer_ratio, found.lift_time) == (0.0, 0.0, 0.0)


def test_the_load_transfer_ratio_is_one_when_a_side_is_unloaded():
    run = history(1.0, normal_force_lf=0.0, normal_force_lr=0.0)
    assert figures_of(outcome(run)).load_transfer_ratio == 1.0


def test_the_time_of_wheel_lift_counts_each_interval_once_whatever_the_number_of_wheels():
    time = np.arange(301) * INTERVAL
    one, other = (time > 1.0) & (time <= 1.5), (time > 1.2) & (time <= 1.7)
    run = history(
        3.0, normal_force_lf=np.where(one, 0.0, 3e3), normal_force_lr=np.where(other, 0.0, 3e3)
    )
    assert lift_time(run) == pytest.approx(0.7, rel=ROUNDING)


def test_brakes_do_the_work_of_their_torque_over_the_angle_that_wheels_turn():
    """500 N m at two wheels that slow down from 50 to 30 rad/s in 2 s: 80 rad each."""
    spin = np.linspace(50.0, 30.0, 201)
    run = history(2.0, {"brake_torque_lf": 500.0, "brake_torque_rf": 500.0}, wheel_speed=spin)
    assert actuator_energy(run) == pytest.approx(2 * 500.0 * 80.0, rel=ROUNDING)


def test_a_brake_that_holds_a_locked_wheel_does_no_work():
    assert actuator_energy(history(1.0, {"brake_torque": 2000.0}, wheel_speed=0.0)) == 0.0


def test_active_forces_do_work_with_the_travel_of_the_suspension_in_either_direction():
    """1000 N over 0.05 m down and up again."""
    travel = 0.1 + 0.05 * np.concatenate((np.linspace(0, 1, 101), np.linspace(1, 0, 101)[1:]))
    run = history(2.0, {"active_force_lf": -1000.0}, suspension_compression_lf=travel)
    assert actuator_energy(run) == pytest.approx(100.0, rel=ROUNDING)


def test_steering_is_given_no_energy_since_the_model_has_no_force_for_it():
    run = history(1.0, {"rear_steering": np.sin(np.arange(101))}, wheel_speed=50.0)
    assert actuator_energy(run) == 0.0


def test_costs_are_compared_up_to_the_end_of_the_shorter_run():
    time, short = np.arange(301) * INTERVAL, np.arange(201) * INTERVAL
    alone = outcome(history(2.0, x=20.0 * short, u=20.0))
    found = outcome(history(3.0, x=20.0 * time, y=0.5 * time**2, u=20.0 - 2.0 * time))
    for pair in ((alone, found), (found, alone)):
        assert cost_of(*pair).distance == pytest.approx(2.0, rel=ROUNDING)
    assert cost_of(alone, found).speed == pytest.approx(4.0, rel=ROUNDING)
    assert cost_of(found, alone).speed == pytest.approx(-4.0, rel=ROUNDING)


def lifted(at: float) -> np.ndarray:
    """Tire compression (m) of wheels that lift at a time (s)."""
    return np.where(np.arange(301) * INTERVAL >= at, LIFTED, 0.02)


def tipping(at: float, **settings):
    compression = lifted(at)
    wheels = {"tire_compression": compression, "normal_force": 4000.0 * (compression > 0.0)}
    sides = {f"{name}_{side}": wheels[name] for name in wheels for side in ("lf", "lr")}
    return outcome(history(3.0, **sides), **settings)


SAFE = tipping(math.inf)


def test_the_lead_time_of_a_warning_is_that_to_the_two_wheel_lift():
    alarm = alarm_of(SAFE, tipping(2.0, warned_at=1.5))
    assert alarm.lead == pytest.approx(0.5, rel=ROUNDING)
    assert (alarm.is_false, alarm.is_missed, alarm.averted) == (False, False, False)


def test_a_danger_that_the_controller_averts_counts_where_it_would_have_been():
    alarm = alarm_of(tipping(2.0), tipping(math.inf, warned_at=1.25))
    assert alarm.averted
    assert alarm.lead == pytest.approx(0.75, rel=ROUNDING)
    silent = alarm_of(tipping(2.0), SAFE)
    assert (silent.is_missed, silent.is_false) == (False, False)


@pytest.mark.parametrize("at", [2.0, 2.5, math.inf])
def test_a_danger_without_a_warning_before_it_is_missed(at):
    alarm = alarm_of(SAFE, tipping(2.0, warned_at=at))
    assert alarm.is_missed
    assert not alarm.is_false
    assert math.isnan(alarm.lead)


def test_a_warning_without_danger_is_false():
    alarm = alarm_of(SAFE, tipping(math.inf, warned_at=1.0))
    assert alarm.is_false
    assert not alarm.is_missed


def test_a_run_that_stops_without_lift_is_in_danger_at_its_end():
    stopped = outcome(history(1.2), Condition.ROLLED_OVER)
    assert alarm_of(SAFE, stopped).danger == pytest.approx(1.2, rel=ROUNDING)


def test_alarms_are_counted_and_lead_times_sorted():
    pairs = [
        (SAFE, tipping(2.0, warned_at=1.0)),
        (SAFE, tipping(2.0, warned_at=1.9)),
        (SAFE, tipping(2.0)),
        (SAFE, tipping(math.inf, warned_at=0.5)),
        (SAFE, SAFE),
    ]
    found = Alarms.of(alarm_of(*pair) for pair in pairs)
    assert (found.runs, found.dangers, found.false, found.missed) == (5, 3, 1, 1)
    assert found.leads == pytest.approx((0.1, 1.0), rel=ROUNDING)
