"""The states of actuators as a message, against closed forms."""

import math

import numpy as np
import pytest
from rclpy.serialization import deserialize_message

from vehicle_roll_sim import Command, Options, Simulation, preset
from vehicle_roll_sim.messages.sets import COMMAND_LABELS, Messages
from vehicle_roll_sim.messages.stamped import builder
from vehicle_roll_sim.messages.topics import ACTUATORS, STAMPED, set_of
from vehicle_roll_sim.ros.encoding import encode
from vehicle_roll_sim.ros.topics import message_class

FREQUENCY, DAMPING, TIME_CONSTANT, MOST = 6.0, 0.6, 0.08, 0.5
"""Hz, 1, s, rad/s"""
STEERING, REAR_STEERING, BRAKE, TIME = 0.1, 0.1, 900.0, 0.05
"""rad, rad, N m, and s after the step of all commands"""
VALUES = {
    "steering_actuator_frequency": FREQUENCY,
    "steering_actuator_damping": DAMPING,
    "rear_steering_actuator_rate_limit": MOST,
    "brake_torque_actuator_time_constant": TIME_CONSTANT,
}
(STAMPED_STATES,) = (topic for topic in STAMPED if topic.name == "actuators_stamped")
ROUNDING = 1e-12
"""Relative, of some hundred half steps."""


@pytest.fixture(scope="module")
def states() -> dict[str, float]:
    """Those after a step of the commands, by name."""
    simulation = Simulation(preset().with_values(VALUES))
    messages = Messages(simulation, "", encode)
    command = Command(steering=STEERING, rear_steering=REAR_STEERING, brake_torque=(BRAKE,) * 4)
    simulation.step(command, TIME)
    build = builder(messages, encode, STAMPED_STATES)
    found = deserialize_message(build(), message_class(STAMPED_STATES.type))
    plain = deserialize_message(messages.actuators(), message_class(ACTUATORS.type))
    assert list(plain.data) == list(found.position)
    return dict(zip(found.name, found.position, strict=True))


def test_a_lag_of_second_order_has_its_place_and_its_rate(states):
    """x = u (1 - e^(-Dwt) (cos wd t + D w / wd sin wd t)), x' = u w^2 / wd e^(-Dwt) sin wd t."""
    w = 2 * math.pi * FREQUENCY
    turn, decay = w * math.sqrt(1 - DAMPING**2), math.exp(-DAMPING * w * TIME)
    cosine, sine = math.cos(turn * TIME), math.sin(turn * TIME)
    place = STEERING * (1 - decay * (cosine + DAMPING * w / turn * sine))
    assert states["lag_steering"] == pytest.approx(place, rel=ROUNDING)
    rate = STEERING * w**2 / turn * decay * sine
    assert states["lag_rate_steering"] == pytest.approx(rate, rel=ROUNDING)


def test_a_lag_of_first_order_has_its_place(states):
    expected = BRAKE * (1 - math.exp(-TIME / TIME_CONSTANT))
    assert states["lag_brake_torque_rr"] == pytest.approx(expected, rel=ROUNDING)
    assert states["lag_rate_brake_torque_rr"] == 0.0


def test_a_rate_limiter_has_what_it_has_let_through(states):
    assert states["limited_rear_steering"] == pytest.approx(MOST * TIME, rel=ROUNDING)
    assert states["limited_steering"] == STEERING
    assert states["lag_rear_steering"] == 0.0


def test_names_are_those_of_the_commands_and_the_topic_is_that_of_vehicles_with_actuators(states):
    assert states["time"] == TIME
    assert len(states) == 1 + 3 * len(COMMAND_LABELS[1:])
    assert np.isfinite(list(states.values())).all()
    assert ACTUATORS in set_of(Options(), False, actuated=True)
    assert ACTUATORS not in set_of(Options(), True, devices=("imu",))
