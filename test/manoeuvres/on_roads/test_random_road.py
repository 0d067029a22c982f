"""Ride on a random road against quarter cars, in the time and in the frequency domain."""

import numpy as np
import pytest
from scipy import signal

from vehicle_roll_sim import InputError, preset, run
from vehicle_roll_sim.roads.iso8608 import HIGHEST, LOWEST

SPEED, LENGTH, ROUGH_FROM = 20.0, 400.0, 10.0
FRONT, REAR = (0, 1), (2, 3)
FINER = 4
"""Heights for each sample, one each 0.05 m."""
EVEN = {"incoherence": 0.0, "roughness": "B", "length": LENGTH, "seed": 5}
"""Both tracks are the same: no roll. The wheels always have load."""


@pytest.fixture(scope="module")
def vehicle():
    """With a pitch inertia of m a b: front and rear axle are quarter cars of their own."""
    given = preset()
    inertia = given.sprung_mass * given.cg_to_front_axle * given.cg_to_rear_axle
    return given.with_values({"pitch_inertia": inertia})


@pytest.fixture(scope="module")
def driven(vehicle):
    values = {"speed": SPEED, "duration": (LENGTH + 20.0) / SPEED, **EVEN}
    return run("random_road", vehicle, **values)


def quarter_car(vehicle, axle: str):
    """Of one wheel: from the height of the road (m) to the dynamic load (N), and body acceleration.

    States: heights and velocities of body and wheel, relative to rest.
    """
    length = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    arm = vehicle.cg_to_rear_axle if axle == "front" else vehicle.cg_to_front_axle
    body = vehicle.sprung_mass * arm / length / 2
    names = ("unsprung_mass", "spring_stiffness", "damping", "tire_stiffness")
    wheel, spring, damper, tire = (getattr(vehicle, f"{axle}_{name}") for name in names)
    strut = np.array([spring, -spring, damper, -damper])
    on_body, on_wheel = -strut / body, strut / wheel - np.array([0, tire / wheel, 0, 0])
    rates = np.array([[0, 0, 1, 0], [0, 0, 0, 1], on_body, on_wheel])
    inputs = np.array([[0], [0], [0], [tire / wheel]])
    outputs = np.array([[0, -tire, 0, 0], on_body])
    return signal.StateSpace(rates, inputs, outputs, np.array([[tire], [0.0]]))


def responses(vehicle, driven, axle: str, arm: float) -> np.ndarray:
    """Dynamic load and body acceleration of a quarter car on the heights, at all samples (n, 2)."""
    time = driven["time"]
    fine = np.linspace(0.0, time[-1], FINER * (len(time) - 1) + 1)
    places = np.interp(fine, time, driven["x"]) + arm
    heights = np.array([driven.road.surface(place, 0.75)[0] for place in places])
    _, response, _ = signal.lsim(quarter_car(vehicle, axle), heights, fine)
    return response[::FINER]


def test_dynamic_loads_are_those_of_quarter_cars_on_the_same_heights(vehicle, driven):
    """Within 2 %: on slopes the static loads also push along the road, and so pitch the body by an
    amount in proportion to the roughness, which quarter cars leave out."""
    loads = driven.history.wheels("normal_force")
    found = driven.manoeuvre.coefficients(driven.history)
    counted = driven.manoeuvre.counted(driven.history)
    for axle, wheels, arm in (("front", FRONT, 1.016), ("rear", REAR, -1.524)):
        response = responses(vehicle, driven, axle, arm)
        static = loads[0, wheels[0]]
        wanted = np.sqrt(np.mean(response[counted, 0] ** 2)) / static
        assert found[list(wheels)] == pytest.approx([wanted] * 2, rel=0.02)
        assert 0.02 < wanted < 0.3


def test_dynamic_load_coefficients_are_those_of_the_spectrum_of_its_class(vehicle, driven):
    """Lines of the spectrum at each 1 / length: Gd of class B, 64e-6 m^3 at 0.1 1/m, through the
    transfer function, and the average over the contact length of 0.1 m. The spectrum of the whole
    road is exact, but 340 of its 400 m count: 7 % for the share of each line in this part."""
    n = np.arange(1, int(HIGHEST * LENGTH) + 1) / LENGTH
    n = n[n >= LOWEST]
    power = 64e-6 * (n / 0.1) ** -2.0 / LENGTH * np.sinc(n * 0.1) ** 2
    loads = driven.history.wheels("normal_force")
    found = driven.manoeuvre.coefficients(driven.history)
    for axle, wheel in (("front", 0), ("rear", 2)):
        system = quarter_car(vehicle, axle)
        rates, inputs, outputs, direct = system.A, system.B, system.C[:1], system.D[0, 0]
        at = 2j * np.pi * n[:, None, None] * SPEED * np.eye(4) - rates
        gain = direct + (outputs @ np.linalg.solve(at, np.broadcast_to(inputs, (len(n), 4, 1))))
        rms = np.sqrt((np.abs(gain[:, 0, 0]) ** 2 * power).sum())
        assert found[wheel] == pytest.approx(rms / loads[0, wheel], rel=0.07)


def test_the_vertical_acceleration_is_that_of_the_quarter_cars(vehicle, driven):
    """Of the body over the axles: at the c.g. it is the mean, weighted by the other arms."""
    parts = []
    for axle, arm in (("front", 1.016), ("rear", -1.524)):
        parts.append(responses(vehicle, driven, axle, arm)[:, 1])
    at_cg = (1.524 * parts[0] + 1.016 * parts[1]) / 2.54
    counted = driven.manoeuvre.counted(driven.history)
    wanted = np.sqrt(np.mean(at_cg[counted] ** 2))
    label, unit = driven.report["rms vertical acceleration"].split()
    assert unit == "m/s^2"
    assert float(label) == pytest.approx(wanted, rel=0.01)
    assert float(driven.report["rms roll acceleration"].split()[0]) < 0.1


def test_what_it_reports_and_what_it_refuses():
    rough = run("random_road", roughness="D", length=150.0, duration=6.0)
    values = {label: float(text.split()[0]) for label, text in rough.report.items()}
    assert values["rms roll acceleration"] > 10.0
    assert values["dynamic load coefficient rr"] > values["dynamic load coefficient lf"]
    unknown = "unknown: too few samples on the road, or more than 10 ms apart"
    for values in ({"sample": 0.02}, {"duration": 0.5}):
        short = {"length": 150.0, "duration": 3.0} | values
        assert run("random_road", **short).report["ride"] == unknown
    for values, told in (({"seed": 1.5}, "seed"), ({"length": 2e4}, "length")):
        with pytest.raises(InputError, match=f"^{told}: "):
            run("random_road", **values)
