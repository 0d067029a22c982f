"""Tires of each axle: which file, and radius, stiffnesses and pressure from it or in its place."""

import dataclasses
import math

import numpy as np
import pytest
from vehicle_files import REFERENCE_TIR, REFERENCE_YAML, edited, line_of, refused, write

from vehicle_roll_sim import LF, LR, InputError, Options, Tire, Vehicle, load_vehicle, preset
from vehicle_roll_sim.manoeuvres.driver.single_track import cornering_stiffnesses
from vehicle_roll_sim.simulation.plant import Plant
from vehicle_roll_sim.vehicle.axle_tires import cornering_stiffness
from vehicle_roll_sim.vehicle.tire.keys import COEFFICIENTS
from vehicle_roll_sim.vehicle.vehicle_file import on_tires

LATERAL = {"front_tire_lateral_stiffness": 1e5, "rear_tire_lateral_stiffness": 2.5e5}
OF_VERSION_6 = {"NOMPRES": 2.2e5, "INFLPRES": 2.3e5, "PFZ1": 0.7, "PPY1": 0.4, "PPY2": 1.2}
TURNED_OFF = ("tire_radius", "front_tire_stiffness", "rear_tire_stiffness")


def without(vehicle: Vehicle, *names: str, **fields) -> Vehicle:
    """The vehicle without these values, and with other fields."""
    kept = {name: value for name, value in vehicle.given.items() if name not in names}
    return Vehicle(**kept, **vehicle.not_numbers | fields)


@pytest.fixture
def tire() -> Tire:
    """The reference tire with what its file says of its size, of no version with pressure."""
    size = {"UNLOADED_RADIUS": 0.31, "VERTICAL_STIFFNESS": 2.1e5}
    return preset().tire.with_coefficients(**size)


@pytest.fixture
def pressed(tire) -> Tire:
    """That tire as one of version 6.1, with effects of pressure."""
    kept = {n: value for n, value in tire.coefficients.items() if n in COEFFICIENTS["6.1"]}
    return dataclasses.replace(tire, coefficients=kept | OF_VERSION_6, version="6.1")


@pytest.fixture
def vehicle_from(tmp_path):
    """Loads a vehicle file with that content, two tires beside it."""
    write(tmp_path, "reference.tir", REFERENCE_TIR)
    write(tmp_path, "other.tir", REFERENCE_TIR.replace("= 1.685", "= 1.5"))
    return lambda content: load_vehicle(write(tmp_path, "some.yaml", content))


def test_each_axle_has_its_tire(vehicle_from):
    own = edited(REFERENCE_YAML, "tire", "front_tire: reference.tir\nrear_tire: other.tir")
    vehicle = vehicle_from(own)
    assert vehicle.tire is None
    assert vehicle.front_tire.coefficients["PCX1"] == 1.685
    assert vehicle.tires()["PCX1"].tolist() == [1.685, 1.5]
    same = vehicle_from(REFERENCE_YAML)
    assert same.axle_tires == {"front": same.tire, "rear": same.tire}
    assert same.tires()["PCX1"].tolist() == [1.685, 1.685]


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("tire: reference\nfront_tire: other.tir", ("tire", "given together with front_tire")),
        ("tire: reference\nrear_tire: other.tir", ("tire", "given together with rear_tire")),
        ("front_tire: other.tir", ("rear_tire: missing", "front_tire is given")),
        ("rear_tire: other.tir", ("front_tire: missing", "rear_tire is given")),
        ("front_tire: none.tir\nrear_tire: other.tir", ("front_tire", "does not exist")),
        ("front_tire: other.tir\nrear_tire: .", ("rear_tire", "s a directory", ".tir file")),
        ("front_tire: other.tir\nrear_tire: 3", ("rear_tire", "3 is not allowed", ".tir file")),
        ("tire: reference\ntire_moments: 1", ("tire_moments", "1 is not", "true or false")),
        ("tire: reference\ntire_moments: auto", ("tire_moments", "'auto'", "true or false")),
        ("tire: reference\ncontact_patch_shift:", ("contact_patch_shift", "true or false")),
        ("tire: reference\ncontact_patch_shift: [on]", ("contact_patch_shift", "true or false")),
        ("tire: reference\nlongitudinal: lateral", ("longitudinal", "'lateral'", "from_lateral")),
        ("tire: reference\nlongitudinal: true", ("longitudinal", "True", "from_lateral")),
    ],
)
def test_what_is_wrong_with_tires_is_refused_in_one_line(vehicle_from, tmp_path, lines, said):
    plain = "\n".join(line for line in REFERENCE_YAML.splitlines() if "tire_m" not in line)
    plain = "\n".join(line for line in plain.splitlines() if "contact_patch" not in line)
    with refused(tmp_path / "some.yaml", *said):
        vehicle_from(edited(plain, "tire", lines))


@pytest.mark.parametrize("name", ["tire_moments", "contact_patch_shift", "front_tire"])
def test_fields_of_a_vehicle_are_checked_as_in_a_file(name):
    with refused(name):
        dataclasses.replace(preset(), **{name: "yes"})


def test_replacing_the_tire_of_one_axle_leaves_the_other_its_own(tmp_path):
    other = write(tmp_path, "other.tir", REFERENCE_TIR.replace("= 1.685", "= 1.5"))
    vehicle = on_tires(preset(), {"rear_tire": other})
    assert vehicle.tires()["PCX1"].tolist() == [1.685, 1.5]
    assert on_tires(vehicle, {"tire": other}).tires()["PCX1"].tolist() == [1.5, 1.5]
    assert on_tires(vehicle, {}) is vehicle
    for name in ("front_tire", "rear_tire"):
        with refused("tire: ", f"together with {name}"):
            on_tires(vehicle, {"tire": other, name: other})


def test_radius_and_stiffness_come_from_the_tire_unless_they_are_given(tire):
    taken = without(preset(), *TURNED_OFF, tire=tire)
    assert taken.per_wheel("tire_radius").tolist() == [0.31] * 4
    assert taken.per_wheel("tire_stiffness").tolist() == [2.1e5] * 4
    assert taken.from_tires["rear_tire_radius"].source == "UNLOADED_RADIUS of the tire file"
    assert taken.record()["tire_radius"].tolist() == [[0.31] * 4]
    given = without(preset(), tire=tire)
    assert given.from_tires == {}
    assert given.per_wheel("tire_radius").tolist() == [0.285] * 4
    smaller = dataclasses.replace(
        taken, tire=None, front_tire=tire.with_coefficients(UNLOADED_RADIUS=0.3), rear_tire=tire
    )
    assert smaller.per_wheel("tire_radius").tolist() == [0.3, 0.3, 0.31, 0.31]


@pytest.mark.parametrize("name", TURNED_OFF)
def test_a_value_that_neither_file_has_is_named_with_the_key_of_the_tire_file(name):
    bare = preset().tire.with_coefficients(UNLOADED_RADIUS=0.0, VERTICAL_STIFFNESS=0.0)
    key = "UNLOADED_RADIUS" if name == "tire_radius" else "VERTICAL_STIFFNESS"
    with refused(f"{name}: missing", "reference.tir", key):
        without(preset(), name, tire=bare)


@pytest.mark.parametrize(
    ("coefficients", "said"),
    [
        ({"UNLOADED_RADIUS": 310.0}, ("front_tire_radius", "UNLOADED_RADIUS", "310.0")),
        ({"VERTICAL_STIFFNESS": 0.5}, ("front_tire_stiffness", "VERTICAL_STIFFNESS", "0.5")),
    ],
)
def test_a_value_of_the_tire_file_that_no_vehicle_may_have_is_refused(tire, coefficients, said):
    with refused(*said, "a number from"):
        without(preset(), *TURNED_OFF, tire=tire.with_coefficients(**coefficients))


@pytest.mark.parametrize("name", ["front_tire_radius", "rear_tire_radius"])
def test_a_radius_is_given_once(name):
    with refused(name, "0.3 together with tire_radius 0.285", "either tire_radius, or"):
        Vehicle(**preset().given | {name: 0.3}, tire=preset().tire)


def test_replacing_the_value_of_one_axle_leaves_the_other_the_common_one(pressed):
    vehicle = preset().with_values({"front_tire_radius": 0.3})
    assert vehicle.per_wheel("tire_radius").tolist() == [0.3, 0.3, 0.285, 0.285]
    assert vehicle.tire_radius is None
    back = vehicle.with_values({"tire_radius": 0.285})
    assert back == preset()
    vehicle = dataclasses.replace(preset(), tire=pressed).with_values({"tire_pressure": 2e5})
    vehicle = vehicle.with_values({"rear_tire_pressure": 2.5e5})
    assert vehicle.per_wheel("tire_pressure").tolist() == [2e5, 2e5, 2.5e5, 2.5e5]


def test_a_tire_that_is_flat_at_rest_is_named():
    with refused("rear_tire_radius", "static compression of the rear tires"):
        preset().with_values({"rear_tire_radius": 0.01})
    with refused("tire_radius", "static compression of the front tires"):
        preset().with_values({"tire_radius": 0.01})


@pytest.mark.parametrize("name", ["tire_pressure", "front_tire_pressure", "rear_tire_pressure"])
def test_a_pressure_is_refused_for_a_tire_that_does_not_depend_on_it(pressed, name):
    with refused(name, "200000.0", "version 5.2", "reference.tir"):
        preset().with_values({name: 2e5})
    unknown = dataclasses.replace(preset(), tire=pressed.with_coefficients(NOMPRES=0.0))
    with refused(name, "200000.0", "has no NOMPRES"):
        unknown.with_values({name: 2e5})
    for wrong in (2.2, 220.0, 3e6):  # bar and kPa
        with refused(name, str(wrong), "from 10000 to 2e+06 Pa"):
            dataclasses.replace(preset(), tire=pressed).with_values({name: wrong})


def test_the_pressure_acts_on_stiffness_and_tires_of_its_axle(pressed):
    vehicle = without(preset(), *TURNED_OFF, tire=pressed)
    change = (2.3e5 - 2.2e5) / 2.2e5
    stiffness = 2.1e5 * (1 + 0.7 * change)
    np.testing.assert_allclose(vehicle.per_wheel("tire_stiffness"), stiffness, rtol=1e-14)
    softer = vehicle.with_values({"rear_tire_pressure": 1.76e5})
    rear = softer.per_wheel("tire_stiffness")[LR]
    assert rear == pytest.approx(2.1e5 * (1 - 0.7 * 0.2), rel=1e-14)
    assert softer.per_wheel("tire_stiffness")[LF] == pytest.approx(stiffness, rel=1e-14)
    np.testing.assert_allclose(softer.tires()["pressure_change"], [change, -0.2], rtol=1e-13)


def test_the_lateral_stiffness_is_that_given_or_of_the_file_or_from_relaxation(pressed):
    taken = preset().lateral_stiffness_from_tires["front_tire_lateral_stiffness"]
    c, load = preset().tire.coefficients, 1440 * 9.81 * 0.3 + 80 * 9.81
    slope = c["PKY1"] * 6000 * math.sin(2 * math.atan(load / (c["PKY2"] * 6000)))
    length = c["PTY1"] * math.sin(2 * math.atan(load / (c["PTY2"] * 6000))) * 0.285 * 1.5
    assert taken.value == pytest.approx(-slope / length, rel=1e-12)
    assert "cornering stiffness over relaxation length" in taken.source
    other = dataclasses.replace(preset(), tire=pressed.with_coefficients(LATERAL_STIFFNESS=1.4e5))
    for found in other.lateral_stiffness_from_tires.values():
        assert found == (1.4e5, "LATERAL_STIFFNESS of the tire file at static load")
    no_lag = dataclasses.replace(preset(), tire=preset().tire.with_coefficients(PTY1=0.0))
    found = no_lag.lateral_stiffness_from_tires["front_tire_lateral_stiffness"]
    assert found.value == pytest.approx(-slope / 0.285, rel=1e-12)
    assert "tire radius" in found.source
    assert preset().with_values(LATERAL).lateral_stiffness_from_tires == {}


def test_the_cornering_stiffness_behind_it_is_that_of_the_tire_model(pressed):
    for tire in (preset().tire, pressed.with_coefficients(PKY4=1.8)):
        vehicle = dataclasses.replace(preset(), tire=tire)
        loads = vehicle.static_tire_compression * vehicle.per_wheel("tire_stiffness")
        both = [-2 * cornering_stiffness(tire, None, float(loads[wheel])) for wheel in (LF, LR)]
        np.testing.assert_allclose(both, cornering_stiffnesses(vehicle), rtol=1e-5)


def test_contact_patches_shift_as_the_option_says_and_not_where_the_moments_contain_it():
    def compliance(vehicle: Vehicle, **options) -> list[float]:
        plant = Plant.of(vehicle, Options(**options))
        return plant.vehicle["tire_lateral_compliance"][0].tolist()

    vehicle = preset().with_values(LATERAL)
    shifted = [1e-5, 1e-5, 4e-6, 4e-6]
    assert compliance(vehicle) == [0.0] * 4
    assert compliance(vehicle, contact_patch_shift="on") == shifted
    own = dataclasses.replace(vehicle, contact_patch_shift=True, tire_moments=True)
    assert compliance(own) == shifted
    assert compliance(own, contact_patch_shift="off") == [0.0] * 4
    assert compliance(own, model="1a") == [0.0] * 4
    overturning = own.tire.with_coefficients(QSX3=0.03, UNLOADED_RADIUS=0.3)
    mixed = dataclasses.replace(own, tire=None, front_tire=overturning, rear_tire=own.tire)
    assert compliance(mixed) == [0.0, 0.0, 4e-6, 4e-6]
    assert compliance(mixed, tire_moments="off") == shifted


@pytest.mark.parametrize("name", ["QSY1", "QSY3"])
def test_rolling_resistance_of_tire_and_vehicle_do_not_count_twice(name):
    tire = preset().tire.with_coefficients(**{name: 0.01}, UNLOADED_RADIUS=0.3)
    vehicle = dataclasses.replace(preset(), tire=tire, tire_moments=True)
    Plant.of(vehicle, Options())
    vehicle = vehicle.with_values({"rolling_resistance_coefficient": 0.015})
    with refused("rolling_resistance_coefficient", "0.015", "QSY1", "tire_moments off"):
        Plant.of(vehicle, Options())
    Plant.of(vehicle, Options(tire_moments="off"))
    Plant.of(vehicle, Options("1b"))
    place = "car.yaml: line 7: rolling_resistance_coefficient"
    named = dataclasses.replace(vehicle, stated_at={"rolling_resistance_coefficient": place})
    with refused(place, "QSY1"):
        Plant.of(named, Options())
    for prefix in ("--set ", "vehicle."):  # an option, and the name of a node parameter
        changed = named.with_values({"rolling_resistance_coefficient": 0.01}, prefix)
        with refused(f"{prefix}rolling_resistance_coefficient: 0.01"):
            Plant.of(changed, Options())


def test_camber_leans_the_tops_of_the_wheels_of_an_axle_outwards():
    vehicle = preset().with_values({"front_camber": -0.02, "rear_camber": 0.01})
    assert vehicle.record()["camber"].tolist() == [[0.02, -0.02, -0.01, 0.01]]
    for name in ("front_camber", "rear_camber"):
        for wrong in (-1.2, 2.0):  # degrees
            with pytest.raises(InputError, match=f"^{name}: {wrong} is not allowed"):
                preset().with_values({name: wrong})


def test_a_line_of_the_file_is_named_for_what_does_not_fit_together(vehicle_from, tmp_path):
    text = REFERENCE_YAML + "front_tire_radius: 0.3\n"
    with refused(tmp_path / "some.yaml", line_of(text, "front_tire_radius"), "together with"):
        vehicle_from(text)
    text = REFERENCE_YAML + "rear_tire_pressure: 200000\n"
    with refused(tmp_path / "some.yaml", line_of(text, "rear_tire_pressure"), "version 5.2"):
        vehicle_from(text)


@pytest.fixture
def progressive(pressed) -> Tire:
    """That tire with a vertical force that is progressive."""
    return pressed.with_coefficients(Q_FZ2=12.0)


def test_tires_whose_stiffness_is_that_of_the_file_carry_the_load_by_its_formula(progressive):
    vehicle = without(preset(), *TURNED_OFF, tire=progressive)
    c, change = progressive.coefficients, (2.3e5 - 2.2e5) / 2.2e5
    slope = c["VERTICAL_STIFFNESS"] * c["UNLOADED_RADIUS"] / c["FNOMIN"]
    share = vehicle.static_tire_compression / c["UNLOADED_RADIUS"]
    by_file = (math.sqrt(slope**2 - 4 * 12.0) + 12.0 * share) * share
    by_file *= c["FNOMIN"] * (1 + c["PFZ1"] * change)
    weights = vehicle.sprung_mass * vehicle.axle_load_share + vehicle.per_wheel("unsprung_mass")
    np.testing.assert_allclose(by_file, 9.81 * weights, rtol=1e-13)
    np.testing.assert_allclose(vehicle.static_tire_load, 9.81 * weights, rtol=1e-13)
    found = vehicle.from_tires
    assert found["rear_tire_progression"].source == "Q_FZ2 of the tire file"
    assert "VERTICAL_STIFFNESS" in found["rear_tire_stiffness"].source


def test_a_stiffness_of_the_vehicle_file_is_that_of_a_linear_tire_unless_it_gives_more(progressive):
    linear = without(preset(), "tire_radius", tire=progressive)
    assert linear.per_wheel("tire_progression").tolist() == [0.0] * 4
    assert linear.tire_stiffness_at_rest.tolist() == [2e5] * 4
    given = linear.with_values({"rear_tire_progression": 4.0})
    assert given.per_wheel("tire_progression").tolist() == [0.0, 0.0, 4.0, 4.0]
    assert given.per_wheel("tire_stiffness").tolist() == [2e5] * 4


@pytest.mark.parametrize("progression", [0.0, 1e-6, 2.0, 50.0])
def test_the_stiffness_of_the_file_is_that_at_nominal_load_with_any_progression(
    progressive, progression
):
    given = {f"{axle}_tire_progression": progression for axle in ("front", "rear")}
    vehicle = without(preset().with_values(given), *TURNED_OFF, tire=progressive)
    c, change = progressive.coefficients, (2.3e5 - 2.2e5) / 2.2e5
    harder = 1 + c["PFZ1"] * change
    stiffness = vehicle.per_wheel("tire_stiffness")
    slope = np.sqrt(stiffness**2 + 4 * stiffness * progression * c["FNOMIN"] * harder)
    np.testing.assert_allclose(slope, c["VERTICAL_STIFFNESS"] * harder, rtol=1e-12)


def test_a_degressive_tire_is_linear(pressed):
    vehicle = without(preset(), *TURNED_OFF, tire=pressed.with_coefficients(Q_FZ2=-5.0))
    assert vehicle.per_wheel("tire_progression").tolist() == [0.0] * 4
    change = 1 + 0.7 * (2.3e5 - 2.2e5) / 2.2e5
    np.testing.assert_allclose(vehicle.per_wheel("tire_stiffness"), 2.1e5 * change, rtol=1e-14)


def test_a_progression_out_of_its_range_is_refused_with_its_file(pressed):
    most = (2.1e5 * 0.31 / pressed.coefficients["FNOMIN"]) ** 2 / 4
    with refused("front_tire_progression, from Q_FZ2 of the tire file", "from 0 to 10000 1/m"):
        without(preset(), *TURNED_OFF, tire=pressed.with_coefficients(Q_FZ2=most))
