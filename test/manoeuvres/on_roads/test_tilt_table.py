"""The tilt table against closed forms of a rigid and of a suspended vehicle."""

import dataclasses
import math

import pytest

from vehicle_roll_sim import Condition, InputError, Options, RollPlane, preset, run
from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES

EVEN = {
    "cg_to_front_axle": 1.27,
    "cg_to_rear_axle": 1.27,
    **{f"{axle}_damping": 2000.0 for axle in ("front", "rear")},
    **{f"{axle}_roll_centre_depth": 0.6 for axle in ("front", "rear")},
}
"""Both axles alike: they lift off together, as in a roll plane."""
QUICK = {"rate": 1.0, "sample": 0.02}
"""It turns the angles of 0.25 deg/s by less than 0.02 deg."""


def even(spring_stiffness: float, tire_stiffness: float = 2e5):
    of_axles = {"spring_stiffness": spring_stiffness, "tire_stiffness": tire_stiffness}
    values = {f"{axle}_{name}": of_axles[name] for axle in ("front", "rear") for name in of_axles}
    return preset().with_values(EVEN | values)


def tilted(vehicle, **values):
    result = run("tilt_table", vehicle, **(QUICK | values))
    first, two, fall = result.manoeuvre.angles(result.history)
    return result, first, two, fall


def closed_form(vehicle) -> float:
    """Angle of the table (rad) at which the load of the raised side is 0.

    The vehicle has rolled by phi, as in the roll plane with its part of gravity, and its springs
    and tires have risen by their part of it. Its c.g. is above the contact points of the lower
    side, which are c tan(phi) closer to the body: tan(angle + phi) = c / (h - c tan(phi)).
    """
    at_rest, angle = vehicle.record(), 0.7
    parts = ("static_suspension_compression", "static_tire_compression")
    sag = float(sum(at_rest[name][0, 0] for name in parts))
    for _ in range(100):
        tilted = vehicle.record()
        tilted["gravity"] *= math.cos(angle)
        plane, gravity = RollPlane(tilted), float(tilted["gravity"][0])
        sprung = vehicle.sprung_mass * gravity / plane.weight
        height = plane.cg_height + sprung * sag * (1.0 - math.cos(angle))
        half, phi = plane.track / 2, float(plane.roll(gravity * math.tan(angle)))
        angle = math.atan(half / (height - half * math.tan(phi))) - phi
    return angle


def test_with_stiff_springs_two_wheels_lift_off_at_the_static_stability_factor():
    vehicle = even(1e6, 6e6)
    factor = RollPlane(vehicle.record(), suspended=False).static_stability_factor
    _, first, two, fall = tilted(vehicle)
    assert math.tan(two) == pytest.approx(factor, rel=0.01)
    assert first == two
    assert two <= fall < two + math.radians(1.5)


@pytest.mark.parametrize("stiffness", [32e3, 96e3])
def test_with_soft_springs_they_lift_off_at_the_closed_form(stiffness):
    """The closed form is of first order in the roll angle phi, up to 0.11: phi^2 is allowed."""
    vehicle = even(stiffness)
    _, _, two, _ = tilted(vehicle)
    wanted = closed_form(vehicle)
    assert two == pytest.approx(wanted, abs=0.012)
    assert wanted - two > 0.0
    assert wanted < math.atan(RollPlane(vehicle.record(), False).static_stability_factor) - 0.02


def test_it_prints_the_angles_and_the_same_to_the_other_side():
    left, *angles = tilted(preset())
    right, *mirrored = tilted(preset(), side="right")
    assert left.condition is right.condition is Condition.ROLLED_OVER
    assert mirrored == pytest.approx(angles, abs=1e-9)
    first, two, fall = angles
    assert first < two < fall  # the rear axle is less loaded, and lifts off first
    lines = left.summary.splitlines()
    assert f"first wheel off at tilt angle: {math.degrees(first):.3f} deg" in lines
    assert f"two wheels off at tilt angle: {math.degrees(two):.3f} deg" in lines
    assert f"falls at tilt angle:        {math.degrees(fall):.3f} deg" in lines
    assert f"tilt table ratio:           {math.tan(two):.4f}" in lines


def test_what_does_not_happen_is_none():
    result, *angles = tilted(preset(), steepest=20.0, duration=25.0)
    assert all(map(math.isnan, angles))
    assert {text for label, text in result.report.items() if label != "figures"} == {"none"}
    assert result.condition is Condition.RUNNING
    assert abs(result["u"]).max() < 1e-3  # m/s: its brakes hold it


def test_a_vehicle_that_is_driven_and_a_model_without_heave_are_refused():
    with pytest.raises(InputError, match=r"^speed: 5.0 .*parked"):
        dataclasses.replace(MANOEUVRES["tilt_table"], speed=5.0)
    with pytest.raises(InputError, match=r"^road: features .* model 8dof"):
        run("tilt_table", options=Options("8dof"))
