"""Recorded runs, read by another library."""

from pathlib import Path

import pytest

pytest.importorskip("rosbags", reason="bags need the library rosbags")
pytest.importorskip("mcap_ros2", reason="mcap-ros2-support, which reads bags, is not installed")

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.bags.run_bag import run_bag
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.runs.run import run

PERIOD = 0.01
"""s"""
PERIOD_NS = 10_000_000


def record(
    folder: Path, options=None, name: str = "j_turn", duration: float = 4.0, vehicle=None
) -> Simulation:
    """Drive a manoeuvre with its bag in `folder`; returns the simulation at its end."""
    simulation, manoeuvre = Simulation(vehicle or preset(), options), STANDARD[name]
    simulation.reset(manoeuvre.speed)
    manoeuvre = manoeuvre.for_vehicle(simulation.vehicle, simulation.options)
    with run_bag(simulation, manoeuvre.commanded, folder, PERIOD_NS, "--bag") as observer:
        run(simulation, manoeuvre.driver(), duration, command_period=PERIOD, observer=observer)
    return simulation


def read_by_another_library(bag: Path) -> dict[str, list]:
    """(log time in ns, message) by topic, in the order of the bag."""
    messages = {}
    with next(bag.glob("*.mcap")).open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for _, channel, record, message in reader.iter_decoded_messages():
            messages.setdefault(channel.topic, []).append((record.log_time, message))
    return messages
