"""The catalogue: tests that a controller is scored in, as data.

To add a test, add an entry to TESTS: a manoeuvre, the levels at which it is driven, and what counts
as a failure.
"""

import dataclasses
import math
from collections.abc import Callable

from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.criteria import two_wheel_lift
from vehicle_roll_sim.manoeuvres.double_lane_change import (
    ISO_DOUBLE_LANE_CHANGE,
    ISO_SEVERE_DOUBLE_LANE_CHANGE,
    KMH,
)
from vehicle_roll_sim.manoeuvres.handwheel import METRES_PER_SECOND_OF_A_MPH
from vehicle_roll_sim.manoeuvres.iso_step_steer import ISO_STEP_STEER
from vehicle_roll_sim.manoeuvres.nhtsa import NHTSA_FISHHOOK, NHTSA_J_TURN
from vehicle_roll_sim.manoeuvres.on_roads.split_friction import SPLIT_FRICTION_BRAKING
from vehicle_roll_sim.manoeuvres.series.entry_speed_search import at_entry_speed
from vehicle_roll_sim.manoeuvres.sine_with_dwell import SINE_WITH_DWELL
from vehicle_roll_sim.manoeuvres.swept_steer import SWEPT_STEER
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.roads.surfaces import Patch
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.scoring.braking import keeps_its_course
from vehicle_roll_sim.simulation.road import Road

SLIPPERY = Road(features=(Patch(start=-1e3, friction=0.3),))
"""Packed snow."""
DECELERATION = 2.5
"""m/s^2: every vehicle that brakes on split friction decelerates more."""


@dataclasses.dataclass(frozen=True)
class ScoredTest:
    """A manoeuvre at rising levels, up to the first failure.

    limit: what the level of the first failure is called. levels: in `unit`; quick: those of the
    quick size. at: the manoeuvre, completed by `for_vehicle`, at a level. has_failed: whether a
    run of it that ended with a condition failed. road: on which it is driven, if the manoeuvre does
    not bring one; by default that of the simulator, a level plane.
    """

    title: str
    manoeuvre: Manoeuvre
    limit: str
    unit: str
    levels: tuple[float, ...]
    quick: tuple[float, ...]
    at: Callable[[Manoeuvre, float], Manoeuvre]
    has_failed: Callable[[Manoeuvre, History, Condition], bool]
    road: Road | None = None


def _at_mph(ready: Manoeuvre, level: float) -> Manoeuvre:
    return dataclasses.replace(ready, speed=level * METRES_PER_SECOND_OF_A_MPH)


def _at_scalar(ready: Manoeuvre, level: float) -> Manoeuvre:
    return dataclasses.replace(ready, scalar=math.copysign(level, ready.scalar)).checked()


def _brakes_from(ready: Manoeuvre, level: float) -> Manoeuvre:
    speed = level / KMH
    duration = round(ready.start + speed / DECELERATION, 1)
    return dataclasses.replace(ready, speed=speed, duration=duration)


def _as_it_is(ready: Manoeuvre, level: float) -> Manoeuvre:
    return ready


def _stopped(manoeuvre: Manoeuvre, history: History, condition: Condition) -> bool:
    return condition is not Condition.RUNNING


def _tipped_up(manoeuvre: Manoeuvre, history: History, condition: Condition) -> bool:
    is_lifted = not math.isnan(two_wheel_lift(history))
    return is_lifted or _stopped(manoeuvre, history, condition)


def _against_the_standard(manoeuvre: Manoeuvre, history: History, condition: Condition) -> bool:
    return _stopped(manoeuvre, history, condition) or not manoeuvre.result(history).is_passed


def _left_the_course(manoeuvre: Manoeuvre, history: History, condition: Condition) -> bool:
    return _stopped(manoeuvre, history, condition) or not keeps_its_course(manoeuvre, history)


TESTS = {
    "fishhook": ScoredTest(
        "NHTSA fishhook",
        NHTSA_FISHHOOK,
        "tip-up speed",
        "mph",
        levels=(25.0, 30.0, 35.0, 40.0, 45.0, 47.5, 50.0),
        quick=(30.0, 45.0),
        at=_at_mph,
        has_failed=_tipped_up,
    ),
    "j_turn": ScoredTest(
        "NHTSA J-turn",
        NHTSA_J_TURN,
        "tip-up speed",
        "mph",
        levels=(25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0),
        quick=(30.0, 50.0),
        at=_at_mph,
        has_failed=_tipped_up,
    ),
    "sine_with_dwell": ScoredTest(
        "Sine with dwell (FMVSS 126)",
        SINE_WITH_DWELL,
        "first failed scalar",
        "",
        levels=(1.5, 2.5, 3.5, 4.5, 5.5, 6.5),
        quick=(2.5, 5.5),
        at=_at_scalar,
        has_failed=_against_the_standard,
    ),
    "lane_change": ScoredTest(
        "Double lane change (ISO 3888-1)",
        ISO_DOUBLE_LANE_CHANGE,
        "first failed speed",
        "km/h",
        levels=(60.0, 70.0, 80.0, 90.0, 100.0, 110.0, 120.0),
        quick=(80.0, 100.0),
        at=at_entry_speed,
        has_failed=_against_the_standard,
    ),
    "obstacle_avoidance": ScoredTest(
        "Obstacle avoidance (ISO 3888-2)",
        ISO_SEVERE_DOUBLE_LANE_CHANGE,
        "first failed speed",
        "km/h",
        levels=(40.0, 45.0, 50.0, 55.0, 60.0, 65.0, 70.0),
        quick=(40.0, 55.0),
        at=at_entry_speed,
        has_failed=_against_the_standard,
    ),
    "slippery_lane_change": ScoredTest(
        "Double lane change (ISO 3888-1) on friction 0.3",
        dataclasses.replace(ISO_DOUBLE_LANE_CHANGE, speed_hold=0.0),
        "first failed speed",
        "km/h",
        levels=(40.0, 45.0, 50.0, 55.0, 60.0, 65.0, 70.0),
        quick=(50.0, 55.0),
        at=at_entry_speed,
        has_failed=_against_the_standard,
        road=SLIPPERY,
    ),
    "split_friction": ScoredTest(
        "Braking on split friction",
        dataclasses.replace(
            SPLIT_FRICTION_BRAKING, front_brake_torque=900.0, rear_brake_torque=450.0
        ),
        "first failed speed",
        "km/h",
        levels=(40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0),
        quick=(60.0, 70.0),
        at=_brakes_from,
        has_failed=_left_the_course,
    ),
    "step": ScoredTest(
        "Step steer (ISO 7401)",
        ISO_STEP_STEER,
        "speed at which it does not stay upright",
        "km/h",
        levels=(100.0,),
        quick=(100.0,),
        at=_as_it_is,
        has_failed=_stopped,
    ),
    "frequency": ScoredTest(
        "Frequency response (ISO 7401)",
        SWEPT_STEER,
        "speed at which it does not stay upright",
        "km/h",
        levels=(100.0,),
        quick=(),
        at=_as_it_is,
        has_failed=_stopped,
    ),
}
"""By the name for `--only`.

The series of NHTSA begin at 35 mph; the lower levels are for vehicles that tip up below.
"""
