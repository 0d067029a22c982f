"""The fishhook: steering reversal at the specified roll rate, offline and with a node."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.runs.run import run

AT_03G = 20.0
AMPLITUDE = 6.5 * AT_03G
"""deg"""
PERIOD = 0.01
"""s"""
LOW = {"cg_height": 0.55}
"""A vehicle that the fishhook does not tip."""


def fishhook(**changes):
    vehicle = preset().with_values(LOW)
    changes = {"steering_at_03g": AT_03G} | changes
    return dataclasses.replace(STANDARD["nhtsa_fishhook"], **changes).for_vehicle(
        vehicle, Options()
    )


def driven(manoeuvre, **settings):
    """History of a run with the driver that drove it."""
    simulation, driver = Simulation(preset().with_values(LOW)), manoeuvre.driver()
    simulation.reset(manoeuvre.speed)
    return run(simulation, driver, manoeuvre.duration, **settings), driver


def handwheel(t: float, reversal: float) -> float:
    """The definition (deg), to the left first."""
    slope, back = AMPLITUDE / 720.0, reversal + 2 * AMPLITUDE / 720.0 + 3.0
    if t < 1.0:
        return 0.0
    if t < 1.0 + slope:
        return 720.0 * (t - 1.0)
    if t < reversal:
        return AMPLITUDE
    if t < reversal + 2 * slope:
        return AMPLITUDE - 720.0 * (t - reversal)
    if t < back:
        return -AMPLITUDE
    return -AMPLITUDE * (back + 2.0 - t) / 2.0 if t < back + 2.0 else 0.0


def told(driver, roll_rates) -> list[float]:
    """Handwheel angles (deg) that a driver answers roll rates (deg/s), one each period, with."""
    answers = []
    for k, rate in enumerate(roll_rates):
        command = driver.command(k * PERIOD, {"roll_rate": math.radians(rate)})[0]
        answers.append(math.degrees(command.steering) * 16.0)
    return answers


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_it_reverses_in_the_first_period_with_a_roll_rate_of_no_more_than_1_5(side):
    rates = np.concatenate((np.zeros(100), np.full(60, 20.0), [1.51, 1.49, 3.0], np.zeros(700)))
    driver = fishhook(scalar=side * 6.5).driver()
    answers = told(driver, side * rates)
    assert driver.reversal == pytest.approx(1.61, abs=1e-12)
    expected = [side * handwheel(k * PERIOD, 1.61) for k in range(len(rates))]
    # 1e-9: rounding of the times at 720 deg/s
    np.testing.assert_allclose(answers, expected, rtol=0, atol=1e-9)


def test_it_does_not_reverse_before_the_first_turn_is_complete():
    rates = np.concatenate((np.zeros(100), [20.0, 20.0], np.zeros(30)))  # turned after 0.181 s
    driver = fishhook().driver()
    told(driver, rates)
    assert driver.reversal == pytest.approx(1.19, abs=1e-12)


@pytest.mark.parametrize("rate", [0.0, 1.5, -30.0, 40.0])
def test_a_roll_rate_that_has_not_risen_and_fallen_reverses_nothing(rate):
    driver = fishhook().driver()
    assert told(driver, [0.0] * 100 + [rate] * 300)[-1] == pytest.approx(AMPLITUDE, rel=1e-12)
    assert driver.reversal == math.inf


def test_the_other_turn_is_as_far_and_held_3_s_then_back_in_2_s():
    times = np.arange(0.0, 10.0, 0.0025)
    manoeuvre = fishhook()
    expected = [handwheel(t, 1.7) for t in times.tolist()]
    np.testing.assert_allclose(manoeuvre.handwheel(times, 1.7), expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_in_a_run_the_roll_rate_has_just_fallen_to_1_5_when_it_reverses(side):
    history, driver = driven(fishhook(scalar=side * 6.5))
    outwards = side * np.degrees(history["roll_rate"])
    at = int(np.argmin(np.abs(history["time"] - driver.reversal)))
    assert outwards[at] == pytest.approx(driver.roll_rate, abs=1e-9)
    assert outwards[at] <= 1.5 < outwards[at - 1]
    steering = side * np.degrees(history["steering"]) * 16.0
    times = history["time"][1:] - PERIOD  # a row has the command of the period that ends with it
    expected = [handwheel(round(t, 9), driver.reversal) for t in times.tolist()]
    np.testing.assert_allclose(steering[1:], expected, rtol=0, atol=1e-9)


def test_the_directions_are_mirror_images_and_runs_repeat_to_the_last_bit():
    left, again, right = (driven(fishhook(scalar=s))[0] for s in (6.5, 6.5, -6.5))
    np.testing.assert_array_equal(left.rows, again.rows)
    np.testing.assert_allclose(left["roll"], -right["roll"], rtol=0, atol=1e-9)


def test_a_shorter_command_period_finds_the_reversal_more_closely():
    (_, coarse), (_, fine) = (driven(fishhook(), command_period=p) for p in (0.01, 0.001))
    assert fine.roll_rate <= 1.5
    assert 1.5 - fine.roll_rate < 1.5 - coarse.roll_rate
    assert coarse.reversal - 0.02 < fine.reversal <= coarse.reversal


def test_the_report_says_when_it_was_reversed():
    manoeuvre = fishhook()
    history, driver = driven(manoeuvre)
    report = manoeuvre.report(history, driver)
    assert report["steering reversal"].startswith(f"{driver.reversal:.3f} s at ")
    assert "none" in manoeuvre.report(history, manoeuvre.driver())["steering reversal"]
