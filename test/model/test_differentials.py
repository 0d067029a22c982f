"""Differentials: torques cancel, speeds equalize at a known rate, power is only taken."""

import numpy as np
import pytest

from vehicle_roll_sim import Command, InputError, Simulation, preset
from vehicle_roll_sim.model.records import WHEEL_SPEED

DAMPING = 400.0
"""N m s/rad"""
TORQUE = 300.0
"""N m, at the left rear wheel alone."""


def spins_after(damping: float | None, seconds: float, spread: float = 0.0) -> np.ndarray:
    """Wheel speeds (4,) (rad/s), with a torque on one rear wheel and a difference at the start."""
    given = {} if damping is None else {"rear_differential_damping": damping}
    vehicle = preset().with_values(given)
    simulation = Simulation(vehicle)
    simulation.reset(20.0)
    state = simulation.state_vector.copy()
    state[WHEEL_SPEED][2:] += (spread / 2, -spread / 2)
    simulation.state_vector[:] = state
    torque = (0.0, 0.0, 0.0 if spread else TORQUE, 0.0)
    simulation.step(Command(wheel_torque=torque), seconds)
    return simulation.state_vector[WHEEL_SPEED].copy()


def test_an_open_differential_is_no_term_at_all():
    assert np.array_equal(spins_after(0.0, 0.2), spins_after(None, 0.2))


def test_the_difference_decays_at_the_rate_of_the_coupling():
    """Within a few ms the tires have not built up forces yet: d = d0 exp(-2 c t / Jw)."""
    seconds, spread, damping = 0.005, 2.0, 100.0
    open_one, coupled = (spins_after(c, seconds, spread) for c in (0.0, damping))
    left = (coupled[2] - coupled[3]) / (open_one[2] - open_one[3])
    assert left == pytest.approx(np.exp(-2 * damping * seconds), rel=0.05)
    assert coupled[2:].sum() == pytest.approx(open_one[2:].sum(), abs=0.01)  # equal and opposite


def test_a_stiff_coupling_is_a_locked_differential():
    open_one, locked = spins_after(0.0, 0.5), spins_after(DAMPING, 0.5)
    assert open_one[2] - open_one[3] > 0.5
    assert 0.0 < locked[2] - locked[3] < TORQUE / (2 * DAMPING) * 1.05


def test_a_coupling_too_stiff_for_the_step_is_refused_with_the_largest_step():
    with pytest.raises(InputError) as refusal:
        spins_after(3000.0, 0.1)
    assert "step" in str(refusal.value)
    assert "at most" in str(refusal.value)
