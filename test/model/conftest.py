"""Vehicles for the tests of the model."""

import pytest

from vehicle_roll_sim import Vehicle, preset

UNEQUAL_AXLES = {
    "sprung_mass": 1810.0,
    "roll_inertia": 640.0,
    "pitch_inertia": 2410.0,
    "yaw_inertia": 2730.0,
    "cg_to_front_axle": 1.31,
    "cg_to_rear_axle": 1.17,
    "cg_height": 0.83,
    "front_track": 1.47,
    "rear_track": 1.61,
    "front_spring_stiffness": 41_000.0,
    "rear_spring_stiffness": 33_500.0,
    "front_damping": 2750.0,
    "rear_damping": 2100.0,
    "front_unsprung_mass": 52.0,
    "rear_unsprung_mass": 67.0,
    "front_tire_stiffness": 215_000.0,
    "rear_tire_stiffness": 245_000.0,
    "front_tire_progression": 3.0,
    "rear_tire_progression": 5.0,
    "tire_radius": 0.312,
    "wheel_inertia": 1.3,
    "front_roll_centre_depth": 0.56,
    "rear_roll_centre_depth": 0.47,
}


@pytest.fixture(scope="session")
def reference() -> Vehicle:
    """The vehicle of the source."""
    return preset("reference")


@pytest.fixture(scope="session")
def unequal_axles(reference) -> Vehicle:
    """A vehicle of which no two parameters are alike."""
    return reference.with_values(UNEQUAL_AXLES)


@pytest.fixture(params=["reference", "unequal_axles"])
def vehicle(request) -> Vehicle:
    return request.getfixturevalue(request.param)
