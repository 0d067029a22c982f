"""The body on the ground at single states: momenta, energy, mirror image, and what wheels do."""

import numpy as np
import pytest
from bodies import BOX, EXACT, GUIDED, fallen_state, forces_on_corners
from guided_wheels import energy as energy_of_guided
from guided_wheels import momenta as momenta_of_guided
from guided_wheels import wheels
from mechanics import GRAVITY, along, drag, energy, external, momenta, powers, slope
from programmes import Evaluation
from random_states import attitude, mirrored, random_command
from road_kinds import road as road_with

from vehicle_roll_sim import Options
from vehicle_roll_sim.model.fallen_wheels import DISC, FLAT, LEANING, RISING, SMALLEST
from vehicle_roll_sim.model.records import COMMAND, STATE
from vehicle_roll_sim.simulation.road import Road

STATES = 40
"""Random states per case, at any roll angle; at least one corner is in the ground."""
RELATIVE = 1e-12
"""Of the largest contribution: rounding of a 6 x 6 solution; seen 2e-14."""
CROSS = [1, 0, 3, 2, 5, 4, 7, 6]
"""The corners in a mirror."""
ROLL_CENTRES = Options(euler_terms=True, body_contact=True)
WAVY = road_with(
    {"kind": "wave", "start": -60, "length": 40, "height": 0.5, "count": 4, "heading": 20},
    {"kind": "patch", "start": -100, "left": 0, "right": -100, "friction": 0.4},
)
ELSEWHERE = road_with({"kind": "patch", "start": 1000, "friction": 0.5})


@pytest.fixture
def boxed(unequal_axles):
    return unequal_axles.with_values(BOX)


def cases(vehicle, options: Options, road: Road = Road(), seed: int = 3):  # noqa: B008
    """State, command, rates and outputs of random states."""
    evaluation, rng = Evaluation(vehicle, options, road), np.random.default_rng(seed)
    for _ in range(STATES):
        state, command = fallen_state(vehicle, rng), random_command(rng)
        evaluation.outputs["turning"] = np.sign(state["wheel_speed"])
        yield state, command, evaluation.rates(state, command), evaluation.outputs


def wrenches(forces: np.ndarray, places: np.ndarray) -> np.ndarray:
    return np.hstack((forces, np.cross(places, forces)))


def assert_balanced(change: np.ndarray, contributions: np.ndarray) -> None:
    scale = np.abs(contributions).max(axis=0) + np.abs(contributions).max() / 100
    assert (np.abs(change - contributions.sum(axis=0)) < RELATIVE * scale).all()


@pytest.mark.parametrize("options", [EXACT, ROLL_CENTRES], ids=["exact", "roll centres"])
def test_loads_and_momenta_of_model_1_change_by_the_forces_on_the_corners(boxed, options):
    touching = []
    for state, _, rates, outputs in cases(boxed, options):
        forces, places, _, loads = forces_on_corners(boxed, Road(), state)
        np.testing.assert_allclose(outputs["body_load"], loads, rtol=1e-9, atol=1e-6)
        change = np.concatenate([slope(each) for each in momenta(boxed, along(state, rates))])
        acting = wrenches(*external(boxed, state, outputs))
        assert_balanced(change, np.vstack((acting, wrenches(forces, places))))
        touching.append((loads > 0.0).sum())
    assert {1, 2} <= set(touching)


@pytest.mark.parametrize("road", [Road(), WAVY], ids=["flat", "waves and a slippery side"])
def test_loads_and_momenta_of_model_2_change_by_the_forces_on_the_corners(boxed, road):
    frictions = set()
    for state, command, rates, outputs in cases(boxed, GUIDED, road):
        if road.features and (outputs["normal_force"] > 0.0).any():
            continue  # the wheels on uneven roads have tests of their own
        forces, places, _, loads = forces_on_corners(boxed, road, state)
        np.testing.assert_allclose(outputs["body_load"], loads, rtol=1e-9, atol=1e-6)
        change = slope(momenta_of_guided(boxed, along(state, rates), command))
        body = np.array([state["x"], state["y"], state["z"]])
        ahead = attitude(state["roll"], state["pitch"], state["yaw"])[:, 0]
        on_body = boxed.sprung_mass * GRAVITY - drag(boxed, state) * ahead
        acting = [wrenches(forces, places), wrenches(on_body, body)]
        parts = [outputs[f"{name}_force"] for name in ("longitudinal", "lateral", "normal")]
        of_tires = np.column_stack(parts) @ attitude(0.0, 0.0, state["yaw"]).T
        for i, each in enumerate(wheels(boxed, state, command)):
            acting.append(wrenches(of_tires[i], each.contact))
            acting.append(wrenches(boxed.per_wheel("unsprung_mass")[i] * GRAVITY, each.centre))
        assert_balanced(change, np.vstack(acting))
        frictions |= {road.surface(*place[:2])[3] for place in places[loads > 0.0]}
    assert frictions == ({1.0, 0.4} if road.features else {1.0})


def test_energy_changes_by_the_work_of_the_ground_which_never_pushes_a_sliding_corner_on(boxed):
    for state, command, rates, outputs in cases(boxed, EXACT):
        gained = slope(energy(boxed, Road(), along(state, rates)))
        forces, _, velocities, _ = forces_on_corners(boxed, Road(), state)
        of_corners = (forces * velocities).sum(axis=1)
        known = powers(boxed, state, outputs, command)
        contributions = np.array([*known.values(), *of_corners])
        assert abs(gained - contributions.sum()) < 10 * RELATIVE * np.abs(contributions).max()
        assert ((forces * velocities)[:, :2].sum(axis=1) <= 0.0).all()


def test_energy_of_model_2_changes_by_the_work_of_the_ground_on_body_and_tires(boxed):
    off = 0
    for state, command, rates, outputs in cases(boxed, GUIDED):
        if (outputs["normal_force"] > 0.0).any():
            continue  # the wheels on the road have tests of their own
        gained = slope(energy_of_guided(boxed, Road(), along(state, rates), command))
        forces, _, velocities, _ = forces_on_corners(boxed, Road(), state)
        struts, spin = outputs["suspension_rate"], state["wheel_speed"]
        contributions = np.concatenate(
            (
                (forces * velocities).sum(axis=1),
                -boxed.per_wheel("damping") * struts**2,
                command["wheel_torque"] * spin - command["normal_force"] * struts,
                [-drag(boxed, state) * state["u"]],
            )
        )
        assert abs(gained - contributions.sum()) < 10 * RELATIVE * np.abs(contributions).max()
        off += 1
    assert off > STATES / 4


@pytest.mark.parametrize("options", [EXACT, GUIDED], ids=["model 1", "model 2"])
def test_left_is_like_right(boxed, options):
    other = Evaluation(boxed, options)
    for state, command, rates, outputs in cases(boxed, options, seed=5):
        opposite = other.rates(mirrored(state), mirrored(command))
        for name in STATE.names:
            expected = mirrored(rates)[name]
            scale = 1e-10 * (1.0 + np.abs(expected).max())
            np.testing.assert_allclose(opposite[name], expected, rtol=0, atol=scale, err_msg=name)
        loads, scale = outputs["body_load"], 1e-10 * outputs["body_load"].max()
        np.testing.assert_allclose(other.outputs["body_load"], loads[CROSS], rtol=0, atol=scale)


@pytest.mark.parametrize("options", [EXACT, GUIDED], ids=["model 1", "model 2"])
def test_a_whole_turn_changes_nothing(boxed, options):
    """Sines of angles a turn apart differ by 1e-15, loads of 1e5 N/m by as much of a metre."""
    other = Evaluation(boxed, options)
    for state, command, rates, outputs in cases(boxed, options, seed=7):
        turned = state.copy()
        turned["roll"] += 2 * np.pi
        again = other.rates(turned, command)
        for name in STATE.names:
            scale = 1e-9 * (1.0 + np.abs(rates[name]).max())
            np.testing.assert_allclose(again[name], rates[name], rtol=0, atol=scale, err_msg=name)
        loads = outputs["normal_force"]
        np.testing.assert_allclose(other.outputs["normal_force"], loads, rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize("options", [EXACT, GUIDED], ids=["model 1", "model 2"])
def test_on_a_road_whose_features_are_elsewhere_everything_is_as_on_a_plane(boxed, options):
    """Also where tires are pressed to the limit of their loaded radius, which differs from the
    distance of the contact point: the same point counts in all equations."""
    on_road, pressed = Evaluation(boxed, options, ELSEWHERE), 0
    for state, command, rates, outputs in cases(boxed, options):
        on_road.outputs["turning"] = outputs["turning"]
        again = on_road.rates(state, command)
        for name in STATE.names:
            scale = 1e-9 * (1.0 + np.abs(rates[name]).max())
            np.testing.assert_allclose(again[name], rates[name], rtol=0, atol=scale, err_msg=name)
        limit = SMALLEST * boxed.per_wheel("tire_radius")
        is_pressed = (outputs["loaded_radius"] <= limit) & (outputs["normal_force"] > 0.0)
        pressed += is_pressed.sum()
    assert pressed > 3


def loads_at(vehicle, options: Options, cosine: float, height: float, road: Road = Road()):  # noqa: B008
    """Normal loads and loaded radii at this cosine, with the lower wheels at a height (m)."""
    evaluation = Evaluation(vehicle, options, road)
    state = np.zeros(1, STATE)[0]
    state["u"], state["roll"] = 10.0, np.arccos(cosine)
    state["suspension_compression"] = vehicle.static_suspension_compression
    rise = vehicle.per_wheel("track")[0] / 2 * np.sin(state["roll"])
    lengths = vehicle.static_strut_length
    state["z"] = height + rise + lengths[1] * cosine  # the right wheels are the lower ones
    state["tire_compression"] = vehicle.per_wheel("tire_radius") - height
    evaluation.rates(state, np.zeros(1, COMMAND)[0])
    return evaluation.outputs["normal_force"].copy(), evaluation.outputs["loaded_radius"].copy()


def smooth(value: float, begin: float, end: float) -> float:
    """3 s^2 - 2 s^3 with the share s of the way from `end` to `begin`."""
    share = np.clip((value - end) / (begin - end), 0.0, 1.0)
    return 3 * share**2 - 2 * share**3


COSINES = (1.0, 0.9, RISING, 0.6, 0.5, DISC, LEANING, 0.25, 0.2, 0.12, FLAT, 0.05, 0.0, -0.3, -1.0)


def test_the_tire_of_model_1_becomes_a_disc_and_then_loses_its_load(reference):
    """The lowest point of a disc is r0 c below its centre, which is 0.05 m above the road."""
    radius, stiffness = reference.per_wheel("tire_radius"), reference.per_wheel("tire_stiffness")
    for cosine in COSINES:
        upright, disc = radius - 0.05, radius * cosine - 0.05
        part = smooth(cosine, RISING, DISC)
        compression = np.maximum(part * upright + (1.0 - part) * disc, 0.0)
        expected = smooth(cosine, LEANING, FLAT) * stiffness * compression
        for road in (Road(), ELSEWHERE):
            loads, radii = loads_at(reference, EXACT, cosine, 0.05, road)
            np.testing.assert_allclose(loads[1::2], expected[1::2], rtol=1e-9, atol=1e-6)
            held = np.clip(radius - compression / max(cosine, FLAT), SMALLEST * radius, radius)
            np.testing.assert_allclose(radii[1::2], held[1::2], rtol=1e-9)


def test_the_disc_of_model_2_loses_its_load_when_it_falls_flat(reference):
    """Upright, k (r0 - z / c) / c; beyond LEANING, which takes the place of c, it fades."""
    radius, stiffness = reference.per_wheel("tire_radius"), reference.per_wheel("tire_stiffness")
    for cosine in COSINES:
        leaning, least = abs(cosine), max(abs(cosine), LEANING)
        depth = np.maximum(radius * leaning - 0.01, 0.0)
        expected = smooth(leaning, LEANING, FLAT) * stiffness * depth / least**2
        for road in (Road(), ELSEWHERE):
            loads, radii = loads_at(reference, GUIDED, cosine, 0.01, road)
            np.testing.assert_allclose(loads[1], expected[1], rtol=1e-9, atol=1e-6)
            assert (radii >= SMALLEST * radius).all()
