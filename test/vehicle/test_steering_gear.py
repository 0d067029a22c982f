"""A steering gear: a ratio or a table, from handwheel to road wheels and back."""

import math

import numpy as np
import pytest
from vehicle_files import refused

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.handwheel import at_the_road_wheels, largest_handwheel
from vehicle_roll_sim.manoeuvres.nhtsa import NHTSA_J_TURN
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.vehicle.steering_gear import ratio_ahead, to_handwheel, to_road_wheels

TABLE = ((0.0, 0.0), (1.0, 0.05), (5.0, 0.45))
"""1 : 20 for the first radian, then 1 : 10."""


@pytest.mark.parametrize("gear", [16.0, TABLE, ((-2.0, -0.2), *TABLE)], ids=["16", "one", "two"])
def test_the_way_back_is_the_inverse_to_both_sides(gear):
    angles = np.linspace(-400.0, 400.0, 41)
    np.testing.assert_allclose(to_handwheel(to_road_wheels(angles, gear), gear), angles, atol=1e-9)


def test_a_table_is_straight_between_its_points_and_beyond_and_the_same_to_both_sides():
    angles = np.degrees([-7.0, -3.0, -0.5, 0.0, 0.5, 3.0, 7.0])
    expected = np.degrees([-0.65, -0.25, -0.025, 0.0, 0.025, 0.25, 0.65])
    np.testing.assert_allclose(to_road_wheels(angles, TABLE), expected, atol=1e-12)
    assert ratio_ahead(TABLE) == pytest.approx(20.0)
    end = math.degrees(5.0 + (math.radians(60.0) - 0.45) * 10.0)
    assert largest_handwheel(TABLE) == pytest.approx(end)
    assert at_the_road_wheels(90.0, TABLE).endswith("with steering_gear")


def test_a_manoeuvre_turns_the_road_wheels_by_the_table():
    vehicle = preset().with_values({"steering_gear": TABLE})
    assert vehicle.steering_ratio is None
    ready = NHTSA_J_TURN.for_vehicle(vehicle, Options())
    history = run(Simulation(vehicle), ready, 1.5)
    handwheel = math.radians(ready.handwheel(np.array([1.5]))[0])
    expected = 0.05 + (handwheel - 1.0) / 10.0 if handwheel > 1.0 else handwheel / 20.0
    assert history["steering"][-1] == pytest.approx(expected)


def test_a_table_that_is_no_gear_is_refused():
    for table in (((0.1, 0.1), (1.0, 0.2)), ((0.0, 0.0), (1.0, 0.0))):
        with refused("steering_gear"):
            preset().with_values({"steering_gear": table})
