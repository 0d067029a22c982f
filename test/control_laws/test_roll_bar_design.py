"""The regulator of the roll bars: its Riccati equation, its poles, and what it saves."""

import dataclasses

import numpy as np
import pytest
from driven import REFERENCE, driven, filled_in
from scipy import linalg

from vehicle_roll_sim import Command, InputError, Options, Simulation
from vehicle_roll_sim.control_laws.lqr_roll_bar import FED_BACK
from vehicle_roll_sim.control_laws.roll_bar_design import (
    RollBarCriteria,
    bar_column,
    design,
)
from vehicle_roll_sim.runs.control_law import Controlled
from vehicle_roll_sim.runs.run import run

ROUNDING = 1e-9
"""Relative: what is left of double precision after a Riccati equation with 14 states."""


@pytest.fixture(scope="module")
def designed():
    return design(REFERENCE)


def closed_loop(designed, gain) -> np.ndarray:
    """A - B K of the lateral motion, with gains on its first states."""
    whole = np.append(gain, np.zeros(len(designed.b) - len(gain)))
    return designed.a - np.outer(designed.b, whole)


def cost_of(designed, gain) -> np.ndarray:
    """X: x' X x is the cost from the state x on, with any stabilizing gains (Lyapunov)."""
    whole = np.append(gain, np.zeros(len(designed.b) - len(gain)))
    weights = designed.weights + designed.weight * np.outer(whole, whole)
    return linalg.solve_continuous_lyapunov(closed_loop(designed, gain).T, -weights)


def test_the_trim_is_straight_driving_at_the_speed(designed):
    trim = dict(zip(designed.model.state_names, designed.model.trim_state, strict=True))
    assert trim["u"] == RollBarCriteria().speed
    assert all(abs(trim[name]) < ROUNDING for name in FED_BACK)


def test_what_is_computed_is_the_cost_of_the_optimal_gains(designed):
    found = cost_of(designed, designed.optimal_gain)
    assert np.allclose(found, designed.cost, rtol=0.0, atol=ROUNDING * np.abs(found).max())


def test_the_optimal_poles_are_the_stable_half_of_the_hamiltonian(designed):
    a, b = designed.a, designed.b
    coupling = np.outer(b, b) / designed.weight
    poles = linalg.eigvals(np.block([[a, -coupling], [-designed.weights, -a.T]]))
    stable = np.sort_complex(poles[poles.real < 0.0])
    found = np.sort_complex(linalg.eigvals(closed_loop(designed, designed.optimal_gain)))
    assert np.allclose(found, stable, rtol=1e-6)  # the Hamiltonian is badly conditioned


def test_the_optimal_loop_never_comes_closer_to_minus_one_than_one(designed):
    """Kalman's inequality: |1 + K (jw - A)^-1 B| >= 1 at every frequency."""
    for frequency in np.geomspace(0.01, 1000.0, 60):
        lag = 1j * frequency * np.eye(len(designed.a)) - designed.a
        loop = designed.optimal_gain @ np.linalg.solve(lag, designed.b)
        assert abs(1.0 + loop) >= 1.0 - ROUNDING, frequency


def test_four_gains_cost_little_more_than_all_of_them(designed):
    """At most 3 % from a roll angle or a roll rate, and 12 % from any motion of the body."""
    found, least = cost_of(designed, designed.gain), designed.cost
    for name in ("roll", "roll_rate"):
        place = FED_BACK.index(name)
        assert 1.0 <= found[place, place] / least[place, place] <= 1.03
    body = slice(len(FED_BACK))
    assert linalg.eigh(found[body, body], least[body, body])[0].max() <= 1.12


def test_the_poles_of_the_whole_model_are_stable_and_only_lateral_ones_move(designed):
    model, gain = designed.model, np.zeros(len(designed.model.state_names))
    gain[[model.state_names.index(name) for name in FED_BACK]] = designed.gain
    bars = bar_column(model, designed.law.front_share, (1.5, 1.5))
    whole = linalg.eigvals(model.a - np.outer(bars, gain))
    neutral = np.abs(whole) < 1e-6  # the speed, which nothing brings back
    assert neutral.sum() == 1
    assert whole[~neutral].real.max() < 0.0
    others = [pole for pole in linalg.eigvals(model.a) if distance(pole, designed.poles_without)]
    expected = np.concatenate((designed.poles, others))
    assert len(expected) == len(whole)
    assert not any(distance(pole, whole) for pole in expected)


def distance(pole: complex, poles: np.ndarray) -> float:
    """Of a pole to the nearest one (1/s), 0 within rounding."""
    nearest = np.abs(poles - pole).min()
    return nearest if nearest > 1e-6 * max(1.0, abs(pole)) else 0.0


def test_the_roll_mode_is_well_damped(designed):
    """The slowest oscillation: from a damping of 0.38 without the bars to at least 0.9."""
    damping = [
        -pole.real / abs(pole)
        for pole in (slowest_pair(designed.poles_without), slowest_pair(designed.poles))
    ]
    assert damping[0] == pytest.approx(0.377, abs=0.005)
    assert damping[1] > 0.9


def slowest_pair(poles: np.ndarray) -> complex:
    return min((pole for pole in poles if pole.imag > 0.0), key=abs)


def test_in_the_nonlinear_vehicle_a_small_disturbance_costs_what_the_linear_model_says(designed):
    """1 % covers commands that are held for 1 ms and a roll rate of 0.02 rad/s, not nought."""
    simulation, start = Simulation(REFERENCE), 0.02
    simulation.reset(RollBarCriteria().speed)
    simulation.state["roll_rate"] = start
    driver = Controlled(simulation, lambda times: Command().records(), designed.law)
    history = run(simulation, driver, 2.0, sample=0.001, command_period=0.001)
    lf, _, lr, _ = history.command("active_force").T
    moment = -1.5 * (lf + lr)
    criteria = RollBarCriteria()
    scaled = (
        history["roll"] / criteria.roll_scale,
        history["roll_rate"] / criteria.roll_rate_scale,
        moment / criteria.moment_scale,
    )
    cost = linalg.norm(scaled) ** 2 * 0.001
    place = FED_BACK.index("roll_rate")
    assert cost == pytest.approx(
        cost_of(designed, designed.gain)[place, place] * start**2, rel=0.01
    )


def test_the_cheaper_the_moment_the_less_the_body_rolls(designed):
    """In a turn in which no wheel lifts."""
    manoeuvre = filled_in("step_steer", duration=2.5, amplitude=2.0)
    peaks = [np.abs(driven(manoeuvre)["roll"]).max()]
    for scale in (3000.0, 9000.0):
        law = design(REFERENCE, criteria=RollBarCriteria(moment_scale=scale)).law
        peaks.append(np.abs(driven(manoeuvre, law)["roll"]).max())
    assert peaks[0] > 1.2 * peaks[1] > 1.2 * 1.2 * peaks[2]


@pytest.mark.parametrize(
    ("change", "options", "problem"),
    [
        ({}, Options(model="8dof"), "model: '8dof'.* 14 degrees"),
        ({"cg_offset": 0.05}, Options(), "vehicle: its lateral motion also"),
    ],
)
def test_what_it_cannot_be_designed_for_is_refused(change, options, problem):
    vehicle = dataclasses.replace(REFERENCE, **change)
    with pytest.raises(InputError, match=problem):
        design(vehicle, options)


@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), "much"])
def test_a_criterion_out_of_range_is_refused(value):
    with pytest.raises(InputError, match="roll_scale"):
        RollBarCriteria(roll_scale=value)
