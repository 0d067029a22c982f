"""Drag, side force and lift: their sizes, in still air and in wind, and which models have them."""

import numpy as np
import pytest
from guided_wheels import momenta as momenta_of_model_2
from mechanics import along, slope
from mechanics import momenta as momenta_of_model_1
from programmes import Evaluation, with_moments
from random_states import attitude, random_command, random_state

from vehicle_roll_sim import Command, InputError, Options, Simulation, preset
from vehicle_roll_sim.vehicle.air_parameters import OF_SIDE_AND_LIFT

DENSITY, DRAG, SIDE, AHEAD, HEIGHT, FRONT, REAR = 1.1, 0.7, 5.0, 0.4, -0.2, 0.3, -0.5
AIR = {
    "air_density": DENSITY,
    "drag_area": DRAG,
    "side_force_area": SIDE,
    "pressure_centre_ahead": AHEAD,
    "pressure_centre_height": HEIGHT,
    "front_lift_area": FRONT,
    "rear_lift_area": REAR,
}
EXACT = {
    "1": Options(model="1", no_roll_centre=True, euler_terms=True),
    "2": Options(model="2"),
}
"""The models that conserve momentum to rounding."""


def momenta(model: str, vehicle, state, command) -> np.ndarray:
    """Linear momentum, and angular momentum about the origin, over the ground, shape (6,)."""
    if model == "2":
        return momenta_of_model_2(vehicle, state, command)
    return np.concatenate(momenta_of_model_1(vehicle, state))


def expected(vehicle, state, wind) -> np.ndarray:
    """Force of the air and its moment about the origin, over the ground, shape (6,)."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    u, v, _ = [state["u"], state["v"], 0.0] - rotation.T @ [*wind, 0.0]
    speed, beta = np.hypot(u, v), np.arctan2(v, u)
    pressure = DENSITY / 2 * speed**2
    lift = [0.0, 0.0, pressure]
    forces = {
        (0.0, 0.0, 0.0): np.array([-DENSITY / 2 * DRAG * u * abs(u), 0.0, 0.0]),
        (AHEAD, 0.0, HEIGHT): np.array([0.0, -pressure * SIDE * np.sin(beta), 0.0]),
        (vehicle.cg_to_front_axle, 0.0, 0.0): np.multiply(FRONT, lift),
        (-vehicle.cg_to_rear_axle, 0.0, 0.0): np.multiply(REAR, lift),
    }
    cg = np.array([state["x"], state["y"], state["z"]])
    total = np.zeros(6)
    for point, force in forces.items():
        total[:3] += rotation @ force
        total[3:] += np.cross(cg + rotation @ point, rotation @ force)
    return total


@pytest.mark.parametrize("model", EXACT)
def test_they_are_all_that_is_added_to_the_momenta(unequal_axles, model):
    plain = with_moments(unequal_axles).with_values({"air_density": DENSITY, "drag_area": 0.0})
    vehicle, rng = plain.with_values(AIR), np.random.default_rng(3)
    evaluations = [Evaluation(each, EXACT[model]) for each in (plain, vehicle)]
    for _ in range(8):
        state, command = random_state(vehicle, rng), random_command(rng)
        command["wind"] = rng.uniform(-30.0, 30.0, 2)
        without, added = (
            slope(momenta(model, vehicle, along(state, each.rates(state, command)), command))
            for each in evaluations
        )
        force = expected(vehicle, state, command["wind"])
        assert np.abs(force[:3]).max() > 1.0
        assert added - without == pytest.approx(force, abs=1e-9 * np.abs(without).max())


def test_density_scales_the_drag_too():
    slowed = []
    for density in (None, 2.45):
        values = {"drag_area": 0.7} | ({} if density is None else {"air_density": density})
        simulation = Simulation(preset().with_values(values), Options(model="8dof"))
        simulation.reset(30.0)
        slowed.append(simulation.outputs["acceleration"][0])
    assert slowed[1] == pytest.approx(2.0 * slowed[0])
    assert slowed[0] < 0.0


@pytest.mark.parametrize("model", ["1", "2"])
def test_downforce_loads_the_tires_by_what_the_axles_get(model):
    vehicle = preset().with_values({"front_lift_area": -1.0, "rear_lift_area": -2.0})
    simulation = Simulation(vehicle, Options(model=model))
    simulation.reset(30.0)
    before = simulation.outputs["normal_force"].copy()
    simulation.step(Command(speed_hold_gain=2000.0, speed_hold_target=30.0), 3.0)
    gained = (simulation.outputs["normal_force"] - before)[::2] * 2
    pressure = 1.225 / 2 * simulation.state["u"] ** 2
    assert gained.sum() == pytest.approx(3.0 * pressure, rel=1e-3)
    assert gained == pytest.approx(pressure * np.array([1.0, 2.0]), rel=0.1)


@pytest.mark.parametrize("name", OF_SIDE_AND_LIFT)
def test_the_8_dof_model_refuses_what_it_does_not_use(name):
    values = {"side_force_area": SIDE} if name.startswith("pressure_centre") else {}
    vehicle = preset().with_values(values | {name: AIR[name]})
    with pytest.raises(InputError, match=r"8dof has no such aerodynamic force"):
        Simulation(vehicle, Options(model="8dof"))


@pytest.mark.parametrize("name", ["pressure_centre_ahead", "pressure_centre_height"])
def test_a_place_of_the_side_force_needs_the_force(name):
    for others in ({}, {"side_force_area": 0.0}):
        with pytest.raises(InputError, match=f"^{name}: .*side_force_area"):
            preset().with_values(others | {name: 0.3})
