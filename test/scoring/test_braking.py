"""How vehicles stop on split friction, and the roads of the tests that have their own."""

import dataclasses
import math

import numpy as np
import pytest
from constructed import history, outcome
from scored import make_setup

from vehicle_roll_sim import InputError
from vehicle_roll_sim.manoeuvres.on_roads.split_friction import SPLIT_FRICTION_BRAKING
from vehicle_roll_sim.scoring import tables
from vehicle_roll_sim.scoring.braking import braking_of, keeps_its_course
from vehicle_roll_sim.scoring.driven import drive_alone
from vehicle_roll_sim.scoring.plan import Ladder
from vehicle_roll_sim.scoring.results import Climb, Score, result_alone
from vehicle_roll_sim.simulation.road import Road

TIME = np.arange(601) * 0.01
BRAKES_FROM, SPEED, DECELERATION = 1.0, 20.0, 5.0
"""s, m/s, m/s^2: the vehicle stops after 4 s and 40 m."""
BRAKED = np.clip(TIME - BRAKES_FROM, 0.0, SPEED / DECELERATION)
STOPPING = {
    "x": SPEED * np.minimum(TIME, BRAKES_FROM) + SPEED * BRAKED - DECELERATION / 2 * BRAKED**2,
    "u": SPEED - DECELERATION * BRAKED,
}
SAMPLED = 0.01
"""m: a vehicle below 0.1 m/s has less than 1 mm to go; the rest is that of the samples."""


def test_the_way_is_that_from_the_brakes_to_the_stop_and_angles_are_those_before_it():
    stopped = TIME > 5.5
    run = history(6.0, yaw=np.where(stopped, 3.0, -0.1), y=np.where(stopped, 9.0, 0.3), **STOPPING)
    found = braking_of(SPLIT_FRICTION_BRAKING, run)
    assert found.distance == pytest.approx(SPEED**2 / (2 * DECELERATION), abs=SAMPLED)
    assert (found.yaw, found.deviation) == (0.1, 0.3)
    assert keeps_its_course(SPLIT_FRICTION_BRAKING, run)


@pytest.mark.parametrize("columns", [{"yaw": 0.3}, {"y": -0.6}, {"u": 1.0}])
def test_a_vehicle_that_turns_leaves_its_course_or_does_not_stop_fails(columns):
    run = history(6.0, **STOPPING | columns)
    assert not keeps_its_course(SPLIT_FRICTION_BRAKING, run)


def test_other_tests_have_no_stop():
    run = outcome(history(1.0))
    assert all(map(math.isnan, dataclasses.astuple(braking_of(run.manoeuvre, run.history))))


def test_the_table_has_the_stop_of_the_nominal_vehicle_at_the_level_compared():
    """Of the passive vehicle against itself: it stops at 60 km/h."""
    setup, ladder = make_setup(), Ladder("split_friction", "nominal", "left", (60.0,))
    run = drive_alone(ladder, 60.0, setup)
    result = result_alone(60.0, run)
    assert not run.has_failed
    score = Score("mine", (Climb(ladder, {60.0: result}, {60.0: result}),))
    ((name, level, way, yaw, _),) = tables.braking_table([score]).rows
    stop = f"{run.manoeuvre.distance(run.history):.1f} m"
    assert (name, level, way) == ("`mine`", "60 km/h", f"{stop} → {stop}")
    assert yaw == "{0} → {0} deg".format(f"{math.degrees(np.abs(run.history['yaw']).max()):.1f}")
    assert tables.braking_table([Score("mine", ())]) is None


def test_tests_with_a_road_of_their_own_are_driven_on_it_and_refused_on_another():
    setup = make_setup()
    left, right = (Ladder("split_friction", "nominal", side, ()) for side in ("left", "right"))
    slippery = Ladder("slippery_lane_change", "nominal", "left", ())
    assert left.road(setup).surface(5.0, 1.0)[-1] == right.road(setup).surface(5.0, -1.0)[-1] == 0.1
    assert slippery.simulation(setup).road.surface(50.0, 0.0)[-1] == 0.3
    assert Ladder("step", "nominal", "left", ()).road(setup) is setup.road
    banked = dataclasses.replace(setup, road=Road(bank=0.05))
    assert Ladder("step", "nominal", "left", ()).road(banked) is banked.road
    for ladder in (left, slippery):
        with pytest.raises(InputError, match=r"road: .* brings its own"):
            ladder.simulation(banked)
