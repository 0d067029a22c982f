"""The record VEHICLE: each field has the value of its parameter, and none is left at zero."""

import numpy as np
import pytest

from vehicle_roll_sim import preset
from vehicle_roll_sim.model.records import VEHICLE


def test_the_values_reach_the_equations_at_the_right_wheels():
    record = preset().with_values({"front_track": 1.4, "rear_track": 1.6}).record()[0]
    np.testing.assert_array_equal(record.x, [1.016, 1.016, -1.524, -1.524])
    np.testing.assert_array_equal(record.y, [0.7, -0.7, 0.8, -0.8])
    np.testing.assert_array_equal(record.spring_stiffness, [35e3, 35e3, 30e3, 30e3])
    np.testing.assert_array_equal(record.damping, [2500.0, 2500.0, 2000.0, 2000.0])
    np.testing.assert_array_equal(record.roll_centre_depth, [0.65, 0.65, 0.60, 0.60])
    share = np.array([1.524, 1.524, 1.016, 1.016]) / (2 * 2.54)
    at_rest = 1440.0 * 9.81 * share / record.spring_stiffness  # (19)
    np.testing.assert_allclose(record.static_suspension_compression, at_rest, rtol=1e-14)


@pytest.mark.parametrize("shape", [(), (4,)])
def test_a_field_of_the_equations_that_the_vehicle_does_not_have_is_no_silent_zero(
    monkeypatch, shape
):
    fields = [(name, VEHICLE[name]) for name in VEHICLE.names]
    longer = np.dtype([*fields, ("anti_roll_stiffness", float, shape)])
    monkeypatch.setattr("vehicle_roll_sim.vehicle.vehicle_record.VEHICLE", longer)
    with pytest.raises(AttributeError, match="anti_roll_stiffness"):
        preset().record()


def test_a_field_of_the_equations_comes_from_the_parameters_of_its_name(monkeypatch):
    longer = np.dtype([("drag_area", float), ("track", float, 4)])
    monkeypatch.setattr("vehicle_roll_sim.vehicle.vehicle_record.VEHICLE", longer)
    vehicle = preset().with_values({"drag_area": 0.7, "front_track": 1.4, "rear_track": 1.6})
    (record,) = vehicle.record()
    assert record["drag_area"] == 0.7
    assert record["track"].tolist() == [1.4, 1.4, 1.6, 1.6]
