"""The integration is of fourth order and keeps tire compression consistent with the body."""

import numpy as np
import pytest
from programmes import SOURCE, j_turn, record_run

from vehicle_roll_sim import Options, Simulation
from vehicle_roll_sim.model.records import COMMAND

GRAVITY = 9.81
STEPS = (1e-3, 0.5e-3, 0.25e-3)
"""s"""
SAMPLES = 20
SAMPLE_INTERVAL = 0.05
"""s"""
SIGNALS = ("v", "w", "roll_rate", "pitch_rate", "yaw_rate", "unsprung_velocity", "wheel_speed")
"""Where the error is largest. The rest, its integrals, reach rounding at 0.25 ms."""
FOURTH_ORDER = 2**4
ORDER_TOLERANCE = 4
"""The next term of the error and, at 0.25 ms, rounding."""
GEOMETRIC = 1e-11
"""m. Seen: 1e-12 at 1 ms and 16 times less at half the step."""


def slalom(times: np.ndarray) -> np.ndarray:
    """2.5 degrees at 3 Hz: smooth, quick enough for errors above rounding, all wheels loaded."""
    commands = np.zeros(len(times), COMMAND)
    commands["steering"] = np.radians(2.5) * np.sin(2 * np.pi * 3.0 * times)
    commands["wheel_torque"] = 400.0 * np.sin(2 * np.pi * 2.0 * times)[:, None]
    return commands


def samples(vehicle, options: Options, step: float) -> dict[str, np.ndarray]:
    simulation = Simulation(vehicle, options, step=step)
    kept = []
    for _ in range(SAMPLES):
        simulation.step(slalom, SAMPLE_INTERVAL)
        kept.append(simulation.state.copy())
    assert np.isnan(simulation.events.lift_off_time).all(), "a lifted wheel is not smooth"
    return {name: np.array([state[name] for state in kept]) for name in SIGNALS}


@pytest.mark.parametrize("steady_state_slip", [False, True])
@pytest.mark.parametrize("no_roll_centre", [False, True])
def test_halving_the_step_divides_the_error_by_sixteen(vehicle, no_roll_centre, steady_state_slip):
    options = Options(
        no_roll_centre=no_roll_centre, euler_terms=True, steady_state_slip=steady_state_slip
    )
    coarse, middle, fine = (samples(vehicle, options, step) for step in STEPS)
    ratios = {}
    for name in SIGNALS:  # Richardson: differences of neighbours shrink as the errors do
        first = np.abs(coarse[name] - middle[name]).max()
        ratios[name] = float(first / np.abs(middle[name] - fine[name]).max())
    assert all(abs(r - FOURTH_ORDER) < ORDER_TOLERANCE for r in ratios.values()), ratios


def wheel_centre_height(vehicle, state: np.ndarray) -> np.ndarray:
    """Of every wheel (m), from the position of the body: third row of Ry(pitch) Rx(roll)."""
    x = np.array([1, 1, 0, 0]) * vehicle.cg_to_front_axle
    x = x - np.array([0, 0, 1, 1]) * vehicle.cg_to_rear_axle
    y = vehicle.per_wheel("track") / 2 * (1, -1, 1, -1)
    load = vehicle.sprung_mass * GRAVITY * vehicle.axle_load_share
    drop = state["suspension_compression"] - load / vehicle.per_wheel("spring_stiffness")
    ls = vehicle.static_strut_length - drop
    roll, pitch = state["roll"][:, None], state["pitch"][:, None]
    across = np.sin(roll) * y - np.cos(roll) * ls
    return state["z"][:, None] - np.sin(pitch) * x + np.cos(pitch) * across


@pytest.mark.parametrize("no_roll_centre", [False, True])
@pytest.mark.parametrize("step", STEPS[:2])
def test_the_tire_compression_stays_that_of_the_wheel_above_the_road(vehicle, step, no_roll_centre):
    """The invariant of equation 14, through the J-turn to rollover."""
    simulation = Simulation(vehicle, Options(no_roll_centre=no_roll_centre), step=step)
    state = record_run(simulation, j_turn(), 4.0).state
    assert state["tire_compression"].min() < -0.01, "no wheel is clear of the road"
    expected = vehicle.tire_radius - wheel_centre_height(vehicle, state)
    assert np.abs(state["tire_compression"] - expected).max() < GEOMETRIC


@pytest.mark.parametrize(("options", "until"), [(Options(), 2.75), (SOURCE, 2.9)])
def test_events_and_motion_are_those_of_a_much_finer_step(reference, options, until):
    """At 1 ms even lift-off, where a force has a corner, costs less than 1e-3 degrees.

    until: s, past two lift-offs, before the fall magnifies everything.
    """
    runs = []
    for step in (1e-3, 0.05e-3):
        simulation = Simulation(reference, options, step=step)
        simulation.step(j_turn(), until)
        runs.append(simulation)
    coarse, fine = runs
    assert np.degrees(coarse.state.roll - fine.state.roll) == pytest.approx(0.0, abs=1e-3)
    lifted = np.isfinite(fine.events.lift_off_time)
    assert lifted.sum() == 2
    np.testing.assert_allclose(
        coarse.events.lift_off_time[lifted], fine.events.lift_off_time[lifted], atol=1e-5
    )
