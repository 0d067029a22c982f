"""A session: periods with the received commands, stopped runs, resets and the pause flag."""

import numpy as np
import pytest
from signals import everything

from vehicle_roll_sim import Command, Condition, Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session

PERIOD_NS = 10_000_000
PERIOD = 0.01
SPEED = 20.0
"""Speed of the fixture (m/s)."""
OVERTURNING = (0.2,)
"""rad: at 20 m/s the reference vehicle rolls over within 3 s."""


def run_periods(session, count: int) -> None:
    for _ in range(count):
        session.run_period()


def roll_over(session) -> None:
    session.inbox.receive("steering_cmd", OVERTURNING, session.simulation.time_ns)
    run_periods(session, 300)
    assert session.rolled_over


def drive_somewhere(session, rng) -> None:
    """Run for a random time with random commands."""
    for _ in range(rng.integers(1, 20)):
        now = session.simulation.time_ns
        session.inbox.receive("steering_cmd", rng.normal(0, 0.1, 1), now)
        session.inbox.receive("normal_force_cmd", rng.normal(0, 1000, 4), now)
        run_periods(session, rng.integers(1, 5))


def test_it_begins_at_time_zero_and_its_initial_speed(session):
    assert session.simulation.time_ns == 0
    assert session.simulation.state.u == SPEED
    assert session.applied == Command()
    assert not session.paused
    assert not session.stopped


def test_a_period_is_a_step_with_the_command_that_has_come_in(session):
    alone = Simulation(preset())
    alone.reset(SPEED)
    commands = [Command(), Command(steering=0.03), Command(0.03, 0.0, (5.0, 6.0, 7.0, 8.0))]
    for command in commands:
        session.inbox.receive("steering_cmd", (command.steering,), session.simulation.time_ns)
        session.inbox.receive("wheel_torque_cmd", command.wheel_torque, alone.time_ns)
        session.run_period()
        alone.step(command, PERIOD)
        assert session.applied == command
        assert everything(session.simulation) == everything(alone)


def test_a_command_holds_for_whole_periods_and_the_next_one_waits(session):
    session.inbox.receive("steering_cmd", (0.01,), 0)
    session.run_period()
    session.inbox.receive("steering_cmd", (0.02,), PERIOD_NS)
    assert session.applied.steering == 0.01
    session.run_period()
    assert session.applied.steering == 0.02


def test_torques_end_half_a_simulated_second_after_the_last_message(session):
    session.inbox.receive("wheel_torque_cmd", (0.0, 0.0, 80.0, 80.0), 0)
    driven = []
    for _ in range(100):
        session.run_period()
        driven.append(session.applied.wheel_torque[2] != 0.0)
    # the period that begins at 0.5 s still has the command, the one at 0.51 s no longer
    assert driven == [True] * 51 + [False] * 49


def test_a_run_that_has_stopped_stays_where_it_is(session):
    roll_over(session)
    before = everything(session.simulation), session.applied
    session.inbox.receive("steering_cmd", (0.0,), session.simulation.time_ns)
    run_periods(session, 10)
    assert (everything(session.simulation), session.applied) == before


@pytest.mark.parametrize("condition", Condition)
def test_every_condition_but_running_is_a_stop_and_the_rollover_an_event_of_its_own(
    session, condition
):
    session.simulation.condition = condition
    assert session.stopped == (condition is not Condition.RUNNING)
    assert not session.rolled_over  # `roll_over` shows that one that happens is told


def test_a_reset_recovers_from_a_rollover_and_forgets_all_commands(session):
    roll_over(session)
    session.reset(15.0)
    assert not session.stopped
    assert session.applied == Command()
    assert session.simulation.state.u == 15.0
    session.run_period()
    assert session.simulation.time_ns == PERIOD_NS
    assert session.applied == Command()  # not the steering from before


@pytest.mark.parametrize("paused", [True, False])
def test_a_reset_leaves_the_pause_as_it_is(session, paused):
    session.paused = paused
    session.reset(SPEED)
    assert session.paused is paused


def test_after_a_hundred_resets_a_run_is_bit_by_bit_that_of_a_fresh_start(session):
    rng = np.random.default_rng(1)
    for _ in range(100):
        drive_somewhere(session, rng)
        session.reset(SPEED)
    fresh = Session(Simulation(preset()), CommandInbox(), PERIOD_NS, SPEED)
    assert everything(session.simulation) == everything(fresh.simulation)
    for each in (session, fresh):
        drive_somewhere(each, np.random.default_rng(2))
    assert everything(session.simulation) == everything(fresh.simulation)


def test_a_message_answers_one_period_even_when_the_model_has_stopped(session):
    topics = ["steering_cmd"]
    assert session.inbox.unanswered(topics) == topics
    for _ in range(300):
        session.inbox.receive("steering_cmd", OVERTURNING, session.simulation.time_ns)
        assert session.inbox.unanswered(topics) == []
        session.run_period()
        assert session.inbox.unanswered(topics) == topics
    assert session.rolled_over
    session.inbox.receive("steering_cmd", OVERTURNING, session.simulation.time_ns)
    session.reset(SPEED)
    assert session.inbox.unanswered(topics) == topics


def test_a_reset_forgets_what_the_speed_controller_has_learnt(session):
    """Even if the next speed is commanded before the next period."""
    session.inbox.receive("speed_cmd", (SPEED + 2.0,), 0)
    run_periods(session, 40)
    session.reset(SPEED)
    fresh = Session(Simulation(preset()), CommandInbox(), PERIOD_NS, SPEED)
    for each in (session, fresh):
        each.inbox.receive("speed_cmd", (SPEED + 2.0,), 0)
        run_periods(each, 40)
    assert everything(session.simulation) == everything(fresh.simulation)
