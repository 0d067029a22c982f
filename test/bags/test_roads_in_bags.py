"""A run on a road with every kind of feature is in its bag, and replayed bit for bit."""

import numpy as np
import pytest
from recorded import PERIOD, PERIOD_NS, read_by_another_library
from road_kinds import FEATURES, TILT, road
from rosbags.rosbag2 import Reader

from vehicle_roll_sim import Command, Simulation, preset
from vehicle_roll_sim.bags.reading import last_run, recorded_runs
from vehicle_roll_sim.bags.replay import replay
from vehicle_roll_sim.bags.run_bag import run_bag
from vehicle_roll_sim.messages.sets import ROAD_LABELS
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.command import Feedback
from vehicle_roll_sim.simulation.description import described
from vehicle_roll_sim.simulation.road_mesh import sampled

END = 1.0
"""s"""
ALL = road({"kind": "commanded"}, TILT, *FEATURES.values())


class Posts(Feedback):
    """Heights and frictions that change all the time."""

    def command(self, time, state):
        heights = tuple(0.01 * np.sin(9.0 * time + wheel) for wheel in range(4))
        return Command(0.02, road_height=heights, road_friction=(0.7 + 0.1 * time, 1.0, 0.9, 0.3))


@pytest.fixture(scope="module")
def driven(tmp_path_factory):
    """The bag of a run, its history, and the simulation."""
    simulation = Simulation(preset(), road=ALL)
    simulation.reset(15.0)
    bag = tmp_path_factory.mktemp("bags") / "road"
    commanded = ("steering", "road_height", "road_friction")
    with run_bag(simulation, commanded, bag, PERIOD_NS, "--bag") as observer:
        history = run(simulation, Posts(), END, command_period=PERIOD, observer=observer)
    return bag, history, simulation


@pytest.fixture(scope="module")
def messages(driven) -> dict[str, list]:
    return read_by_another_library(driven[0])


def test_the_bag_has_the_road_and_is_replayed_bit_for_bit(driven):
    bag, _, simulation = driven
    (recorded,) = recorded_runs(bag)
    again = described(recorded.description).simulation
    assert again.road == simulation.road
    result = replay(recorded, again)
    assert result.is_exact
    assert result.periods == round(END / PERIOD)


def test_the_bag_has_the_surface_of_the_road_once_and_that_of_a_plane_has_no_such_topic(
    driven, messages, tmp_path
):
    _, _, simulation = driven
    ((time, marker),) = messages["/road"]
    assert time == 0
    x, y, z = (np.array([getattr(each, axis) for each in marker.points]) for axis in "xyz")
    heights = sampled(simulation.road, np.column_stack((x, y)))[:, 0]
    assert z.tolist() == heights.tolist()
    with run_bag(Simulation(preset()), (), tmp_path / "bag", PERIOD_NS, "--bag"):
        pass
    with Reader(tmp_path / "bag") as reader:
        assert "/road" not in reader.topics


def test_the_bag_has_heights_and_frictions_in_their_topics_and_in_what_was_applied(messages):
    wanted = Posts().command(0.19, None)
    _, heights = messages["/road_height_cmd"][19]
    _, frictions = messages["/road_friction_cmd"][19]
    _, applied = messages["/applied_command"][20]
    assert list(heights.data) == pytest.approx(wanted.road_height, abs=1e-12)
    assert list(frictions.data) == pytest.approx(wanted.road_friction, abs=1e-12)
    assert [dimension.label for dimension in applied.layout.dim][-8:] == list(ROAD_LABELS)
    assert list(applied.data[-8:]) == [*heights.data, *frictions.data]


def test_the_lateral_acceleration_is_read_back_although_gravity_tilts(driven):
    """It is found from the accelerometer, whose part of gravity changes with time."""
    bag, history, _ = driven
    read = last_run(bag)[0]
    own = history["lateral_acceleration"]
    assert np.abs(own).max() > 0.5
    np.testing.assert_allclose(read["lateral_acceleration"], own, atol=1e-9)
