"""Huge commands are clamped, and with every command at its limit states stay finite."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from signals import everything

from vehicle_roll_sim import Command, Condition, Simulation, preset
from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.command_limits import CommandLimits
from vehicle_roll_sim.live.session import Session

pytestmark = pytest.mark.unmeasured

LIMIT_OF = {topic: channel.limit for topic, channel in channels().items()}
SIZE_OF = {topic: channel.size for topic, channel in channels().items()}
USUAL = CommandLimits()
TOTALS = ("speed_cmd", "drive_torque_cmd", "brake_cmd")
FIELDS = {t: c.field for t, c in channels().items() if t not in TOTALS}
HUGE = (1e10, 1e308)
ONE_SIDED = ("brake_torque_cmd", "brake_cmd", "road_friction_cmd")
PERIOD_NS, PERIOD = 10_000_000, 0.01
TEN_SECONDS = 10_000_000_000
"""ns"""


def limit(topic: str, limits: CommandLimits = USUAL) -> float:
    return getattr(limits, LIMIT_OF[topic])


def applied(inbox: CommandInbox, topic: str, now_ns: int = 0):
    """What a topic commands, as values."""
    if topic in TOTALS:
        return (inbox.total(topic, now_ns),)
    value = getattr(inbox.command(now_ns), FIELDS[topic])
    return value if isinstance(value, tuple) else (value,)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("huge", HUGE)
@pytest.mark.parametrize("topic", LIMIT_OF)
def test_a_huge_value_is_driven_as_the_limit_and_counted(topic, huge, sign):
    inbox = CommandInbox()
    sign = abs(sign) if topic in ONE_SIDED else sign
    values = [0.0] * SIZE_OF[topic]
    values[-1] = sign * huge
    reason = inbox.receive(topic, values, 0)
    assert reason.startswith("clamped: ")
    assert LIMIT_OF[topic] in reason
    assert applied(inbox, topic) == (*values[:-1], sign * limit(topic))
    channel = inbox.channels[topic]
    counts = (channel.received, channel.clamped, channel.dropped, channel.last_problem)
    assert counts == (1, 1, 0, reason)
    assert sum(c.clamped for c in inbox.channels.values()) == 1


@pytest.mark.parametrize("topic", LIMIT_OF)
def test_a_value_at_the_limit_is_driven_as_it_is(topic):
    inbox = CommandInbox()
    values = (limit(topic),) * SIZE_OF[topic]
    assert inbox.receive(topic, values, 0) == ""
    assert applied(inbox, topic) == values
    assert inbox.receive(topic, [math.nextafter(values[0], math.inf), *values[1:]], 0)
    assert applied(inbox, topic) == values


def test_a_clamped_message_is_a_sign_of_life_and_a_dropped_one_of_huge_values_is_not():
    inbox = CommandInbox()
    inbox.receive("wheel_torque_cmd", [1e10] * 4, 0)
    assert inbox.channels["wheel_torque_cmd"].arrival_ns == 0
    inbox.receive("wheel_torque_cmd", [1e10, 1e10, math.nan, 0.0], 1)
    assert inbox.channels["wheel_torque_cmd"].arrival_ns == 0


def test_a_limit_that_changes_counts_from_the_next_period_for_a_held_command_too(session):
    session.inbox.receive("steering_cmd", (0.04,), 0)
    session.run_period()
    assert session.applied.steering == 0.04
    session.inbox.limits.steering_limit = 0.01
    session.run_period()
    assert session.applied.steering == 0.01
    session.inbox.limits.steering_limit = 1.0
    session.run_period()
    assert session.applied.steering == 0.04


def test_steering_follows_no_faster_than_its_rate_limit(session):
    session.inbox.limits.steering_rate_limit = 0.5
    session.inbox.receive("steering_cmd", (0.012,), 0)
    session.inbox.receive("rear_steering_cmd", (-1.0,), 0)
    driven = []
    for _ in range(4):
        session.run_period()
        driven.append((session.applied.steering, session.applied.rear_steering))
    front, rear = zip(*driven, strict=True)
    # 0.5 rad/s over periods of 10 ms; the sums of 0.005 round
    assert front == pytest.approx((0.005, 0.010, 0.012, 0.012), abs=1e-15)
    assert front[-1] == 0.012
    assert rear == pytest.approx((-0.005, -0.010, -0.015, -0.020), abs=1e-15)


def test_steering_that_is_given_up_is_centred_no_faster_than_its_rate_limit(session):
    session.inbox.steering_policy, session.inbox.timeout = "centre", PERIOD
    session.inbox.receive("steering_cmd", (0.01,), 0)
    session.run_period()
    session.inbox.limits.steering_rate_limit = 0.2
    driven = []
    for _ in range(7):
        session.run_period()
        driven.append(session.applied.steering)
    assert driven == pytest.approx([0.01, 0.008, 0.006, 0.004, 0.002, 0.0, 0.0], abs=1e-15)
    assert driven[-1] == 0.0


def test_without_a_rate_limit_and_within_limits_commands_are_driven_to_the_bit(session):
    alone = Simulation(preset())
    alone.reset(20.0)
    rng = np.random.default_rng(5)
    for _ in range(50):
        steering, force = float(rng.normal(0, 0.1)), tuple(rng.normal(0, 1000, 4).tolist())
        session.inbox.receive("steering_cmd", (steering,), session.simulation.time_ns)
        session.inbox.receive("normal_force_cmd", force, session.simulation.time_ns)
        session.run_period()
        alone.step(Command(steering, normal_force=force), PERIOD)
    assert everything(session.simulation) == everything(alone)


@pytest.mark.parametrize("name", parameters_of(CommandLimits))
@pytest.mark.parametrize("wrong", [math.nan, math.inf, -1.0, 1e7])
def test_a_limit_of_its_own_is_checked(name, wrong):
    with pytest.raises(InputError, match=name):
        parameters_of(CommandLimits)[name].validate(wrong)


def driven_at_limits(speed: float, segments) -> Session:
    """Ten seconds of commands far beyond the limits, held over segments of the same length."""
    session = Session(Simulation(preset()), CommandInbox(timeout=0.0), PERIOD_NS, speed)
    every = -(-TEN_SECONDS // PERIOD_NS // len(segments))
    for count in range(TEN_SECONDS // PERIOD_NS):
        if count % every == 0:
            for topic, values in segments[count // every].items():
                session.inbox.receive(topic, values, session.simulation.time_ns)
        session.run_period()
    return session


def huge_values(topic: str):
    lowest = 0.0 if topic in ONE_SIDED else -1e308
    one = st.sampled_from([lowest, 0.0, 1e308])
    return st.lists(one, min_size=SIZE_OF[topic], max_size=SIZE_OF[topic])


STEERING = ("steering_cmd", "rear_steering_cmd")
HARMLESS = {
    "brakes and forces": (*STEERING, "brake_torque_cmd", "normal_force_cmd"),
    "speed": (*STEERING, "speed_cmd"),
}
"""Topics beside the steering: together they spin no wheel in the air for seconds."""


def segments_of(topics):
    """Each commands some of the topics: a speed is driven only while brakes are off."""
    one = st.fixed_dictionaries({}, optional={topic: huge_values(topic) for topic in topics})
    return st.lists(one, min_size=1, max_size=20)


def is_finite(session: Session) -> bool:
    """Whether everything there is to be published is."""
    simulation = session.simulation
    parts = (simulation.state_vector, simulation.outputs.normal_force, simulation.cg_motion)
    return all(np.isfinite(part).all() for part in parts)


@pytest.mark.parametrize("driven", HARMLESS)
@settings(max_examples=15, deadline=None)
@given(data=st.data(), speed=st.floats(0.0, 60.0))
def test_steering_with_brakes_and_forces_or_a_speed_at_their_limits_never_diverges_in_ten_seconds(
    driven, data, speed
):
    session = driven_at_limits(speed, data.draw(segments_of(HARMLESS[driven])))
    assert is_finite(session)
    assert session.simulation.condition in (Condition.RUNNING, Condition.ROLLED_OVER)


@pytest.mark.parametrize("drive", ["wheel_torque_cmd", "speed_cmd"])
@settings(max_examples=15, deadline=None)
@given(data=st.data(), speed=st.floats(0.0, 60.0))
def test_with_a_drive_at_its_limit_too_all_stays_finite_for_ten_seconds(drive, data, speed):
    topics = (*HARMLESS["brakes and forces"], drive)
    session = driven_at_limits(speed, data.draw(segments_of(topics)))
    assert is_finite(session)
    if session.simulation.condition is Condition.DIVERGED:
        # a wheel that spins on at some 1000 m/s over a road at rest, or a vehicle on its back
        assert session.simulation.implausible.startswith(("longitudinal_slip", "pitch"))


def test_each_command_alone_at_its_limit_leaves_everything_finite(session):
    for topic in LIMIT_OF:
        session.reset(13.9)
        session.inbox.timeout = 0.0
        session.inbox.receive(topic, [1e308] * SIZE_OF[topic], 0)
        for _ in range(TEN_SECONDS // PERIOD_NS):
            session.run_period()
        assert is_finite(session)
