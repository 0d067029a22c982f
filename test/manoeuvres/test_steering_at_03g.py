"""The handwheel angle at 0.3 g, from data with a known answer and from vehicles."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.manoeuvres.slowly_increasing_steer import angle_at_level, steering_at_03g
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run

GRAVITY = 9.81
REFERENCE = 19.39
"""deg: of the reference vehicle, as docs/manoeuvres.md has it."""


def history_of(handwheel: np.ndarray, acceleration: np.ndarray, ratio: float) -> History:
    """Handwheel angles (deg) and lateral accelerations (g) as a run has them."""
    rows = np.zeros((len(handwheel), len(COLUMNS)))
    rows[:, COLUMNS.index("steering")] = np.radians(handwheel / ratio)
    rows[:, COLUMNS.index("lateral_acceleration")] = acceleration * GRAVITY
    return History(rows)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("ratio", [16.0, 20.0])
def test_a_straight_line_is_read_exactly_whatever_lies_outside_the_band(ratio, side):
    handwheel = np.linspace(0.0, 60.0, 601)
    acceleration = 0.012 * handwheel - 0.03
    outside = (acceleration < 0.1) | (acceleration > 0.375)
    acceleration[outside] += 0.05 * np.sin(handwheel[outside]) * (acceleration[outside] > 0.45)
    history = history_of(side * handwheel, side * acceleration, ratio)
    assert angle_at_level(history, ratio) == pytest.approx(0.33 / 0.012, rel=1e-12)


def test_a_bent_curve_is_fitted_by_least_squares():
    handwheel = np.linspace(0.0, 40.0, 4001)
    acceleration = 0.02 * handwheel - 1e-4 * handwheel**2
    band = (acceleration >= 0.1) & (acceleration <= 0.375)
    x, y = handwheel[band], acceleration[band]
    slope = np.sum((x - x.mean()) * (y - y.mean())) / np.sum((x - x.mean()) ** 2)
    expected = x.mean() + (0.3 - y.mean()) / slope
    found = angle_at_level(history_of(handwheel, acceleration, 16.0), 16.0)
    assert found == pytest.approx(expected, rel=1e-9)


def test_without_enough_acceleration_there_is_no_angle():
    handwheel = np.linspace(0.0, 60.0, 601)
    assert math.isnan(angle_at_level(history_of(handwheel, 0.006 * handwheel, 16.0), 16.0))


def test_the_reference_vehicle_has_the_documented_angle():
    assert steering_at_03g(preset(), Options()) == pytest.approx(REFERENCE, abs=0.005)


def test_it_is_that_of_the_whole_manoeuvre():
    vehicle = preset()
    manoeuvre = STANDARD["slowly_increasing_steer"].for_vehicle(vehicle, Options())
    simulation = Simulation(vehicle)
    simulation.reset(manoeuvre.speed)
    history = run(simulation, manoeuvre, 8.0)
    found = manoeuvre.report(history, manoeuvre)["handwheel angle at 0.3 g"]
    assert float(found.split()[0]) == pytest.approx(steering_at_03g(vehicle, Options()), abs=1e-3)


def test_a_higher_steering_ratio_takes_so_much_more_of_the_handwheel():
    slower = preset().with_values({"steering_ratio": 20.0})
    ratio = steering_at_03g(slower, Options()) / steering_at_03g(preset(), Options())
    # at the same handwheel rate the road wheels turn more slowly, so that the lag is smaller
    assert 0.95 * 20 / 16 < ratio < 20 / 16


def test_the_amplitude_is_a_multiple_of_it():
    vehicle, angle = preset(), steering_at_03g(preset(), Options())
    for name, multiple in (("nhtsa_j_turn", 8.0), ("nhtsa_fishhook", 6.5)):
        assert STANDARD[name].for_vehicle(vehicle, Options()).amplitude == multiple * angle
    given = dataclasses.replace(STANDARD["nhtsa_j_turn"], steering_at_03g=25.0)
    assert given.for_vehicle(vehicle, Options()).amplitude == 200.0


def test_a_vehicle_that_never_gets_there_is_refused_by_name():
    clumsy = preset().with_values({"steering_ratio": 100.0})
    high = clumsy.with_values({"cg_height": 3.0})
    with pytest.raises(InputError) as refusal:
        steering_at_03g(high, Options())
    assert refusal.value.field == "steering_at_03g"
    assert len(str(refusal.value).splitlines()) == 1
