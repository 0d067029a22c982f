"""Runs after a rollover: a fall on the roof, sliding, rest, and whole rolls."""

import numpy as np
import pytest
from bodies import BOX, EXACT, GUIDED, corners
from programmes import Run, j_turn, ramp_and_hold, record_run
from random_states import attitude
from scipy.linalg import expm

from vehicle_roll_sim import Command, Condition, Options, Simulation, Vehicle
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.simulation.command import Programme

G = 9.81
STEP = 1e-3
"""s"""
SYMMETRIC = {
    "cg_to_front_axle": 1.3,
    "cg_to_rear_axle": 1.3,
    "front_spring_stiffness": 3e4,
    "rear_spring_stiffness": 3e4,
    "front_damping": 2000.0,
    "rear_damping": 2000.0,
    "front_roll_centre_height": 0.0,
    "rear_roll_centre_height": 0.0,
    "body_front_overhang": 0.9,
    "body_rear_overhang": 0.9,
}
"""Front is like rear, and the wheels move along the body's z axis in model 2 too: on its roof it
neither pitches nor rolls."""
BOTH = pytest.mark.parametrize("options", [EXACT, GUIDED], ids=["model 1", "model 2"])


def coast(times: np.ndarray) -> np.ndarray:
    return np.zeros(len(times), COMMAND)


@pytest.fixture(scope="module")
def symmetric(reference) -> Vehicle:
    return reference.with_values(BOX | SYMMETRIC)


def on_its_roof(vehicle: Vehicle, options: Options, sunk: float, **velocities) -> Simulation:
    """Upside down, its roof `sunk` into the ground (m), struts without load."""
    simulation = Simulation(vehicle, options, step=STEP)
    simulation.reset(0.0)
    state = simulation.state
    state["roll"] = np.pi
    state["z"] = vehicle.body_roof_height - vehicle.cg_height - sunk
    state["suspension_compression"] = 0.0
    lengths = vehicle.static_strut_length + vehicle.static_suspension_compression
    state["tire_compression"] = vehicle.per_wheel("tire_radius") - state["z"] - lengths
    for name, value in velocities.items():
        state[name] = value
    return simulation


@BOTH
def test_a_fall_on_the_roof_is_that_of_a_linear_oscillator(symmetric, options):
    """Body on four corners, wheels on their struts, by the matrix exponential; until it bounces
    off. Tolerance: the error of Runge-Kutta, whose largest is seen as 1e-9 of the velocity."""
    speed, duration, sunk = 2.0, 0.05, 1e-4  # it has just met the ground
    falling = {"w": speed, "unsprung_velocity": speed}  # the body's z axis points down
    simulation = on_its_roof(symmetric, options, sunk, **falling)
    run = record_run(simulation, coast, duration)
    m, mu = symmetric.sprung_mass, symmetric.per_wheel("unsprung_mass").sum()
    k, c = 4 * symmetric.body_stiffness, 4 * symmetric.body_damping
    ks, bs = (symmetric.per_wheel(name).sum() for name in ("spring_stiffness", "damping"))
    system = np.zeros((5, 5))  # depth, compression of the struts, their rates, and 1
    system[0, 2] = system[1, 3] = 1.0
    system[2] = np.array([-k, ks, -c, bs, m * G]) / m
    of_wheels = np.array([0.0, -ks, 0.0, -bs, mu * G]) / mu
    system[3] = of_wheels - system[2]  # towards the body, which is below
    start = np.array([sunk, 0.0, speed, 0.0, 1.0])
    exact = np.array([expm(system * time) @ start for time in run.time])
    touching = k * exact[:, 0] + c * exact[:, 2] > 0.0
    assert touching[1:].all()
    top = symmetric.body_roof_height - symmetric.cg_height
    np.testing.assert_allclose(top - run.state["z"], exact[:, 0], rtol=0, atol=1e-9)
    np.testing.assert_allclose(run.state["w"], exact[:, 2], rtol=0, atol=2e-8)
    struts = run.state["suspension_compression"]
    np.testing.assert_allclose(struts, exact[:, [1] * 4], rtol=0, atol=1e-9)
    load = run.outputs["body_load"][1:].sum(axis=1)
    np.testing.assert_allclose(load, (k * exact[:, 0] + c * exact[:, 2])[1:], rtol=1e-7)


@BOTH
def test_at_rest_on_its_roof_the_corners_carry_the_weight_and_sink_in_by_it(symmetric, options):
    """Within a millionth after 4 s: the bounce of the wheels on the dampers decays at 12/s."""
    simulation = on_its_roof(symmetric, options, 0.05)
    simulation.step(Command(), 4.0)
    weight = symmetric.mass * G
    sunk = symmetric.body_roof_height - symmetric.cg_height - simulation.state["z"]
    assert simulation.outputs["body_load"].sum() == pytest.approx(weight, rel=1e-6)
    assert sunk == pytest.approx(weight / (4 * symmetric.body_stiffness), rel=1e-6)
    assert (simulation.outputs["normal_force"] == 0.0).all()


@BOTH
@pytest.mark.parametrize("direction", ["u", "v"])
def test_on_its_roof_it_slides_to_a_stop_at_mu_g(symmetric, options, direction):
    """While all corners slide, friction is mu times the load on them, whose sum is the weight but
    for what bounces; from the sticking speed V on, the speed decays at mu g / V."""
    simulation = on_its_roof(symmetric, options, 0.0)
    simulation.step(Command(), 4.0)
    simulation.state[direction], start = 5.0, simulation.time
    slowing = symmetric.body_friction * G
    run = record_run(simulation, coast, start + 5.0 / slowing + 2.0)
    speed = run.state[direction]
    load = run.outputs["body_load"].sum(axis=1)
    sliding = run.time < start + 4.5 / slowing
    lost = np.trapezoid(load[sliding], run.time[sliding]) * symmetric.body_friction
    gone = speed[0] - speed[sliding][-1]
    assert gone * symmetric.mass == pytest.approx(lost, rel=1e-2)
    seconds = run.time[sliding][-1] - start
    assert gone / seconds == pytest.approx(slowing, rel=1e-2)
    assert abs(speed[-1]) < 1e-3


FULL_ROLL = {"body_friction": 1.0}
FISHHOOK_SPEED = 35.0
"""m/s"""


@pytest.fixture(scope="module")
def rolls(reference) -> dict[str, Run]:
    """A J-turn at 35 m/s on a rough ground, through the rollover, for 12 s."""
    found = {}
    for name, options in {"1": EXACT, "2": GUIDED, "source": Options(body_contact=True)}.items():
        simulation = Simulation(reference.with_values(FULL_ROLL), options, step=STEP)
        simulation.reset(FISHHOOK_SPEED)
        found[name] = record_run(simulation, j_turn(), 12.0)
        assert simulation.condition is Condition.RUNNING
    return found


def mechanical(vehicle: Vehicle, run: Run) -> np.ndarray:
    """Kinetic energy of the body, and its potential energy with that of the wheels (J)."""
    state = run.state
    speeds = sum(state[name] ** 2 for name in "uvw") * vehicle.mass
    turning = sum(
        getattr(vehicle, f"{axis}_inertia") * state[f"{axis}_rate"] ** 2
        for axis in ("roll", "pitch", "yaw")
    )
    return (speeds + turning) / 2 + vehicle.mass * G * state["z"]
