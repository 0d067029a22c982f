"""A driver whom laws assist: what laws see and when, and what they may not do."""

import numpy as np
import pytest
from driven import PERIOD, REFERENCE, driven, filled_in

from vehicle_roll_sim import Command, InputError, Simulation
from vehicle_roll_sim.control_laws.law import Assisted, ControlLaw
from vehicle_roll_sim.runs.run import run

SHORT = filled_in("step_steer", duration=1.5)
"""Steers from 1.0 s on."""


class Watching(ControlLaw):
    """Sets no force, and keeps what it has seen since the reset."""

    commanded = ("normal_force",)

    def reset(self):
        super().reset()
        self.seen = []

    def law(self, motion):
        self.seen.append(motion)
        return {"normal_force": (0.0,) * 4}


class Braking(Watching):
    commanded = ("brake_torque",)

    def law(self, motion):
        return {"brake_torque": (100.0, 0.0, 0.0, 50.0)}


def test_with_laws_that_do_nothing_the_run_is_the_same_to_the_bit():
    simulation = Simulation(REFERENCE)
    simulation.reset(SHORT.speed)
    alone = run(simulation, SHORT.driver(), SHORT.duration, command_period=PERIOD)
    assert np.array_equal(driven(SHORT, Watching()).rows, alone.rows)


def test_a_law_sees_the_present_state_and_the_steering_of_the_period_that_ends():
    law = Watching()
    history = driven(SHORT, law)
    assert [motion["time"] for motion in law.seen] == history["time"][:-1].tolist()
    for name in ("u", "v", "yaw_rate", "roll", "roll_rate", "steering"):
        assert [motion[name] for motion in law.seen] == history[name][:-1].tolist(), name
    assert law.seen[0]["steering"] == 0.0
    assert law.seen[-1]["steering"] == pytest.approx(np.radians(4.0))


def test_its_commands_are_applied_beside_those_of_the_driver():
    history = driven(SHORT, Watching(), Braking())
    assert (history.command("brake_torque")[1:] == [100.0, 0.0, 0.0, 50.0]).all()
    assert np.degrees(history["steering"][-1]) == pytest.approx(4.0)


@pytest.mark.parametrize("time", [0.0, PERIOD])
def test_a_law_is_reset_where_time_does_not_go_on(time):
    law = Watching()
    for now in (0.0, PERIOD, time):
        law.answer({"time": now})
    assert [motion["time"] for motion in law.seen] == [time]


def test_two_laws_that_set_the_same_command_are_refused():
    with pytest.raises(InputError, match=r"laws: .*brake_torque.*one law only"):
        Assisted(SHORT.driver(), Braking(), Watching(), Braking())


def test_a_command_that_the_driver_sets_too_is_refused():
    def braking(times):
        return Command(brake_torque=(1.0, 0.0, 0.0, 0.0)).records()

    state = Simulation(REFERENCE).state
    with pytest.raises(InputError, match=r"brake_torque: the driver sets it too"):
        Assisted(braking, Braking()).command(0.0, state)
