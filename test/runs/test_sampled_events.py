"""Events found in samples, against those that the simulation finds at every step."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import manoeuvre_named
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.roads.heights import CorkscrewRamp
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import LEFT, lift_off_times
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.runs.sampled_events import events_of
from vehicle_roll_sim.simulation.road import Road

SAMPLE = 0.01
"""s"""
WITHIN_A_SAMPLE = 1e-3
"""s: what is interpolated over 10 ms is bent less than a tenth of them."""
PEAKS = {"rel": 1e-3}
"""Between two samples a peak rises by its curvature over 5 ms."""
ROLLOVER = math.radians(85.0)


def driven(name: str, sample: float = SAMPLE, **options) -> tuple[History, np.record]:
    """The history of a manoeuvre, and the events of its simulation."""
    simulation = Simulation(preset("reference"), Options(**options), rollover_angle=ROLLOVER)
    manoeuvre = manoeuvre_named(name).for_vehicle(simulation.vehicle, simulation.options)
    simulation.reset(manoeuvre.speed)
    history = run(simulation, manoeuvre.driver(), manoeuvre.duration, sample=sample)
    return history, simulation.events


@pytest.mark.parametrize("name", ["j_turn", "ramp_steer", "step_steer"])
def test_samples_show_the_events_of_the_run(name):
    history, happened = driven(name)
    seen = events_of(history, ROLLOVER)
    for event in ("lift_off_time", "rollover_time"):
        assert seen[event] == pytest.approx(happened[event], abs=WITHIN_A_SAMPLE, nan_ok=True)
    for event in ("peak_roll", "peak_lateral_acceleration"):
        assert seen[event][0] == pytest.approx(happened[event][0], **PEAKS)
        assert seen[event][1] == pytest.approx(happened[event][1], abs=SAMPLE)


@pytest.mark.parametrize("model", ["1", "2"])
def test_on_a_road_with_heights_a_wheel_lifts_at_its_first_sample_without_load(model):
    """A wheel that climbs is not off the road, though higher than its radius over z = 0."""
    climb = CorkscrewRamp(start=5.0, length=8.0, height=0.4, width=0.5, top=200.0)
    jump = CorkscrewRamp(start=5.0, length=8.0, height=0.4, width=0.5)
    for ramp in (climb, jump):
        simulation = Simulation(preset(), Options(model=model), road=Road(features=(ramp,)))
        simulation.reset(8.0)
        history = run(simulation, lambda times: np.zeros(len(times), COMMAND), 3.0, sample=SAMPLE)
        compressions, seen = history.wheels("tire_compression"), events_of(history, ROLLOVER)
        assert (compressions.min(axis=0)[LEFT] < 0.0).all()
        happened = simulation.events["lift_off_time"]
        assert np.isnan(happened).all() == (ramp is climb)
        assert seen["lift_off_time"] == pytest.approx(happened, abs=SAMPLE, nan_ok=True)


def test_a_model_without_tire_compression_lifts_at_its_first_sample_without_load():
    history, _ = driven("ramp_steer", model="8dof")
    assert np.isnan(history.wheels("tire_compression")).all()
    first = lift_off_times(history["time"], history.wheels("normal_force"))
    assert not np.isnan(first).all()
    assert events_of(history, ROLLOVER).lift_off_time == pytest.approx(first, nan_ok=True)


def test_rollover_is_at_the_angle_that_was_asked_for():
    history, _ = driven("j_turn")
    angle = math.radians(60.0)
    found = events_of(history, angle).rollover_time[0]
    assert np.interp(found, history["time"], np.abs(history["roll"])) == pytest.approx(angle)


@pytest.mark.filterwarnings("error")
def test_where_nothing_is_known_nothing_has_happened():
    rows = np.full((5, len(COLUMNS)), np.nan)
    rows[:, 0] = np.arange(5)
    events = events_of(History(rows), ROLLOVER)
    for event in ("lift_off_time", "rollover_time", "peak_roll"):
        assert np.isnan(events[event]).all()


def test_a_single_sample_has_a_peak_and_no_lift_off():
    history, _ = driven("step_steer")
    events = events_of(History(history.rows[200:201]), ROLLOVER)
    assert events.peak_roll == pytest.approx([history["roll"][200], history["time"][200]])
    assert np.isnan(events.lift_off_time).all()
