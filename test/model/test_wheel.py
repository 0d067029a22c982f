"""The spin of a wheel: brakes, drive torque, rolling resistance and drag, by closed forms."""

import math

import numpy as np
import pytest
from programmes import Evaluation
from random_states import random_command, random_state

from vehicle_roll_sim import LF, LR, RF, RR, Command, Condition, InputError, Options, Simulation
from vehicle_roll_sim.model.wheel import with_friction
from vehicle_roll_sim.simulation.road import Road

pytestmark = [pytest.mark.slow, pytest.mark.unmeasured]

WHEELS = (LF, RF, LR, RR)
G = 9.81
SPIN = 40.0
"""rad/s"""
STEP = 1e-3
"""s"""
ROUNDING = 1e-12
"""Relative, of a spin under constant torque: a straight line, exact in RK4."""
DROP = 10.0
"""m: the fall from there lasts 1.4 s, in which no wheel touches the road."""


def everywhere(torque: float) -> tuple:
    return (torque,) * 4


def lifted(vehicle, spin: float) -> Simulation:
    """A vehicle in free fall, all its wheels turning."""
    simulation = Simulation(vehicle, step=STEP)
    simulation.reset(0.0)
    simulation.state.z += DROP
    simulation.state.tire_compression -= DROP
    simulation.state.wheel_speed = spin
    return simulation


def total_mass(vehicle) -> float:
    return vehicle.sprung_mass + vehicle.per_wheel("unsprung_mass").sum()


def moving_mass(vehicle, simulation) -> float:
    """Mass and what the wheels add to it, rolling without slip (kg)."""
    return total_mass(vehicle) + np.sum(vehicle.wheel_inertia / simulation.outputs.loaded_radius**2)


def spins(simulation, command, duration: float) -> np.ndarray:
    """Of all wheels (rad/s), after every step."""
    kept = []
    for _ in range(round(duration / STEP)):
        simulation.step(command, STEP)
        kept.append(simulation.state.wheel_speed.copy())
    assert simulation.condition is Condition.RUNNING
    return np.array(kept)


@pytest.mark.parametrize("direction", [1, -1])
def test_a_brake_stops_a_free_wheel_in_the_time_of_the_closed_form_and_not_beyond(
    vehicle, direction
):
    brakes = (150.0, 170.0, 230.0, 310.0)
    simulation = lifted(vehicle, direction * SPIN)
    seen = spins(simulation, Command(brake_torque=brakes), 0.6)
    assert simulation.outputs.normal_force.max() == 0.0, "a wheel has touched the road"
    times = STEP * np.arange(1, len(seen) + 1)[:, None]
    expected = direction * (SPIN - np.array(brakes) / vehicle.wheel_inertia * times)
    turning = direction * expected > SPIN * ROUNDING
    np.testing.assert_allclose(seen[turning], expected[turning], atol=SPIN * ROUNDING)
    stopped = direction * expected < -SPIN * ROUNDING
    assert stopped[-1].all()
    assert (seen[stopped] == 0.0).all()


@pytest.mark.parametrize("direction", [1, -1])
def test_a_drive_torque_turns_a_free_wheel_the_way_of_its_sign_through_standstill(
    vehicle, direction
):
    torque = direction * 100.0
    seen = spins(lifted(vehicle, -direction * 20.0), Command(wheel_torque=everywhere(torque)), 0.5)
    end = -direction * 20.0 + torque * 0.5 / vehicle.wheel_inertia
    np.testing.assert_allclose(seen[-1], end, rtol=ROUNDING, atol=20 * ROUNDING)
    assert np.sign(seen[0] * seen[-1]).max() == -1


@pytest.mark.parametrize("direction", [1, -1])
def test_a_standing_wheel_turns_only_by_what_its_brake_cannot_hold(vehicle, direction):
    brakes, drive = (200.0, 101.0, 100.0, 60.0), direction * 100.0
    command = Command(wheel_torque=everywhere(drive), brake_torque=brakes)
    seen = spins(lifted(vehicle, 0.0), command, 0.5)
    assert (seen[:, :3] == 0.0).all()
    expected = direction * (100.0 - 60.0) / vehicle.wheel_inertia * 0.5
    assert seen[-1, RR] == pytest.approx(expected, rel=ROUNDING)


def test_dry_friction_takes_its_capacity_from_a_torque_and_no_more():
    for turning in (1.0, -1.0):
        for torque in (-30.0, 0.0, 30.0):
            assert with_friction(torque, 10.0, turning) == torque - turning * 10.0
    held = {torque: with_friction(torque, 10.0, 0.0) for torque in (-30.0, -10.0, 3.0, 10.0, 30.0)}
    assert held == {-30.0: -20.0, -10.0: 0.0, 3.0: 0.0, 10.0: 0.0, 30.0: 20.0}


@pytest.mark.parametrize("share", [0.8, 1.25])
def test_brakes_hold_a_vehicle_on_a_grade_up_to_their_capacity_and_brake_it_beyond(vehicle, share):
    """The sum of their torques is that share of what the downhill force has about the hubs."""
    road = Road(grade=0.1)
    simulation = Simulation(vehicle, road=road)
    simulation.reset(0.0)
    downhill = total_mass(vehicle) * -road.gravity(G)[1]
    radius = simulation.outputs.loaded_radius.mean()
    brakes = Command(brake_torque=everywhere(share * downhill * radius / 4))
    simulation.step(brakes, 10.0)
    before = simulation.state.u
    simulation.step(brakes, 1.0)
    gained = simulation.state.u - before
    if share > 1:
        assert (simulation.state.wheel_speed == 0.0).all()
        assert abs(before) < 1e-3  # m/s: its body still swings by 1e-5
    else:
        expected = -(1 - share) * downhill / moving_mass(vehicle, simulation)
        assert gained == pytest.approx(expected, rel=0.02)  # the radius is a mean; seen 0.3 %


@pytest.mark.parametrize("direction", [1, -1])
def test_a_locked_wheel_stays_locked_while_its_tire_slides_and_its_force_opposes_that(
    vehicle, direction
):
    simulation = Simulation(vehicle, step=STEP)
    simulation.reset(15.0)
    if direction < 0:  # in reverse
        simulation.state.u *= -1.0
        simulation.state.wheel_speed *= -1.0
    command = Command(brake_torque=everywhere(6000.0))
    spins(simulation, command, 0.2)
    seen = spins(simulation, command, 1.0)
    assert direction * simulation.state.u > 3.0, "it has stopped"
    assert (seen == 0.0).all()
    # slip of a locked wheel: -1, times the way it goes
    assert np.abs(direction * simulation.outputs.slip_ratio + 1).max() < 0.02
    force, load = simulation.outputs.longitudinal_force, simulation.outputs.normal_force
    assert (-direction * force > 0.5 * load).all()


def test_a_locked_wheel_turns_again_when_its_brake_lets_it(vehicle):
    simulation = Simulation(vehicle, step=STEP)
    simulation.reset(15.0)
    simulation.step(Command(brake_torque=everywhere(6000.0)), 0.5)
    simulation.step(Command(), 1.0)
    assert np.abs(simulation.outputs.slip_ratio).max() < 1e-2
    assert simulation.state.wheel_speed.min() > 20.0


def test_without_friction_the_spin_is_that_of_its_torques_to_the_bit(vehicle):
    evaluation = Evaluation(vehicle, Options())
    rng = np.random.default_rng(4)
    for _ in range(50):
        state, command = random_state(vehicle, rng), random_command(rng)
        for evaluation.outputs.turning[:] in (1.0, -1.0, 0.0):
            rates = evaluation.rates(state, command)
            torque = command["wheel_torque"].copy()
            torque -= evaluation.outputs.loaded_radius * evaluation.outputs.tire_longitudinal
            assert (rates["wheel_speed"] == torque / vehicle.wheel_inertia).all()


@pytest.mark.parametrize(
    ("model", "grade", "vehicle"),
    [
        *((model, 0.2, "unequal_axles") for model in ("1", "1b", "8dof")),
        *((model, -0.2, "reference") for model in ("1", "1b", "8dof")),
    ],
    indirect=["vehicle"],
)
def test_parked_for_a_minute_on_a_grade_of_20_percent_it_creeps_less_than_a_millimetre(
    vehicle, grade, model
):
    simulation = Simulation(vehicle, Options(model=model), road=Road(grade=grade))
    simulation.reset(0.0)
    brakes = Command(brake_torque=everywhere(2000.0))
    simulation.step(brakes, 3.0)  # at first the body sways: 1.5 mm 2 s after, 0.3 mm 3 s after
    x, y = simulation.state.x, simulation.state.y
    simulation.step(brakes, 57.0)
    assert math.hypot(simulation.state.x - x, simulation.state.y - y) < 1e-3  # m
    x = simulation.state.x
    simulation.step(brakes, 10.0)
    assert abs(simulation.state.x - x) < 1.5e-10  # m: no creep at all; seen 1e-12 in a minute
    assert abs(simulation.state.u) < 1e-12
    assert (simulation.state.wheel_speed == 0.0).all()


COEFFICIENT = 0.015


def coasting(vehicle, values: dict, speed: float, settle: float, road: Road | None = None):
    """A vehicle with these values, rolling freely at `speed` for `settle` seconds."""
    simulation = Simulation(vehicle.with_values(values), road=road)
    simulation.reset(speed)
    simulation.step(Command(), settle)
    return simulation


@pytest.mark.parametrize("speed", [20.0, 5.0])
def test_rolling_resistance_slows_a_coasting_vehicle_by_its_share_of_the_weight(vehicle, speed):
    simulation = coasting(vehicle, {"rolling_resistance_coefficient": COEFFICIENT}, speed, 2.5)
    before = simulation.state.u
    simulation.step(Command(), 1.0)
    expected = -COEFFICIENT * G * total_mass(vehicle) / moving_mass(vehicle, simulation)
    # the tires slip a little to turn the wheels, and the load moves to the front: seen 4e-5
    assert simulation.state.u - before == pytest.approx(expected, rel=2e-4)


def test_a_slope_below_the_coefficient_holds_a_vehicle_and_a_steeper_one_does_not(vehicle):
    values = {"rolling_resistance_coefficient": COEFFICIENT}
    held = coasting(vehicle, values, 0.0, 60.0, Road(grade=0.9 * COEFFICIENT))
    assert abs(held.state.x) < 5e-3  # m: what the tires give; seen 1.8e-3 and 2.6e-3
    x = held.state.x
    held.step(Command(), 10.0)
    assert abs(held.state.x - x) < 1.5e-10  # seen 1e-12 in a minute
    assert (held.state.wheel_speed == 0.0).all()
    road = Road(grade=1.5 * COEFFICIENT)
    free = coasting(vehicle, values, 0.0, 10.0, road)
    before = free.state.u
    free.step(Command(), 1.0)
    down, along, _ = road.gravity(G)
    expected = (along + COEFFICIENT * down) * total_mass(vehicle) / moving_mass(vehicle, free)
    assert free.state.u - before == pytest.approx(expected, rel=1e-4)  # seen 2e-5


@pytest.mark.parametrize("model", ["1", "8dof"])
def test_drag_slows_a_coasting_vehicle_with_the_square_of_its_speed(vehicle, model):
    """u = u0 / (1 + k u0 t) with k = rho CdA / (2 m)."""
    area, speed, time = 2.0, 40.0, 20.0
    simulation = Simulation(vehicle.with_values({"drag_area": area}), Options(model=model))
    simulation.reset(speed)
    simulation.step(Command(), time)
    k = 1.225 * area / 2 / moving_mass(vehicle, simulation)
    expected = speed / (1 + k * speed * time)
    assert simulation.state.u == pytest.approx(expected, rel=1e-5)  # seen 1.2e-6


@pytest.mark.parametrize("values", [(0, -1e-9, 0, 0), (0, 0, math.nan, 0), (math.inf, 0, 0, 0)])
def test_brake_torques_below_0_or_not_finite_are_refused_by_name(values):
    with pytest.raises(InputError) as refusal:
        Command(brake_torque=values)
    assert refusal.value.field == "brake_torque"
