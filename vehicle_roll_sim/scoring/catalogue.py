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
)
from vehicle_roll_sim.manoeuvres.handwheel import METRES_PER_SECOND_OF_A_MPH
from vehicle_roll_sim.manoeuvres.iso_step_steer import ISO_STEP_STEER
from vehicle_roll_sim.manoeuvres.nhtsa import NHTSA_FISHHOOK, NHTSA_J_TURN
from vehicle_roll_sim.manoeuvres.series.entry_speed_search import at_entry_speed
from vehicle_roll_sim.manoeuvres.sine_with_dwell import SINE_WITH_DWELL
from vehicle_roll_sim.manoeuvres.swept_steer import SWEPT_STEER
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.history import History


@dataclasses.dataclass(frozen=True)
class ScoredTest:
    """A manoeuvre at rising levels, up to the first failure.

    limit: what the level of the first failure is called. levels: in `unit`; quick: those of the
    quick size. at: the manoeuvre, completed by `for_vehicle`, at a level. has_failed: whether a
    run of it that ended with a condition failed.
    """

    title: str
    manoeuvre: Manoeuvre
    limit: str
    unit: str
    levels: tuple[float, ...]
    quick: tuple[float, ...]
    at: Callable[[Manoeuvre, float], Manoeuvre]
    has_failed: Callable[[Manoeuvre, History, Condition], bool]


def _at_mph(ready: Manoeuvre, level: float) -> Manoeuvre:
    return dataclasses.replace(ready, speed=level * METRES_PER_SECOND_OF_A_MPH)


def _at_scalar(ready: Manoeuvre, level: float) -> Manoeuvre:
    return dataclasses.replace(ready, scalar=math.copysign(level, ready.scalar)).checked()


def _as_it_is(ready: Manoeuvre, level: float) -> Manoeuvre:
    return ready


def _stopped(manoeuvre: Manoeuvre, history: History, condition: Condition) -> bool:
    return condition is not Condition.RUNNING


def _tipped_up(manoeuvre: Manoeuvre, history: History, condition: Condition) -> bool:
    is_lifted = not math.isnan(two_wheel_lift(history))
    return is_lifted or _stopped(manoeuvre, history, condition)


def _against_the_standard(manoeuvre: Manoeuvre, history: History, condition: Condition) -> bool:
    return _stopped(manoeuvre, history, condition) or not manoeuvre.result(history).is_passed


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
"""By the name for `--only`. Each is driven on a level road.

The series of NHTSA begin at 35 mph; the lower levels are for vehicles that tip up below.
"""
