"""Properties of the rates for any vehicle, model, option, state and command."""

import dataclasses

import magic_formula
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mechanics import along, energy, external, momenta, powers, slope
from programmes import Evaluation
from random_states import random_command, random_state
from random_vehicles import (
    NUMBERS,
    OPTIONS,
    ROADS,
    WITH_ONE_SOLUTION,
    every_option,
    ordinary_vehicles,
    tires,
)
from test_mirror import OTHER_SIDE, REVERSED_SIGNALS, REVERSED_STATES, SIGNALS
from test_momentum import close

from vehicle_roll_sim import Options
from vehicle_roll_sim.model.records import STATE, WHEEL_COUNT
from vehicle_roll_sim.simulation.road import Road

pytestmark = [pytest.mark.slow, pytest.mark.unmeasured]

OF_MODEL_1 = st.sampled_from(
    [o for o in every_option() if o.model == "1" and not o.tire_normal_to_ground]
)
"""Whose tires touch the road at one point, so that forces, motion and power belong together."""
MULTIBODY = st.sampled_from([o for o in every_option() if o.model == "1" and o.euler_terms])
ROUNDING = 1e-12
"""Of the largest term: a 6 x 6 solution and some hundred operations, seen 2e-15."""
AGREEMENT = 1e-9
"""The 8 DOF model's loads and accelerations agree to 1e-12, and stiff tires multiply that."""
ELLIPSE = 1.007
"""Largest (Fx/Dx)^2 + (Fy/Dy)^2 of the reference tire on a fine grid of slips and of loads in its
range: 1.0066. Nothing in the formula makes it 1, the weights of combined slip are curves of their
own; far beyond the range, where lateral friction is used up before the other, it gets to 1.03."""
REVERSED = {*REVERSED_STATES, "steering", "rear_steering"}


def instant(vehicle, options, rng, road=None):
    """A random state and command, the rates and outputs there; brakes and drive at all wheels."""
    evaluation = Evaluation(vehicle, options, road or Road())
    state, command = random_state(vehicle, rng), random_command(rng)
    command["brake_torque"] = rng.uniform(0.0, 3000.0, WHEEL_COUNT)
    return evaluation, state, command, rates_of(evaluation, state, command)


def rates_of(evaluation, state, command):
    evaluation.outputs["turning"] = np.sign(state["wheel_speed"])
    return evaluation.rates(state, command)


@given(ordinary_vehicles(), OF_MODEL_1, ROADS, NUMBERS)
def test_energy_changes_by_named_powers_and_nothing_else(vehicle, options, road, rng):
    """With a roll centre too, and without the Euler terms, which do no work."""
    evaluation, state, command, rates = instant(vehicle, options, rng, road)
    gained = slope(energy(vehicle, road, along(state, rates)))
    named = powers(vehicle, state, evaluation.outputs, command)
    largest = max(map(abs, named.values()))
    weights = abs(slope(energy(vehicle, Road(), along(state, rates))) - gained)  # of a slope
    assert abs(gained - sum(named.values())) < ROUNDING * (largest + weights)
    assert max(named["dampers"], named["brakes"], named["drag"]) <= 0.0


@given(ordinary_vehicles(sides=("",)), NUMBERS)
def test_sliding_of_a_tire_without_lag_or_shifts_only_takes_energy(vehicle, rng):
    """At any slip, though combined slip can turn one of the two forces round."""
    evaluation, state, command, _ = instant(vehicle, Options(steady_state_slip=True), rng)
    assert powers(vehicle, state, evaluation.outputs, command)["slip"] <= 0.0


@given(ordinary_vehicles(), MULTIBODY, NUMBERS)
def test_tires_weights_and_drag_are_all_that_changes_the_momenta(vehicle, options, rng):
    evaluation, state, _, rates = instant(vehicle, options, rng)
    linear, angular = momenta(vehicle, along(state, rates))
    forces, points = external(vehicle, state, evaluation.outputs)
    assert close(slope(linear), forces)
    if not options.tire_normal_to_ground:  # whose tilted wheels turn with the axle by eq. 76
        assert close(slope(angular), np.cross(points, forces))


@given(ordinary_vehicles(), OPTIONS, NUMBERS)
def test_loads_are_never_negative_and_zero_exactly_off_the_ground(vehicle, options, rng):
    evaluation, *_ = instant(vehicle, options, rng)
    loads, support = evaluation.outputs["normal_force"], evaluation.outputs["support"]
    assert (loads >= 0.0).all()
    assert ((loads == 0.0) == (support <= 0.0)).all()
    assert (loads[support > 0.0] == support[support > 0.0]).all()
    lifted = loads == 0.0
    for name in ("tire_longitudinal", "tire_lateral", "longitudinal_force", "lateral_force"):
        assert (evaluation.outputs[name][lifted] == 0.0).all()


@given(ordinary_vehicles(), OPTIONS, tires(), NUMBERS)
def test_no_tire_force_is_beyond_its_own_peak(vehicle, options, tire, rng):
    """Exact: a sine is within 1, and so is a weight, which is a cosine where it has no shift.

    What is not multiplied by them comes on top: vertical shifts and slip-induced ply-steer.
    """
    evaluation, *_ = instant(dataclasses.replace(vehicle, tire=tire), options, rng)
    load, p = evaluation.outputs["normal_force"], tire.coefficients
    dfz = magic_formula.relative_load(p, load)
    ahead = np.abs(magic_formula.longitudinal_peak(p, load))
    ahead += np.abs(load * (p["PVX1"] + p["PVX2"] * dfz)) * p["LMUX"]
    across = np.abs(magic_formula.lateral_peak(p, load)) * (1 + np.abs(p["RVY1"] + p["RVY2"] * dfz))
    across += np.abs(load * (p["PVY1"] + p["PVY2"] * dfz)) * p["LMUY"]
    slack = ROUNDING * load
    assert (np.abs(evaluation.outputs["tire_longitudinal"]) <= ahead + slack).all()
    assert (np.abs(evaluation.outputs["tire_lateral"]) <= across + slack).all()


@given(ordinary_vehicles(sides=("",)), OPTIONS, NUMBERS)
def test_the_reference_tire_stays_within_its_friction_ellipse(vehicle, options, rng):
    evaluation, *_ = instant(vehicle, options, rng)
    out, p = evaluation.outputs, vehicle.tire.coefficients
    load = out["normal_force"]
    ahead, across = magic_formula.longitudinal_peak(p, load), magic_formula.lateral_peak(p, load)
    grips = (load > 0.0) & (load <= p["FZMAX"])
    used = (out["tire_longitudinal"][grips] / ahead[grips]) ** 2
    used += (out["tire_lateral"][grips] / across[grips]) ** 2
    assert (used <= ELLIPSE).all()


@given(ordinary_vehicles(), WITH_ONE_SOLUTION, ROADS, NUMBERS)
def test_a_mirrored_state_and_command_have_the_mirrored_rates_and_outputs(
    vehicle, options, road, rng
):
    evaluation, state, command, rates = instant(vehicle, options, rng, road)
    other = Evaluation(vehicle, options, Road(road.grade, -road.bank))
    back = reflected(rates_of(other, reflected(state), reflected(command)))
    largest = max(np.abs(rates[name]).max() for name in STATE.names)
    for name in STATE.names:
        assert np.abs(rates[name] - back[name]).max() <= AGREEMENT * largest, name
    for name in (*SIGNALS, *REVERSED_SIGNALS[:-1]):
        here, there = evaluation.outputs[name], other.outputs[name][OTHER_SIDE]
        there = -there if name in REVERSED_SIGNALS else there
        assert np.abs(here - there).max() <= AGREEMENT * np.abs(here).max(), name


def reflected(record):
    """A STATE or COMMAND record of the vehicle seen in a mirror along its length."""
    result = record.copy()
    for name in record.dtype.names:
        values = record[name][OTHER_SIDE] if record[name].shape == (4,) else record[name]
        result[name] = -values if name in REVERSED else values
    return result
