"""The driver's preview: predicted motion, optimal steering angle, and steering limits."""

import math

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import minimize_scalar

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.manoeuvres.driver.preview_steering import POINTS, PreviewSteering, transition
from vehicle_roll_sim.manoeuvres.driver.single_track import SingleTrack, cornering_stiffnesses
from vehicle_roll_sim.model.records import YAW_RATE, V

CAR = preset()
GRAVITY = 9.81
PERIOD = 0.01
"""s"""
AT_REST = {"x": 0.0, "y": 0.0, "yaw": 0.0, "u": 15.0, "v": 0.0, "yaw_rate": 0.0}


def driver(path=None, **settings) -> PreviewSteering:
    settings = {"preview": 0.7, "delay": 0.0, "rate": 1e6, "limit": 10.0} | settings
    return PreviewSteering(SingleTrack.of(CAR), path or line(0.0), **settings)


def line(aside: float, heading: float = 0.0):
    """A straight path, (0, aside) the place beside the origin."""

    def ahead(x: float, y: float, distance: float) -> np.ndarray:
        way = np.arange(-5.0, 2 * distance + 5.0, 0.1)
        return np.column_stack(
            (way * math.cos(heading), aside + way * math.sin(heading))
        ) + np.array([x, math.tan(heading) * x])

    return ahead


def test_cornering_stiffnesses_are_those_of_the_magic_formula_under_the_load_at_rest():
    tire = CAR.tire.coefficients
    nominal = tire["LFZO"] * tire["FNOMIN"]
    share = np.array([1.524, 1.016]) / 2.54 / 2
    loads = (1440.0 * share + 80.0) * GRAVITY
    each = -tire["PKY1"] * nominal * np.sin(2 * np.arctan(loads / (tire["PKY2"] * nominal)))
    # the slope is taken between slips of 1e-4, where the curve bends by the square of B times that
    np.testing.assert_allclose(cornering_stiffnesses(CAR), 2 * each, rtol=1e-5)


@pytest.mark.parametrize("speed", [10.0, 30.0])
def test_the_single_track_model_turns_as_the_8_dof_model_without_roll(speed):
    upright = {"front_roll_centre_depth": 0.0, "rear_roll_centre_depth": 0.0}
    car, steering = CAR.with_values(upright), 1e-4
    trim = find_trim(car, Options(model="8dof"), speed=speed, steering=steering)
    rates, steer = SingleTrack.of(car).rates(speed)
    v, yaw_rate = np.linalg.solve(rates, -steer * steering)
    # the 8 DOF model's wheels run at two tracks, and those that are driven need some of their grip
    assert trim.state[YAW_RATE] == pytest.approx(yaw_rate, rel=2e-3)
    assert trim.state[V] == pytest.approx(v, rel=2e-3)


@pytest.mark.parametrize("speed", [10.0, 30.0])
def test_its_rates_are_those_of_the_text_book_where_wheels_weigh_nothing(speed):
    light = CAR.with_values({"front_unsprung_mass": 0.01, "rear_unsprung_mass": 0.01})
    front, rear = cornering_stiffnesses(light)
    m, inertia, a, b, u = 1440.0, 2000.0, 1.016, 1.524, speed
    moment = a * front - b * rear
    expected = [
        [-(front + rear) / (m * u), -moment / (m * u) - u],
        [-moment / (inertia * u), -(a**2 * front + b**2 * rear) / (inertia * u)],
    ]
    rates, steer = SingleTrack.of(light).rates(speed)
    # four wheels of 10 g, the lightest that there are, far from the c.g.
    np.testing.assert_allclose(rates, expected, rtol=1e-3)
    np.testing.assert_allclose(steer, [front / m, a * front / inertia], rtol=1e-3)


@pytest.mark.parametrize("speed", [4.0, 8.0, 40.0])
@pytest.mark.parametrize("preview", [0.3, 2.0])
def test_the_prediction_is_the_exponential_of_the_expected_motion(speed, preview):
    rates, steer = SingleTrack.of(CAR).rates(speed)
    system = np.zeros((5, 5))
    system[0, 1:4], system[1, 3] = (speed, 1.0, 0.0), 1.0
    system[2:4, 2:] = np.column_stack((rates, steer))
    motion = np.array([0.3, 0.4])
    free, response = driver(preview=preview).prediction(speed, motion)
    exact = [expm(system * preview * (k + 1) / POINTS)[0] for k in range(POINTS)]
    # of the last value: the approximant's error, at 4 m/s where the motion decays within 3 steps
    for found, expected in (
        (free, [e[2:4] @ motion for e in exact]),
        (response, [e[4] for e in exact]),
    ):
        np.testing.assert_allclose(found, expected, rtol=0, atol=5e-3 * abs(expected[-1]))


def test_what_decays_within_a_step_does_so_in_its_approximation():
    assert np.abs(transition(np.array([[-1e4]]))) < 1.0
    assert transition(np.array([[-0.1]]))[0, 0] == pytest.approx(math.exp(-0.1), rel=1e-7)


def test_the_angle_is_the_one_with_the_least_squared_distance_over_the_preview():
    state = AT_REST | {"v": 0.2, "yaw_rate": 0.1, "y": -0.3, "yaw": 0.05}
    found = driver(line(0.5)).best_angle(state)
    free, response = driver().prediction(15.0, np.array([0.2, 0.1]))
    ahead = 15.0 * 0.7 * np.arange(1, POINTS + 1) / POINTS
    # a line along x, 0.8 m aside, in the axes of a vehicle that points 0.05 rad to the left
    path = (0.8 - ahead * math.sin(0.05)) / math.cos(0.05)
    cost = minimize_scalar(lambda angle: ((path - free - response * angle) ** 2).sum())
    assert found == pytest.approx(cost.x, rel=1e-6)


def test_on_a_straight_path_that_it_points_along_it_does_not_steer():
    assert driver().best_angle(AT_REST) == pytest.approx(0.0, abs=1e-12)


def test_a_path_to_the_other_side_gives_the_other_sign():
    left, right = (driver(line(aside)).best_angle(AT_REST) for aside in (0.4, -0.4))
    assert left > 0.0
    assert right == pytest.approx(-left, rel=1e-12)


def test_where_it_is_and_points_makes_no_difference_if_the_path_moves_along():
    here = driver(line(0.4)).best_angle(AT_REST)
    heading = 0.7
    moved = AT_REST | {"x": 30.0, "y": 30.0 * math.tan(heading), "yaw": heading}
    beside = 0.4 / math.cos(heading)
    assert driver(line(beside, heading)).best_angle(moved) == pytest.approx(here, rel=1e-6)


def test_the_handwheel_turns_no_quicker_than_it_can_and_no_further():
    steering = driver(line(5.0), rate=2.0, limit=0.3)
    angles = [steering.angle(k * PERIOD, AT_REST) for k in range(30)]
    expected = [min(2.0 * k * PERIOD, 0.3) for k in range(30)]
    np.testing.assert_allclose(angles, expected, rtol=0, atol=1e-12)


def test_the_hands_follow_after_the_delay():
    prompt, late = driver(line(0.2)), driver(line(0.2), delay=0.15)
    states = [AT_REST | {"y": 0.01 * k} for k in range(40)]
    wanted = [prompt.angle(k * PERIOD, state) for k, state in enumerate(states)]
    done = [late.angle(k * PERIOD, state) for k, state in enumerate(states)]
    assert done[:15] == [0.0] * 15
    # the first period has no turn yet, however quick the handwheel is
    np.testing.assert_allclose(done[16:], wanted[1:25], rtol=0, atol=1e-12)


def test_a_vehicle_on_the_path_of_its_own_steady_turn_keeps_its_steering():
    """What is found is the steering of the single track, whose turn is the path."""
    speed, steering = 10.0, 0.01
    rates, steer = SingleTrack.of(CAR).rates(speed)
    v, yaw_rate = np.linalg.solve(rates, -steer * steering)
    angles = np.arange(-0.5, 1.5, 1e-3)
    slip, radius = math.atan2(v, speed), math.hypot(speed, v) / yaw_rate
    circle = radius * np.column_stack(
        (np.sin(angles + slip) - math.sin(slip), math.cos(slip) - np.cos(angles + slip))
    )
    found = driver(lambda x, y, distance: circle).best_angle(
        AT_REST | {"u": speed, "v": v, "yaw_rate": yaw_rate}
    )
    # rel: small angles; the heading turns by 0.05 rad within the preview
    assert found == pytest.approx(steering, rel=0.01)


def test_a_standing_vehicle_has_an_angle_too():
    state = Simulation(CAR).state
    simulated = {name: float(state[name]) for name in AT_REST} | {"u": 0.0}
    assert math.isfinite(driver(line(0.4)).best_angle(simulated))
