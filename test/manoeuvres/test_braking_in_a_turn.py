"""Braking in a turn against the mechanics of a point on a circle."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import InputError, preset, run
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History

GENTLE = {"speed": 10.0, "lateral_acceleration": 1.0, "deceleration": 0.5, "duration": 27.0}
ANGLE = {"handwheel_angle": 27.485}
"""deg: that for 5 m/s^2 at 80 km/h, which takes some runs to find."""


@pytest.fixture(scope="module")
def gentle():
    return run("braking_in_a_turn", **GENTLE)


def test_the_turn_before_is_that_of_the_speed_and_the_lateral_acceleration(gentle):
    before = int(np.searchsorted(gentle["time"], 6.0))
    assert gentle["lateral_acceleration"][before] == pytest.approx(1.0, abs=2e-3)
    speed = math.hypot(gentle["u"][before], gentle["v"][before])
    radius, *_ = gentle.manoeuvre.after_a_second(gentle.history)
    assert radius == pytest.approx(speed**2, rel=5e-3)
    assert gentle.report["radius of the turn"] == f"{radius:.3f} m"


def test_it_brakes_as_the_torques_slow_its_mass_and_its_wheels(gentle):
    """a (M + sum of J / r^2) = M a0, and the drag of steered tires: delta times a share of M ay,
    0.016 of 1 m/s^2 at first and less with the speed; its mean is within 2 %."""
    vehicle = preset()
    radii = vehicle.static_loaded_radius
    spun = vehicle.mass + (vehicle.wheel_inertia / radii**2).sum()
    wanted = GENTLE["deceleration"] * vehicle.mass / spun
    found = gentle.manoeuvre.mean_deceleration(gentle.history)
    assert found == pytest.approx(wanted, rel=0.02)
    assert found > wanted


def test_it_turns_by_its_way_over_the_radius_of_each_speed(gentle):
    """d psi = ds / R with R = (L + K u^2) / delta. K of steady turns, 0.0412 deg/(m/s^2), is that
    without brakes, whose load transfer tightens the turn by some per cent."""
    braking = (gentle["time"] >= 6.0) & (gentle["u"] > 1.0)
    time, speed, yaw = (gentle[name][braking] for name in ("time", "u", "yaw"))
    steering = gentle["steering"][braking][0]
    curvature = steering / (2.54 + math.radians(0.0412) * speed**2)
    turned = np.trapezoid(speed * curvature, time)
    assert yaw[-1] - yaw[0] == pytest.approx(turned, rel=0.06)
    assert yaw[-1] - yaw[0] > turned


def test_without_brakes_it_stays_on_the_circle(gentle):
    """It coasts for a second: the drag of the steered tires slows it by 0.02 m/s."""
    coasting = run("braking_in_a_turn", **(GENTLE | {"deceleration": 0.0, "duration": 7.5}))
    _, ratio, inwards = coasting.manoeuvre.after_a_second(coasting.history)
    assert ratio == pytest.approx(1.0, abs=5e-3)
    assert abs(inwards) < 5e-3
    assert gentle.manoeuvre.after_a_second(gentle.history)[2] > abs(inwards)


def test_the_distance_from_a_circle_is_that_of_a_spiral():
    """A path straight ahead from the circle of 50 m is 50 - sqrt(50^2 + 10^2) inside it after 1 s
    at 10 m/s: outside. Its yaw rate is 0."""
    time = np.arange(0.0, 8.0, 0.01)
    rows = np.zeros((len(time), len(COLUMNS)))
    before = time <= 6.0
    values = {
        "time": time,
        "u": np.full(len(time), 10.0),
        "x": np.where(before, 50 * np.sin(0.2 * (time - 6.0)), 10.0 * (time - 6.0)),
        "y": np.where(before, 50 * (1 - np.cos(0.2 * (time - 6.0))), 0.0),
        "yaw": np.where(before, 0.2 * (time - 6.0), 0.0),
        "yaw_rate": np.where(before, 0.2, 0.0),
    }
    for name, column in values.items():
        rows[:, COLUMNS.index(name)] = column
    manoeuvre = STANDARD["braking_in_a_turn"]
    for side in (1.0, -1.0):
        for name in ("y", "yaw", "yaw_rate"):
            rows[:, COLUMNS.index(name)] = side * values[name]
        radius, ratio, inwards = manoeuvre.after_a_second(History(rows))
        assert radius == pytest.approx(50.0, rel=1e-9)
        assert ratio == pytest.approx(0.0, abs=1e-9)
        assert inwards == pytest.approx(50.0 - math.hypot(50.0, 10.0), rel=1e-6)


def test_to_the_right_it_is_the_mirror_image():
    left, right = (
        run("braking_in_a_turn", handwheel_angle=side * ANGLE["handwheel_angle"], duration=9.0)
        for side in (1.0, -1.0)
    )
    np.testing.assert_allclose(left["y"], -right["y"], rtol=0, atol=1e-6)
    np.testing.assert_allclose(left["yaw_rate"], -right["yaw_rate"], rtol=0, atol=1e-6)
    same = ("mean deceleration", "off the circle after 1 s", "radius of the turn")
    assert [left.report[name] for name in same] == [right.report[name] for name in same]


def test_what_does_not_fit_is_refused_or_unknown():
    with pytest.raises(
        InputError, match=r"^brakes_from: 1.2 .*after the handwheel has been turned"
    ):
        dataclasses.replace(STANDARD["braking_in_a_turn"], brakes_from=1.2)
    short = run("braking_in_a_turn", duration=6.5, **ANGLE)
    assert short.report["braking"] == "unknown: the run is too short"


def test_a_vehicle_that_is_too_slow_for_the_turn_is_refused_by_what_was_asked():
    with pytest.raises(InputError, match="lateral_acceleration: no handwheel angle gives"):
        run("braking_in_a_turn", speed=1.0)
