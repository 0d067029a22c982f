"""The declarations of topics: their meanings, units and types."""

import pytest

from vehicle_roll_sim.messages.command_topics import COMMANDS, WAYS_IN
from vehicle_roll_sim.messages.topic import ARRAY, FLOAT, Topic
from vehicle_roll_sim.messages.topics import PUBLISHED, STAMPED, STATE_SET


@pytest.mark.parametrize(
    "topic", [*COMMANDS, *WAYS_IN, *PUBLISHED, *STAMPED], ids=lambda topic: topic.name
)
def test_every_topic_says_in_one_phrase_what_it_means(topic):
    assert topic.meaning
    assert not topic.meaning.endswith(".")
    assert "\n" not in topic.meaning


def test_commands_have_the_units_and_sizes_that_their_limits_are_for():
    assert {topic.name: (topic.unit, topic.type) for topic in COMMANDS} == {
        "steering_cmd": ("rad", FLOAT),
        "rear_steering_cmd": ("rad", FLOAT),
        "wheel_torque_cmd": ("N m", ARRAY),
        "brake_torque_cmd": ("N m", ARRAY),
        "normal_force_cmd": ("N", ARRAY),
        "speed_cmd": ("m/s", FLOAT),
        "drive_torque_cmd": ("N m", FLOAT),
        "brake_cmd": ("N m", FLOAT),
        "wind_cmd": ("m/s", ARRAY),
        "road_height_cmd": ("m", ARRAY),
        "road_friction_cmd": ("", ARRAY),
    }


def test_topics_that_differ_in_words_only_are_the_same_topic():
    """A controller may name one as `Topic(name, type)`."""
    (state, *_) = STATE_SET
    assert Topic(state.name, state.type) == state
