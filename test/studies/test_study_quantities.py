"""Each kind of quantity reaches the run for which it is meant, and nothing else changes."""

import dataclasses
import math

import pytest

from vehicle_roll_sim import preset
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.studies.quantities import case_of, unit_of
from vehicle_roll_sim.vehicle.masses import Load
from vehicle_roll_sim.vehicle.parameters import Vehicle


@pytest.fixture(scope="module")
def loaded() -> Vehicle:
    """The reference vehicle with one mass of payload."""
    load = Load(mass=100.0, behind_front_axle=2.0, height=1.0)
    vehicle = preset()
    return Vehicle.checked(vehicle.given, **vehicle.not_numbers | {"payload": (load,)})


def test_without_values_the_case_is_that_of_the_study(study):
    given = study()
    case = case_of(given, {})
    assert (case.vehicle, case.manoeuvre, case.road) == (given.vehicle, given.manoeuvre, None)
    assert (case.step, case.rollover_angle) == (0.001, math.radians(85.0))


def test_fixed_values_and_those_of_the_point_reach_the_case(study):
    given = study(fixed={"road.grade": 0.1, "options.no_roll_centre": True}, model="1b", step=0.002)
    point = {"vehicle.cg_height": 0.7, "manoeuvre.speed": 15.0, "road.bank": -0.05}
    case = case_of(given, point)
    assert case.vehicle == given.vehicle.with_values({"cg_height": 0.7})
    assert case.manoeuvre == dataclasses.replace(given.manoeuvre, speed=15.0)
    assert case.road == Road(grade=0.1, bank=-0.05)
    assert (case.options.model, case.options.no_roll_centre, case.step) == ("1b", True, 0.002)


def test_a_coefficient_changes_the_tires_of_both_axles_or_of_one(study):
    before = preset().axle_tires
    both = case_of(study(), {"tire.LMUY": 0.8}).vehicle.axle_tires
    for axle, tire in both.items():
        assert tire == before[axle].with_coefficients(LMUY=0.8)
    rear = case_of(study(), {"tire.LMUY": 0.8, "rear_tire.LMUY": 0.9}).vehicle.axle_tires
    assert [tire.coefficients["LMUY"] for tire in rear.values()] == [0.8, 0.9]


def test_a_mass_of_the_payload_is_replaced_and_the_sprung_mass_follows(study, loaded):
    given = study(vehicle=loaded)
    vehicle = case_of(given, {"payload.1.mass": 300.0, "vehicle.drag_area": 0.5}).vehicle
    assert (vehicle.payload[0].mass, vehicle.payload[0].height) == (300.0, 1.0)
    assert vehicle.sprung_mass == pytest.approx(loaded.sprung_mass + 200.0)
    assert vehicle.drag_area == 0.5


def test_a_value_that_is_not_allowed_is_refused_when_the_case_is_made(study):
    with pytest.raises(InputError, match=r"^bank: 1\.2 is not allowed"):
        case_of(study(), {"road.bank": 1.2})


def test_quantities_have_the_units_of_their_declarations(study):
    names = ("vehicle.cg_height", "manoeuvre.speed", "road.bank", "payload.2.mass", "tire.LMUY")
    units = [unit_of(name, study()) for name in names]
    assert units == ["m", "m/s", "m/m", "kg", ""]
