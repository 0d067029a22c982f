"""A profile under all wheels: the same heights as point by point."""

import math

import numpy as np
from road_kinds import road

from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.road.layout import HEADER
from vehicle_roll_sim.model.road.profile import add_profile_under_wheels
from vehicle_roll_sim.model.work_space import ROAD_TERMS

TURNED = road(
    {"kind": "random_profile", "start": 4.0, "offset": 1.0, "heading": 20.0, "length": 30.0}
)


def looked_up(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """A ROAD_TERMS record after a look under wheels at x, y, shape (4,) (m)."""
    terms = np.zeros(1, ROAD_TERMS)
    terms["place_x"], terms["place_y"] = x, y
    add_profile_under_wheels(HEADER, TURNED.ground(), kernel_argument(terms)[0])
    return terms[0]


def test_wheels_find_what_the_surface_of_the_road_is_at_their_places():
    rng = np.random.default_rng(3)
    for _ in range(100):
        x, y = rng.uniform(-5.0, 45.0, WHEEL_COUNT), rng.uniform(-3.0, 18.0, WHEEL_COUNT)
        found = looked_up(x, y)
        for i in range(WHEEL_COUNT):
            expected = TURNED.surface(x[i], y[i])[:3]
            assert (found["height"][i], found["slope_x"][i], found["slope_y"][i]) == expected


def test_a_place_that_is_not_a_number_is_not_looked_up_outside_the_table():
    """States may diverge within a step, before this is noticed."""
    for x in (math.nan, math.inf, -math.inf):
        found = looked_up(np.array([x, 10.0, x, 10.0]), np.ones(WHEEL_COUNT))
        assert np.isfinite(found["part"]).all()
        assert np.isfinite(found["height"][[1, 3]]).all()
