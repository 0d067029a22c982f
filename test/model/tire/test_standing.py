"""The slip that a standing tire holds, and what it is for: a parked vehicle stays where it is."""

import math

import magic_formula
import numpy as np
import pytest
from entries import entry
from programmes import Evaluation, with_tire

from vehicle_roll_sim import Command, Options, Simulation
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.model.tire import standing
from vehicle_roll_sim.simulation.road import Road

BRAKED = Command(brake_torque=(1e5,) * 4)
SETTLED, LATER = 10.0, 30.0
"""s"""
CREEP = 1e-4
"""m in the time between, of what was 1.5 and 14 m."""


@pytest.mark.parametrize("shape", [1.05, 1.2, 1.7, 2.5])
@pytest.mark.parametrize("curvature", [-3.0, -0.5, 0.0, 0.6, 0.95])
def test_it_is_where_the_curve_has_its_peak(shape, curvature):
    slip_at_peak = entry(standing.slip_at_peak)
    slip = np.linspace(0.0, 1.0, 20_001)
    b = 12.0
    bend = b * slip - curvature * (b * slip - np.arctan(b * slip))
    curve = np.sin(shape * np.arctan(bend))
    found = slip_at_peak(b, shape, curvature)
    if curve.argmax() == len(slip) - 1:
        assert found > 0.9
    else:
        assert found == pytest.approx(slip[curve.argmax()], abs=1e-3)


def test_without_a_peak_it_has_a_limit():
    slip_at_peak = entry(standing.slip_at_peak)
    for parts in ((0.0, 1.5, 0.0), (10.0, 1.0, 0.0), (10.0, 0.5, 0.3), (10.0, 1.1, 1.0)):
        assert slip_at_peak(*parts) == standing.LARGEST_HELD


def held_slips(vehicle, slip: float) -> tuple[float, float, float]:
    """Normal load and slips that a standing tire holds where both slips are `slip`, the lateral
    one the other way; of the wheel to whose side the tire belongs."""
    simulation = Simulation(vehicle)
    evaluation, state = Evaluation(vehicle, Options()), simulation.state.copy()
    state.u, state.wheel_speed = 0.0, 0.0
    state.longitudinal_slip, state.lateral_slip = slip, -slip
    evaluation.rates(state, np.zeros(1, COMMAND)[0])
    wheel = {"left": 0, "right": 1}[vehicle.tire.side]
    terms, load = evaluation.outputs.tire_terms, evaluation.outputs.normal_force[wheel]
    beyond = terms.longitudinal_release[wheel], terms.lateral_release[wheel]  # all of it, at 0 m/s
    return load, slip - beyond[0], -slip - beyond[1]


def test_what_a_tire_holds_gives_its_friction(reference):
    load, kappa, tangent = held_slips(reference, 0.5)
    p = reference.tire.coefficients
    assert magic_formula.pure_longitudinal(p, kappa, load) == pytest.approx(
        magic_formula.longitudinal_peak(p, load), rel=1e-9
    )
    force = magic_formula.pure_lateral(p, np.arctan(tangent), load)
    assert abs(force) == pytest.approx(abs(magic_formula.lateral_peak(p, load)), rel=1e-9)
    assert held_slips(reference, 0.01)[1:] == pytest.approx((0.01, -0.01))


def moved(vehicle, road) -> float:
    """How far a vehicle creeps from SETTLED to LATER with its wheels braked (m)."""
    simulation = Simulation(vehicle, Options(), road=road)
    simulation.reset(0.0)
    simulation.step(BRAKED, SETTLED)
    x, y = float(simulation.state.x), float(simulation.state.y)
    simulation.step(BRAKED, LATER - SETTLED)
    return math.hypot(float(simulation.state.x) - x, float(simulation.state.y) - y)


def test_a_parked_vehicle_does_not_creep_on_a_grade_below_its_grip(reference):
    assert moved(reference, Road(grade=1.0)) < CREEP


def test_a_parked_vehicle_on_soft_tires_does_not_creep_on_a_bank(reference):
    assert moved(with_tire(reference, LKY=0.5), Road(bank=0.5)) < CREEP


def test_beyond_its_grip_a_parked_vehicle_slides(reference):
    slippery = with_tire(reference, LMUX=0.5, LMUY=0.5)
    assert moved(slippery, Road(grade=1.0)) > 10.0
