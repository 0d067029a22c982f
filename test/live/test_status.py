"""The status of a session names the problem, since when it exists, and its source."""

import pytest

from vehicle_roll_sim import Condition
from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.live.status import (
    Level,
    command_troubles,
    command_values,
    model_values,
    verdict,
)

KEYS = ("received", "dropped", "clamped", "last problem", "age (s)", "publishers")
PUBLISHERS = {"steering_cmd": ["/car/driver", "/joystick"], "speed_cmd": ["/joystick"]}


def run_periods(session, count: int) -> None:
    for _ in range(count):
        session.run_period()


def test_it_is_well_while_it_runs_or_is_paused(session):
    session.run_period()
    assert verdict(session, []) == (Level.OK, "running")
    session.paused = True
    assert verdict(session, []) == (Level.OK, "paused")
    assert model_values(session)["paused"] == "true"


@pytest.mark.parametrize(
    ("condition", "words"),
    [
        (Condition.ROLLED_OVER, "rolled over at 0.050 s"),
        (Condition.TOO_SLOW, "too slow at 0.050 s"),
        (Condition.DIVERGED, "diverged (roll_rate) at 0.050 s"),
    ],
)
def test_a_stop_is_an_error_that_says_why_and_when(session, condition, words):
    run_periods(session, 5)
    session.simulation.condition = condition
    session.simulation.implausible = "roll_rate" if condition is Condition.DIVERGED else None
    level, message = verdict(session, ["another trouble"])
    assert level is Level.ERROR
    assert message == f"{words}: reset to go on; another trouble"
    told = model_values(session)
    assert told["condition"] == condition.name.lower()
    assert told["simulated time (s)"] == "0.050"


def test_the_state_that_diverged_is_named_and_no_other_is(session):
    assert model_values(session)["implausible state"] == "none"
    session.simulation.state_vector[3] = float("nan")
    session.run_period()
    assert session.simulation.condition is Condition.DIVERGED
    assert model_values(session)["implausible state"] == "roll"
    session.reset(20.0)
    assert model_values(session)["implausible state"] == "none"


def test_troubles_are_a_warning_with_all_of_them(session):
    assert verdict(session, ["this", "that"]) == (Level.WARN, "this; that")


def test_every_topic_has_all_its_values_from_the_start(session):
    told = command_values(session, {})
    for topic in channels():
        for key in (*KEYS, "publisher names"):
            assert f"{topic} {key}" in told
        assert told[f"{topic} age (s)"] == told[f"{topic} last problem"] == "none"
    session.inbox.receive("steering_cmd", (float("nan"),), 0)
    assert command_values(session, PUBLISHERS).keys() == told.keys()


def test_the_age_of_a_command_is_simulated_time_since_its_last_good_message(session):
    session.inbox.receive("steering_cmd", (0.01,), 0)
    run_periods(session, 30)
    session.inbox.receive("steering_cmd", (), session.simulation.time_ns)
    told = command_values(session, {})
    assert told["steering_cmd age (s)"] == "0.300"
    assert told["steering_cmd dropped"] == "1"
    session.inbox.receive("steering_cmd", (9.0,), session.simulation.time_ns)
    told = command_values(session, {})
    assert told["steering_cmd age (s)"] == "0.000"
    assert told["steering_cmd clamped"] == "1"
    assert told["steering_cmd last problem"] == ("clamped: 9 is beyond steering_limit, 1.0472 rad")
    session.reset(20.0)
    told = command_values(session, {})
    assert told["steering_cmd age (s)"] == "none"
    assert told["steering_cmd received"] == "3"


def test_two_publishers_of_a_command_are_named_and_a_trouble(session):
    told = command_values(session, PUBLISHERS)
    assert told["steering_cmd publishers"] == "2"
    assert told["steering_cmd publisher names"] == "/car/driver, /joystick"
    assert told["speed_cmd publisher names"] == "/joystick"
    assert told["wheel_torque_cmd publishers"] == "0"
    (trouble,) = command_troubles(session, PUBLISHERS)
    assert trouble.startswith("steering_cmd: 2 publishers")
    assert trouble.endswith("/car/driver, /joystick")


@pytest.mark.parametrize(
    ("topic", "values", "policy", "instead"),
    [
        ("steering_cmd", (0.01,), "hold", "policy hold"),
        ("rear_steering_cmd", (0.01,), "centre", "policy centre"),
        ("wheel_torque_cmd", (1.0,) * 4, "hold", "0 is applied"),
        ("speed_cmd", (20.0,), "hold", "no speed is held"),
    ],
)
def test_a_controller_that_died_is_a_trouble_until_its_next_good_message(
    session, topic, values, policy, instead
):
    session.inbox.steering_policy = policy
    session.inbox.receive(topic, values, 0)
    run_periods(session, 50)
    assert command_troubles(session, {}) == []
    session.run_period()
    (trouble,) = command_troubles(session, {})
    assert trouble.startswith(f"{topic}: no message within 0.5 s of simulation")
    assert trouble.endswith(instead)
    session.inbox.receive(topic, values, session.simulation.time_ns)
    assert command_troubles(session, {}) == []
