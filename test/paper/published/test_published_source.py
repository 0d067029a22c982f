"""The files of published numbers, and the vehicles that are made of them."""

import math

import numpy as np
import pytest

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.paper.published.reruns import RERUNS
from vehicle_roll_sim.paper.published.source import numbers, read
from vehicle_roll_sim.vehicle.tire_evaluation import evaluate

INCH, POUND = 0.0254, 0.45359237
TEXT = """
source: {authors: A. Author, title: On a car, year: 1999, read_in: the printed book}
base: suv
columns: {front_track: in, rear_track: in, wheelbase: in, total_mass: lb,
  total_cg_to_front_axle: in, total_cg_height: in, ratio: "-"}
vehicles:
  car: [60.0, 62.0, 110.0, 4000.0, 50.0, 25.0, 1.22]
  other: [60.0, 62.0, 110.0, 4000.0, 50.0, 30.0, 1.9]
numbers:
  - quantity: T/2h
    unit: "-"
    rerun: static_stability_factor
    place: p. 3
    published: ratio
    tolerance: 0.01
    because: of rounding
    not_judged: {other: misprinted}
  - quantity: another
    unit: "-"
    rerun: static_stability_factor
    place: p. 4
    vehicles: [car]
    values: {total_cg_height: 20.0}
    published: ratio
    because: of interest
"""


@pytest.fixture
def found(tmp_path):
    (tmp_path / "numbers.yaml").write_text(TEXT)
    return read(tmp_path / "numbers.yaml")


def test_each_number_has_its_source_place_and_reason(found):
    assert [(one.name, one.quantity, one.place) for one in found] == [
        ("car", "T/2h", "p. 3"),
        ("other", "T/2h", "p. 3"),
        ("car", "another", "p. 4"),
    ]
    assert [one.published for one in found] == [1.22, 1.9, 1.22]
    assert [one.tolerance for one in found] == [0.01, None, None]
    assert [one.because for one in found] == ["of rounding", "misprinted", "of interest"]
    assert str(found[0].source) == "A. Author (1999): On a car. Read in the printed book."


def test_columns_are_converted_and_the_wheelbase_gives_the_rear_axle(found):
    vehicle = found[0].vehicle
    plane = RollPlane(vehicle.record(), suspended=False)
    assert plane.weight == pytest.approx(4000 * POUND * 9.81)
    assert plane.cg_height == pytest.approx(25 * INCH)
    assert plane.track == pytest.approx(61 * INCH)
    assert vehicle.given["total_cg_to_front_axle"] == pytest.approx(50 * INCH)
    assert vehicle.given["total_cg_to_rear_axle"] == pytest.approx(60 * INCH)
    changed = RollPlane(found[2].vehicle.record(), suspended=False)
    assert changed.cg_height == pytest.approx(20 * INCH)


def test_a_value_that_no_vehicle_has_is_refused(tmp_path):
    (tmp_path / "numbers.yaml").write_text(TEXT.replace("[60.0", "[-60.0"))
    with pytest.raises(InputError, match=r"front_track: -1\.524 is not allowed"):
        read(tmp_path / "numbers.yaml")


def test_cornering_stiffness_is_the_published_one_times_the_load():
    """A compliance in deg/g is the slip angle whose force is the load; PKY1 force per load."""
    found = {one.name: one.vehicle.axle_tires for one in numbers()}
    honda, escort = found["Honda Civic Si Coupe 2012"], found["Ford Escort"]
    slip = math.radians(0.01)  # at which the formula is straight to 1e-4
    for tire, stiffness in (
        (honda["front"], math.degrees(1 / 9.6)),
        (honda["rear"], math.degrees(1 / 4.1)),
        (escort["front"], 21.92),
        (escort["rear"], 21.92),
    ):
        loads = np.array([1500.0, 4000.0])
        forces = evaluate(tire, loads, 0.0, slip).lateral_force
        np.testing.assert_allclose(np.abs(forces), loads * stiffness * slip, rtol=1e-4)


def test_every_number_says_where_it_is_from_and_can_be_computed():
    found = numbers()
    assert len({str(one.source) for one in found}) >= 3
    for one in found:
        assert all((one.source.authors, one.source.title, one.source.read_in, one.place))
        assert one.because
        assert one.rerun in RERUNS
        assert np.isfinite(one.published)
        assert one.tolerance is None or one.tolerance > 0.0
    assert {one.rerun for one in found} == RERUNS.keys()
    named = [(one.source, one.quantity, one.name) for one in found]
    assert len(named) == len(set(named))
