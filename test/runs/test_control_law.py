"""A control law is asked once per period, like a node in lockstep, and its answer is held."""

import dataclasses

import numpy as np
import pytest

from vehicle_roll_sim import Command, ControlLaw, InputError, Options, Simulation, parameter, preset
from vehicle_roll_sim.batch.case import Case
from vehicle_roll_sim.batch.evaluate import outcome_of, outcomes
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.model.frames import quaternion
from vehicle_roll_sim.runs.control_law import Controlled
from vehicle_roll_sim.runs.run import run

TURN = dataclasses.replace(STANDARD["j_turn"], duration=0.1, start=0.02)
PERIODS = 10


@dataclasses.dataclass(kw_only=True)
class Braking(ControlLaw):
    """Brakes more from period to period, and keeps what it was told."""

    commands = ("brake_torque",)
    step: float = parameter("torque more in each period", "N m", 0.0, 1e4, default=10.0)

    def begin(self, vehicle):
        self.torque, self.heard = 0.0, []

    def answer(self, sensed):
        self.heard.append((sensed.time, float(sensed.state["u"]), sensed.applied, sensed.asked))
        self.torque += self.step
        return {"brake_torque": [self.torque] * 4}


@dataclasses.dataclass(kw_only=True)
class Answering(ControlLaw):
    """Answers what a test wants."""

    commands = ("normal_force",)
    said: object = None

    def answer(self, sensed):
        return self.said


def driven(law, **changes):
    """A simulation driven with a law in the turn, the copy of the law that drove it, and rows."""
    simulation = Simulation(preset(), **changes)
    simulation.reset(TURN.speed)
    driver = Controlled(simulation, TURN.driver(), law)
    return simulation, driver._law, run(simulation, driver, TURN.duration)


def test_it_hears_each_period_once_and_its_answer_is_held_until_the_next():
    _, law, history = driven(Braking())
    times = [time for time, *_ in law.heard]
    assert times == [round(0.01 * k, 2) for k in range(PERIODS)]
    assert [speed for _, speed, *_ in law.heard] == history["u"][:-1].tolist()
    held = history.command("brake_torque")[:, 0]
    assert held.tolist() == [0.0, *(10.0 * (k + 1) for k in range(PERIODS))]


def test_it_knows_the_last_command_and_that_of_the_manoeuvre():
    _, law, history = driven(Braking())
    applied = [each.brake_torque[0] for *_, each, _ in law.heard]
    assert applied == [10.0 * k for k in range(PERIODS)]
    asked = [each.steering for *_, each in law.heard]
    assert asked == history["steering"][1:].tolist()
    assert [each.steering for *_, each, _ in law.heard] == history["steering"][:-1].tolist()


def test_the_rest_of_the_command_is_that_of_the_manoeuvre_held_for_the_period():
    """A law that commands nothing gives the bits of a run with a command period."""
    idle = Answering(said={"normal_force": [0.0] * 4})
    _, _, history = driven(idle)
    alone = Simulation(preset())
    alone.reset(TURN.speed)
    expected = run(alone, TURN.driver(), TURN.duration, command_period=0.01)
    assert np.array_equal(history.rows, expected.rows)


def test_each_run_has_a_law_of_its_own():
    cases = [Case(vehicle=preset(), manoeuvre=TURN, controller=Braking())] * 3
    runs = list(outcomes(cases, workers=2, histories=True))
    for found in runs[1:]:
        assert np.array_equal(found.history.commands, runs[0].history.commands)


def test_the_attitude_is_that_of_the_message_also_without_pitch():
    seen = []

    @dataclasses.dataclass(kw_only=True)
    class Looking(ControlLaw):
        commands = ("rear_steering",)

        def answer(self, sensed):
            seen.append((sensed.attitude, float(sensed.state["roll"]), float(sensed.state["yaw"])))
            return {"rear_steering": 0.01}

    driven(Looking(), options=Options(model="8dof"))
    attitude, roll, yaw = seen[-1]
    assert attitude == quaternion(roll, 0.0, yaw)


@pytest.mark.parametrize(
    ("said", "problem"),
    [
        (None, "answer of the controller: missing: a dict of normal_force"),
        ([1.0] * 4, "a dict of normal_force"),
        ({"steering": 0.1}, "a dict of normal_force"),
        ({"normal_force": [0.0] * 4, "steering": 0.1}, "a dict of normal_force"),
        ({"normal_force": [0.0] * 3}, "normal_force: .*: four numbers"),
        ({"normal_force": [0.0, 0.0, 0.0, float("nan")]}, "normal_force: nan .* a finite number"),
    ],
)
def test_an_answer_that_is_not_allowed_ends_the_run_in_one_line(said, problem):
    with pytest.raises(InputError, match=problem):
        driven(Answering(said=said))


def test_what_is_no_law_is_refused_and_the_others_run():
    cases = [Case(vehicle=preset(), manoeuvre=TURN, controller=each) for each in (Command(), None)]
    refused, fine = map(outcome_of, cases)
    assert refused.failure.startswith("refused: controller: Command(")
    assert fine.failure == ""


def test_a_parameter_that_is_not_allowed_is_refused():
    with pytest.raises(InputError, match=r"step: -1 is not allowed: a number from 0 to 10000 N m"):
        Braking(step=-1)
