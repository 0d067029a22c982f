"""Messages of several topics are joined into sets, regardless of their order of arrival."""

import itertools
import random

import pytest

from vehicle_roll_sim.messages.set_synchronizer import KEPT, SetSynchronizer

PERIOD, GAP = 10_000_000, 1_000
"""ns between two sets, and between two messages of one."""
SET = ("state", "imu", "lift_off")
"""In the order in which they are sent."""


def message(name: str, number: int) -> tuple[str, int, str]:
    """(topic, when it was sent, content) of a set."""
    return name, number * PERIOD + SET.index(name) * GAP, f"{name} {number}"


def expected(names, number: int) -> tuple[str, ...]:
    return tuple(f"{name} {number}" for name in names)


@pytest.mark.parametrize("names", itertools.permutations(SET))
@pytest.mark.parametrize("arrival", itertools.permutations(SET))
def test_a_set_is_complete_with_its_last_message_whatever_the_orders(names, arrival):
    joined = SetSynchronizer(names)
    for number in range(3):
        *early, last = (joined.add(*message(name, number)) for name in arrival)
        assert early == [None, None]
        assert last == expected(names, number)


def test_topics_may_overtake_each_other_by_sets():
    joined = SetSynchronizer(SET)
    messages = [message(name, number) for name in reversed(SET) for number in range(KEPT)]
    found = [each for each in (joined.add(*each) for each in messages) if each]
    assert found == [expected(SET, number) for number in range(KEPT)]


def test_random_arrivals_in_order_of_each_topic_give_every_set_once():
    draw = random.Random(7)
    for _ in range(100):
        joined, found = SetSynchronizer(SET), []
        left = {name: list(range(KEPT)) for name in SET}
        while any(left.values()):
            name = draw.choice([name for name in left if left[name]])
            found.append(joined.add(*message(name, left[name].pop(0))))
        assert [each for each in found if each] == [expected(SET, number) for number in range(KEPT)]


@pytest.mark.parametrize("lost", SET)
def test_a_set_that_lost_a_message_is_dropped_and_the_next_is_whole(lost):
    joined = SetSynchronizer(SET)
    for name in SET:
        if name != lost:
            assert joined.add(*message(name, 0)) is None
    found = [joined.add(*message(name, 1)) for name in SET]
    assert found[-1] == expected(SET, 1)


def test_no_set_is_given_after_a_later_one():
    joined = SetSynchronizer(("state", "imu"))
    joined.add(*message("state", 0))
    joined.add(*message("state", 1))
    assert joined.add(*message("imu", 1)) == expected(("state", "imu"), 1)
    assert joined.add(*message("imu", 0)) is None
    joined.add(*message("state", 2))
    assert joined.add(*message("imu", 2)) == expected(("state", "imu"), 2)


def test_one_topic_is_a_set_by_itself():
    joined = SetSynchronizer(("imu",))
    assert [joined.add("imu", 5, k) for k in range(3)] == [(0,), (1,), (2,)]


@pytest.mark.parametrize("ahead", [-60_000_000_000, 0, 60_000_000_000])
def test_an_answer_of_another_node_counts_whatever_its_clock(ahead):
    """In lockstep it comes after its set was sent, and before the next one is."""
    joined = SetSynchronizer(("prediction", "imu"))
    for number in range(5):
        assert joined.add(*message("imu", number)) is None
        sent = number * PERIOD + 5 * GAP + ahead
        assert joined.add("prediction", sent, number) == (number, f"imu {number}")


def test_an_answer_that_is_handled_before_its_set_belongs_to_it():
    joined = SetSynchronizer(("imu", "prediction"))
    for number in range(3):
        assert joined.add("prediction", number * PERIOD + 5 * GAP, number) is None
        assert joined.add(*message("imu", number)) == (f"imu {number}", number)


@pytest.mark.parametrize("arrival", itertools.permutations(SET))
def test_a_clock_that_is_set_back_costs_no_set(arrival):
    """An hour: what was left of an old set must not wait in front of all that is sent now."""
    joined, hour = SetSynchronizer(SET), 3_600_000_000_000
    for name in SET[:2]:
        joined.add(*message(name, 2))
    for number in range(3):
        for name in arrival:
            topic, sent, content = message(name, number)
            last = joined.add(topic, sent - hour, content)
        assert last == expected(SET, number)
