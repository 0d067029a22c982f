"""Snapshots, copies and pickles: independent of the original, with bit-identical results."""

import copy
import dataclasses
import multiprocessing
import pickle

import pytest

from vehicle_roll_sim import Command, InputError, Options, Simulation, Vehicle, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.paper.multibody import Multibody
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.snapshot import Snapshot

TURN = Command(steering=0.12, wheel_torque=(0.0, 0.0, 60.0, 60.0))
PERIOD_NS = 10_000_000
COPIES = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": lambda simulation: pickle.loads(pickle.dumps(simulation)),
}
PLANTS = {
    "14 dof": {},
    "8 dof": {"options": Options(model="8dof")},
    "steady-state slip": {"options": Options(steady_state_slip=True)},
    "on a slope": {"road": Road(grade=0.1, bank=-0.05), "step": 0.0007, "rollover_angle": 0.5},
}
each_copy = pytest.mark.parametrize("copied", COPIES.values(), ids=COPIES)


@pytest.fixture(scope="module")
def reference() -> Vehicle:
    return preset("reference")


def everything(simulation) -> tuple:
    records = (simulation.state, simulation.outputs, simulation.events)
    now = (simulation.time_ns, simulation.condition, simulation.implausible)
    return (*now, *(record.tobytes() for record in records))


def turned(simulation, seconds: float):
    simulation.step(TURN, seconds)
    return everything(simulation)


@each_copy
@pytest.mark.parametrize("plant", PLANTS.values(), ids=PLANTS)
def test_a_copy_goes_on_as_the_original_does_and_neither_moves_the_other(reference, copied, plant):
    original = Simulation(reference, **plant)
    original.reset(speed=20.0)
    turned(original, 0.7)
    twin = copied(original)
    before = everything(original)
    assert everything(twin) == before
    after = turned(twin, 0.7)
    assert everything(original) == before
    assert turned(original, 0.7) == after != before


@each_copy
def test_a_copy_can_be_reset(reference, copied):
    original = Simulation(reference)
    turned(original, 0.5)
    twin = copied(original)
    twin.reset(speed=15.0)
    fresh = Simulation(reference)
    fresh.reset(speed=15.0)
    assert turned(twin, 0.5) == turned(fresh, 0.5)


@each_copy
def test_a_copy_of_a_run_that_has_stopped_has_stopped_too(reference, copied):
    original = Simulation(reference, rollover_angle=0.05)
    turned(original, 3.0)
    twin = copied(original)
    assert turned(twin, 1.0) == everything(original)
    assert twin.condition.name == "ROLLED_OVER"


def test_a_copy_of_the_multibody_engine_goes_on_alike(reference):
    original = Multibody(reference)
    original.reset(20.0)
    turned(original, 0.05)
    twin = copy.deepcopy(original)
    assert turned(twin, 0.05) == turned(original, 0.05)


def test_a_snapshot_can_be_restored_any_number_of_times(reference):
    simulation = Simulation(reference)
    turned(simulation, 0.5)
    kept = simulation.snapshot()
    assert kept.time == 0.5
    first = turned(simulation, 0.5)
    for _ in range(2):
        simulation.restore(kept)
        assert simulation.snapshot() == kept
        assert turned(simulation, 0.5) == first


def test_a_snapshot_is_a_value(reference):
    simulation = Simulation(reference)
    kept = simulation.snapshot()
    received = pickle.loads(pickle.dumps(kept))
    assert received == kept
    assert hash(received) == hash(kept)
    turned(simulation, 0.1)
    assert simulation.snapshot() != kept
    other = Simulation(reference)
    other.restore(received)
    simulation.restore(received)
    assert turned(other, 0.1) == turned(simulation, 0.1)


@pytest.mark.parametrize(
    "other",
    [
        pytest.param({"options": Options(model="1a")}, id="options"),
        pytest.param({"road": Road(bank=0.1)}, id="road"),
        pytest.param({"step": 0.002}, id="step"),
        pytest.param({"rollover_angle": 1.0}, id="rollover angle"),
    ],
)
def test_a_snapshot_of_a_different_simulation_is_refused_and_nothing_moves(reference, other):
    simulation = Simulation(reference, **other)
    before = everything(simulation)
    with pytest.raises(InputError, match="snapshot: taken from a different simulation"):
        simulation.restore(Simulation(reference).snapshot())
    assert everything(simulation) == before


def test_a_snapshot_of_a_different_vehicle_is_refused(reference):
    with pytest.raises(InputError, match="snapshot"):
        Simulation(reference.with_values({"cg_height": 0.7})).restore(
            Simulation(reference).snapshot()
        )


@pytest.mark.parametrize("plant", PLANTS.values(), ids=PLANTS)
def test_a_simulation_made_from_a_snapshot_in_a_file_goes_on_alike(reference, plant, tmp_path):
    original = Simulation(reference, **plant)
    original.reset(speed=20.0)
    turned(original, 0.07)
    original.snapshot().write(tmp_path / "kept.snapshot")
    kept = Snapshot.of_file(tmp_path / "kept.snapshot")
    assert kept == original.snapshot()
    other = Simulation.from_snapshot(kept, reference, **plant)
    assert turned(other, 0.07) == turned(original, 0.07)


def test_a_simulation_of_another_vehicle_is_not_made_from_a_snapshot(reference):
    kept = Simulation(reference).snapshot()
    with pytest.raises(InputError, match="taken from a different simulation"):
        Simulation.from_snapshot(kept, reference.with_values({"cg_height": 0.7}))


@pytest.mark.parametrize("wrong", [None, 0.5, b"", {}])
def test_what_is_no_snapshot_is_refused(reference, wrong):
    with pytest.raises(InputError, match="snapshot"):
        Simulation(reference).restore(wrong)


def test_a_snapshot_of_a_version_with_other_arrays_is_refused(reference):
    simulation = Simulation(reference)
    kept = simulation.snapshot()
    before = everything(simulation)
    with pytest.raises(InputError, match="snapshot"):
        simulation.restore(dataclasses.replace(kept, memory=(*kept.memory[:3], b"")))
    assert everything(simulation) == before


class Named(Simulation):
    """A user's subclass with a different constructor and additional attributes."""

    def __init__(self, name: str):
        self.name = name
        super().__init__(preset("reference"), step=0.002)
        self.seen = [name]


@each_copy
def test_a_copy_has_what_a_subclass_and_its_user_have_added(copied):
    original = Named("mine")
    original.note = 7
    turned(original, 0.2)
    twin = copied(original)
    assert (type(twin), twin.name, twin.seen, twin.note) == (Named, "mine", ["mine"], 7)
    assert turned(twin, 0.2) == turned(original, 0.2)


def test_a_simulation_can_be_sent_to_another_process(reference):
    simulation = Simulation(reference)
    turned(simulation, 0.3)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        there = pool.apply(turned, (simulation, 0.4))
    assert there == turned(simulation, 0.4)


def test_a_copied_session_keeps_commands_and_the_speed_controller_to_itself(reference):
    original = Session(Simulation(reference), CommandInbox(), PERIOD_NS, 10.0)
    original.inbox.receive("speed_cmd", [14.0], 0)
    for _ in range(20):
        original.run_period()
    twin = copy.deepcopy(original)
    before = everything(original.simulation)
    for _ in range(20):
        twin.run_period()
    assert everything(original.simulation) == before
    for _ in range(20):
        original.run_period()
    assert everything(original.simulation) == everything(twin.simulation) != before
