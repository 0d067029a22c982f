"""Springs, dampers and stops with any characteristic: forces, energy and rest in closed form."""

import numpy as np
import pytest
from mechanics import along, energy, powers, slope
from programmes import Evaluation
from random_states import random_command, random_state

from vehicle_roll_sim import Command, Options, Simulation
from vehicle_roll_sim.simulation.road import Road

ALONG = np.linspace(-0.18, 0.4, 12)
STIFFNESS, RISE = np.array([2.4e4, 2.0e4]), np.array([6e4, 5e4])
"""N/m and N/m^2: the spring force of each axle is STIFFNESS x + RISE x^2."""
BUMP, REBOUND = np.array([2500.0, 2000.0]), np.array([4100.0, 2000.0])
"""N s/m"""
CLEARANCE = {"bump": 0.04, "rebound": 0.06}
FIRM, RISING = 8e4, 3e6
"""N/m and N/m^2, of the stops of the front wheels."""
EXACT = Options(no_roll_centre=True, euler_terms=True)
STATES = 20
PAIRS = np.repeat([0, 1], 2)
"""The axle of each wheel."""


def spring_tables() -> dict:
    return {
        f"{axle}_spring_force": tuple((float(x), float(k * x + c * x**2)) for x in ALONG)
        for axle, k, c in zip(("front", "rear"), STIFFNESS, RISE, strict=True)
    }


DETAILS = {
    **spring_tables(),
    "front_damping": BUMP[0],
    "front_rebound_damping": REBOUND[0],
    "rear_damper_force": ((-2.0, -4000.0), (0.0, 0.0), (1.0, 2000.0), (2.0, 4000.0)),
    **{f"front_{side}_stop_clearance": room for side, room in CLEARANCE.items()},
    **{f"front_{side}_stop_stiffness": FIRM for side in CLEARANCE},
    **{f"front_{side}_stop_progression": RISING for side in CLEARANCE},
}


@pytest.fixture(scope="module")
def detailed(unequal_axles):
    return unequal_axles.with_values(DETAILS)


def at_rest(vehicle) -> np.ndarray:
    """Compressions that carry the vehicle, from the quadratic equation."""
    load = vehicle.sprung_mass * 9.81 * vehicle.axle_load_share
    k, c = STIFFNESS[PAIRS], RISE[PAIRS]
    return (np.sqrt(k**2 + 4 * c * load) - k) / (2 * c)


def in_stops(vehicle, compression) -> tuple[np.ndarray, np.ndarray]:
    """Compressions of bump and rebound stops, infinitely far away at the rear (m)."""
    travel, room = compression - at_rest(vehicle), np.array([0.0, 0.0, np.inf, np.inf])
    pairs = ((travel, "bump"), (-travel, "rebound"))
    return tuple(np.maximum(q - (CLEARANCE[side] + room), 0.0) for q, side in pairs)


def forces(vehicle, compression, rate) -> tuple[np.ndarray, np.ndarray]:
    """Of what stores energy, and of the dampers (N)."""
    bump, rebound = in_stops(vehicle, compression)
    springs = STIFFNESS[PAIRS] * compression + RISE[PAIRS] * compression**2
    stops = FIRM * bump + RISING * bump**2 / 2 - FIRM * rebound - RISING * rebound**2 / 2
    return springs + stops, np.where(rate > 0.0, BUMP[PAIRS], REBOUND[PAIRS]) * rate


def stored(vehicle, compression):
    """Energy in springs and stops (J); compression may be complex."""
    real = np.real(compression)
    ends = [np.where(d > 0.0, 1.0, 0.0) for d in in_stops(vehicle, real)]
    travel = compression - at_rest(vehicle)
    bump, rebound = travel - CLEARANCE["bump"], -travel - CLEARANCE["rebound"]
    total = STIFFNESS[PAIRS] * compression**2 / 2 + RISE[PAIRS] * compression**3 / 3
    for on, d in zip(ends, (bump, rebound), strict=True):
        total = total + on * (FIRM * d**2 / 2 + RISING * d**3 / 6)
    return total.sum()


def cases(vehicle, options: Options):
    evaluation, rng = Evaluation(vehicle, options), np.random.default_rng(5)
    for _ in range(STATES):
        state, command = random_state(vehicle, rng), random_command(rng)
        yield state, command, evaluation.rates(state, command), evaluation.outputs


@pytest.mark.parametrize("model", ["1", "1b", "2"])
def test_every_force_of_a_strut_is_that_of_its_closed_form(detailed, model):
    np.testing.assert_allclose(detailed.static_suspension_compression, at_rest(detailed), 1e-12)
    touched = np.zeros(2)
    for state, command, _, outputs in cases(detailed, Options(model=model)):
        x, rate = state["suspension_compression"], outputs["suspension_rate"]
        expected = sum(forces(detailed, x, rate)) + command["normal_force"]
        np.testing.assert_allclose(outputs["strut_force"], expected, rtol=1e-10, atol=1e-6)
        touched += [(part > 0.0).sum() for part in in_stops(detailed, x)]
    assert (touched > 0).all()


def test_energy_is_stored_in_springs_and_stops_and_lost_in_dampers(detailed):
    """Model 1 in its exact form; beyond the struts, the named powers are those of any vehicle."""

    def total(state):
        linear = detailed.per_wheel("spring_stiffness") @ state["suspension_compression"] ** 2 / 2
        whole = energy(detailed, Road(), state)
        return whole - linear + stored(detailed, state["suspension_compression"])

    for state, command, rates, outputs in cases(detailed, EXACT):
        gained = slope(total(along(state, rates)))
        named, struts = powers(detailed, state, outputs, command), outputs["suspension_rate"]
        named["dampers"] = -forces(detailed, state["suspension_compression"], struts)[1] @ struts
        assert named["dampers"] < 0.0
        scale = max(map(abs, named.values()))
        assert abs(gained - sum(named.values())) < 1e-11 * scale


@pytest.mark.parametrize("model", ["1", "2"])
def test_a_vehicle_on_such_springs_stands_still(detailed, model):
    simulation = Simulation(detailed, Options(model=model))
    simulation.reset(0.0)
    before = simulation.state.copy()
    simulation.step(Command(), 2.0)
    for name in ("z", "roll", "pitch", "suspension_compression", "tire_compression"):
        assert np.abs(simulation.state[name] - before[name]).max() < 1e-9, name


def test_a_straight_table_and_equal_coefficients_are_a_plain_vehicle(reference):
    """To rounding; the plain vehicle does not compute them as tables."""
    straight = reference.with_values(
        {
            "front_spring_force": ((0.0, 0.0), (0.1, 3500.0), (0.3, 10500.0)),
            "rear_damper_force": ((-1.0, -2000.0), (0.0, 0.0), (1.0, 2000.0)),
            "front_rebound_damping": 2500.0,
        }
    )
    runs = [Simulation(vehicle) for vehicle in (reference, straight)]
    for simulation in runs:
        simulation.step(Command(steering=0.1), 1.0)
    np.testing.assert_allclose(runs[0].model_state, runs[1].model_state, rtol=1e-9, atol=1e-12)
