"""Wind: its force on a parked vehicle, none on one that moves with it, in every direction."""

import numpy as np
import pytest
from programmes import Evaluation
from random_states import attitude, random_state

from vehicle_roll_sim import Command, InputError, Options, Simulation, preset
from vehicle_roll_sim.model.records import COMMAND, YAW

AREA, DENSITY, WIND = 5.0, 1.225, 20.0
"""m^2, kg/m^3, m/s"""
AIR = {"side_force_area": AREA, "pressure_centre_height": 0.3, "front_lift_area": 0.2}
MASS = 1600.0
"""kg: of the reference vehicle with its wheels."""
HELD = (3000.0,) * 4
"""N m: brakes of a parked vehicle."""
MODELS = ("1", "2")


@pytest.fixture(scope="module")
def vehicle():
    return preset().with_values(AIR | {"drag_area": 0.7})


@pytest.mark.parametrize("model", MODELS)
def test_the_tires_of_a_parked_vehicle_hold_it_against_the_wind(vehicle, model):
    simulation = Simulation(vehicle, Options(model=model))
    simulation.reset(0.0)
    simulation.step(Command(wind=(0.0, WIND), brake_torque=HELD), 6.0)
    force = DENSITY / 2 * AREA * WIND**2
    held = simulation.outputs["lateral_force"].sum()
    assert held == pytest.approx(-force, rel=2e-3)  # the body leans by 1 degree
    left, right = simulation.outputs["normal_force"].reshape(2, 2).sum(axis=0)
    height = vehicle.cg_height
    leaning = vehicle.sprung_mass * 9.81 * height * -float(simulation.state["roll"])
    overturning = force * (height + AIR["pressure_centre_height"]) + leaning
    assert (left - right) * vehicle.front_track / 2 == pytest.approx(overturning, rel=0.05)


@pytest.mark.parametrize("model", MODELS)
def test_air_that_moves_with_the_vehicle_exerts_no_force(vehicle, model):
    """Its velocity over the ground is horizontal, at any attitude."""
    rng, bare = np.random.default_rng(5), preset().with_values({"drag_area": 0.0})
    windy, airless = (Evaluation(each, Options(model=model)) for each in (vehicle, bare))
    for _ in range(3):
        state, command = random_state(vehicle, rng), np.zeros(1, COMMAND)[0]
        command["wind"] = rng.uniform(-30.0, 30.0, 2)
        rotation = attitude(state["roll"], state["pitch"], state["yaw"])
        state["u"], state["v"], state["w"] = rotation.T @ [*command["wind"], 0.0]
        without = airless.rates(state, command)
        rates = windy.rates(state, command)
        for name in ("u", "v", "w", "roll_rate", "pitch_rate", "yaw_rate"):
            assert rates[name] == pytest.approx(without[name], rel=1e-9, abs=1e-9), name


def gust(vehicle, heading: float) -> np.ndarray:
    """States relative to the heading (rad) at the start, after a gust from the left."""
    simulation = Simulation(vehicle)
    simulation.reset(25.0)
    state = simulation.state_vector.copy()
    state[YAW] = heading
    simulation.state_vector[:] = state
    wind = attitude(0.0, 0.0, heading) @ [-3.0, -WIND, 0.0]
    simulation.step(Command(wind=tuple(wind[:2])), 1.0)
    state = simulation.state_vector.copy()
    place = attitude(0.0, 0.0, -heading) @ [*state[:2], 0.0]
    state[:2], state[YAW] = place[:2], state[YAW] - heading
    return state


def test_a_world_that_is_turned_with_its_wind_gives_the_same_run(vehicle):
    straight, turned = gust(vehicle, 0.0), gust(vehicle, 2.0)
    assert straight[1] < -0.1  # m
    assert turned == pytest.approx(straight, rel=1e-7, abs=1e-8)


def test_a_tail_wind_of_the_speed_takes_the_drag_away():
    dragging = preset().with_values({"drag_area": 0.7, "side_force_area": 0.0})
    slowed = []
    for wind in (0.0, 30.0, 60.0):
        simulation = Simulation(dragging)
        simulation.reset(30.0)
        simulation.step(Command(wind=(wind, 0.0)), 0.001)
        slowed.append(simulation.outputs["acceleration"][0])
    drag = DENSITY / 2 * 0.7 * 30.0**2 / MASS
    assert slowed[1] - slowed[0] == pytest.approx(drag, rel=0.1)  # the body pitches
    assert slowed[2] - slowed[1] == pytest.approx(drag, rel=0.1)  # the body pitches


def test_a_wind_that_would_have_no_effect_is_refused():
    simulation = Simulation(preset())
    with pytest.raises(InputError, match=r"^wind: -4.0 is not allowed: .*no air forces"):
        simulation.step(Command(wind=(0.0, -4.0)), 0.01)
    assert simulation.time == 0.0
    with pytest.raises(InputError, match=r"8dof has no such aerodynamic force"):
        Simulation(preset().with_values({"side_force_area": 0.0}), Options(model="8dof"))


@pytest.mark.parametrize("wind", [(1.0,), (0.0, 1.0, 2.0), 3.0, "ab", (0.0, float("nan"))])
def test_a_wind_is_two_finite_numbers(wind):
    with pytest.raises(InputError, match=r"^wind: "):
        Command(wind=wind)
