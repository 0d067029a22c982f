"""The sprung mass from data of the whole vehicle, and with payload, against sums by hand."""

import dataclasses

import numpy as np
import pytest

from vehicle_roll_sim import InputError, Options, load_vehicle, preset
from vehicle_roll_sim.vehicle.masses import Load

G = 9.81
BOX = Load(90.0, behind_front_axle=1.4, height=1.7)
"""A roof box, taken as a point."""
DRIVER = Load(
    80.0, 1.2, 0.6, left_of_middle=0.35, roll_inertia=6.0, pitch_inertia=7.0, yaw_inertia=3.0
)
UNEQUAL = {
    "rear_track": 1.45,
    "rear_unsprung_mass": 60.0,
    "rear_tire_stiffness": 180e3,
    "cg_height": 0.7,
}


def whole_of(vehicle) -> dict:
    """Mass, c.g. and inertias of a vehicle, summed up over its five masses one by one."""
    height = vehicle.per_wheel("tire_radius") - vehicle.static_tire_compression
    front, rear = vehicle.cg_to_front_axle, vehicle.cg_to_rear_axle
    parts = [(vehicle.sprung_mass, 0.0, 0.0, vehicle.cg_height)]
    for i, (x, side) in enumerate(((front, 1), (front, -1), (-rear, 1), (-rear, -1))):
        y = side * vehicle.per_wheel("track")[i] / 2 - (vehicle.cg_offset or 0.0)
        parts.append((vehicle.per_wheel("unsprung_mass")[i], x, y, height[i]))
    mass = sum(part[0] for part in parts)
    x, y, z = (sum(part[0] * part[axis] for part in parts) / mass for axis in (1, 2, 3))
    away = [(m, px - x, py - y, pz - z) for m, px, py, pz in parts]
    return {
        "total_mass": mass,
        "total_cg_to_front_axle": front - x,
        "total_cg_to_rear_axle": rear + x,
        "total_cg_height": z,
        "total_cg_offset": (vehicle.cg_offset or 0.0) + y,
        "total_roll_inertia": vehicle.roll_inertia + sum(m * (b**2 + c**2) for m, a, b, c in away),
        "total_pitch_inertia": vehicle.pitch_inertia
        + sum(m * (a**2 + c**2) for m, a, b, c in away),
        "total_yaw_inertia": vehicle.yaw_inertia + sum(m * (a**2 + b**2) for m, a, b, c in away),
        "total_roll_yaw_product": (vehicle.roll_yaw_product or 0.0)
        + sum(m * a * c for m, a, b, c in away),
    }


@pytest.fixture(scope="module")
def lopsided():
    return preset().with_values(UNEQUAL | {"cg_offset": 0.04, "roll_yaw_product": -30.0})


def test_the_sprung_mass_is_what_is_left_of_the_whole_without_the_wheels(lopsided):
    vehicle = lopsided.with_values(whole_of(lopsided))
    assert vehicle.given["total_mass"] == 1440 + 2 * 80 + 2 * 60
    assert "sprung_mass" not in vehicle.given
    for name in ("sprung_mass", "cg_height", "cg_offset", "cg_to_front_axle", "cg_to_rear_axle"):
        assert getattr(vehicle, name) == pytest.approx(getattr(lopsided, name), rel=1e-12)
    for name, value in lopsided.inertias.items():
        assert vehicle.inertias[name] == pytest.approx(value, rel=1e-11, abs=1e-9)


@pytest.mark.parametrize("names", [("total_yaw_inertia",), ("total_mass", "total_pitch_inertia")])
def test_some_values_of_the_whole_go_with_others_of_the_sprung_mass(lopsided, names):
    whole = whole_of(lopsided)
    vehicle = lopsided.with_values({name: whole[name] for name in names})
    for name in ("sprung_mass", *lopsided.inertias):
        expected = getattr(lopsided, name) or 0.0
        assert (getattr(vehicle, name) or 0.0) == pytest.approx(expected, rel=1e-11, abs=1e-9)


def test_a_load_adds_to_mass_and_inertia_as_a_point_on_a_rigid_body_does():
    """Two masses m and M a distance apart add m M / (m + M) times its square."""
    empty, loaded = preset(), dataclasses.replace(preset(), payload=(BOX,))
    reduced = 1440 * 90 / 1530
    ahead, above = -(1.4 - 1.016), 1.7 - 0.75
    assert loaded.sprung_mass == 1530.0
    assert loaded.cg_to_front_axle == pytest.approx((1440 * 1.016 + 90 * 1.4) / 1530)
    assert loaded.cg_to_front_axle + loaded.cg_to_rear_axle == pytest.approx(2.54)
    assert loaded.roll_inertia == pytest.approx(900 + reduced * above**2)
    assert loaded.pitch_inertia == pytest.approx(2000 + reduced * (above**2 + ahead**2))
    assert loaded.yaw_inertia == pytest.approx(2000 + reduced * ahead**2)
    assert loaded.roll_yaw_product == pytest.approx(reduced * ahead * above)
    assert loaded.cg_offset is None
    assert loaded.given == empty.given


def test_a_vehicle_sinks_under_its_load_and_its_roll_centres_with_it():
    empty, loaded = preset(), dataclasses.replace(preset(), payload=(BOX,))
    rear = 90 * 1.4 / 2.54  # kg on the rear axle
    front = (90 - rear) * G / 2 * (1 / 35e3 + 1 / 200e3)
    rear *= G / 2 * (1 / 30e3 + 1 / 200e3)
    share = loaded.cg_to_front_axle / 2.54
    sinking = front * (1 - share) + rear * share
    before = (1440 * 0.75 + 90 * 1.7) / 1530
    assert loaded.cg_height == pytest.approx(before - sinking)
    np.testing.assert_allclose(
        loaded.roll_centre_height, empty.roll_centre_height - sinking, rtol=0, atol=1e-12
    )


def test_own_inertia_and_place_beside_the_middle_give_products_of_inertia():
    loaded = dataclasses.replace(preset(), payload=(DRIVER,))
    reduced = 1440 * 80 / 1520
    ahead, left, above = -(1.2 - 1.016), 0.35, 0.6 - 0.75
    assert loaded.cg_offset == pytest.approx(80 * 0.35 / 1520)
    assert loaded.roll_inertia == pytest.approx(900 + 6 + reduced * (left**2 + above**2))
    assert loaded.pitch_inertia == pytest.approx(2000 + 7 + reduced * (ahead**2 + above**2))
    assert loaded.roll_pitch_product == pytest.approx(reduced * ahead * left)
    assert loaded.pitch_yaw_product == pytest.approx(reduced * left * above)


def test_loads_and_wheels_are_in_balance_about_a_c_g_beside_the_middle(lopsided):
    record = lopsided.record()[0]
    assert record.axle_load_share.sum() == pytest.approx(1.0)
    assert record.axle_load_share @ record.y == pytest.approx(0.0, abs=1e-15)
    assert record.axle_load_share @ record.x == pytest.approx(0.0, abs=1e-15)
    assert record.y == pytest.approx([0.71, -0.79, 0.685, -0.765])


def test_a_loaded_vehicle_is_changed_by_its_given_values_and_written_down_without_its_load():
    loaded = dataclasses.replace(preset(), payload=(BOX, DRIVER))
    heavier = loaded.with_values({"sprung_mass": 1500.0})
    assert heavier.sprung_mass == 1670.0
    assert heavier.with_values({"sprung_mass": 1440.0}) == loaded
    assert dataclasses.replace(loaded, tire=loaded.tire) == loaded
    alone = loaded.with_depths()
    assert (alone.payload, alone.origin) == ((), None)
    assert alone.record() == loaded.record()
    with pytest.raises(InputError, match=r"cg_height: 0\.7 is not allowed: unchanged, since"):
        dataclasses.replace(loaded, cg_height=0.7)


@pytest.mark.parametrize(
    ("told", "values"),
    {
        "total_mass: 300.0 is not allowed: more than the unsprung masses together, 320 kg": {
            "total_mass": 300.0
        },
        "total_yaw_inertia: 600.0 is not allowed: more than 713.019 kg m^2": {
            "total_yaw_inertia": 600.0
        },
        "total_yaw_inertia: 4000 leaves 3286.98 kg m^2 for the sprung mass": {
            "total_yaw_inertia": 4000.0
        },
        "total_cg_to_front_axle: 1.1 together with cg_to_rear_axle 1.524: together with": {
            "total_cg_to_front_axle": 1.1
        },
        "total_cg_offset: 0.1 together with cg_offset 0.2: only one": {
            "cg_offset": 0.2,
            "total_cg_offset": 0.1,
        },
        "cg_offset: it puts the sprung c.g. -0.75 m to the left of the middle: less than half the "
        "smaller track, 0.75 m, to either side": {"cg_offset": -0.75, "front_track": 1.8},
        "total_cg_offset: it puts the sprung c.g. 0.855556 m to": {"total_cg_offset": 0.7},
        "roll_yaw_product: 900.0 is not allowed: from -835.165 to 835.165 kg m^2": {
            "roll_yaw_product": 900.0
        },
        "yaw_inertia: 3000.0 is not allowed: at most the sum of the other two moments of inertia, "
        "2900 kg m^2; it is 100 kg m^2 (3.4 %) more: give the yaw inertia of the sprung mass "
        "alone, or that of the whole vehicle as total_yaw_inertia": {"yaw_inertia": 3000.0},
    }.items(),
)
def test_what_no_vehicle_can_have_is_refused_with_the_reason(told, values):
    with pytest.raises(InputError) as caught:
        preset().with_values(values)
    assert str(caught.value).startswith(told)


@pytest.mark.parametrize(
    ("model", "values", "name"),
    [
        ("8dof", {"cg_offset": 0.02}, "cg_offset"),
        ("8dof-rigid-tires", {"roll_pitch_product": 5.0}, "roll_pitch_product"),
        ("8dof", {"roll_yaw_product": 5.0}, "roll_yaw_product"),
    ],
)
def test_a_model_that_cannot_take_a_mass_refuses_it(model, values, name):
    with pytest.raises(InputError, match=f"^{name}: .* 0 in model {model}; .* takes it"):
        Options(model=model).for_vehicle(preset().with_values(values))
    for other in ("1", "1b", "2"):
        Options(model=other).for_vehicle(preset().with_values(values))


LOADED = "payload:\n  - {mass: 90, behind_front_axle: 1.4, height: 1.7}\n"


@pytest.fixture
def in_a_file(tmp_path):
    """Reads the reference vehicle with further lines at the end of its file."""

    def read(lines: str):
        file = tmp_path / "car.yaml"
        lines_of_preset = (f"{name}: {value!r}\n" for name, value in preset().given.items())
        file.write_text("".join(lines_of_preset) + "tire: reference\n" + lines)
        return load_vehicle(file)

    return read


def test_a_vehicle_file_lists_its_loads(in_a_file):
    assert in_a_file(LOADED).payload == (BOX,)


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        ("payload: 90\n", "payload: 90 is not allowed: a list of masses, each with mass, behind"),
        (LOADED.replace("height", "hight"), "payload: mass 1: name: 'hight' is unknown: did you"),
        (LOADED.replace(", height: 1.7", ""), "payload: mass 1: height: missing: all are req"),
        (LOADED.replace("90", "-90"), "payload: mass 1: mass: -90 is not allowed: a number from"),
        (LOADED.replace("1.7", "1.7, yaw_inertia: 3"), "mass 1: yaw_inertia: 3.0 is not allowed"),
    ],
)
def test_a_load_that_is_wrong_is_refused_by_line_and_number(in_a_file, lines, told):
    with pytest.raises(InputError) as caught:
        in_a_file(lines)
    assert told in str(caught.value)
    assert "car.yaml: line " in str(caught.value)
