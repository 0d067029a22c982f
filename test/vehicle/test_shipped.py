"""The vehicles that come with the package: origins, conversions, plausibility, stored speeds."""

import dataclasses
import math
import re

import pytest

from vehicle_roll_sim import InputError, Options, preset
from vehicle_roll_sim.manoeuvres.criteria import two_wheel_lift
from vehicle_roll_sim.manoeuvres.series.base import driven
from vehicle_roll_sim.manoeuvres.series.catalogue import series_named
from vehicle_roll_sim.vehicle.combinations import combinations
from vehicle_roll_sim.vehicle.plausibility import plausibility
from vehicle_roll_sim.vehicle.shipped import SHIPPED, lift_speeds, vehicle_named
from vehicle_roll_sim.vehicle.vehicle_file import PRESETS

VALUE = re.compile(r"[\w-]+: \S+.*")
SLUG, FOOT, POUND = 14.593903, 0.3048, 4.4482216
"""kg, m, N"""
OTHERS = [name for name in SHIPPED if name != "reference"]


@pytest.mark.parametrize("name", SHIPPED)
def test_every_shipped_vehicle_is_plausible(name):
    vehicle = preset(name)
    assert plausibility(vehicle) == []
    assert combinations(vehicle) == []


def test_each_is_read_once_and_what_is_done_to_one_does_nothing_to_the_next(monkeypatch):
    changed = preset()
    monkeypatch.setattr("vehicle_roll_sim.vehicle.vehicle_file.load_vehicle", None)
    changed.tire.coefficients["PDY1"] *= 2.0
    object.__setattr__(changed, "cg_height", 2.0)
    assert changed != preset()
    assert preset().tire.coefficients["PDY1"] == changed.tire.coefficients["PDY1"] / 2.0
    assert preset().cg_height == 0.75


def test_each_has_its_file_and_each_file_its_name():
    assert {*SHIPPED} == {path.stem for path in PRESETS.iterdir() if path.name.endswith(".yaml")}


@pytest.mark.parametrize("name", OTHERS)
def test_every_number_has_its_origin(name):
    lines = (PRESETS / f"{name}.yaml").read_text().splitlines()
    values = [line for line in lines if VALUE.fullmatch(line)]
    assert len(values) > 20
    assert all(" # " in line for line in values)
    assert lines[0].startswith("# ")


@pytest.mark.parametrize("path", [p for p in PRESETS.iterdir() if p.name.endswith(".tir")])
def test_every_tire_file_says_what_it_is(path):
    assert path.read_text().startswith("$ ")


def test_pounds_feet_and_seconds_became_si_units():
    car, van = preset("small_sedan"), preset("van")
    assert car.sprung_mass == pytest.approx(75 * SLUG, rel=1e-5)
    assert car.front_unsprung_mass == pytest.approx(4.5 * SLUG / 2, rel=1e-4)
    assert car.cg_to_rear_axle == pytest.approx(4.95 * FOOT, rel=1e-4)
    assert car.pitch_inertia == pytest.approx(990 * POUND * FOOT, rel=1e-4)
    assert car.rear_spring_stiffness == pytest.approx(1500 * POUND / FOOT, rel=1e-4)
    assert van.front_anti_roll_bar_stiffness == pytest.approx(25038.92 * POUND * FOOT, rel=1e-4)
    assert van.given["total_yaw_inertia"] == pytest.approx(1824.078 * POUND * FOOT, rel=1e-4)
    assert van.mass == pytest.approx(101.3367 * SLUG, rel=1e-4)


@pytest.mark.parametrize("name", ["suv", "delivery_truck"])
def test_two_wheels_lift_at_the_stored_speed_and_not_much_below(name):
    """By the resolution of the search, 0.1 m/s. `benchmarks/two_wheel_lift.py` finds them all."""
    vehicle, options = preset(name), Options(model="2")
    ready = series_named("nhtsa_fishhook", is_search=True).manoeuvre.for_vehicle(vehicle, options)
    lifts = []
    for speed in (lift_speeds()[name] - 0.1, lift_speeds()[name] + 1e-4):
        manoeuvre = dataclasses.replace(ready, speed=speed).for_vehicle(vehicle, options)
        _, history = driven(manoeuvre, vehicle, options)
        lifts.append(two_wheel_lift(history))
    assert math.isnan(lifts[0])
    assert lifts[1] > 0.0


def test_each_has_its_stored_speed():
    assert [*lift_speeds()] == [*SHIPPED]


def test_a_file_comes_before_a_shipped_vehicle(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert vehicle_named("suv") == preset("suv")
    text = (PRESETS / "reference.yaml").read_text().replace("reference.tir", "reference")
    (tmp_path / "suv").write_text(text)
    assert vehicle_named("suv") == preset()
    with pytest.raises(InputError, match=r"^vehicle: bus does not exist: .* city_bus, "):
        vehicle_named("bus")
    with pytest.raises(InputError, match=r"^file bus\.yaml: No such file"):
        vehicle_named("bus.yaml")
