"""Transient slip: the lag of the tires behind the contact point."""

import dataclasses
import itertools
import math
from pathlib import Path

import magic_formula
import numpy as np
import pytest
from programmes import Evaluation, ramp_and_hold, record_run, with_tire
from random_states import random_command, random_state

from vehicle_roll_sim import Command, Options, Simulation, load_tire
from vehicle_roll_sim.model.records import COMMAND, WHEEL_COUNT

DATA = Path(__file__).parent / "data"
SPEED = 50 / 3.6
LIMP = {"LMUX": 0.0, "LMUY": 0.0}
"""A tire that gives no force: the vehicle goes on as it was, whatever its slip."""


def lengths(vehicle, fz) -> tuple[np.ndarray, np.ndarray]:
    """Relaxation lengths by Magic Formula 5.2, written out once more."""
    c = vehicle.tire.coefficients
    nominal = c["LFZO"] * c["FNOMIN"]
    dfz = fz / nominal - 1
    along = fz * (c["PTX1"] + c["PTX2"] * dfz) * np.exp(-c["PTX3"] * dfz)
    along = along * vehicle.tire_radius / c["FNOMIN"] * c["LSGKP"]
    across = c["PTY1"] * np.sin(2 * np.arctan2(fz, c["PTY2"] * nominal))
    across = across * vehicle.tire_radius * c["LFZO"] * c["LSGAL"]
    floor = vehicle.minimum_relaxation_length
    return np.maximum(along, floor), np.maximum(across, floor)


def simulated_lengths(vehicle, most: float) -> tuple[np.ndarray, np.ndarray]:
    """200 normal loads up to about `most` (N), and the relaxation lengths at them, shape (2, 200).

    They are those at which the model's rates are computed, of tires that are compressed so far.
    """
    evaluation, simulation = Evaluation(vehicle, Options()), Simulation(vehicle)
    state, command = simulation.state.copy(), np.zeros(1, COMMAND)[0]
    per_metre = simulation.outputs.normal_force[0] / state.tire_compression[0]
    loads, found = [], []
    for compression in np.linspace(1.0, most, 200).reshape(-1, WHEEL_COUNT) / per_metre:
        state.tire_compression = compression
        evaluation.rates(state, command)
        terms = evaluation.outputs.tire_terms
        loads.append(evaluation.outputs.normal_force.copy())
        found.append((terms.longitudinal_relaxation.copy(), terms.lateral_relaxation.copy()))
    return np.concatenate(loads), np.hstack(found)


SCALED = {"LFZO": 0.8, "LSGKP": 0.7, "LSGAL": 1.3}


@pytest.mark.parametrize("scaling", [{}, SCALED], ids=["file", "scaled"])
def test_relaxation_lengths_are_those_of_the_magic_formula_with_a_floor(vehicle, scaling):
    vehicle = with_tire(vehicle, **scaling)
    loads, seen = simulated_lengths(vehicle, 12_000.0)
    assert 0.0 < loads.min() < 50.0
    assert loads.max() > 10_000.0
    np.testing.assert_allclose(seen, lengths(vehicle, loads), rtol=1e-13)
    assert (seen[:, 0] == vehicle.minimum_relaxation_length).all()
    assert seen.max() > 0.3  # m


@pytest.mark.parametrize("name", ["mf61", "mf62"])
def test_files_of_version_6_give_relaxation_lengths_by_the_stiffness_of_the_carcass(vehicle, name):
    tire = load_tire(DATA / f"{name}.tir")
    c, dp = tire.coefficients, tire.record(1.1e5)["pressure_change"]
    vehicle = dataclasses.replace(vehicle, tire=tire).with_values({"tire_pressure": 1.1e5})
    load, seen = simulated_lengths(vehicle, 10_000.0)
    assert load.min() < 500.0
    assert load.max() > 8_000.0
    dfz = magic_formula.relative_load(c, load)
    along = 1 + c["PCFX1"] * dfz + c["PCFX2"] * dfz**2
    along *= c["LONGITUDINAL_STIFFNESS"] * (1 + c["PCFX3"] * dp)
    across = 1 + c["PCFY1"] * dfz + c["PCFY2"] * dfz**2
    across *= c["LATERAL_STIFFNESS"] * (1 + c["PCFY3"] * dp)
    p, _ = magic_formula.read(DATA / f"{name}.tir")
    expected = [
        magic_formula.longitudinal_stiffness(p, load, dp=dp) / along,
        -magic_formula.cornering_stiffness(p, load, dp=dp) / across,
    ]
    floor = vehicle.minimum_relaxation_length
    np.testing.assert_allclose(seen, np.maximum(expected, floor), rtol=1e-12)
    assert 0.2 < seen[1].max() < 1.0  # m


def test_slips_follow_the_contact_point_over_the_relaxation_length(vehicle):
    """At any state above 1 m/s of rolling: the equation without its terms for standstill."""
    evaluation, rng = Evaluation(vehicle, Options()), np.random.default_rng(5)
    for _ in range(100):
        state, command = random_state(vehicle, rng), random_command(rng)
        state["longitudinal_slip"], state["lateral_slip"] = rng.uniform(-0.5, 0.5, (2, 4))
        rates = evaluation.rates(state, command)
        out = evaluation.outputs
        s, c = np.sin(out.steering), np.cos(out.steering)
        rolling, sliding = (
            out.contact_u * c + out.contact_v * s,
            out.contact_v * c - out.contact_u * s,
        )
        spinning = out.loaded_radius * state["wheel_speed"] - rolling
        along, across = lengths(vehicle, np.maximum(out.normal_force, 1.0))
        checked = (np.abs(rolling) > 1.0) & (out.normal_force > 0)
        for name, source, length in (
            ("longitudinal_slip", spinning, along),
            ("lateral_slip", sliding, across),
        ):
            expected = (source - np.abs(rolling) * state[name]) / length
            np.testing.assert_allclose(
                rates[name][checked], expected[checked], rtol=1e-11, atol=1e-9
            )
        np.testing.assert_array_equal(out.slip_ratio[checked], state["longitudinal_slip"][checked])
        np.testing.assert_allclose(np.tan(out.slip_angle), state["lateral_slip"], rtol=1e-9)


def test_after_a_step_of_steering_the_lateral_slip_builds_up_exponentially(vehicle):
    """-tan(delta) (1 - exp(-V t / sigma)), on tires without force, so that V stays."""
    vehicle = with_tire(vehicle, **LIMP)
    simulation, angle = Simulation(vehicle), 0.05
    run = record_run(simulation, Command(steering=angle), 0.2)
    _, sigma = lengths(vehicle, run.outputs[0].normal_force)
    rolling = SPEED * math.cos(angle)
    grown = 1 - np.exp(-rolling * run.time[:, None] / sigma)
    seen = run.state["lateral_slip"]
    np.testing.assert_allclose(seen[:, :2], -math.tan(angle) * grown[:, :2], atol=1e-9)  # RK4
    assert np.abs(seen[:, 2:]).max() < 1e-12
    assert np.abs(run.state["u"] - SPEED).max() < 1e-9


def test_while_a_wheel_gathers_spin_its_longitudinal_slip_lags_behind_by_the_relaxation_length(
    vehicle,
):
    vehicle = with_tire(vehicle, **LIMP)
    torque = 20.0  # N m
    run = record_run(Simulation(vehicle), Command(wheel_torque=(torque,) * 4), 0.2)
    sigma, _ = lengths(vehicle, run.outputs[0].normal_force)
    lag = sigma / SPEED
    slope = run.outputs[0].loaded_radius * torque / vehicle.wheel_inertia / SPEED
    time = run.time[:, None]
    expected = slope * (time - lag * (1 - np.exp(-time / lag)))
    np.testing.assert_allclose(run.state["longitudinal_slip"], expected, atol=1e-8)


def test_slips_decay_without_load(vehicle):
    simulation = Simulation(vehicle)
    simulation.state.z += 5.0
    simulation.state.tire_compression -= 5.0
    simulation.state.longitudinal_slip, simulation.state.lateral_slip = 0.3, -0.2
    simulation.step(Command(), 0.2)
    assert (simulation.outputs.normal_force == 0).all()
    expected = math.exp(-0.2 / 0.02)  # over the release time
    np.testing.assert_allclose(simulation.state.longitudinal_slip, 0.3 * expected, rtol=1e-5)
    np.testing.assert_allclose(simulation.state.lateral_slip, -0.2 * expected, rtol=1e-5)


STEERED = ramp_and_hold(0.5, 40.0, 3.0, speed_hold_gain=500.0, speed_hold_target=SPEED)


def peak_and_end(vehicle, **options) -> tuple[float, Simulation]:
    simulation = Simulation(vehicle, Options(**options))
    simulation.step(STEERED, 12.0)
    return float(simulation.events.peak_roll[0]), simulation


STEADY = 1e-8
"""Relative: what is left of the transient 11 s after the steering; seen 6e-11."""


def test_steady_cornering_is_that_of_steady_state_slip(vehicle):
    (_, lagging), (_, steady) = peak_and_end(vehicle), peak_and_end(vehicle, steady_state_slip=True)
    assert lagging.state.roll == pytest.approx(steady.state.roll, rel=STEADY)
    np.testing.assert_allclose(
        lagging.outputs.normal_force, steady.outputs.normal_force, rtol=STEADY
    )
    assert lagging.state.yaw_rate == pytest.approx(steady.state.yaw_rate, rel=STEADY)


def test_the_shorter_the_relaxation_lengths_the_nearer_to_steady_state_slip(vehicle):
    goal, _ = peak_and_end(vehicle, steady_state_slip=True)
    gaps = []
    for scale in (1.0, 0.5, 0.25, 0.125):
        short = with_tire(vehicle, LSGKP=scale, LSGAL=scale)
        floor = vehicle.minimum_relaxation_length * scale
        gaps.append(
            peak_and_end(dataclasses.replace(short, minimum_relaxation_length=floor))[0] - goal
        )
    # to first order in the length: seen 2.0 to 2.2 per halving
    assert all(1.9 < a / b < 2.25 for a, b in itertools.pairwise(gaps)), gaps
    assert 0 < gaps[0] < 0.12 * goal  # tires that lag damp the roll less; seen 4.5 % and 9.7 %
