"""The soil trip against a rigid block and the balance of momentum."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import Condition, InputError, Options, preset, run

STIFF = {
    "cg_to_front_axle": 1.27,
    "cg_to_rear_axle": 1.27,
    **{f"{axle}_damping": 8e3 for axle in ("front", "rear")},
    **{f"{axle}_roll_centre_depth": 0.6 for axle in ("front", "rear")},
    **{f"{axle}_spring_stiffness": 1e6 for axle in ("front", "rear")},
    **{f"{axle}_tire_stiffness": 6e6 for axle in ("front", "rear")},
}
"""Nearly a rigid block."""
FIRM = {"stiffness": 1e6, "cohesion": 1.31e6, "contact_length": 0.5, "unit_weight": 0.0}
"""Wheels sink by 9 mm, and furrows resist with 2.27 times the load: twice what tips a block."""


def test_a_stiff_vehicle_rolls_over_from_the_critical_speed_of_a_block_on():
    """The furrow follows the load, which is not constant while the block rises, and the wheels of
    the other side do not meet it at once: the critical speeds agree within a tenth."""
    vehicle = preset().with_values(STIFF)
    ready = run("soil_trip", vehicle, duration=0.01, **FIRM).manoeuvre
    resistance = ready.resistance(vehicle) / vehicle.mass
    # 2 L C sqrt(K) z of a load z stiffness, with K = 3
    assert resistance == pytest.approx(2 * 0.5 * 1.31 * math.sqrt(3) * 9.81, rel=1e-9)
    for share, condition in ((0.9, Condition.RUNNING), (1.1, Condition.ROLLED_OVER)):
        speed = share * ready.critical
        result = run("soil_trip", vehicle, sliding_speed=speed, step=5e-4, **FIRM)
        assert result.condition is condition


def test_the_reference_vehicle_rolls_over_long_before_a_block_and_to_both_sides_alike():
    upright = run("soil_trip", sliding_speed=3.4)
    assert upright.condition is Condition.RUNNING
    peaks = {}
    for side in ("left", "right"):
        over = run("soil_trip", sliding_speed=4.0, side=side)
        assert over.condition is Condition.ROLLED_OVER
        assert over.manoeuvre.least < 3.4 < 4.0 < over.manoeuvre.critical
        peaks[side] = over["roll"]
    np.testing.assert_allclose(peaks["left"], -peaks["right"], rtol=0, atol=1e-6)
    halved = run("soil_trip", sliding_speed=3.4, step=5e-4)
    peak = upright.metrics["peak_roll"]
    assert halved.metrics["peak_roll"] == pytest.approx(peak, rel=0.01)
    assert abs(peak) > 0.5


def lateral_momentum(result, vehicle) -> np.ndarray:
    """Of all masses, across the road (kg m/s): those of unsprung ones by (9, 10) and (17)."""
    record, roll = vehicle.record()[0], result["roll"]
    wheels = result.history.wheels
    travel = wheels("suspension_compression") - record["static_suspension_compression"]
    strut = record["static_strut_length"] - travel
    beside = result["v"] + record["x"][:, None] * result["yaw_rate"]
    beside = beside.T + strut * result["roll_rate"][:, None]
    up = wheels("unsprung_velocity") * np.sin(roll)[:, None]
    unsprung = (record["unsprung_mass"] * (beside * np.cos(roll)[:, None] - up)).sum(axis=1)
    body = result["v"] * np.cos(roll) - result["w"] * np.sin(roll)
    return unsprung + vehicle.sprung_mass * body


def test_the_furrows_take_the_momentum_of_the_vehicle():
    """On ice that is level from 3 s on. It yaws by 0.05 rad, whose cosine is 1 within 0.002."""
    result = run("soil_trip", sliding_speed=3.4, duration=4.3)
    level = result["time"] >= 3.0
    force = result.history.wheels("lateral_force").sum(axis=1)[level]
    taken = np.concatenate(([0.0], np.cumsum((force[1:] + force[:-1]) / 2 * 0.01)))
    momentum = lateral_momentum(result, preset())[level]
    assert abs(result["yaw"]).max() < 0.05
    assert np.abs(taken).max() > 0.5 * momentum[0]
    np.testing.assert_allclose(momentum - momentum[0], taken, rtol=0, atol=0.01 * momentum[0])


def test_models_and_values_that_do_not_fit_are_refused():
    with pytest.raises(InputError, match=r"^cohesion: -1.0 .*from 0"):
        run("soil_trip", cohesion=-1.0)
    with pytest.raises(InputError, match=r"^road: features .* model 8dof"):
        run("soil_trip", options=Options("8dof"))
    soft = run("soil_trip", stiffness=1e5, cohesion=5e3, contact_length=0.2, duration=3.5)
    assert soft.report["critical speed of a block"] == "none: it stays upright"


def test_the_sliding_speed_is_that_on_the_ice_and_not_that_of_the_fall():
    """On soil of 1 kN/m the vehicle sinks by metres, and falls faster than it slid."""
    result = run("soil_trip", sliding_speed=1.0, stiffness=1000.0)
    assert abs(result.history["v"]).max() > 3.0
    assert result.report["sliding speed"] == "1.000 m/s"
    short = run("soil_trip", duration=2.9).report
    assert short["sliding speed"] == "unknown: the run is too short"
