"""Laws that hear `motion`: what they hear and when, and that they restart with the time."""

import dataclasses

import numpy as np
import pytest
from driven import begun, driven, filled_in

from vehicle_roll_sim.control_laws.motion_law import STATES, MotionLaw
from vehicle_roll_sim.messages.sets import MOTION_LABELS

SHORT = filled_in("step_steer", duration=1.2)
"""Steers from 1.0 s on."""
HEARD = []
"""The samples since the last restart."""
PERIOD = 0.01


@dataclasses.dataclass(kw_only=True)
class Watching(MotionLaw):
    """Steers the rear wheels by a little more in each period."""

    commands = ("rear_steering",)

    def restart(self):
        super().restart()
        HEARD.clear()

    def commanded(self, motion):
        HEARD.append(motion)
        return {"rear_steering": 1e-4 * len(HEARD)}


def test_it_hears_the_present_state_and_the_steering_of_the_period_that_ends():
    history = driven(SHORT, Watching())
    assert [motion["time"] for motion in HEARD] == history["time"][:-1].tolist()
    for name in (*STATES, "steering"):
        assert [motion[name] for motion in HEARD] == history[name][:-1].tolist(), name
    rear = [motion["rear_steering"] for motion in HEARD]
    assert rear == [1e-4 * count for count in range(len(HEARD))]
    assert np.degrees(HEARD[-1]["steering"]) == pytest.approx(4.0)


def test_what_it_hears_is_in_the_message():
    assert {"time", "steering", "rear_steering", *STATES} <= {*MOTION_LABELS}


@pytest.mark.parametrize("time", [0.0, PERIOD])
def test_a_law_restarts_where_time_does_not_go_on(time):
    law = begun(Watching())
    for now in (0.0, PERIOD, time):
        law.answer_to({"time": now})
    assert [motion["time"] for motion in HEARD] == [time]
