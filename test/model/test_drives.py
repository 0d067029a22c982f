"""Drives from standstill to standstill: finite, smooth and accurate, without jumps."""

import itertools
import math

import numpy as np
import pytest
from programmes import Evaluation, record_run, with_tire

from vehicle_roll_sim import Command, Condition, Options, Simulation
from vehicle_roll_sim.model.records import COMMAND, MODEL_STATE, STATE, STATE_NAMES
from vehicle_roll_sim.simulation.options import MODELS

pytestmark = [pytest.mark.slow, pytest.mark.unmeasured]

VELOCITIES = (
    *("u", "v", "w", "roll_rate", "pitch_rate", "yaw_rate"),
    *("unsprung_velocity", "wheel_speed"),
)


def drive(*points, steering=0.0, until=0.0, brakes=(1.0,) * 4):
    """Torque and brake torque of every wheel (N m) along (time, torque, brake torque).

    steering: amplitude (rad) at 1 rad/s, held from `until` (s) on. brakes: share of each wheel.
    """
    times, torque, brake = np.array(points).T

    def programme(now: np.ndarray) -> np.ndarray:
        commands = np.zeros(len(now), COMMAND)
        commands["wheel_torque"] = np.interp(now, times, torque)[:, None]
        commands["brake_torque"] = np.interp(now, times, brake)[:, None] * brakes
        commands["steering"] = steering * np.sin(np.minimum(now, until))
        return commands

    return programme


GO = ((0.0, 0.0, 0.0), (0.2, 300.0, 0.0), (12.0, 300.0, 0.0), (12.5, 0.0, 0.0))
TO_30_AND_BACK = (*GO, (13.0, 0.0, 0.0), (13.2, 0.0, 600.0))
REVERSE = ((0.0, 0.0, 0.0), (0.2, -200.0, 0.0), (3.0, -200.0, 0.0), (3.2, 0.0, 0.0))
REVERSE = (*REVERSE, (4.0, 0.0, 0.0), (4.2, 0.0, 500.0))
LOCK = ((0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.6, 0.0, 3000.0))
DRIVES = {
    "straight": (drive(*TO_30_AND_BACK), 0.0, 30.0),
    "steering": (drive(*TO_30_AND_BACK, steering=0.02, until=17.0), 0.0, 30.0),
    "reverse": (drive(*REVERSE, steering=0.15, until=5.0), 0.0, 14.0),
    "locked at low speed": (drive(*LOCK), 3.0, 10.0),
    "locked in a turn": (drive(*LOCK, steering=0.1, until=1.0), 3.0, 12.0),
    "split locking": (drive(*LOCK, brakes=(1.0, 0.05, 1.0, 0.05)), 8.0, 14.0),
}
"""Programme, speed at the start (m/s), duration (s)."""


def driven(vehicle, name: str, step: float, model: str = "1") -> tuple[np.ndarray, Simulation]:
    """States every 10 ms, and the simulation at the end."""
    programme, speed, duration = DRIVES[name]
    simulation = Simulation(vehicle, Options(model=model), step=step)
    simulation.reset(speed)
    kept = [simulation.state.copy()]
    for _ in range(round(duration / 0.01)):
        simulation.step(programme, 0.01)
        kept.append(simulation.state.copy())
    assert simulation.condition is Condition.RUNNING
    return np.array(kept, STATE), simulation


@pytest.mark.parametrize("name", DRIVES)
def test_a_drive_is_finite_and_comes_to_rest_and_a_step_of_1_ms_shows_it(unequal_axles, name):
    """Positions and speeds within 2 % of the peak of each; seen 1.2 % where wheels lock at once.

    A wheel locks at the end of a step, up to 1 ms late: the error does not fall smoothly with the
    step. Between 0.25 and 0.1 ms it is 0.3 %.
    """
    coarse, simulation = driven(unequal_axles, name, 1e-3)
    fine, _ = driven(unequal_axles, name, 0.25e-3)
    assert all(np.isfinite(coarse[state]).all() for state in STATE.names)
    gaps = {}
    for state in MODEL_STATE.names:
        peak = np.abs(fine[state]).max() + 1e-9
        gaps[state] = float(np.abs(coarse[state] - fine[state]).max() / peak)
    assert max(gaps.values()) < 0.02, gaps
    assert (simulation.state.wheel_speed == 0).all()
    left = {state: float(np.abs(simulation.state[state]).max()) for state in VELOCITIES}
    assert max(left.values()) < 3e-5, left  # m/s, rad/s, 7 s and more after the stop; seen 1.7e-5


def parked_modes(vehicle) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues (1/s) and eigenvectors of the vehicle at rest on locked wheels.

    By differences of its rates.
    """
    simulation, evaluation = Simulation(vehicle), Evaluation(vehicle, Options())
    evaluation.outputs.turning[:] = 0.0
    simulation.reset(0.0)
    at_rest, size = simulation.state_vector.copy(), 1e-6
    brakes = Command(brake_torque=(2000.0,) * 4).records()[0]
    columns = []
    for place in range(len(at_rest)):
        both = []
        for sign in (1, -1):
            state = at_rest.copy()
            state[place] += sign * size
            rates = evaluation.rates(state.view(STATE)[0], brakes)
            both.append(np.atleast_1d(rates).view(np.float64).copy())
        columns.append((both[0] - both[1]) / (2 * size))
    values, vectors = np.linalg.eig(np.array(columns).T)
    sways = values.imag > 1.0  # rad/s
    return values[sways], vectors[:, sways]


def rate_of_decay(time, signal) -> float:
    """1/s: slope of the logarithm of the peaks between changes of sign."""
    turns = np.flatnonzero(np.diff(np.sign(signal)))
    parts = [slice(a, b) for a, b in itertools.pairwise(turns)]
    peaks = [np.abs(signal[part]).max() for part in parts]
    middles = [time[part][np.abs(signal[part]).argmax()] for part in parts]
    return -np.polyfit(middles, np.log(peaks), 1)[0]


def slowest_rate(vehicle, name: str) -> float:
    """Decay (1/s) of the slowest mode in which the state of this name has a good part."""
    values, vectors = parked_modes(vehicle)
    part = np.abs(vectors[STATE_NAMES.index(name)]) / np.abs(vectors).max(axis=0)
    return -values[part > 0.5].real.max()


def speeds(states) -> np.ndarray:
    """Largest of all speeds and rates at each sample (m/s, rad/s)."""
    return np.max([np.abs(states[s]).reshape(len(states), -1).max(1) for s in VELOCITIES], axis=0)


def stop_of(states) -> int:
    """The sample after which the forward speed stays below 0.05 m/s."""
    return len(states) - int(np.argmax(np.abs(states["u"])[::-1] > 0.05))


SWAYS = {"straight": ("pitch_rate",), "reverse": ("pitch_rate", "roll_rate")}


@pytest.mark.parametrize("name", SWAYS)
def test_after_a_stop_the_body_sways_on_its_springs_and_calms_down_at_their_rate(vehicle, name):
    """No faster: pitch decays with 1.70 and 1.30 1/s, roll with 1.05 and 1.11 1/s on the two."""
    states, _ = driven(vehicle, name, 1e-3)
    settled = states[stop_of(states) + 150 :][:350]
    time = 0.01 * np.arange(len(settled))
    for sway in SWAYS[name]:
        # peaks of one mode amid others: seen 2 % off
        assert rate_of_decay(time, settled[sway]) == pytest.approx(
            slowest_rate(vehicle, sway), rel=0.05
        )


def test_ten_seconds_after_a_straight_stop_nothing_moves_any_more(vehicle):
    states, _ = driven(vehicle, "straight", 1e-3)
    stop, moving = stop_of(states), speeds(states)
    assert moving[-1] < 1e-6  # m/s, rad/s; seen 5e-9 and 2.5e-7, 9.6 s after the stop
    assert moving[stop + 200] < 1e-2  # seen 2e-3 and 3e-3, 2 s after it


@pytest.mark.parametrize("name", ["reverse", "locked in a turn"])
def test_no_state_jumps_through_a_stop_half_the_step_makes_half_the_change(reference, name):
    programme, speed, _ = DRIVES[name]
    changes = []
    for step in (1e-3, 0.5e-3):
        simulation = Simulation(reference, step=step)
        simulation.reset(speed)
        states = record_run(simulation, programme, 7.5 if name == "reverse" else 3.0).state
        changes.append({s: np.abs(np.diff(states[s], axis=0)).max() for s in STATE.names})
    whole, half = changes
    share = {s: float(half[s] / whole[s]) for s in STATE.names}
    assert all(0.45 < value < 0.55 for value in share.values()), share  # seen 0.50 to 0.51


def test_at_standstill_on_the_flat_nothing_drifts(vehicle):
    simulation = Simulation(vehicle)
    simulation.reset(0.0)
    start = simulation.state.copy()
    simulation.step(Command(), 60.0)
    drift = {s: float(np.abs(simulation.state[s] - start[s]).max()) for s in STATE.names}
    assert max(drift.values()) < 1e-9, drift  # m, rad, ...; seen 4e-13


@pytest.mark.parametrize("model", MODELS)
def test_every_model_starts_stops_and_stays(unequal_axles, model):
    simulation = Simulation(unequal_axles, Options(model=model))
    simulation.reset(0.0)
    simulation.step(Command(wheel_torque=(200.0,) * 4), 3.0)
    assert simulation.state.u > 2.0
    brakes = Command(brake_torque=(500.0,) * 4)
    simulation.step(brakes, 8.0)
    x, y = simulation.state.x, simulation.state.y
    assert simulation.step(brakes, 20.0) is Condition.RUNNING
    assert np.isfinite(simulation.model_state).all()
    assert math.hypot(simulation.state.x - x, simulation.state.y - y) < 1e-4  # m
    assert abs(simulation.state.u) < 1e-9
    assert (simulation.state.wheel_speed == 0).all()


NO_LAG = {"PTX1": 0.0, "PTX2": 0.0, "PTY1": 0.0}
ODD = {
    "short lags": (NO_LAG, {}),
    "short lags, light wheels": (NO_LAG, {"wheel_inertia": 0.5}),
    "very light wheels": ({}, {"wheel_inertia": 0.1}),
    "short lags, heavy": (NO_LAG, {"sprung_mass": 3000.0}),
}
"""Coefficients of the tire and values of the vehicle for which the spring of a tire is stiff."""


@pytest.mark.parametrize("odd", ODD)
def test_a_vehicle_of_stiff_tires_or_light_wheels_calms_down_too(reference, odd):
    coefficients, values = ODD[odd]
    vehicle = with_tire(reference.with_values(values), **coefficients)
    simulation = Simulation(vehicle)
    simulation.reset(0.0)
    for torque in (50.0, -50.0, 0.0):
        simulation.step(Command(wheel_torque=(torque,) * 4), 0.5)
    simulation.step(Command(brake_torque=(300.0,) * 4), 20.0)
    assert np.abs(simulation.state.wheel_speed).max() == 0.0
    assert np.abs([simulation.state.u, simulation.state.v, simulation.state.w]).max() < 1e-6
    simulation.step(Command(), 10.0)
    assert np.abs(simulation.outputs.longitudinal_force).max() < 1.0  # N
