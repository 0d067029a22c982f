"""Model 2 is mechanics: energy and momentum of random suspensions balance, left is like right."""

import numpy as np
import pytest
from guided_wheels import (
    AIR_DENSITY,
    SMALL,
    G,
    damper_power,
    energy,
    momenta,
    turning_of_carrier,
    wheels,
)
from programmes import Evaluation, with_moments
from random_states import OTHER_SIDE, attitude, mirrored, random_command, random_state
from tire_springs import tire_loads

from vehicle_roll_sim import Options, Vehicle
from vehicle_roll_sim.model.records import STATE
from vehicle_roll_sim.simulation.road import Road

STATES = 5
"""Random states per suspension."""
SUSPENSIONS = (0, 1, 2, 3, 10, 42)
"""Seeds. In the last two, curves are extrapolated to angles above a quarter turn."""
RELATIVE = 1e-12
"""Of the largest contribution: rounding of a 6 x 6 solution."""
SLOPE = Road(grade=0.1, bank=-0.05)
LARGEST = {
    "half_track_change": 0.06,
    "longitudinal_change": 0.02,
    "camber_change": 0.15,
    "toe_change": 0.05,
    "carrier_pitch_change": 0.1,
}
"""Of the values of a random table (m, rad), over travels of a decimetre or two."""
ASIDE = {"cg_offset": 0.1, "roll_pitch_product": 30.0, "pitch_yaw_product": 30.0}
"""Largest values (m, kg m^2) of what changes its sign in a mirror."""


def random_suspension(vehicle: Vehicle, rng: np.random.Generator) -> Vehicle:
    """Tables of random values, single numbers, or nothing, with bars, stops and static camber.

    The body is not symmetric.
    """
    of_body, of_struts = rng.spawn(2)
    values = {
        **random_struts(of_struts),
        **{name: of_body.uniform(-most, most) for name, most in ASIDE.items()},
        "roll_yaw_product": of_body.uniform(-100.0, 100.0),
        "front_anti_roll_bar_rate": rng.uniform(0.0, 2e4),
        "rear_anti_roll_bar_stiffness": rng.uniform(0.0, 4e4),
        "front_camber": rng.uniform(-0.05, 0.05),
    }
    for axle in ("front", "rear"):
        for name, most in LARGEST.items():
            kind = rng.integers(4)
            if kind == 0:
                continue
            if kind == 1:
                values[f"{axle}_{name}"] = 5 * rng.uniform(-most, most)
                continue
            travels = np.sort(rng.uniform(-0.2, 0.25, rng.integers(2, 9)))
            travels += 0.02 * np.arange(len(travels))
            table = np.column_stack((travels, rng.uniform(-most, most, len(travels))))
            values[f"{axle}_{name}"] = tuple(map(tuple, table.tolist()))
    return vehicle.with_values(values)


def random_struts(rng: np.random.Generator) -> dict:
    """Springs, dampers and their motion ratios by tables or numbers, and stops within reach."""
    values = {}
    for axle in ("front", "rear"):
        if rng.random() < 0.7:
            values[f"{axle}_spring_force"] = rising(rng, -0.1, 0.08, 3e4, 0.4)
        for part in ("spring", "damper"):
            if rng.random() < 0.7:
                ratio = rng.uniform(0.6, 1.2)
                values[f"{axle}_{part}_motion_ratio"] = rising(rng, -0.2, 0.05, ratio, 0.05)
        if rng.random() < 0.7:
            bump, rebound = rising(rng, 0.0, 0.5, 2e3, 0.5), rising(rng, 0.0, 0.5, 3e3, 0.5)
            rebound = tuple((-speed, -force) for speed, force in rebound[:0:-1])
            values[f"{axle}_damper_force"] = rebound + bump
        else:
            values[f"{axle}_rebound_damping"] = rng.uniform(1e3, 6e3)
        for stop in ("bump", "rebound"):
            values[f"{axle}_{stop}_stop_clearance"] = rng.uniform(0.02, 0.1)
            values[f"{axle}_{stop}_stop_stiffness"] = rng.uniform(1e4, 1e5)
            values[f"{axle}_{stop}_stop_progression"] = rng.uniform(0.0, 1e6)
    return values


def rising(rng: np.random.Generator, first: float, step: float, slope: float, spread: float):
    """A table of ten points from (`first`, 0), with slopes within `spread` of `slope`, relatively.

    Gaps are between `step` and three quarters of it.
    """
    gaps = step * rng.uniform(0.75, 1.0, 9)
    rises = gaps * slope * rng.uniform(1.0 - spread, 1.0 + spread, 9)
    points = zip(np.append(0.0, np.cumsum(gaps)), np.append(0.0, np.cumsum(rises)), strict=True)
    return tuple((first + float(x), float(y)) for x, y in points)


@pytest.fixture(params=SUSPENSIONS)
def rng(request) -> np.random.Generator:
    return np.random.default_rng(request.param)


@pytest.fixture
def suspended(unequal_axles, rng) -> Vehicle:
    return random_suspension(with_moments(unequal_axles), rng)


def cases(suspended: Vehicle, evaluation: Evaluation, rng: np.random.Generator):
    """State, command, rates and outputs at states anywhere, wheels off the road among them."""
    for _ in range(STATES):
        state, command = random_state(suspended, rng), random_command(rng)
        command["brake_torque"] = rng.uniform(0.0, 2000.0, 4)
        command["speed_hold_gain"], command["speed_hold_target"] = 500.0, 20.0
        state["roll"] *= rng.uniform(0.0, 0.7)
        state["z"] = suspended.cg_height + rng.uniform(-0.05, 0.1)
        evaluation.outputs["turning"] = np.sign(state["wheel_speed"])
        yield state, command, evaluation.rates(state, command), evaluation.outputs


def further(state, rates) -> dict:
    """The state a complex step along its rates."""
    return {name: state[name] + 1j * SMALL * rates[name] for name in STATE.names}


def rate_of(quantity):
    return np.imag(quantity) / SMALL


def contact_moments(state, outputs) -> np.ndarray:
    """Moments at the contact points over the ground, shape (4, 3) (N m)."""
    rotation = attitude(state["roll"], state["pitch"], state["yaw"])
    parts = [outputs[f"contact_moment_{axis}"] for axis in "xyz"]
    return np.column_stack(parts) @ rotation.T


def contact_forces(state, outputs) -> np.ndarray:
    parts = [outputs[f"{name}_force"] for name in ("longitudinal", "lateral", "normal")]
    return np.column_stack(parts) @ attitude(0.0, 0.0, state["yaw"]).T


def drag(vehicle, state) -> float:
    return AIR_DENSITY / 2 * vehicle.drag_area * state["u"] * abs(state["u"])


def test_tires_and_weights_are_all_that_changes_the_momenta(suspended, rng):
    evaluation = Evaluation(suspended, Options(model="2"))
    lifted = []
    for state, command, rates, outputs in cases(suspended, evaluation, rng):
        changes = rate_of(momenta(suspended, further(state, rates), command))
        forces, moments = contact_forces(state, outputs), contact_moments(state, outputs)
        weight, contributions = np.array([0.0, 0.0, -G]), []
        body = np.array([state["x"], state["y"], state["z"]])
        ahead = attitude(state["roll"], state["pitch"], state["yaw"])[:, 0]
        acting = [(body, suspended.sprung_mass * weight - drag(suspended, state) * ahead)]
        for i, each in enumerate(wheels(suspended, state, command)):
            acting.append((each.contact, forces[i]))
            acting.append((each.centre, suspended.per_wheel("unsprung_mass")[i] * weight))
        contributions = [np.concatenate((f, np.cross(at, f))) for at, f in acting]
        contributions += [np.concatenate((np.zeros(3), m)) for m in moments]
        scale = np.abs(contributions).max(axis=0) + np.abs(contributions).max() / 100
        assert (np.abs(changes - np.sum(contributions, axis=0)) < RELATIVE * scale).all()
        lifted.append(outputs["normal_force"] == 0.0)
    assert 0.0 < np.mean(lifted) < 1.0


@pytest.mark.parametrize("road", [Road(), SLOPE], ids=["flat", "slope"])
def test_energy_changes_by_the_named_powers_alone(suspended, rng, road):
    """The load of a tire and the jacking of a suspension are none of them: they conserve energy."""
    evaluation = Evaluation(suspended, Options(model="2"), road)
    for state, command, rates, outputs in cases(suspended, evaluation, rng):
        gained = rate_of(energy(suspended, road, further(state, rates), command))
        struts, spin = outputs["suspension_rate"], state["wheel_speed"]
        drive = command["wheel_torque"].copy()
        drive[2:] += command["speed_hold_gain"] * (command["speed_hold_target"] - state["u"])
        slip = outputs["longitudinal_force"] * outputs["contact_u"]
        slip += outputs["lateral_force"] * outputs["contact_v"]
        slip -= outputs["loaded_radius"] * outputs["tire_longitudinal"] * spin
        rotation = attitude(state["roll"], state["pitch"], state["yaw"])
        turning = [state["roll_rate"], state["pitch_rate"], state["yaw_rate"]]
        moments, powers = contact_moments(state, outputs), []
        for i, each in enumerate(wheels(suspended, state, command)):
            kappa = turning_of_carrier(suspended, i, each.travel)
            axis = each.spin_axis
            powers.append(drive[i] * (spin[i] + (rotation @ kappa) @ axis * struts[i]))
            whole = rotation @ (turning + kappa * struts[i]) + spin[i] * axis
            powers.append(moments[i] @ whole)
            powers.append(-damper_power(suspended, i, each.travel, struts[i]))
        powers += slip.tolist()
        powers += [*(-command["normal_force"] * struts), -drag(suspended, state) * state["u"]]
        friction = command["brake_torque"]
        powers += [*(-friction * np.abs(spin))]
        assert abs(gained - sum(powers)) < RELATIVE * 10 * np.abs(powers).max()


def test_contact_point_load_and_inclination_are_those_of_the_geometry(suspended, rng):
    evaluation = Evaluation(suspended, Options(model="2"))
    for state, command, rates, outputs in cases(suspended, evaluation, rng):
        for i, each in enumerate(wheels(suspended, state, command)):
            load = tire_loads(suspended, max(each.deflection, 0.0))[i] / each.cosine
            assert outputs["normal_force"][i] == pytest.approx(load, rel=1e-10, abs=1e-6)
            assert outputs["inclination"][i] == pytest.approx(np.arcsin(each.spin_axis[2]))
            assert outputs["loaded_radius"][i] == pytest.approx(each.radius, rel=1e-12)
        moved = wheels(suspended, further(state, rates), command)
        unloaded = suspended.per_wheel("tire_radius")
        sinking = [rate_of(unloaded[i] * w.cosine - w.centre[2]) for i, w in enumerate(moved)]
        np.testing.assert_allclose(rates["tire_compression"], sinking, rtol=1e-10, atol=1e-10)


def test_left_and_right_are_alike(suspended, rng):
    evaluation = Evaluation(suspended, Options(model="2"))
    other = suspended.with_values({name: -getattr(suspended, name) for name in ASIDE})
    through_the_mirror = Evaluation(other, Options(model="2"))
    for state, command, rates, outputs in cases(suspended, evaluation, rng):
        straight, centres = rates.copy(), outputs.copy()
        through_the_mirror.outputs["turning"] = outputs["turning"][OTHER_SIDE]
        opposite = through_the_mirror.rates(mirrored(state), mirrored(command))
        outputs = through_the_mirror.outputs
        for name in STATE.names:
            expected = mirrored(straight)[name]
            scale = 1e-10 * (1.0 + np.abs(expected).max())
            np.testing.assert_allclose(opposite[name], expected, rtol=0, atol=scale, err_msg=name)
        height, place = outputs["roll_centre_height"], outputs["roll_centre_place"]
        np.testing.assert_allclose(height, centres["roll_centre_height"], rtol=1e-6)
        np.testing.assert_allclose(place, -centres["roll_centre_place"], rtol=1e-6)
