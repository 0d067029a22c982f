"""Commands from outside: only complete, finite ones are kept, and they expire."""

import math
from array import array

import pytest

from vehicle_roll_sim import Command
from vehicle_roll_sim.live.command_inbox import CommandInbox

GOOD = {
    "steering_cmd": (0.02,),
    "rear_steering_cmd": (-0.01,),
    "wheel_torque_cmd": (10.0, -20.0, 30.0, -40.0),
    "brake_torque_cmd": (500.0, 0.0, 300.0, 200.0),
    "normal_force_cmd": (100.0, 200.0, -300.0, -400.0),
    "wind_cmd": (3.0, -8.0),
    "road_height_cmd": (0.1, 0.2, -0.3, 0.0),
    "road_friction_cmd": (0.5, 0.6, 0.7, 1.2),
}
OTHER = {topic: tuple(value / 2 for value in values) for topic, values in GOOD.items()}
DRIVEN = Command(
    *(0.02, -0.01),
    wheel_torque=GOOD["wheel_torque_cmd"],
    brake_torque=GOOD["brake_torque_cmd"],
    normal_force=GOOD["normal_force_cmd"],
    wind=GOOD["wind_cmd"],
    road_height=GOOD["road_height_cmd"],
    road_friction=GOOD["road_friction_cmd"],
)
STEERING = {"steering_cmd": "steering", "rear_steering_cmd": "rear_steering"}
NOT_HELD = {
    f"{name}_cmd": name for name in ("wheel_torque", "brake_torque", "normal_force", "wind")
}
OF_ROAD = {"road_height_cmd": "road_height", "road_friction_cmd": "road_friction"}
ROAD = {field: GOOD[topic] for topic, field in OF_ROAD.items()}
FIELDS = STEERING | NOT_HELD | OF_ROAD
NOT_FINITE = (math.nan, math.inf, -math.inf)
LENGTHS = (0, 1, 3, 4, 5, 1_000_000)
SECOND = 1_000_000_000
TIMEOUT = SECOND // 2
"""ns: the default of `command_timeout`."""
TOTALS = ("speed_cmd", "drive_torque_cmd", "brake_cmd")
SIZES = {**{topic: len(values) for topic, values in GOOD.items()}, **dict.fromkeys(TOTALS, 1)}
WRONG_LENGTHS = [(t, n) for t, size in SIZES.items() for n in LENGTHS if n != size]
WRONG_VALUES = [(t, n, v) for t, size in SIZES.items() for n in range(size) for v in NOT_FINITE]


def filled(timeout: float = 0.5, policy: str = "hold") -> CommandInbox:
    """An inbox that got a good message on every topic at time 0."""
    inbox = CommandInbox(timeout, policy)
    for topic, values in GOOD.items():
        assert inbox.receive(topic, values, 0) == ""
    return inbox


def test_it_knows_the_topics_of_the_interface():
    assert set(CommandInbox().channels) == {*GOOD, *TOTALS}


def test_a_speed_is_no_part_of_a_command_and_gives_way_to_wheel_torques():
    inbox = CommandInbox(timeout=0.5)
    assert inbox.total("speed_cmd", 0) is None
    assert inbox.receive("speed_cmd", (12.0,), 0) == ""
    assert inbox.command(0) == Command()
    assert inbox.total("speed_cmd", TIMEOUT) == 12.0
    assert inbox.total("speed_cmd", TIMEOUT + 1) is None  # silent
    inbox.receive("speed_cmd", (3.0,), SECOND)
    inbox.receive("wheel_torque_cmd", GOOD["wheel_torque_cmd"], SECOND)
    assert inbox.total("speed_cmd", SECOND) is None
    inbox.receive("speed_cmd", (4.0,), 2 * SECOND)  # by now the torques are silent
    assert inbox.total("speed_cmd", 2 * SECOND) == 4.0


def test_before_any_message_nothing_is_commanded_and_nothing_counts_as_silent():
    inbox = CommandInbox()
    assert inbox.command(3600 * SECOND) == Command()
    assert not any(inbox.is_silent(c, 3600 * SECOND) for c in inbox.channels.values())


@pytest.mark.parametrize("topic", GOOD)
def test_a_message_sets_the_field_of_its_topic_and_no_other(topic):
    inbox = CommandInbox()
    assert inbox.receive(topic, array("d", GOOD[topic]), 0) == ""
    value = GOOD[topic][0] if topic in STEERING else GOOD[topic]
    assert inbox.command(0) == Command(**{FIELDS[topic]: value})


@pytest.mark.parametrize("topic", GOOD)
def test_of_many_messages_the_newest_good_one_is_driven(topic):
    inbox = filled()
    inbox.receive(topic, OTHER[topic], 0)
    value = OTHER[topic][0] if topic in STEERING else OTHER[topic]
    assert getattr(inbox.command(0), FIELDS[topic]) == value


def dropped(topic: str, values) -> str:
    """The reason for which a message is dropped; all else stays as it was."""
    inbox = filled()
    for total in TOTALS:
        assert inbox.receive(total, (12.0,), 0) == ""
    reason = inbox.receive(topic, values, 0)
    assert reason.startswith("message dropped: ")
    assert len(reason) < 200  # it is a line of a log, however long the message
    assert reason.isprintable()
    assert inbox.command(0) == DRIVEN
    assert {inbox.channels[total].value for total in TOTALS} == {(12.0,)}
    channel = inbox.channels[topic]
    assert (channel.received, channel.dropped, channel.last_problem) == (2, 1, reason)
    assert sum(c.dropped for c in inbox.channels.values()) == 1
    return reason


@pytest.mark.parametrize(("topic", "element", "value"), WRONG_VALUES)
def test_a_message_with_a_value_that_is_not_finite_is_dropped(topic, element, value):
    values = array("d", OTHER.get(topic, (3.0,)))
    values[element] = value
    reason = dropped(topic, values)
    assert "finite" in reason
    assert str(value) in reason


@pytest.mark.parametrize("element", range(4))
def test_a_brake_that_would_drive_is_dropped(element):
    values = array("d", OTHER["brake_torque_cmd"])
    values[element] = -1e-9
    reason = dropped("brake_torque_cmd", values)
    assert "-1e-09" in reason
    assert "below 0" in reason


def test_the_reason_shows_the_values_as_numbers():
    reason = dropped("wheel_torque_cmd", array("d", (1.0, math.nan, 2.5, -3.0)))
    assert "[1.0, nan, 2.5, -3.0]" in reason  # not as a library spells them


@pytest.mark.parametrize(("topic", "length"), WRONG_LENGTHS)
def test_a_message_of_the_wrong_length_is_dropped(topic, length):
    reason = dropped(topic, array("d", bytes(8 * length)))
    assert str(length) in reason
    assert f"{SIZES[topic]} are expected" in reason


def test_a_million_values_that_are_not_finite_are_dropped_for_their_number():
    assert "1000000" in dropped("wheel_torque_cmd", array("d", [math.nan]) * 1_000_000)


def test_a_dropped_first_message_commands_nothing_and_starts_no_timeout():
    inbox = CommandInbox()
    inbox.receive("steering_cmd", (math.nan,), 0)
    assert inbox.command(SECOND) == Command()
    assert not inbox.is_silent(inbox.channels["steering_cmd"], SECOND)


@pytest.mark.parametrize("topic", GOOD)
def test_a_topic_is_silent_once_more_than_the_timeout_has_passed(topic):
    inbox = filled()
    channel = inbox.channels[topic]
    assert not inbox.is_silent(channel, TIMEOUT)
    assert inbox.is_silent(channel, TIMEOUT + 1)


@pytest.mark.parametrize("topic", GOOD)
def test_a_dropped_message_is_no_sign_of_life(topic):
    inbox = filled()
    inbox.receive(topic, (math.nan,) * len(GOOD[topic]), TIMEOUT)
    assert inbox.is_silent(inbox.channels[topic], TIMEOUT + 1)


def test_the_timeout_of_a_late_first_message_starts_with_it():
    inbox = CommandInbox()
    inbox.receive("steering_cmd", (0.02,), 7 * SECOND)
    assert not inbox.is_silent(inbox.channels["steering_cmd"], 7 * SECOND + TIMEOUT)
    assert inbox.is_silent(inbox.channels["steering_cmd"], 7 * SECOND + TIMEOUT + 1)


def test_of_silent_topics_forces_go_to_zero_and_steering_is_held_by_default():
    inbox = CommandInbox()
    for topic, values in GOOD.items():
        inbox.receive(topic, values, 0)
    assert inbox.command(TIMEOUT) == DRIVEN
    assert inbox.command(TIMEOUT + 1) == Command(steering=0.02, rear_steering=-0.01, **ROAD)


def test_of_silent_topics_steering_is_centred_where_that_is_the_policy():
    inbox = filled(policy="centre")
    assert inbox.command(TIMEOUT) == DRIVEN
    assert inbox.command(TIMEOUT + 1) == Command(**ROAD)


@pytest.mark.parametrize("policy", ["hold", "centre"])
@pytest.mark.parametrize("topic", GOOD)
def test_a_silent_topic_recovers_with_its_next_good_message_and_alone(topic, policy):
    inbox = filled(policy=policy)
    silent = inbox.command(2 * SECOND)
    inbox.receive(topic, GOOD[topic], 2 * SECOND)
    recovered = inbox.command(2 * SECOND)
    for field in FIELDS.values():
        expected = DRIVEN if field == FIELDS[topic] else silent
        assert getattr(recovered, field) == getattr(expected, field)


@pytest.mark.parametrize("timeout", [0.001, 0.1, 3.0])
def test_the_timeout_can_be_chosen(timeout):
    inbox = filled(timeout)
    assert inbox.command(round(timeout * SECOND)) == DRIVEN
    assert inbox.command(round(timeout * SECOND) + 1).wheel_torque == (0.0,) * 4


def test_a_timeout_of_zero_holds_commands_for_ever():
    day = 86_400 * SECOND
    inbox = filled(timeout=0.0, policy="centre")
    assert inbox.command(day) == DRIVEN
    assert not any(inbox.is_silent(c, day) for c in inbox.channels.values())


def test_clear_forgets_the_commands_and_goes_on_counting():
    inbox = filled()
    inbox.receive("steering_cmd", (math.nan,), 0)
    inbox.clear()
    assert inbox.command(SECOND) == Command()
    assert not any(inbox.is_silent(c, SECOND) for c in inbox.channels.values())
    assert inbox.channels["steering_cmd"].received == 2
    assert inbox.channels["steering_cmd"].dropped == 1


def test_a_wrong_message_is_an_answer_too():
    inbox = filled()
    inbox.command(0)
    assert inbox.unanswered(tuple(GOOD)) == list(GOOD)
    assert inbox.receive("steering_cmd", (math.nan,), 0)
    assert inbox.receive("rear_steering_cmd", OTHER["rear_steering_cmd"], 0) == ""
    left = [topic for topic in GOOD if topic not in STEERING]
    assert inbox.unanswered(tuple(GOOD)) == left


def test_the_command_is_the_same_object_until_something_changes():
    inbox = filled()
    first = inbox.command(0)
    assert inbox.command(TIMEOUT) is first
    assert inbox.command(TIMEOUT + 1) != first  # given up
