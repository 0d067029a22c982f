"""Snapshots of a session: branches equal their straight runs, to the bit, wherever they go on."""

import dataclasses
import multiprocessing
import pickle

import numpy as np
import pytest
from signals import everything

from vehicle_roll_sim import Command, InputError, Simulation, preset
from vehicle_roll_sim.input_errors import NotWrittenError
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.command_limits import CommandLimits
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.session_snapshot import SessionSnapshot
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.snapshot import Snapshot
from vehicle_roll_sim.simulation.speed_controller import SpeedController

PERIOD_NS = 2_000_000
TIMEOUT = 0.01
"""s: five periods, so that commands expire in every branch."""
EQUIPPED = preset().with_values(
    {
        "steering_actuator_frequency": 6.0,
        "steering_actuator_dead_time": 0.007,
        "wheel_torque_actuator_time_constant": 0.02,
        "side_force_area": 4.0,
        "wheel_speed_sensor_period": 0.004,
        "wheel_speed_sensor_delay": 0.008,
        "wheel_speed_sensor_noise_density": 0.01,
        "wheel_speed_sensor_bias_walk": 0.1,
        "wheel_speed_sensor_dropout": 0.2,
        "sensor_seed": 11,
    }
)
ROAD = Road.from_values({"features": [{"kind": "commanded"}]})
BRANCHES, PERIODS = 1000, 6
SPREAD = {
    "steering_cmd": 0.1,
    "normal_force_cmd": 2000.0,
    "wheel_torque_cmd": 500.0,
    "speed_cmd": 20.0,
    "wind_cmd": 10.0,
    "road_height_cmd": 0.01,
}
"""Standard deviation of random commands (SI units)."""


class Noise:
    """A part with a generator of random numbers, as a sensor has one: it pushes the wheels."""

    def __init__(self, seed: int):
        self.generator = np.random.default_rng(seed)

    def memory(self) -> dict:
        return self.generator.bit_generator.state

    def remember(self, memory: dict) -> None:
        self.generator.bit_generator.state = memory


def made(seed: int = 0) -> Session:
    inbox = CommandInbox(TIMEOUT, "centre", CommandLimits(steering_rate_limit=2.0))
    session = Session(Simulation(EQUIPPED, road=ROAD), inbox, PERIOD_NS, 20.0)
    session.parts["noise"] = Noise(seed)
    return session


def drive(session: Session, rng: np.random.Generator, periods: int) -> list:
    """Run with random commands; returns all that can be seen after each period."""
    seen = []
    for _ in range(periods):
        now = session.simulation.time_ns
        for topic, spread in SPREAD.items():
            if rng.random() < 0.3:
                size = session.inbox.channels[topic].size
                session.inbox.receive(topic, (spread * rng.normal(size=size)).tolist(), now)
        if rng.random() < 0.1:
            session.inbox.limits.steering_limit = float(rng.uniform(0.05, 0.2))
        noise = session.parts["noise"].generator.normal(size=4)
        session.inbox.receive("brake_torque_cmd", abs(noise).tolist(), now)
        session.inbox.receive("road_friction_cmd", abs(1.0 + 0.1 * noise).tolist(), now)
        session.run_period()
        readings = session.simulation.sensors.devices["wheel_speed_sensor"].memory.tobytes()
        seen.append((everything(session.simulation), session.applied, readings))
    return seen


def test_a_thousand_random_branches_equal_their_straight_runs():
    """Each begins where one before it has left its session, and goes on in a session that has
    been elsewhere before."""
    straight, branch = made(1), made(2)
    rng = np.random.default_rng(3)
    for number in range(BRANCHES):
        if number % 50 == 0:
            straight.reset(float(rng.uniform(5.0, 30.0)))
        drive(straight, rng, int(rng.integers(0, PERIODS)))
        kept = straight.snapshot()
        seed, periods = int(rng.integers(2**60)), int(rng.integers(1, PERIODS))
        there = drive(straight, np.random.default_rng(seed), periods)
        branch.restore(kept)
        assert branch.snapshot() == kept
        assert drive(branch, np.random.default_rng(seed), periods) == there
        assert branch.snapshot() == straight.snapshot()


@pytest.fixture(scope="module")
def kept() -> SessionSnapshot:
    session = made(4)
    drive(session, np.random.default_rng(5), 40)
    return session.snapshot()


def continued(kept) -> list:
    """What a fresh session sees that goes on from a snapshot, or from one in a file."""
    session = made(6)
    session.restore(kept if isinstance(kept, SessionSnapshot) else SessionSnapshot.of_file(kept))
    return drive(session, np.random.default_rng(7), 20)


def test_a_snapshot_is_a_value(kept):
    received = pickle.loads(pickle.dumps(kept))
    assert (received, hash(received), received.token) == (kept, hash(kept), kept.token)
    assert continued(received) == continued(kept)
    session = made()
    assert session.snapshot().token == made().snapshot().token != kept.token


def test_another_process_goes_on_from_a_file(kept, tmp_path):
    path = tmp_path / "kept.snapshot"
    kept.write(path)
    assert SessionSnapshot.of_file(path) == kept
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        there = pool.apply(continued, (path,))
    assert there == continued(kept)


def test_the_simulation_in_a_snapshot_goes_on_alone(kept):
    session = made()
    session.restore(kept)
    alone = Simulation.from_snapshot(kept.simulation, EQUIPPED, road=ROAD)
    assert everything(alone) == everything(session.simulation)


def test_a_pause_and_the_counts_of_messages_stay_as_they_are(kept):
    session = made()
    session.paused = True
    session.inbox.receive("steering_cmd", [0.1], 0)
    session.restore(kept)
    assert session.paused
    assert session.inbox.channels["steering_cmd"].received == 1


def other_period() -> Session:
    return Session(Simulation(EQUIPPED), CommandInbox(), 2 * PERIOD_NS, 20.0)


def other_limit() -> Session:
    controller = SpeedController(EQUIPPED, drive_limit=100.0)
    return Session(Simulation(EQUIPPED), CommandInbox(), PERIOD_NS, 20.0, controller)


def other_parts() -> Session:
    return Session(Simulation(EQUIPPED), CommandInbox(), PERIOD_NS, 20.0)


def other_vehicle() -> Session:
    session = Session(Simulation(preset()), CommandInbox(), PERIOD_NS, 20.0)
    session.parts["noise"] = Noise(0)
    return session


@pytest.mark.parametrize(
    ("other", "words"),
    [
        (other_period, "another period (s), 0.002"),
        (other_limit, "another speed_drive_limit (N m), 800.0"),
        (other_parts, "it contains commands, noise, speed_controller"),
        (other_vehicle, "a different simulation"),
    ],
)
def test_a_snapshot_of_a_different_session_is_refused_and_nothing_moves(kept, other, words):
    session = other()
    before = session.snapshot()
    with pytest.raises(InputError) as refusal:
        session.restore(kept)
    assert words in str(refusal.value)
    assert "\n" not in str(refusal.value)
    assert session.snapshot() == before


@pytest.mark.parametrize("wrong", [None, "s0123", b"", {}])
def test_what_is_no_snapshot_is_refused(wrong):
    with pytest.raises(InputError, match="snapshot"):
        made().restore(wrong)


def damages(text: str) -> dict[str, str]:
    """Files that are no whole snapshot, and a word of the refusal."""
    head, body = text.split("\n")[:2]
    middle = len(body) // 2
    flipped = "1" if body[middle] != "1" else "2"
    return {
        "": "it is none",
        "{}\n{}\n": "it is none",
        "[" * 100_000: "it is none",
        text[:-1]: "damaged",
        text[: len(text) // 2]: "damaged",
        head: "damaged",
        text + "more": "damaged",
        f"{head}\n{body[:middle]}{flipped}{body[middle + 1 :]}\n": "damaged",
        text.replace('"session"', '"simulation"', 1): "it is none",
        text.replace('"version":"', '"version":"0.', 1): "saved by version 0.",
    }


def test_a_damaged_file_and_one_of_another_version_are_refused_in_one_line(kept, tmp_path):
    path = tmp_path / "kept.snapshot"
    kept.write(path)
    for text, words in damages(path.read_text()).items():
        path.write_text(text)
        with pytest.raises(InputError) as refusal:
            SessionSnapshot.of_file(path)
        assert words in str(refusal.value)
        assert str(path) in str(refusal.value)
        assert "\n" not in str(refusal.value)
    with pytest.raises(InputError, match="existing file"):
        SessionSnapshot.of_file(tmp_path / "none")


def test_a_snapshot_of_a_simulation_is_none_of_a_session_and_the_other_way_round(kept, tmp_path):
    path = tmp_path / "kept.snapshot"
    kept.simulation.write(path)
    assert Snapshot.of_file(path) == kept.simulation
    with pytest.raises(InputError, match="a snapshot of a session"):
        SessionSnapshot.of_file(path)
    kept.write(path)
    with pytest.raises(InputError, match="a snapshot of a simulation"):
        Snapshot.of_file(path)


def test_a_file_that_cannot_be_written_leaves_nothing(kept, tmp_path):
    with pytest.raises(NotWrittenError):
        kept.write(tmp_path / "missing" / "kept.snapshot")
    kept.write(tmp_path / "kept.snapshot")
    assert [each.name for each in tmp_path.iterdir()] == ["kept.snapshot"]


def test_every_field_of_a_command_that_was_applied_is_kept():
    session = made()
    numbers = iter(range(1, 100))
    fields = {
        each.name: tuple(float(next(numbers)) for _ in each.default)
        if isinstance(each.default, tuple)
        else next(numbers) / 100
        for each in dataclasses.fields(Command)
    }
    session.applied = Command(**fields)
    other = made()
    other.restore(session.snapshot())
    assert other.applied == session.applied == Command(**fields)
