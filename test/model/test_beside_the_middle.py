"""Vehicles with their c.g. beside the middle, and products of inertia, in the 14 DOF models."""

import numpy as np
import pytest
from mechanics import along, energy, external, momenta, powers, slope
from programmes import Evaluation
from random_states import mirrored, random_command, random_state
from test_momentum import close

from vehicle_roll_sim import Command, Options, Simulation, preset
from vehicle_roll_sim.model.records import COMMAND, STATE, WHEEL_COUNT
from vehicle_roll_sim.model.variants import MODELS
from vehicle_roll_sim.simulation.road import Road

OFFSET = 0.08
"""m, to the left"""
PRODUCTS = {"roll_pitch_product": 40.0, "roll_yaw_product": -60.0, "pitch_yaw_product": 25.0}
UNEVEN = {"cg_offset": OFFSET, "front_track": 1.46, "rear_unsprung_mass": 90.0, **PRODUCTS}
DETAILS = {
    "front_anti_roll_bar_rate": 9000.0,
    "rear_anti_roll_bar_rate": 4000.0,
    "front_roll_steer": 0.1,
    "front_bump_stop_clearance": 0.05,
    "front_bump_stop_stiffness": 1e5,
}
LINKS = {
    "roll centre": {},
    "each side's own link load transfer": {"link_load_transfer": "asymmetric"},
    "no roll centre": {"no_roll_centre": True},
}
FOURTEEN_DOF = [name for name, flags in MODELS.items() if "eight_dof" not in flags]
STATES = 20
NAMES = Options().states
ROUNDING = 1e-12
"""Relative: a 6 x 6 solution and some hundred operations."""
DRIFT = 1e-9
"""m, rad, m/s, rad/s: rounding of 5,000 steps, far below anything physical."""
LIGHTEST = 0.01
"""kg: of an unsprung mass that hardly counts."""
LEFT_OF_IT = 5 * LIGHTEST / 1440.0
"""Relative: its share of the sprung mass, times leverage. Seen 2.7 of it, also with
twice the mass."""


def uneven(**changes):
    return preset().with_values(UNEVEN | changes)


def in_model_1(vehicle, links: dict) -> Evaluation:
    return Evaluation(vehicle, Options(euler_terms=True, **links))


@pytest.mark.parametrize("details", [{}, DETAILS], ids=["plain", "with bars and stops"])
@pytest.mark.parametrize("model", FOURTEEN_DOF)
def test_it_stands_level_and_each_wheel_carries_its_share_of_the_moment(model, details):
    """Of axle loads F: left F (1/2 + e / c), by the moment about the right wheel."""
    vehicle = uneven(**details)
    simulation = Simulation(vehicle, Options(model=model))
    simulation.reset(0.0)
    start = simulation.state.copy()
    simulation.step(Command(), 5.0)
    for name in set(simulation.options.states) - {"wheel_angle"}:
        assert np.abs(simulation.state[name] - start[name]).max() < DRIFT, name
    a, b, mass = vehicle.cg_to_front_axle, vehicle.cg_to_rear_axle, vehicle.sprung_mass
    expected = []
    for axle, share in (("front", b / (a + b)), ("rear", a / (a + b))):
        track, unsprung = (getattr(vehicle, f"{axle}_{n}") for n in ("track", "unsprung_mass"))
        left = mass * share * (track / 2 + OFFSET) / track
        expected += [left + unsprung, mass * share - left + unsprung]
    loads = simulation.outputs["normal_force"]
    np.testing.assert_allclose(loads, 9.81 * np.array(expected), rtol=1e-9)


@pytest.mark.parametrize("links", LINKS.values(), ids=LINKS)
def test_tires_and_weights_are_all_that_changes_the_momenta(links):
    vehicle, rng = uneven(), np.random.default_rng(4)
    evaluation = in_model_1(vehicle, links)
    for _ in range(STATES):
        state = random_state(vehicle, rng)
        linear, angular = momenta(
            vehicle, along(state, evaluation.rates(state, random_command(rng)))
        )
        forces, points = external(vehicle, state, evaluation.outputs)
        assert close(slope(linear), forces), state
        assert close(slope(angular), np.cross(points, forces)), state


@pytest.mark.parametrize("links", LINKS.values(), ids=LINKS)
def test_energy_changes_by_the_named_powers_alone(links):
    vehicle, rng = uneven(), np.random.default_rng(6)
    evaluation = in_model_1(vehicle, links)
    for _ in range(STATES):
        state, command = random_state(vehicle, rng), random_command(rng)
        rates = evaluation.rates(state, command)
        gained = slope(energy(vehicle, Road(), along(state, rates)))
        named = powers(vehicle, state, evaluation.outputs, command)
        assert abs(gained - sum(named.values())) < ROUNDING * max(map(abs, named.values()))


@pytest.mark.parametrize("links", LINKS.values(), ids=LINKS)
def test_the_mirror_image_has_its_c_g_on_the_other_side(links):
    reversed_values = ("cg_offset", "roll_pitch_product", "pitch_yaw_product")
    vehicle = uneven(**DETAILS)
    image = vehicle.with_values({name: -UNEVEN[name] for name in reversed_values})
    here, there = in_model_1(vehicle, links), in_model_1(image, links)
    rng = np.random.default_rng(9)
    for _ in range(STATES):
        state, command = random_state(vehicle, rng), random_command(rng)
        rates = mirrored(here.rates(state, command).copy())
        other = there.rates(mirrored(state), mirrored(command))
        for name in NAMES:
            scale = np.abs(rates[name]).max()
            assert np.abs(rates[name] - other[name]).max() <= ROUNDING * scale, name


def level(rng: np.random.Generator, vehicle) -> np.ndarray:
    """A STATE record of a vehicle that drives level at its heights of rest, in some turn."""
    simulation = Simulation(vehicle, Options(model="2"), step=1e-5)  # a light wheel needs it
    simulation.reset(15.0)
    state = simulation.state.copy()
    state["v"], state["yaw_rate"] = rng.uniform(-2.0, 2.0), rng.uniform(-0.5, 0.5)
    state["wheel_speed"] *= rng.uniform(0.9, 1.1, WHEEL_COUNT)
    state["lateral_slip"] = rng.uniform(-0.1, 0.1, WHEEL_COUNT)
    return state


BODY = ("u", "v", "w", "roll_rate", "pitch_rate", "yaw_rate")


def body_accelerations(evaluation, state, command) -> np.ndarray:
    rates = evaluation.rates(state, command)
    return np.array([rates[name] for name in BODY])


def test_without_roll_centres_a_level_vehicle_moves_as_in_model_2_with_wheels_that_go_straight_up():
    on_the_road = {"front_roll_centre_height": 0.0, "rear_roll_centre_height": 0.0}
    vehicle, rng = uneven(**on_the_road), np.random.default_rng(8)
    one, two = in_model_1(vehicle, {"no_roll_centre": True}), Evaluation(vehicle, Options("2"))
    for _ in range(STATES):
        state, command = level(rng, vehicle), random_command(rng)
        for name in ("w", "roll_rate", "pitch_rate", "unsprung_velocity"):
            state[name] = rng.uniform(-1.0, 1.0, STATE[name].shape)
        mine, other = (one.rates(state, command).copy(), two.rates(state, command))
        for name in NAMES:
            scale = np.abs(other[name]).max()
            assert np.abs(mine[name] - other[name]).max() <= ROUNDING * scale, name


def test_with_each_sides_own_link_load_transfer_it_moves_so_on_the_same_roll_centres():
    """Model 1 has the inertia of the wheels act on other points of the links: without it."""
    light = {"front_unsprung_mass": LIGHTEST, "rear_unsprung_mass": LIGHTEST}
    vehicle, rng = uneven(**light), np.random.default_rng(3)
    one = in_model_1(vehicle, {"link_load_transfer": "asymmetric"})
    two = Evaluation(vehicle, Options("2"))
    for _ in range(STATES):
        state, command = level(rng, vehicle), np.zeros(1, COMMAND)[0]
        command["steering"] = rng.uniform(-0.1, 0.1)
        # active forces that keep the wheels where they are: their paths differ
        rising = one.rates(state, command)["unsprung_velocity"]
        command["normal_force"] = LIGHTEST * rising
        mine, other = (body_accelerations(each, state, command) for each in (one, two))
        assert np.abs(mine - other).max() < LEFT_OF_IT * np.abs(other).max()
