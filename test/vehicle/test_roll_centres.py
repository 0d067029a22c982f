"""Roll centres as depths below the c.g. or heights above the road: the given value is kept."""

import dataclasses

import numpy as np
import pytest
from vehicle_files import REFERENCE_TIR, REFERENCE_YAML, edited, line_of, refused, write

from vehicle_roll_sim import Simulation, Vehicle, load_vehicle, preset
from vehicle_roll_sim.manoeuvres.catalogue import manoeuvre_named
from vehicle_roll_sim.runs.run import run

HEIGHTS = {"front_roll_centre_height": 0.1, "rear_roll_centre_height": 0.15}
DEPTHS = {"front_roll_centre_depth": 0.65, "rear_roll_centre_depth": 0.60}
"""Roll centre heights of the reference vehicle, whose c.g. is at 0.75 m."""
ROUNDING = 1e-15
"""Tolerance (m) of a difference of numbers below 1."""


def depths(vehicle: Vehicle) -> list[float]:
    """Depths at the front and rear axle, as the equations use them (m)."""
    lf, rf, lr, rr = vehicle.record()[0].roll_centre_depth
    assert (lf, lr) == (rf, rr)
    return [lf, lr]


def with_heights() -> str:
    text = REFERENCE_YAML
    for (depth, _), (height, value) in zip(DEPTHS.items(), HEIGHTS.items(), strict=True):
        text = edited(text, depth, f"{height}: {value}")
    return text


@pytest.fixture
def vehicle_from(tmp_path):
    write(tmp_path, "reference.tir", REFERENCE_TIR)
    return lambda content: load_vehicle(write(tmp_path, "some.yaml", content))


def test_the_depths_of_the_reference_vehicle_reach_the_equations_to_the_bit():
    assert depths(preset()) == [0.65, 0.60]
    assert depths(preset().with_values({"cg_height": 0.7})) == [0.65, 0.60]


def test_heights_of_a_file_are_the_depths_that_they_come_to(vehicle_from):
    vehicle = vehicle_from(with_heights())
    assert {name: getattr(vehicle, name) for name in HEIGHTS} == HEIGHTS
    assert depths(vehicle) == [0.75 - 0.1, 0.75 - 0.15]
    np.testing.assert_allclose(preset().roll_centre_height, vehicle.roll_centre_height, ROUNDING)


@pytest.mark.parametrize("kept", ["heights", "depths"])
def test_what_a_file_gives_is_kept_when_the_cg_is_moved(vehicle_from, kept):
    vehicle = vehicle_from(with_heights() if kept == "heights" else REFERENCE_YAML)
    low = vehicle.with_values({"cg_height": 0.6})
    given = HEIGHTS if kept == "heights" else DEPTHS
    assert {name: low.given[name] for name in given} == given
    expected = [0.6 - 0.1, 0.6 - 0.15] if kept == "heights" else [0.65, 0.60]
    assert depths(low) == expected


def test_a_height_replaces_a_depth_and_a_depth_a_height_of_that_axle_alone():
    one = preset().with_values({"front_roll_centre_height": 0.2})
    assert (one.front_roll_centre_depth, one.rear_roll_centre_height) == (None, None)
    assert depths(one) == [0.75 - 0.2, 0.60]
    assert one.with_values({"front_roll_centre_depth": 0.65}) == preset()


def test_the_same_vehicle_with_depths_is_the_same_to_the_bit():
    vehicle = preset().with_values(HEIGHTS | {"cg_height": 0.61})
    same = vehicle.with_depths()
    assert same.given.keys() == preset().given.keys()
    assert same.record().tobytes() == vehicle.record().tobytes()


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_both_for_an_axle_are_refused_by_both_names(vehicle_from, tmp_path, axle):
    height, depth = f"{axle}_roll_centre_height", f"{axle}_roll_centre_depth"
    text = REFERENCE_YAML + f"{height}: 0.1\n"
    with refused(tmp_path / "some.yaml", line_of(text, depth), height, depth):
        vehicle_from(text)
    with refused(height, depth):
        preset().with_values({height: 0.1, depth: 0.65})
    with refused(height, depth):
        Vehicle(**preset().given, **{height: 0.1}, tire=preset().tire)


@pytest.mark.parametrize("height", [-3.0, 8.1])
def test_a_height_whose_depth_could_not_be_given_is_refused(height):
    """A recording contains depths and must be able to describe every vehicle."""
    values = {"cg_height": 48.0 if height < 0.0 else 3.0, "rear_roll_centre_height": height}
    with refused("rear_roll_centre_height", f"{height}", "with the c.g. at"):
        preset().with_values(values)


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_none_for_an_axle_is_refused_by_both_names(vehicle_from, tmp_path, axle):
    height, depth = f"{axle}_roll_centre_height", f"{axle}_roll_centre_depth"
    with refused(tmp_path / "some.yaml", height, depth, "missing"):
        vehicle_from(edited(REFERENCE_YAML, depth, ""))
    values = {name: value for name, value in preset().given.items() if name != depth}
    with refused(height, depth, "missing"):
        Vehicle(**values, tire=preset().tire)


def fishhook_at_45_mph(values: dict) -> tuple[float, str]:
    """Peak roll (deg) and two-wheel lift of the reference vehicle with its c.g. at 0.6 m."""
    vehicle = preset().with_values({"cg_height": 0.6} | values)
    simulation = Simulation(vehicle)
    hook = dataclasses.replace(
        manoeuvre_named("nhtsa_fishhook"), speed=45 * 0.44704, steering_at_03g=19.26
    ).for_vehicle(vehicle, simulation.options)
    simulation.reset(hook.speed)
    driver = hook.driver()
    history = run(simulation, driver, hook.duration)
    peak = float(np.degrees(np.abs(history["roll"]).max()))
    return peak, hook.report(history, driver)["two-wheel lift"]


def test_a_fishhook_tells_roll_centres_that_stay_from_those_that_sink_with_the_cg():
    peak, lift = fishhook_at_45_mph(HEIGHTS)
    assert (peak, lift) == (pytest.approx(11.2, abs=0.1), "none")
    peak, lift = fishhook_at_45_mph({})
    assert peak > 85.0
    assert float(lift.split()[0]) == pytest.approx(2.93, abs=0.02)
