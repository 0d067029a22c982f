"""The catalogue and the spread: every test can be driven with every variant."""

import itertools
from pathlib import Path

import pytest
from scored import make_setup

from benchmarks.scores import BEGIN, CONTROLLERS, replaced
from vehicle_roll_sim import preset
from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.manoeuvres.base import SIDES
from vehicle_roll_sim.scoring.catalogue import TESTS
from vehicle_roll_sim.scoring.plan import ladders
from vehicle_roll_sim.scoring.spread import NOMINAL, SPREAD
from vehicle_roll_sim.vehicle.sensor_parameters import devices_of

PAGE = Path(__file__).parents[2] / "docs" / "scores.md"
CARS = ("reference", "small_sedan", "large_sedan", "suv", "van", "delivery_truck", "city_bus")


def test_levels_rise_and_those_of_the_quick_size_are_among_them():
    for name, test in TESTS.items():
        for levels in (test.levels, test.quick):
            assert list(levels) == sorted(set(levels)), name
        assert test.levels
        if name in ("fishhook", "j_turn"):
            assert {35.0, 45.0, 50.0} <= {*test.levels}  # of the standard
        assert all(test.levels[0] <= level <= test.levels[-1] for level in test.quick)


def test_a_score_has_every_test_with_every_variant_to_each_side_once():
    found = [(each.test, each.variant, each.side) for each in ladders((), False)]
    assert found[0][1] == NOMINAL
    assert len(found) == len(set(found))
    assert {*found} == {*itertools.product(TESTS, SPREAD, SIDES)}


def test_the_quick_size_is_a_part_of_it():
    quick, full = ladders((), True), ladders((), False)
    parts = {(each.test, each.variant, each.side) for each in full}
    assert {(each.test, each.variant, each.side) for each in quick} < parts
    assert {each.variant for each in ladders(["step"], True)} >= {NOMINAL}


def test_an_unknown_test_is_refused_with_the_nearest_name():
    with pytest.raises(InputError, match="did you mean fishhook"):
        ladders(["fishook"], True)


@pytest.mark.parametrize("car", CARS)
def test_every_variant_of_a_vehicle_is_possible_and_the_nominal_one_is_itself(car):
    vehicle = preset(car)
    assert SPREAD[NOMINAL].of(vehicle) is vehicle
    for variant in SPREAD.values():
        variant.of(vehicle)


def test_variants_change_what_they_say():
    vehicle = preset()
    heavy, slow = SPREAD["heavy"].of(vehicle), SPREAD["slow_actuators"].of(vehicle)
    assert heavy.sprung_mass == 1.15 * vehicle.sprung_mass
    assert slow.brake_torque_actuator_dead_time == 0.05
    less = SPREAD["grip_less"].of(vehicle).axle_tires["rear"].coefficients
    assert set(devices_of(SPREAD["noisy_imu"].of(vehicle))) == {"imu"}
    assert less["LMUY"] == 0.85 * vehicle.axle_tires["rear"].coefficients["LMUY"]
    assert "sprung_mass × 1.15" in SPREAD["heavy"].changes


def test_the_page_names_every_test_and_has_a_row_for_every_example_that_is_scored():
    page = PAGE.read_text(encoding="utf-8")
    assert all(f"`{name}`" in page for name in TESTS)
    summary = replaced(page, "## Summary\n\nnew\n\n## Worst runs\n")
    assert "\n### Summary\n\nnew\n" in summary
    assert page.partition(BEGIN)[0] in summary
    shown = page.partition(BEGIN)[2]
    assert all(f"| `{name}` |" in shown for name in CONTROLLERS)


def test_sides_are_mirror_images():
    setup = make_setup()
    found = {each.side: each for each in ladders(["sine_with_dwell"], False)[:2]}
    left, right = (found[side].manoeuvre(setup, 2.5) for side in ("left", "right"))
    assert left.amplitude == -right.amplitude > 0.0
    lanes = {each.side: each for each in ladders(["lane_change"], False)[:2]}
    assert lanes["left"].manoeuvre(setup, 80.0).cones[:, 1].max() > 0.0
    mirrored = -lanes["right"].manoeuvre(setup, 80.0).cones[:, 1]
    assert sorted(mirrored) == pytest.approx(
        sorted(lanes["left"].manoeuvre(setup, 80.0).cones[:, 1]), abs=1e-12
    )
