"""The corkscrew ramp against the roll of a parked vehicle, its mirror image and a shorter step."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import Condition, InputError, preset, run

SLOW = {"speed": 3.0, "duration": 13.0, "ramp_length": 10.0, "ramp_top": 10.0}
"""From 13 s on, both left wheels are on the level top."""


def rolled_on(vehicle, height: float) -> float:
    """Roll (rad) on a ramp of that height: atan(h / c), and what gravity rolls the body further.

    The roll plane with K = sum of c^2 / 2 times the springs and tires of an axle in series, and the
    component of gravity along the line from wheel to wheel.
    """
    track, slope = vehicle.front_track, math.atan(height / vehicle.front_track)
    axles = [
        getattr(vehicle, f"{axle}_{name}")
        for axle in ("front", "rear")
        for name in ("spring_stiffness", "tire_stiffness")
    ]
    series = [k * t / (k + t) for k, t in (axles[:2], axles[2:])]
    stiffness = track**2 / 2 * sum(series)
    length = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    depths = (vehicle.front_roll_centre_depth, vehicle.rear_roll_centre_depth)
    arms = (vehicle.cg_to_rear_axle, vehicle.cg_to_front_axle)
    depth = sum(d * arm for d, arm in zip(depths, arms, strict=True)) / length
    tipping = vehicle.sprung_mass * 9.81 * depth
    return slope + tipping * math.sin(slope) / (stiffness - tipping * math.cos(slope))


@pytest.mark.parametrize("height", [0.1, 0.3])
def test_at_low_speed_the_vehicle_rolls_by_height_over_track_and_its_springs(height):
    """First order in the roll, up to 0.26: its square is some hundredths of it."""
    result = run("corkscrew_ramp", ramp_height=height, **SLOW)
    roll = float(np.mean(result["roll"][-50:]))
    assert result["x"][-1] > 20.0 + 10.0 + 2.0
    assert roll == pytest.approx(rolled_on(preset(), height), rel=0.05)
    assert roll > math.atan(height / preset().front_track)
    assert math.isnan(result.metrics["two_wheel_lift_time"])  # the wheels are up, but on the ramp


def test_at_speed_it_flies_and_to_the_other_side_it_is_its_mirror_image():
    left, right = (run("corkscrew_ramp", side=side, duration=3.0) for side in ("left", "right"))
    assert left.condition is Condition.RUNNING
    assert left.manoeuvre.time_in_the_air(left.history) > 0.5
    assert left["roll"].max() > 0.5
    np.testing.assert_allclose(left["roll"], -right["roll"], rtol=0, atol=1e-6)
    np.testing.assert_allclose(left["y"], -right["y"], rtol=0, atol=1e-6)
    assert left.report == right.report


def test_half_the_step_changes_its_peak_by_less_than_one_per_cent():
    whole, half = (run("corkscrew_ramp", duration=3.0, step=step) for step in (1e-3, 5e-4))
    assert half.metrics["peak_roll"] == pytest.approx(whole.metrics["peak_roll"], rel=0.01)


def test_it_rolls_over_at_a_higher_speed_and_says_what_is_allowed():
    assert run("corkscrew_ramp", speed=22.0).condition is Condition.ROLLED_OVER
    with pytest.raises(InputError, match=r"^ramp_height: 0.0 .*0.001 to 10 m"):
        run("corkscrew_ramp", ramp_height=0.0)


def test_a_ramp_beyond_the_wheels_is_refused():
    """The wheels of the reference vehicle are 0.75 m from the course."""
    with pytest.raises(InputError, match=r"ramp_edge: 0.75 .*: less than the 0.75 m"):
        run("corkscrew_ramp", ramp_edge=0.75, duration=0.1)
