"""Steering of each wheel: geometry, toe, roll steer, compliance; gyroscopics, engine drag."""

import math

import numpy as np
import pytest
from guided_wheels import curves, momenta, wheels
from mechanics import along, slope
from mechanics import momenta as momenta_of_model_1
from programmes import Evaluation, with_moments
from random_states import attitude, mirrored, random_command, random_state

from vehicle_roll_sim import Command, Options, Simulation
from vehicle_roll_sim.model.records import STATE

STATES = 8
SIDES = np.array([1.0, -1.0, 1.0, -1.0])
LEFT, RIGHT = [0, 0, 2, 2], [1, 1, 3, 3]
SHARE = 60.0
TOE = {"front_toe": 0.004, "rear_toe": -0.002}
ROLL_STEER = {"front_roll_steer": -0.08, "rear_roll_steer": 0.05}
TRAVEL = {
    "front_toe_change": ((-0.1, 0.01), (0.0, 0.0), (0.1, -0.004)),
    "rear_toe_change": 0.06,
}
COMPLIANCE = {
    "front_lateral_force_steer": -3e-7,
    "rear_lateral_force_steer": 1e-7,
    "front_aligning_moment_steer": 4e-6,
}
CAMBER = {"front_lateral_force_camber": 1.5e-6, "rear_lateral_force_camber": 2e-6}
ALL = {"ackermann_percentage": SHARE, **TOE, **ROLL_STEER, **TRAVEL, **COMPLIANCE, **CAMBER}


@pytest.fixture(scope="module")
def plain(unequal_axles):
    """On tires that are linear springs: loads of random states stay within what wheels yield to."""
    return with_moments(unequal_axles).with_values(
        {"front_tire_progression": 0.0, "rear_tire_progression": 0.0}
    )


def cases(vehicle, options: Options, seed: int = 1):
    evaluation, rng = Evaluation(vehicle, options), np.random.default_rng(seed)
    for _ in range(STATES):
        state, command = random_state(vehicle, rng), random_command(rng)
        state["roll"] *= 0.5
        yield state, command, evaluation.rates(state, command).copy(), evaluation.outputs.copy()


def commanded(command) -> np.ndarray:
    return np.repeat([command["steering"], command["rear_steering"]], 2)


def compliance_steer(vehicle, outputs) -> np.ndarray:
    """Angle of each wheel by COMPLIANCE, from lateral force and moment of the tire alone."""
    along, across = outputs["tire_longitudinal"], outputs["tire_lateral"]
    shifted = vehicle.contact_patch_compliance(True) * (across * along)
    per_force, per_moment = np.repeat([-3e-7, 1e-7], 2), np.repeat([4e-6, 0.0], 2)
    return per_force * across + per_moment * (outputs["aligning_moment"] + shifted)


def check_lean(plain, options, state, command, outputs) -> tuple[np.ndarray, Evaluation]:
    """Assert that CAMBER leans each wheel as its force says; the lean (rad), and rigid wheels."""
    rigid = Evaluation(plain, options)
    rigid.rates(state, command)
    lean = outputs["inclination"] - rigid.outputs["inclination"]
    expected = np.repeat([*CAMBER.values()], 2) * outputs["tire_lateral"]
    np.testing.assert_allclose(lean, expected, rtol=0, atol=1e-11)
    return lean, rigid


@pytest.mark.parametrize("model", ["1", "2", "8dof"])
def test_ackermann_geometry_is_that_of_the_cotangents(plain, model):
    vehicle = plain.with_values({"ackermann_percentage": SHARE})
    wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    for angle in (0.02, -0.3, 0.6):
        simulation = Simulation(vehicle, Options(model=model))
        simulation.step(Command(steering=angle), 1e-3)
        left, right, *rear = simulation.outputs["steering"]
        inner, outer = (left, right) if angle > 0.0 else (-right, -left)
        gap = 1.0 / math.tan(outer) - 1.0 / math.tan(inner)
        assert gap == pytest.approx(SHARE / 100 * vehicle.front_track / wheelbase, rel=1e-9)
        mean = (1.0 / math.tan(outer) + 1.0 / math.tan(inner)) / 2
        assert mean == pytest.approx(1.0 / math.tan(abs(angle)), rel=1e-12)
        assert rear == [0.0, 0.0]


@pytest.mark.parametrize("model", ["1", "1b", "2"])
def test_toe_and_roll_steer_follow_the_travel_of_the_wheels(plain, model):
    """In model 2 the change of toe turns the carriers, which has tests of its own."""
    vehicle = plain.with_values(TOE | ROLL_STEER | TRAVEL)
    for state, command, _, outputs in cases(vehicle, Options(model=model)):
        x = state["suspension_compression"]
        tracks = np.repeat([vehicle.front_track, vehicle.rear_track], 2)
        coefficient = np.repeat([*ROLL_STEER.values()], 2)
        expected = commanded(command) - SIDES * np.repeat([*TOE.values()], 2)
        expected += coefficient * (x[RIGHT] - x[LEFT]) / tracks
        travel = x - vehicle.static_suspension_compression
        turned = [curves(vehicle, i, q)["toe"].real for i, q in enumerate(travel)]
        expected += 0.0 if model == "2" else SIDES * turned
        np.testing.assert_allclose(outputs["steering"], expected, rtol=0, atol=1e-14)


@pytest.mark.parametrize("steady", [False, True], ids=["transient slip", "steady-state slip"])
@pytest.mark.parametrize("model", ["1", "2"])
def test_compliance_steer_and_the_forces_that_cause_it_agree(plain, model, steady):
    vehicle = plain.with_values(COMPLIANCE)
    options = Options(model=model, steady_state_slip=steady)
    turned = 0.0
    for (_, command, _, outputs), rigid in zip(
        cases(vehicle, options), cases(plain, options), strict=True
    ):
        angle = outputs["steering"] - commanded(command)
        expected = compliance_steer(vehicle, outputs)
        np.testing.assert_allclose(angle, expected, rtol=0, atol=1e-11)
        turned = max(turned, np.abs(angle).max())
        if not steady:  # the forces are those of the lagged slip, as on rigid wheels
            np.testing.assert_array_equal(outputs["tire_lateral"], rigid[-1]["tire_lateral"])
    assert turned > 0.003


@pytest.mark.parametrize("steady", [False, True], ids=["transient slip", "steady-state slip"])
@pytest.mark.parametrize("model", ["1", "2"])
def test_compliance_camber_and_the_forces_that_cause_it_agree(plain, model, steady):
    """The forces are those of a rigid wheel with as much more static camber."""
    vehicle, options = plain.with_values(CAMBER), Options(model=model, steady_state_slip=steady)
    leaning = 0.0
    for state, command, _, outputs in cases(vehicle, options):
        lean, rigid = check_lean(plain, options, state, command, outputs)
        leaning = max(leaning, np.abs(lean).max())
        np.testing.assert_array_equal(outputs["steering"], rigid.outputs["steering"])
        if model == "2":  # where static camber moves the contact point too
            continue
        for i in np.flatnonzero(outputs["normal_force"]):
            name = "front_camber" if i < 2 else "rear_camber"
            camber = getattr(plain, name) + SIDES[i] * -lean[i]
            cambered = Evaluation(plain.with_values({name: camber}), options)
            cambered.rates(state, command)
            for force in ("tire_longitudinal", "tire_lateral", "aligning_moment"):
                like = cambered.outputs[force][i]
                assert outputs[force][i] == pytest.approx(like, rel=1e-8, abs=1e-6), force
    assert leaning > 0.01


def test_a_wheel_that_yields_in_steering_and_camber_agrees_in_both(plain):
    """With steady-state slip, where each of the two angles changes the force of the other."""
    vehicle = plain.with_values(COMPLIANCE | CAMBER)
    options = Options(steady_state_slip=True)
    for state, command, _, outputs in cases(vehicle, options):
        check_lean(plain, options, state, command, outputs)
        angle = outputs["steering"] - commanded(command)
        steer = compliance_steer(vehicle, outputs)
        np.testing.assert_allclose(angle, steer, rtol=0, atol=1e-11)


@pytest.mark.parametrize("model", ["1", "2"])
def test_left_and_right_are_alike_with_every_detail(plain, model):
    vehicle = plain.with_values(ALL | {"front_rebound_damping": 4000.0})
    options = Options(model=model, wheel_gyroscopics=True)
    evaluation = Evaluation(vehicle, options)
    for state, command, rates, _ in cases(vehicle, options, seed=2):
        opposite = evaluation.rates(mirrored(state), mirrored(command))
        for name in STATE.names:
            expected = mirrored(rates)[name]
            scale = 1e-9 * (1.0 + np.abs(expected).max())
            np.testing.assert_allclose(opposite[name], expected, rtol=0, atol=scale, err_msg=name)


def test_gyroscopic_moments_turn_the_body_as_the_wheels_are_turned_in_model_1(plain):
    """Angular momentum of body and spinning wheels together changes as without moments of spin."""
    exact = {"no_roll_centre": True, "euler_terms": True}
    for (state, command, rates, _), without in zip(
        cases(plain, Options(**exact, wheel_gyroscopics=True)),
        cases(plain, Options(**exact)),
        strict=True,
    ):
        changes = [
            slope(momenta_of_model_1(plain, along(state, each))[1]) for each in (rates, without[2])
        ]
        angles, now = commanded(command), along(state, rates)
        axes = np.array([-np.sin(angles), np.cos(angles), 0 * angles])
        turned = attitude(now["roll"], now["pitch"], now["yaw"]) @ axes
        of_wheels = plain.wheel_inertia * slope(turned @ now["wheel_speed"])
        largest = np.abs(of_wheels).max()
        np.testing.assert_allclose(changes[0] - changes[1], -of_wheels, rtol=0, atol=1e-9 * largest)


def test_gyroscopic_moments_act_through_the_carriers_of_model_2(plain):
    """They change angular momentum as the axes turn with the carriers and the wheels spin up."""
    vehicle = plain.with_values(TRAVEL | {"front_camber_change": -0.8, "rear_camber_change": -0.5})
    for (state, command, rates, _), without in zip(
        cases(vehicle, Options(model="2", wheel_gyroscopics=True)),
        cases(vehicle, Options(model="2")),
        strict=True,
    ):
        now = along(state, rates)
        changes = [
            slope(momenta(vehicle, along(state, each), command))[3:] for each in (rates, without[2])
        ]
        axes = np.array([each.spin_axis for each in wheels(vehicle, now, command)])
        of_wheels = vehicle.wheel_inertia * slope(now["wheel_speed"] @ axes)
        largest = np.abs(of_wheels).max()
        np.testing.assert_allclose(changes[0] - changes[1], -of_wheels, rtol=0, atol=1e-8 * largest)


@pytest.mark.parametrize("model", ["1", "2", "8dof"])
def test_the_engine_brakes_the_driven_wheels_by_their_speed(reference, model):
    """4 N m per rad/s at each rear wheel; the tires then brake the vehicle."""
    speeds = []
    for drag in (0.0, 4.0):
        vehicle = reference.with_values({"engine_drag": drag})
        simulation = Simulation(vehicle, Options(model=model))
        simulation.step(Command(), 2.0)
        speeds.append(simulation.state.u)
        spin = simulation.state.wheel_speed
    mass = reference.mass + 4 * reference.wheel_inertia / reference.tire_radius**2
    rate = 2 * 4.0 / reference.tire_radius**2 / mass
    assert speeds[0] == pytest.approx(50 / 3.6, abs=1e-6)
    assert speeds[1] == pytest.approx(speeds[0] * math.exp(-2.0 * rate), rel=0.03)
    assert spin[2] < spin[0]
