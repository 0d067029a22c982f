"""Poles against closed forms: quarter car, pitch and roll, tires without grip, single track."""

import dataclasses
import math

import numpy as np
import pytest
from linear_studies import REFERENCE

from vehicle_roll_sim import Options, Vehicle
from vehicle_roll_sim.analysis.linear_model import linearize
from vehicle_roll_sim.analysis.modes import modes_of
from vehicle_roll_sim.analysis.trim import find_trim

GRAVITY = 9.81
"""m/s^2"""
SAME_FRONT_AND_REAR = {
    **dict.fromkeys(("cg_to_front_axle", "cg_to_rear_axle"), 1.27),
    **dict.fromkeys(("front_spring_stiffness", "rear_spring_stiffness"), 32_000.0),
    **dict.fromkeys(("front_damping", "rear_damping"), 2_200.0),
    "front_track": 1.4,
    "rear_track": 1.4,
}
LIMP = 1e-9
"""Factor by which the slip forces of the tires are reduced."""


def limp(vehicle: Vehicle) -> Vehicle:
    """The vehicle on tires that carry load but generate practically no slip forces."""
    tire = vehicle.tire.with_coefficients(LKX=LIMP, LKY=LIMP)
    return dataclasses.replace(vehicle, tire=tire)


def poles_of(vehicle: Vehicle, options: Options, speed: float) -> np.ndarray:
    return np.linalg.eigvals(linearize(find_trim(vehicle, options, speed=speed)).a)


def heave(car: Vehicle) -> np.ndarray:
    """Rates of the heights and vertical velocities of body and wheel: a quarter-car model."""
    m, mu = car.sprung_mass / 4, car.front_unsprung_mass
    ks, bs, kt = car.front_spring_stiffness, car.front_damping, car.front_tire_stiffness
    stiffness = np.array([[ks, -ks], [-ks, ks + kt]])
    return second_order(np.diag([m, mu]), bs * np.array([[1, -1], [-1, 1]]), stiffness)


def tilting(car: Vehicle, inertia: float, lever: float) -> np.ndarray:
    """Pitch, or roll without a roll centre: rates of the angle and of the height of a wheel.

    The links carry the unsprung masses, at the depth ls below the c.g., and the weight tilts the
    body: in limp tires, which give way on the ground, all but the share that the body itself moves.
    """
    m, mu = car.sprung_mass, car.front_unsprung_mass
    ks, bs, kt = car.front_spring_stiffness, car.front_damping, car.front_tire_stiffness
    ls, load = car.static_strut_length[0], m * GRAVITY / 4 + mu * GRAVITY
    r = car.cg_height - ls
    carried = 4 * mu * ls**2 * m / (m + 4 * mu)
    toppling = 4 * (load * r + m * GRAVITY / 4 * ls)
    arms = np.array([[4 * lever**2, 4 * lever], [lever, 1.0]])
    stiffness = ks * arms + np.diag([-toppling, kt])
    return second_order(np.diag([inertia + carried, mu]), bs * arms, stiffness)


def second_order(mass, damping, stiffness) -> np.ndarray:
    """M x'' + B x' + K x = 0 as rates of (x, x')."""
    inverse, zero = np.linalg.inv(mass), np.zeros_like(mass)
    return np.block([[zero, np.eye(len(mass))], [-inverse @ stiffness, -inverse @ damping]])


def warp(car: Vehicle) -> np.ndarray:
    """Diagonally opposed wheel motion, which leaves the body at rest."""
    stiffness = car.front_spring_stiffness + car.front_tire_stiffness
    mass = np.array([[car.front_unsprung_mass]])
    return second_order(mass, np.array([[car.front_damping]]), np.array([[stiffness]]))


def relaxation_rates(car: Vehicle, speed: float) -> list[float]:
    """V / sigma of the longitudinal and lateral slip states (1/s); docs/model.md."""
    tire = car.tire.coefficients
    load = (car.sprung_mass / 4 + car.front_unsprung_mass) * GRAVITY
    nominal = tire["LFZO"] * tire["FNOMIN"]
    dfz = (load - nominal) / nominal
    along = load * (tire["PTX1"] + tire["PTX2"] * dfz) * math.exp(-tire["PTX3"] * dfz)
    along *= car.tire_radius / tire["FNOMIN"]
    across = tire["PTY1"] * math.sin(2 * math.atan(load / (tire["PTY2"] * nominal)))
    across *= car.tire_radius * tire["LFZO"]
    return [speed / along, speed / across]


@pytest.mark.parametrize("speed", [5.0, 30.0])
def test_on_limp_tires_every_pole_is_that_of_a_matrix_by_hand(speed):
    car = limp(REFERENCE.with_values(SAME_FRONT_AND_REAR))
    found = poles_of(car, Options(no_roll_centre=True), speed)
    matrices = (
        heave(car),
        tilting(car, car.pitch_inertia, car.cg_to_front_axle),
        tilting(car, car.roll_inertia, car.front_track / 2),
        warp(car),
    )
    expected = [pole for matrix in matrices for pole in np.linalg.eigvals(matrix)]
    expected += [-rate for rate in relaxation_rates(car, speed) for _ in range(4)]
    expected += [0.0] * 7  # u, v, the yaw rate and the spins go on as they are
    assert len(found) == len(expected) == 29
    for pole in expected:
        nearest = np.abs(found - pole).argmin()
        # eight poles coincide in fours, seven in one: rounding splits them by its root
        assert found[nearest] == pytest.approx(pole, rel=1e-6, abs=2e-3)
        found = np.delete(found, nearest)


@pytest.mark.parametrize(("speed", "to_front", "grows"), [(14.0, 1.016, 0), (60.0, 1.9, 1)])
def test_without_roll_the_yaw_poles_of_the_8_dof_model_are_those_of_the_bicycle(
    speed, to_front, grows
):
    """The states are v and the yaw rate; tail-heavy and at high speed it is unstable."""
    axles = {"cg_to_front_axle": to_front, "cg_to_rear_axle": 2.54 - to_front}
    upright = {"front_roll_centre_depth": 0.0, "rear_roll_centre_depth": 0.0}
    car = REFERENCE.with_values(axles | upright)
    a, b = car.cg_to_front_axle, car.cg_to_rear_axle
    front, rear = (2 * stiffness for stiffness in cornering_stiffnesses(car)[::2])
    unsprung = 2 * car.front_unsprung_mass
    offset = unsprung * (a - b)
    turning = car.yaw_inertia + unsprung * (a**2 + b**2 + car.front_track**2 / 2)
    inertia = np.array([[car.sprung_mass + 2 * unsprung, offset], [offset, turning]])
    slip = np.array([[-front - rear, b * rear - a * front]])
    slip = np.vstack([slip, [b * rear - a * front, -(a**2) * front - b**2 * rear]]) / speed
    slip[:, 1] -= speed * inertia[:, 0]
    expected = np.sort_complex(np.linalg.eigvals(np.linalg.solve(inertia, slip)))
    options = Options(model="8dof", steady_state_slip=True)
    light, heavy = (
        poles_of(car.with_values({"wheel_inertia": inertia}), options, speed)
        for inertia in (0.01, 0.02)
    )
    assert (expected.real > 0.0).sum() == (light.real > 1e-6).sum() == grows
    for pole in expected:
        # the bicycle has no wheels that spin: the pole is where their inertia goes to 0
        one, two = (found[np.abs(found - pole).argmin()] for found in (light, heavy))
        assert 2 * one - two == pytest.approx(pole, rel=1e-4)


def cornering_stiffnesses(car: Vehicle) -> np.ndarray:
    """Cornering stiffness of each tire at its static load (N/rad; K of the lateral force)."""
    tire = car.tire.coefficients
    nominal = tire["LFZO"] * tire["FNOMIN"]
    loads = (car.sprung_mass * car.axle_load_share + car.front_unsprung_mass) * GRAVITY
    return -tire["PKY1"] * nominal * np.sin(2 * np.arctan(loads / (tire["PKY2"] * nominal)))


def test_an_oscillator_has_its_frequency_damping_and_both_states():
    frequency, damping = 2 * math.pi * 1.5, 0.3
    a = np.array([[0.0, 1.0], [-(frequency**2), -2 * damping * frequency]])
    (mode,) = modes_of(a, ("angle", "rate"))
    assert mode.frequency == pytest.approx(1.5)
    assert mode.damping == pytest.approx(damping)
    assert mode.time_constant == pytest.approx(1 / (damping * frequency))
    assert mode.pole.imag == pytest.approx(frequency * math.sqrt(1 - damping**2))
    assert set(mode.states) == {"angle", "rate"}


def test_modes_come_slowest_first_with_the_states_that_move_whatever_their_units():
    units = np.diag([1.0, 1e6, 1e-6])
    a = units @ np.diag([-5.0, 0.0, 2.0]) @ np.linalg.inv(units)
    neutral, growing, decaying = modes_of(a, ("decaying", "neutral", "growing"))
    assert neutral.states == ("neutral",)
    assert math.isnan(neutral.damping)
    assert neutral.time_constant == math.inf
    assert (growing.states, growing.damping) == (("growing",), -1.0)
    assert growing.time_constant == pytest.approx(-0.5)
    assert (decaying.states, decaying.damping) == (("decaying",), 1.0)
    assert decaying.time_constant == pytest.approx(0.2)
