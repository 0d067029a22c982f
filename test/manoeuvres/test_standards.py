"""Manoeuvres of the standards: the handwheel angle, sample by sample, against the definition."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import PAPER, STANDARD
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.command import command_at

AT_03G = 20.0
"""deg"""
MPH = 0.44704
"""m/s"""
TIMES = np.linspace(0.0, 24.0, 9601)
"""s: 400 samples a second."""
ROUNDING = 1e-13
"""rad: some operations on angles below 1 rad, at rates up to 2 rad/s and times of 24 s."""
RATIOS = (16.0, 20.0)
# name: speed (m/s), duration (s)
CONDITIONS = {
    "slowly_increasing_steer": (50 * MPH, 22.0),
    "nhtsa_j_turn": (35 * MPH, 9.0),
    "nhtsa_fishhook": (35 * MPH, 10.0),
    "sine_with_dwell": (80 / 3.6, 6.0),
    "iso_step_steer": (100 / 3.6, 6.0),
    "iso_double_lane_change": (80 / 3.6, 15.0),
    "iso_severe_double_lane_change": (50 / 3.6, 10.0),
    "steady_state_circle": (100 / 3.6, 62.0),
    "constant_radius_circle": (8.0, 250.0),
    "constant_handwheel_circle": (8.0, 250.0),
    "braking_in_a_turn": (80 / 3.6, 13.0),
}


def ready(name: str, ratio: float = 16.0, **changes):
    """A manoeuvre for the reference vehicle with that steering ratio."""
    vehicle = preset().with_values({"steering_ratio": ratio})
    return dataclasses.replace(STANDARD[name], **changes).for_vehicle(vehicle, Options())


def slowly_increasing(t: float) -> float:
    return min(13.5 * max(t - 1.0, 0.0), 270.0)


def j_turn(t: float) -> float:
    """8.0 x 20 deg = 160 deg after 0.16 s, held 4 s, back in 2 s."""
    if t < 1.0:
        return 0.0
    if t < 1.16:
        return 1000.0 * (t - 1.0)
    if t < 5.16:
        return 160.0
    return 160.0 * (7.16 - t) / 2.0 if t < 7.16 else 0.0


def sine_with_dwell(t: float) -> float:
    """5 x 20 deg = 100 deg; three quarters of 0.7 Hz, 0.5 s at -100 deg, the last quarter."""
    t, quarter = t - 1.0, 0.25 / 0.7
    if t < 0.0:
        return 0.0
    if t < 3 * quarter:
        return 100.0 * math.sin(2 * math.pi * 0.7 * t)
    if t < 3 * quarter + 0.5:
        return -100.0
    if t < 4 * quarter + 0.5:
        return -100.0 * math.cos(2 * math.pi * 0.7 * (t - 0.5 - 3 * quarter))
    return 0.0


def step(t: float) -> float:
    """15 deg in 0.15 s."""
    return 15.0 * min(max(t - 1.0, 0.0) / 0.15, 1.0)


SHAPES = {
    "slowly_increasing_steer": (slowly_increasing, {}, {"handwheel_angle": -270.0}),
    "nhtsa_j_turn": (j_turn, {"steering_at_03g": AT_03G}, {"scalar": -8.0}),
    "sine_with_dwell": (sine_with_dwell, {"steering_at_03g": AT_03G}, {"scalar": -5.0}),
    "iso_step_steer": (step, {"handwheel_angle": 15.0}, {"handwheel_angle": -15.0}),
}
"""Handwheel angle (deg) at a time (s), what is given, and what mirrors it."""


def test_there_are_the_manoeuvres_of_the_source_and_these():
    assert set(STANDARD) == {*PAPER, *CONDITIONS}


@pytest.mark.parametrize("name", CONDITIONS)
def test_speed_and_length_are_those_of_the_standard(name):
    speed, duration = CONDITIONS[name]
    assert STANDARD[name].speed == pytest.approx(speed, rel=1e-15)
    assert STANDARD[name].duration == duration


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("name", SHAPES)
def test_the_steering_is_that_of_the_definition_at_every_sample(name, ratio):
    handwheel, given, _ = SHAPES[name]
    steering = ready(name, ratio, **given)(TIMES)["steering"]
    expected = [math.radians(handwheel(t) / ratio) for t in TIMES.tolist()]
    np.testing.assert_allclose(steering, expected, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("name", SHAPES)
def test_to_the_other_side_it_is_the_same_with_the_other_sign(name):
    _, given, mirrored = SHAPES[name]
    left, right = (ready(name, **(given | other))(TIMES) for other in ({}, mirrored))
    np.testing.assert_array_equal(left["steering"], -right["steering"])


def test_the_dwell_is_exactly_half_a_second_and_begins_at_the_second_peak():
    manoeuvre = ready("sine_with_dwell", steering_at_03g=AT_03G)
    begin = 1.0 + 0.75 / 0.7
    inside = manoeuvre.handwheel(np.linspace(begin, begin + 0.5, 1001))
    np.testing.assert_allclose(inside, -100.0, rtol=1e-15)
    outside = manoeuvre.handwheel(np.array([begin - 1e-3, begin + 0.5 + 1e-3]))
    assert (outside > -100.0 + 5e-4).all()  # 100 (1 - cos(2 pi 0.7 0.001)) = 9.7e-4 deg
    assert manoeuvre.end == 1.0 + 1 / 0.7 + 0.5
    after_the_end = manoeuvre.handwheel(np.array([manoeuvre.end, 5.0, 1e3]))
    np.testing.assert_allclose(after_the_end, 0.0, atol=1e-12)


def test_the_step_rises_from_a_tenth_to_nine_tenths_within_150_ms():
    handwheel = ready("iso_step_steer", handwheel_angle=10.0).handwheel(TIMES)
    tenth, nine_tenths = (TIMES[np.argmax(handwheel >= share)] for share in (1.0, 9.0))
    assert 0.0 < nine_tenths - tenth <= 0.15


@pytest.mark.parametrize("name", ["nhtsa_j_turn", "sine_with_dwell"])
def test_the_throttle_is_dropped_when_the_steering_begins(name):
    gain = ready(name, steering_at_03g=AT_03G)(np.array([0.0, 0.999, 1.0, 3.0]))["speed_hold_gain"]
    assert gain.tolist() == [2000.0, 2000.0, 0.0, 0.0]


def test_the_step_steer_holds_the_speed_throughout():
    commands = ready("iso_step_steer", handwheel_angle=10.0)(np.array([0.0, 1.0, 5.0, 20.0]))
    assert set(commands["speed_hold_gain"]) == {2000.0}
    assert set(commands["speed_hold_target"]) == {100 / 3.6}


def test_the_slowly_increasing_steer_holds_the_speed_until_the_vehicle_is_beyond_0_375_g():
    manoeuvre = ready("slowly_increasing_steer")
    simulation = Simulation(preset())
    simulation.reset(manoeuvre.speed)
    history = run(simulation, manoeuvre, 4.0)
    beyond = np.abs(history["lateral_acceleration"]) > 0.375 * 9.81
    assert manoeuvre.throttle_dropped == history["time"][np.argmax(beyond)]
    times = manoeuvre.throttle_dropped + np.array([-1.0, -0.001, 0.0, 1.0])
    assert manoeuvre(times)["speed_hold_gain"].tolist() == [2000.0, 2000.0, 0.0, 0.0]
    held = history["u"][~beyond]
    assert np.abs(held - 50 * MPH).max() < 0.02  # m/s


def test_a_handwheel_that_stays_below_that_has_its_speed_held_to_the_end():
    assert ready("slowly_increasing_steer", handwheel_angle=10.0).throttle_dropped == math.inf


def test_without_a_vehicle_there_is_no_steering_ratio_to_steer_by():
    manoeuvre = dataclasses.replace(STANDARD["slowly_increasing_steer"], speed_hold=0.0)
    with pytest.raises(InputError, match="gear: missing: a manoeuvre completed by for_vehicle"):
        manoeuvre(np.array([3.0]))


@pytest.mark.parametrize("name", ["iso_double_lane_change", "constant_radius_circle"])
def test_without_a_vehicle_a_driver_does_not_know_how_to_steer(name):
    state = Simulation(preset()).state
    driver = dataclasses.replace(STANDARD[name], speed_hold=0.0).driver()
    for time in (0.0, 0.01):
        assert np.isnan(driver.command(time, state)["steering"]).all()


@pytest.mark.parametrize(
    ("ratio", "scalar", "largest"), [(16.0, 50.0, "960 deg"), (30.0, 80.0, "1440 deg")]
)
def test_wheels_that_would_turn_too_far_are_refused(ratio, scalar, largest):
    with pytest.raises(InputError) as refusal:
        ready("nhtsa_j_turn", ratio, scalar=scalar, steering_at_03g=AT_03G)
    assert largest in str(refusal.value)
    assert str(scalar * AT_03G) in str(refusal.value)


@pytest.mark.parametrize("ratio", [4.0, 30.0])
@pytest.mark.parametrize("name", STANDARD)
def test_a_vehicle_of_any_steering_ratio_takes_every_manoeuvre_as_it_is(name, ratio):
    ready(name, ratio)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_slowly_increasing_steer_ends_where_the_wheels_turn_no_further(side):
    steer = ready("slowly_increasing_steer", 4.0, handwheel_angle=side * 270.0)
    assert np.degrees(steer(TIMES)["steering"][-1]) == pytest.approx(side * 60.0, rel=1e-15)
    history = run(Simulation(preset()), steer, 0.1)
    said = steer.report(history, steer)["handwheel ends at"]
    assert said == "240 deg, which is 60 deg at the road wheels with steering_ratio 4"
    whole = ready("slowly_increasing_steer")
    assert "handwheel ends at" not in whole.report(history, whole)


def test_an_angle_of_ones_own_beyond_the_wheels_is_refused_with_the_steering_ratio():
    with pytest.raises(InputError) as refusal:
        ready("slowly_increasing_steer", 4.0, handwheel_angle=271.0)
    for word in ("271", "240 deg", "60 deg at the road wheels", "steering_ratio 4"):
        assert word in str(refusal.value)


@pytest.mark.parametrize("name", ["nhtsa_j_turn", "nhtsa_fishhook", "sine_with_dwell"])
def test_a_handwheel_manoeuvre_without_its_vehicle_is_refused_when_it_is_driven(name):
    """Also with a speed hold of its own: the steering gear is that of the vehicle."""
    given = dataclasses.replace(STANDARD[name], speed_hold=2000.0, steering_at_03g=30.0)
    with pytest.raises(InputError, match=r"gear: missing: a manoeuvre completed by for_vehicle"):
        command_at(given.driver(), 2.0, {"u": 15.0, "roll_rate": 0.0})
