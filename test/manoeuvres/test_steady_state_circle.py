"""The steady-state circle: steering, and gradients against closed forms and steady turns."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run

WHEELBASE = 1.016 + 1.524
"""m"""


def circle(**changes):
    manoeuvre = dataclasses.replace(STANDARD["steady_state_circle"], **changes)
    return manoeuvre.for_vehicle(preset(), Options())


def driven(manoeuvre) -> History:
    simulation = Simulation(preset())
    simulation.reset(manoeuvre.speed)
    return run(simulation, manoeuvre, manoeuvre.duration, sample=0.02)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_handwheel_turns_at_half_a_degree_a_second_to_30_degrees(side):
    times = np.arange(0.0, 62.0, 0.0025)
    steering = circle(handwheel_angle=side * 30.0)(times)["steering"]
    expected = [
        side * math.radians(min(0.5 * max(t - 1.0, 0.0), 30.0)) / 16.0 for t in times.tolist()
    ]
    # rad: rounding of angles of 0.03
    np.testing.assert_allclose(steering, expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("understeer", [0.003, 0.0, -0.002])
def test_gradients_of_a_linear_vehicle_are_its_own(side, understeer):
    speed, roll_gradient = 25.0, 0.02
    acceleration = side * np.linspace(0.0, 5.0, 501)
    rows = np.zeros((501, len(COLUMNS)))
    yaw_rate = acceleration / speed
    signals = {
        "lateral_acceleration": acceleration,
        "yaw_rate": yaw_rate,
        "u": np.full(501, speed),
        "roll": roll_gradient * acceleration,
        "steering": WHEELBASE * yaw_rate / speed + understeer * acceleration,
    }
    for name, values in signals.items():
        rows[:, COLUMNS.index(name)] = values
    found = circle().gradients(History(rows))
    expected = np.degrees([understeer, roll_gradient])
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


@pytest.fixture(scope="module")
def steady_turns() -> np.ndarray:
    """Lateral acceleration, steering beyond that of the wheels' circle, and roll of steps."""
    turns = []
    for wanted in (1.0, 2.3, 3.6):
        step = dataclasses.replace(
            STANDARD["iso_step_steer"], lateral_acceleration=wanted, duration=10.0
        ).for_vehicle(preset(), Options())
        last = driven(step).rows[-1]
        value = dict(zip(COLUMNS, last.tolist(), strict=True))
        beyond = value["steering"] - WHEELBASE * value["yaw_rate"] / value["u"]
        turns.append((value["lateral_acceleration"], beyond, value["roll"]))
    return np.array(turns)


def test_gradients_of_the_reference_vehicle_are_those_of_steady_turns(steady_turns):
    acceleration, beyond, roll = steady_turns.T
    expected = [math.degrees(np.polyfit(acceleration, angle, 1)[0]) for angle in (beyond, roll)]
    understeer, roll_gradient = circle().gradients(driven(circle()))
    # the lag of 0.13 m/s^2 a second, and three points of a slightly bent curve
    assert understeer == pytest.approx(expected[0], abs=0.004)
    assert roll_gradient == pytest.approx(expected[1], rel=0.01)


def test_a_vehicle_that_does_not_get_to_0_375_g_has_no_gradients():
    straight = circle(handwheel_angle=3.0, duration=12.0)
    history = driven(straight)
    assert np.isnan(straight.gradients(history)).all()
    assert set(straight.report(history, straight).values()) == {
        "not enough samples between 0.1 and 0.375 g"
    }
