"""Curves over wheel travel: through the points, smooth, straight outside, and no detours."""

import dataclasses
import itertools
import math

import numpy as np
import pytest
from vehicle_files import REFERENCE_YAML, refused, write

from vehicle_roll_sim import load_vehicle, preset
from vehicle_roll_sim.model.work_space import KNOTS
from vehicle_roll_sim.vehicle.travel_curves import (
    TravelCurve,
    _knots_and_ends,
    _piece,
    tabulated,
)

SMOOTH = tuple((q, math.sin(4 * q) + 0.3 * q) for q in np.linspace(-0.15, 0.2, 15).tolist())
STEPPED = ((-0.1, -0.05), (-0.05, -0.05), (-0.01, -0.04), (0.0, 0.0), (0.01, 0.05), (0.1, 0.06))
TABLES = {
    "smooth": SMOOTH,
    "stepped": STEPPED,
    "two points": ((-0.1, -0.02), (0.1, 0.04)),
    "hill": ((-0.1, 0.0), (-0.02, 0.04), (0.05, 0.041), (0.1, 0.0)),
    "level": ((-0.1, 0.0), (0.0, 0.0), (0.05, 0.0), (0.1, 0.1), (0.15, 0.1)),
}


@pytest.fixture(params=TABLES)
def table(request) -> tuple:
    return TABLES[request.param]


def at(curve: TravelCurve, travel: float, order: int = 0) -> float:
    piece = np.polynomial.Polynomial(curve.piece(0.01, travel))
    return float(piece.deriv(order)(travel - 0.01) if order else piece(travel - 0.01))


def test_the_curve_goes_through_its_points_counted_from_that_at_rest(table):
    curve = TravelCurve(table)
    assert at(curve, 0.0) == pytest.approx(0.0, abs=1e-15)
    (first, start), *others = table
    for travel, value in others:
        rise = at(curve, travel) - at(curve, first)
        assert rise == pytest.approx(value - start, abs=1e-13)


def test_value_slope_and_bend_are_continuous_and_it_is_straight_outside(table):
    curve = TravelCurve(table)
    for travel, _ in table:
        before, after = curve.piece(travel, travel - 1e-9), curve.piece(travel, travel + 1e-9)
        np.testing.assert_allclose(before[:3], after[:3], rtol=0, atol=1e-9)
    for beyond in (table[0][0] - 0.3, table[-1][0] + 0.3):
        assert at(curve, beyond, 2) == pytest.approx(0.0, abs=1e-12)


def test_it_rises_or_falls_as_the_points_around_do_and_is_level_where_two_are(table):
    curve, chords = TravelCurve(table), np.sign(np.diff([value for _, value in table]))
    around = [chords[0], *chords, chords[-1]]
    for i, (start, end) in enumerate(itertools.pairwise(table)):
        slopes = [at(curve, q, 1) for q in np.linspace(start[0], end[0], 200)[1:-1]]
        if chords[i] == 0.0:
            assert np.abs(slopes).max() < 1e-12
        elif around[i] == around[i + 2] == chords[i]:
            assert (np.array(slopes) * chords[i]).min() > -1e-9


def test_between_the_points_of_a_smooth_function_it_is_that_function():
    curve, inside = TravelCurve(SMOOTH), np.linspace(-0.1, 0.15, 300)
    errors = [at(curve, q) - (math.sin(4 * q) + 0.3 * q) for q in inside]
    assert np.abs(errors).max() < 1e-6


def test_a_number_is_a_straight_line():
    curve = TravelCurve(-0.4)
    assert len(curve.knots) == 0
    np.testing.assert_allclose(curve.piece(0.2, 0.7), [-0.08, -0.4, 0, 0, 0, 0], atol=1e-17)


@pytest.mark.parametrize("slope", [-0.4, 0.3, 1.0, 0.0, -0.0])
def test_a_line_has_the_bits_of_the_polynomials_between_and_beside_its_points(slope):
    """Of the points 0 and 1, as if they were a table."""
    points = np.array([(0.0, 0.0), (1.0, slope)]).tobytes()
    for is_change in (True, False):
        curve, table = TravelCurve(slope, is_change), _knots_and_ends(points, is_change)
        for origin, inside in itertools.product((0.0, -0.3, 0.7, 1.0, 1.7), (-1.0, 0.0, 0.4, 1.0)):
            expected = _piece(*table, origin, inside)
            assert curve.piece(origin, inside).tobytes() == expected.tobytes()


def test_the_table_of_an_axle_holds_all_its_curves():
    curves = [TravelCurve(SMOOTH), TravelCurve(STEPPED), TravelCurve(0.3)]
    knots, origins, coefficients = tabulated(curves)
    for travel in np.linspace(-0.3, 0.3, 101):
        row = int((knots <= travel).sum())
        for k, curve in enumerate(curves):
            value = np.polynomial.Polynomial(coefficients[row, :, k])(travel - origins[row])
            assert value == pytest.approx(at(curve, travel), abs=1e-11)


def test_curves_that_differ_in_a_bit_or_in_kind_are_not_taken_for_each_other():
    points = ((0.0, 0.0), (1.0, 0.3))
    counted, line = TravelCurve(((0.0, 0.1), (1.0, 0.3))), TravelCurve(0.3)
    table, nearly = TravelCurve(points), TravelCurve(np.nextafter(0.3, 1.0).item())
    not_counted = TravelCurve(((0.0, 0.1), (1.0, 0.3)), is_change=False)
    found = [tabulated([each]) for each in (counted, line, table, nearly, not_counted)]
    texts = [(knots.tobytes(), pieces.tobytes()) for knots, _, pieces in found]
    assert len(set(texts)) == len(texts)
    again = tabulated([TravelCurve(points)])
    assert all(one is other for one, other in zip(again, found[2], strict=True))
    with pytest.raises(ValueError, match="read-only"):
        again[2][0] = 1.0


GOOD = "[[-0.1, 0.02], [0.0, 0.0], [0.1, -0.03]]"


@pytest.fixture
def vehicle_with(tmp_path):
    """Loads the reference vehicle with a front camber change."""
    text = REFERENCE_YAML.replace("reference.tir", "reference")
    return lambda value: load_vehicle(
        write(tmp_path, "car.yaml", f"{text}front_camber_change: {value}\n")
    )


def test_a_vehicle_file_has_tables_as_pairs_or_as_their_numbers_in_a_row(vehicle_with):
    points = ((-0.1, 0.02), (0.0, 0.0), (0.1, -0.03))
    assert vehicle_with(GOOD).front_camber_change == points
    assert vehicle_with("[-0.1, 0.02, 0, 0, 0.1, -0.03]").front_camber_change == points
    assert vehicle_with("-0.4").front_camber_change == -0.4


@pytest.mark.parametrize(
    "value",
    [
        *("[]", "[[0, 0]]", "[[0, 0], [0, 1]]", "[[0.1, 0], [0, 1]]", "[[0, 0], [1, 2, 3]]"),
        *("[[0, 0], [.nan, 1]]", "[[0, 0], [0.1, 99]]", "[[0, 0], [9, 1]]", "[0, 0, 1]"),
        *("[[0, 0], [0.1, many]]", "[{a: 1}, 2]", str([[k / 100, 0] for k in range(70)])),
    ],
)
def test_a_table_that_is_none_is_refused(vehicle_with, value):
    with refused("front_camber_change", "pairs [travel, value]"):
        vehicle_with(value)


def test_tables_of_an_axle_share_so_many_travels():
    half = [tuple((k / 500 + shift, 0.0) for k in range(40)) for shift in (0.0, 0.0005)]
    both = {"front_camber_change": half[0], "front_toe_change": half[1]}
    with refused("front_camber_change", "80", KNOTS):
        preset().with_values(both)


def test_a_bar_has_one_stiffness_in_either_spelling():
    in_roll = preset().with_values({"rear_anti_roll_bar_stiffness": 22_500.0})
    np.testing.assert_allclose(in_roll.bar_rate, [0, 0, 10_000, 10_000])
    at_wheels = in_roll.with_values({"rear_anti_roll_bar_rate": 1.0})  # in place of the other
    np.testing.assert_allclose(at_wheels.bar_rate, [0, 0, 1, 1])
    with refused("rear_anti_roll_bar_stiffness", "rear_anti_roll_bar_rate"):
        dataclasses.replace(in_roll, rear_anti_roll_bar_rate=1.0)


def test_angles_in_degrees_are_refused():
    with refused("front_camber_change", "-1 to 1 rad"):
        preset().with_values({"front_camber_change": ((-0.1, 3.0), (0.1, -4.0))})
