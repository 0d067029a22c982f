"""Circles of constant radius and constant handwheel angle; all methods agree."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.manoeuvres.driver.single_track import cornering_stiffnesses
from vehicle_roll_sim.model.records import ROLL, YAW_RATE, U
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run

pytestmark = pytest.mark.unmeasured

WHEELBASE = 1.016 + 1.524
"""m"""
GRAVITY = 9.81
METHODS = ("steady_state_circle", "constant_radius_circle", "constant_handwheel_circle")
RADIUS = 100.0
"""m"""
OF_THE_RISE = 0.002
"""deg/(m/s^2) of understeer gradient: a rise of 0.05 m/s^2 asks for torque, which unloads the front
axle; half of it brings the gradient 0.0013 down, and 0.2 m/s^2 some 0.009 up."""


def circle(name: str, **changes):
    return dataclasses.replace(STANDARD[name], **changes).for_vehicle(preset(), Options())


def driven(manoeuvre, duration: float | None = None) -> History:
    simulation = Simulation(preset())
    simulation.reset(manoeuvre.speed)
    whole = duration or manoeuvre.duration
    return run(simulation, manoeuvre.driver(), whole, sample=0.05, command_period=0.05)


@pytest.fixture(scope="module")
def runs() -> dict:
    """Manoeuvre and history of each method to the left, with the conditions of the standard."""
    return {name: (circle(name), driven(circle(name))) for name in METHODS}


def gradients_of_trims(speed_at) -> tuple[float, float]:
    """Understeer and roll gradient (deg/(m/s^2)) of steady turns at these speeds."""
    turns = []
    for wanted in np.linspace(0.1 * GRAVITY, 0.375 * GRAVITY, 6):
        trim = find_trim(preset(), speed=speed_at(wanted), lateral_acceleration=float(wanted))
        beyond = trim.inputs[0] - WHEELBASE * trim.state[YAW_RATE] / trim.state[U]
        turns.append((wanted, beyond, trim.state[ROLL]))
    acceleration, beyond, roll = np.array(turns).T
    return tuple(math.degrees(np.polyfit(acceleration, angle, 1)[0]) for angle in (beyond, roll))


def test_methods_agree_on_both_gradients(runs):
    understeer, roll = np.transpose([m.gradients(history) for m, history in runs.values()])
    assert np.ptp(understeer) < OF_THE_RISE
    assert np.ptp(roll) < 0.005 * roll.mean()


@pytest.mark.parametrize(
    ("name", "speed_at"),
    [
        ("steady_state_circle", lambda a: 100 / 3.6),
        ("constant_radius_circle", lambda a: math.sqrt(a * RADIUS)),
    ],
)
def test_gradients_are_those_of_steady_turns_found_without_driving(runs, name, speed_at):
    manoeuvre, history = runs[name]
    understeer, roll = manoeuvre.gradients(history)
    expected = gradients_of_trims(speed_at)
    # and six points of a slightly bent curve for a thousand
    assert understeer == pytest.approx(expected[0], abs=1.5 * OF_THE_RISE)
    assert roll == pytest.approx(expected[1], rel=0.005)


def test_at_small_accelerations_the_understeer_is_that_of_the_cornering_stiffnesses(runs):
    """m_f / C_f - m_r / C_r, before load transfer bends the curve."""
    front, rear = cornering_stiffnesses(preset())
    share = 1440.0 * 1.524 / WHEELBASE, 1440.0 * 1.016 / WHEELBASE
    closed_form = (share[0] + 160.0) / front - (share[1] + 160.0) / rear
    for manoeuvre, history in runs.values():
        acceleration = history["lateral_acceleration"]
        band = (acceleration > 0.9) & (acceleration < 1.2)
        needed = manoeuvre.wheelbase * history["yaw_rate"] / history["u"]
        beyond = (history["steering"] - needed)[band]
        slope = np.polyfit(acceleration[band], beyond, 1)[0]
        # the bend makes it 5 % more at 1 m/s^2, and the torque of the rise as much again
        assert slope == pytest.approx(closed_form, rel=0.12)


def test_at_constant_radius_the_slope_of_the_steering_is_the_understeer_gradient(runs):
    manoeuvre, history = runs["constant_radius_circle"]
    acceleration = history["lateral_acceleration"]
    band = (acceleration > 0.1 * GRAVITY) & (acceleration < 0.375 * GRAVITY)
    slope = np.degrees(np.polyfit(acceleration[band], history["steering"][band], 1)[0])
    # the radius is held to a few cm, but the c.g. turns to the inside: 1 / R is r / V and not r / u
    assert slope == pytest.approx(manoeuvre.gradients(history)[0], abs=0.002)


def test_at_constant_handwheel_angle_the_slope_of_the_curvature_is_the_understeer_gradient(runs):
    manoeuvre, history = runs["constant_handwheel_circle"]
    acceleration, curvature = history["lateral_acceleration"], history["yaw_rate"] / history["u"]
    band = (acceleration > 0.1 * GRAVITY) & (acceleration < 0.375 * GRAVITY)
    slope = -WHEELBASE * np.polyfit(acceleration[band], curvature[band], 1)[0]
    # the two find the edges of the band by other samples
    assert math.degrees(slope) == pytest.approx(manoeuvre.gradients(history)[0], abs=1e-3)
    held = history["steering"][history["time"] > 2.5]
    assert np.ptp(held) == 0.0
    assert np.degrees(held[0]) * 16.0 == pytest.approx(30.0, rel=1e-12)


@pytest.mark.parametrize("radius", [RADIUS, 40.0, -300.0])
def test_the_circle_is_followed_within_5_cm(runs, radius):
    _, history = runs["constant_radius_circle"]
    if radius != RADIUS:
        history = driven(circle("constant_radius_circle", radius=radius), 40.0)
    away = np.hypot(history["x"], history["y"] - radius) - abs(radius)
    settled = history["time"] > 3.0
    assert np.abs(away[settled]).max() < 0.05
    assert np.sign(history["yaw_rate"][-1]) == np.sign(radius)


@pytest.mark.parametrize("name", METHODS[1:])
def test_the_speed_rises_at_its_rate_until_0_4_g_and_is_then_held(runs, name):
    manoeuvre, history = runs[name]
    time, speed = history["time"], history["u"]
    lateral = np.abs(speed * history["yaw_rate"])
    enough = time[np.argmax(lateral > 0.4 * GRAVITY)]
    assert 5.0 < enough < manoeuvre.duration - 5.0
    rising = (time > 10.0) & (time < enough)
    # m/s: the speed hold lags behind by what asks for its torque
    expected = 8.0 + 0.05 * (time[rising] - 5.0)
    np.testing.assert_allclose(speed[rising], expected, rtol=0, atol=0.1)
    held = speed[time > enough + 2.0]
    assert np.ptp(held) < 0.02


@pytest.mark.parametrize(
    ("name", "mirrored"),
    [
        ("constant_radius_circle", {"radius": -100.0}),
        ("constant_handwheel_circle", {"handwheel_angle": -30.0}),
    ],
)
def test_to_the_right_all_is_mirrored(name, mirrored):
    left, right = driven(circle(name), 10.0), driven(circle(name, **mirrored), 10.0)
    for signal in ("y", "roll", "steering"):
        np.testing.assert_allclose(left[signal], -right[signal], rtol=0, atol=1e-8)
    np.testing.assert_allclose(left["x"], right["x"], rtol=0, atol=1e-8)


@pytest.mark.parametrize("name", METHODS[1:])
def test_a_vehicle_that_does_not_get_to_0_375_g_has_no_gradients(name):
    short = circle(name)
    report = short.report(driven(short, 10.0), short.driver())
    assert set(report.values()) == {"not enough samples between 0.1 and 0.375 g"}


@pytest.mark.parametrize("radius", [0.0, 9.9, -5.0])
def test_a_circle_that_no_vehicle_follows_is_refused(radius):
    with pytest.raises(InputError, match="at least 10 m"):
        circle("constant_radius_circle", radius=radius)
