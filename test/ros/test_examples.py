"""Every file in msg_examples does what its README says, on a running simulator."""

from pathlib import Path

import pytest
import yaml

from vehicle_roll_sim.messages.command_topics import COMMANDS

EXAMPLES = Path(__file__).parents[2] / "msg_examples"
Y, ROLL, U, YAW_RATE = 2, 4, 7, 12
"""Places in `state`, whose first element is the time."""


def example(name: str):
    return yaml.safe_load((EXAMPLES / f"{name}.yaml").read_text())["data"]


def turns_left(state):
    return state[YAW_RATE] > 0.1


def yaws_left_from_behind(state):
    return state[YAW_RATE] > 0.02


def gains_speed(state):
    return state[U] > 14.2


def loses_speed(state):
    return state[U] < 13.5


def leans_left(state):
    return state[ROLL] < -0.01


def is_blown_to_the_right(state):
    return state[Y] < -0.05


def drifts(state):
    return abs(state[Y]) > 1.0


EFFECTS = {
    "steering_cmd": turns_left,
    "rear_steering_cmd": yaws_left_from_behind,
    "wheel_torque_cmd": gains_speed,
    "brake_torque_cmd": loses_speed,
    "speed_cmd": loses_speed,
    "drive_torque_cmd": gains_speed,
    "brake_cmd": loses_speed,
    "normal_force_cmd": leans_left,
    "wind_cmd": is_blown_to_the_right,
    "road_height_cmd": leans_left,
    "road_friction_cmd": drifts,
}
COMMANDED_ROAD = ("--ros-args", "-p", f"road_file:={EXAMPLES / 'commanded_road.yaml'}")
NEEDED = {
    "wind_cmd": ("--ros-args", "-p", "vehicle.side_force_area:=4.0"),
    "road_height_cmd": COMMANDED_ROAD,
    "road_friction_cmd": (*COMMANDED_ROAD, "-p", "bank:=-0.1"),
}
"""Arguments of the simulator without which a message has no effect."""


@pytest.mark.parametrize("name", [topic.name for topic in COMMANDS])
def test_the_example_message_has_its_effect(start, peer, name):
    start("simulator", *NEEDED.get(name, ()))
    peer.listen("state")
    peer.command(
        {name: example(name)}, lambda: EFFECTS[name](peer.newest("state").data), f"effect of {name}"
    )


def test_the_readme_has_the_line_for_every_message():
    text = (EXAMPLES / "README.md").read_text()
    for topic in COMMANDS:
        kind = topic.type
        line = f'ros2 topic pub --rate 50 {topic.name} {kind} "$(cat {topic.name}.yaml)"'
        assert line in text
