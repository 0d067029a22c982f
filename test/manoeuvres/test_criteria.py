"""Pass criteria of the standards, on histories with a known result."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import WHEELS, Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.manoeuvres.criteria import two_wheel_lift, two_wheel_lift_line, value_at
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run

TIMES = np.round(np.arange(0.0, 6.0, 0.01), 9)
START, END = 1.0, 1.0 + 1 / 0.7 + 0.5
"""s: of the steering of a sine with dwell."""


def history_of(times=TIMES, **signals) -> History:
    """A history with these columns and 0 in the others."""
    rows = np.zeros((len(times), len(COLUMNS)))
    rows[:, 0] = times
    for name, values in signals.items():
        rows[:, COLUMNS.index(name)] = values
    return History(rows)


def heights(**metres) -> dict:
    """Tire compressions of wheels that are so high at times from 2 s on; -0 below 0 is loaded."""
    return {f"tire_compression_{w}": np.where(TIMES >= 2.0, -h, 0.02) for w, h in metres.items()}


@pytest.mark.parametrize(
    ("lifted", "time"),
    [
        pytest.param({"lf": 0.06, "lr": 0.06}, 2.0, id="both on the left"),
        pytest.param({"rf": 0.0508, "rr": 0.2}, 2.0, id="both on the right, one just so"),
        pytest.param({"lf": 0.0507, "lr": 0.2}, math.nan, id="one too low"),
        pytest.param({"lf": 0.2, "rf": 0.2}, math.nan, id="both in front"),
        pytest.param({"lf": 0.2, "rr": 0.2}, math.nan, id="across"),
        pytest.param({"rr": 0.3}, math.nan, id="one alone"),
    ],
)
def test_two_wheels_lift_when_both_of_a_side_are_two_inches_off(lifted, time):
    assert two_wheel_lift(history_of(**heights(**lifted))) == pytest.approx(time, nan_ok=True)


def test_two_wheels_that_are_off_at_different_times_are_no_two_wheel_lift():
    front = np.where((TIMES > 1.0) & (TIMES < 2.0), -0.1, 0.02)
    rear = np.where((TIMES >= 2.0) & (TIMES < 3.0), -0.1, 0.02)
    one_by_one = history_of(tire_compression_lf=front, tire_compression_lr=rear)
    assert math.isnan(two_wheel_lift(one_by_one))
    assert two_wheel_lift_line(one_by_one) == {"two-wheel lift": "none"}


def test_a_model_without_wheel_heights_does_not_pass_for_one_that_stays_down():
    unknown = history_of(**{f"tire_compression_{w}": math.nan for w in WHEELS})
    assert "unknown" in two_wheel_lift_line(unknown)["two-wheel lift"]


def test_a_signal_beyond_the_end_of_the_run_is_not_known():
    history = history_of(y=2.0 * TIMES)
    assert value_at(history, "y", 1.234) == pytest.approx(2.468, rel=1e-12)
    assert value_at(history, "y", 5.99) == pytest.approx(11.98, rel=1e-12)
    assert math.isnan(value_at(history, "y", 6.0))


def dwell(**changes):
    """A sine with dwell of 100 deg to the left, 5 times the angle at 0.3 g."""
    manoeuvre = STANDARD["sine_with_dwell"]
    changes = {"steering_at_03g": 20.0} | changes
    return dataclasses.replace(manoeuvre, **changes).for_vehicle(preset(), Options())


def yaw_rates(after_1_00: float, after_1_75: float) -> np.ndarray:
    """1 to the left at first, a peak of -0.5 at 2.7 s, and these shares of the peak afterwards."""
    knots = {START: 0.0, 1.4: 1.0, 2.0: 0.0, 2.7: -0.5, END: -0.4}
    knots |= {END + 1.0: -0.5 * after_1_00, END + 1.75: -0.5 * after_1_75, 6.0: 0.0}
    return np.interp(TIMES, list(knots), list(knots.values()))


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(
    ("ratios", "moved", "is_passed"),
    [
        ((0.34, 0.19), 1.84, True),
        ((0.36, 0.19), 1.84, False),
        ((0.34, 0.21), 1.84, False),
        ((0.34, 0.19), 1.82, False),
        ((-0.36, 0.0), 1.84, False),
    ],
)
def test_a_sine_with_dwell_is_passed_within_all_three_limits(side, ratios, moved, is_passed):
    manoeuvre = dwell(scalar=5.0 * side)
    y = moved / 1.07 * np.clip(TIMES - START, 0.0, None)
    result = manoeuvre.result(history_of(yaw_rate=side * yaw_rates(*ratios), y=side * y))
    # knots lie between samples, and the steepest slope is 0.2 % of the peak in half of one
    assert result.yaw_rate_ratios == pytest.approx([abs(r) for r in ratios], abs=3e-3)
    assert result.displacement == pytest.approx(moved, abs=1e-3)
    assert result.is_passed is is_passed


@pytest.mark.parametrize(("extra", "least"), [(0.0, 1.83), (1e-3, 1.52)])
@pytest.mark.parametrize("short", [-0.01, 0.01])
def test_a_vehicle_of_more_than_3500_kg_moves_aside_by_less(extra, least, short):
    """The whole vehicle's mass counts: 3180 kg on four wheels of 80 kg are just not more."""
    heavy = preset().with_values({"sprung_mass": 3180.0 + extra})
    manoeuvre = dataclasses.replace(STANDARD["sine_with_dwell"], steering_at_03g=20.0)
    manoeuvre = manoeuvre.for_vehicle(heavy, Options())
    moved = (least + short) / 1.07 * np.clip(TIMES - START, 0.0, None)
    history = history_of(yaw_rate=yaw_rates(0.1, 0.1), y=moved)
    assert manoeuvre.result(history).is_passed is (short > 0.0)
    assert f"at least {least:g} m" in manoeuvre.report(history, None)["lateral displacement"]


def test_below_five_times_the_angle_no_displacement_is_wanted():
    history = history_of(yaw_rate=yaw_rates(0.1, 0.1))
    assert dwell(scalar=4.5).result(history).is_passed
    assert not dwell(scalar=5.0).result(history).is_passed


def test_a_run_that_ends_before_it_can_be_judged_is_failed():
    kept = TIMES <= END + 1.5
    history = history_of(
        TIMES[kept], yaw_rate=yaw_rates(0.1, 0.1)[kept], y=np.full(kept.sum(), 5.0)
    )
    result = dwell().result(history)
    assert math.isnan(result.yaw_rate_ratios[1])
    assert not result.is_passed


def test_a_vehicle_that_never_yaws_to_the_second_side_is_failed():
    history = history_of(yaw_rate=np.ones(len(TIMES)), y=np.full(len(TIMES), 5.0))
    assert not dwell().result(history).is_passed


@pytest.mark.parametrize("wanted", [4.0, -4.0, 2.0])
@pytest.mark.parametrize("ratio", [16.0, 20.0])
def test_the_step_steer_finds_the_angle_of_its_lateral_acceleration(wanted, ratio):
    vehicle = preset().with_values({"steering_ratio": ratio})
    step = dataclasses.replace(STANDARD["iso_step_steer"], lateral_acceleration=wanted)
    step = step.for_vehicle(vehicle, Options())
    simulation = Simulation(vehicle)
    simulation.reset(step.speed)
    history = run(simulation, step, step.duration)
    assert history["lateral_acceleration"][-30:].mean() == pytest.approx(wanted, abs=2e-3)


def test_response_times_of_a_step_are_those_of_a_first_order_lag():
    step = dataclasses.replace(STANDARD["iso_step_steer"], handwheel_angle=10.0)
    lag, begin = 0.2, step.start + step.rise / 2
    rate = 1.0 - np.exp(-np.clip(TIMES - begin, 0.0, None) / lag)
    time, overshoot = step.response(history_of(yaw_rate=-0.3 * rate), "yaw_rate")
    assert time == pytest.approx(lag * math.log(10.0), abs=1e-4)  # samples are 10 ms apart
    assert overshoot == pytest.approx(0.0, abs=1e-6)
