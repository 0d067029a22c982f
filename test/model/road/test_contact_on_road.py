"""Wheels on an uneven road: what an equal plane, a mirror image and other tires give as well."""

import numpy as np
import pytest
from programmes import Evaluation, ramp_and_hold, record_run, with_tire
from random_states import attitude, mirrored, random_command, random_state
from road_kinds import FEATURES, ROADS, road

from vehicle_roll_sim import Options, Simulation, run
from vehicle_roll_sim.simulation.road import Road

FAR = {"kind": "wave", "start": 9e4, "length": 1.0, "height": 0.1}
"""A feature where no vehicle comes."""
LAGGED = Options()
EXACT = Options(model="2")
MODELS = ("1", "1a", "1b", "1c-iii", "1c-iv", "1b-no-strut", "2")


def tilted_plane(bank: float) -> Road:
    """A plane that rises to the left, as heights."""
    rows = np.linspace(-60.0, 60.0, 5)
    heights = np.tile(bank * rows, (5, 1)).tolist()
    spacing = {"spacing": 50.0, "side_spacing": 30.0}
    return road({"kind": "grid", "start": -100.0, "right": -60.0, "heights": heights, **spacing})


def euler_angles(rotation: np.ndarray) -> dict[str, float]:
    """Angles of a rotation Rz(yaw) Ry(pitch) Rx(roll)."""
    return {
        "roll": np.arctan2(rotation[2, 1], rotation[2, 2]),
        "pitch": -np.arcsin(rotation[2, 0]),
        "yaw": np.arctan2(rotation[1, 0], rotation[0, 0]),
    }


@pytest.mark.parametrize("model", MODELS)
def test_a_road_whose_features_are_elsewhere_is_a_plane(reference, model):
    turn = ramp_and_hold(0.05, 60.0, 6.0, wheel_torque=200.0)
    on_plane, on_road = (
        record_run(Simulation(reference, Options(model), road=each), turn, 0.5)
        for each in (Road(0.03, -0.02), road(FAR, grade=0.03, bank=-0.02))
    )
    for name in on_plane.state.dtype.names:
        expected = on_plane.state[name]
        assert np.allclose(on_road.state[name], expected, rtol=1e-11, atol=1e-11, equal_nan=True)
    load = on_plane.outputs["normal_force"]
    assert on_road.outputs["normal_force"] == pytest.approx(load, rel=1e-9)


def test_in_model_2_a_plane_made_of_heights_is_the_same_as_gravity_that_is_turned(vehicle):
    """The same vehicle in the same place on the same plane, in the axes of the plane and of the
    earth. Forces in its own axes, and the accelerations, are equal to rounding."""
    bank, rng = 0.3, np.random.default_rng(8)
    turned = attitude(np.arctan(bank), 0.0, 0.0)
    in_plane = Evaluation(vehicle, EXACT, Road(bank=bank))
    over_earth = Evaluation(vehicle, EXACT, tilted_plane(bank))
    for _ in range(20):
        state, command = random_state(vehicle, rng), random_command(rng)
        state["roll"], state["pitch"] = state["roll"] / 4, state["pitch"] / 4
        state["x"], state["y"] = state["x"] / 4, state["y"] / 4
        again = state.copy()
        place = turned @ [state["x"], state["y"], state["z"]]
        again["x"], again["y"], again["z"] = place
        pose = turned @ attitude(state["roll"], state["pitch"], state["yaw"])
        for name, value in euler_angles(pose).items():
            again[name] = value
        in_plane.rates(state, command)
        over_earth.rates(again, command)
        for name in ("contact_x", "contact_y", "contact_z", "inclination", "specific_force"):
            expected = in_plane.outputs[name]
            size = np.abs(expected).max() + 1.0
            assert over_earth.outputs[name] == pytest.approx(expected, abs=1e-9 * size), name
        own, other = in_plane.outputs["body_acceleration"], over_earth.outputs["body_acceleration"]
        assert other == pytest.approx(own, abs=1e-9 * np.abs(own).max())


def climbing(vehicle, options: Options, road: Road, slope: float) -> tuple[float, np.ndarray]:
    """Pitch (rad) and loads normal to the road (N) after 8 s at a speed that is held."""
    history = run(
        "step_steer",
        vehicle=vehicle,
        options=options,
        road=road,
        amplitude=0.0,
        speed=15.0,
        duration=8.0,
    ).history
    along, up = (history.wheels(f"{name}_force")[-1] for name in ("longitudinal", "normal"))
    return history["pitch"][-1], (up - slope * along) / np.hypot(1.0, slope)


def test_on_a_long_slope_of_heights_the_load_of_model_1_has_the_lever_of_a_pitched_body(reference):
    """r sin(pitch), from which pitch to which does not matter; that of model 2 has none."""
    height, length, rounding, slope = 20.0, 210.0, 10.0, 0.1
    ramp = {"kind": "ramp", "start": 20.0, "length": length, "height": height, "rounding": rounding}
    grade = Road(grade=slope)
    for options in (LAGGED, EXACT):
        flat, on_grade = climbing(reference, options, grade, 0.0)
        pitch, loads = climbing(reference, options, road(ramp), slope)
        moved = (loads - on_grade)[2:]
        if options is EXACT:
            assert moved == pytest.approx(0.0, abs=0.1)
            continue
        lever = reference.static_loaded_radius[0] * (np.sin(flat) - np.sin(pitch))
        base = reference.cg_to_front_axle + reference.cg_to_rear_axle
        assert moved == pytest.approx(loads.sum() * lever / base / 2, rel=0.05)


MIRRORED = {
    "corkscrew ramp": {"raised": "right"},
    "curb": {"raised": "right", "offset": -0.8},
    "banked curve": {"radius": -60.0},
    "patch": {"left": None, "right": 0.0},
    "profile": {"points": [[0, 0], [3, 0.02, 0.05], [6, -0.03, 0.0], [9, 0, 0]]},
}


@pytest.mark.parametrize("options", [LAGGED, EXACT], ids=["model 1", "model 2"])
@pytest.mark.parametrize("name", MIRRORED)
def test_on_the_mirror_image_of_a_road_a_vehicle_moves_like_its_mirror_image(
    reference, name, options
):
    brake = ramp_and_hold(0.5, 10.0, 2.0, brake_torque=200.0)
    other = ramp_and_hold(0.5, -10.0, 2.0, brake_torque=200.0)
    image = {**FEATURES[name], **MIRRORED[name]}
    image = {key: value for key, value in image.items() if value is not None}
    left = record_run(Simulation(reference, options, road=ROADS[name]), brake, 1.0)
    right = record_run(Simulation(reference, options, road=road(image)), other, 1.0)
    assert np.abs(left.state["roll"]).max() > 1e-4
    for number in (500, 1000):
        state = mirrored(right.state[number])
        for field in ("y", "roll", "yaw", "u", "v", "pitch", "tire_compression", "wheel_speed"):
            own = left.state[number][field]
            assert state[field] == pytest.approx(own, abs=1e-9 + 1e-9 * np.abs(own).max()), field


@pytest.mark.parametrize("options", [LAGGED, EXACT], ids=["model 1", "model 2"])
def test_a_slippery_road_is_a_tire_with_less_friction(reference, options):
    slippery = road({"kind": "patch", "start": -100.0, "friction": 0.4})
    scaled = {name: 0.4 * reference.tire.coefficients[name] for name in ("LMUX", "LMUY")}
    turn = ramp_and_hold(0.1, 60.0, 8.0, brake_torque=400.0)
    found = record_run(Simulation(reference, options, road=slippery), turn, 1.5)
    expected = record_run(Simulation(with_tire(reference, **scaled), options), turn, 1.5)
    for name in ("x", "y", "yaw", "roll", "u", "lateral_slip"):
        assert found.state[name] == pytest.approx(expected.state[name], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("options", [LAGGED, EXACT], ids=["model 1", "model 2"])
def test_a_vehicle_that_jumps_from_a_ramp_lands_at_the_height_of_the_road(reference, options):
    jump = record_run(
        Simulation(reference, options, road=ROADS["ramp"]), ramp_and_hold(0.0, 0.0, 0.0), 6.0
    )
    off = jump.outputs["normal_force"].max(axis=1) == 0.0
    assert off.sum() > 100  # ms
    rest = reference.cg_height
    assert jump.state["z"].max() > rest + 0.5
    assert jump.state["z"][-1] == pytest.approx(rest, abs=2e-3)
    weight = reference.sprung_mass + 4 * reference.front_unsprung_mass
    assert jump.outputs["normal_force"][-1].sum() == pytest.approx(9.81 * weight, rel=0.02)


@pytest.mark.parametrize("name", ROADS)
def test_half_the_step_gives_the_same_peaks(reference, name):
    """Within 1 %. Rolling freely: a brake that stops a wheel in the air does so to a step."""
    peaks = []
    for step in (1e-3, 5e-4):
        simulation = Simulation(reference, step=step, road=ROADS[name])
        run = record_run(simulation, ramp_and_hold(0.3, 10.0, 2.0), 1.5)
        state = run.state
        peaks.append([np.abs(state[n]).max() for n in ("roll", "pitch", "yaw_rate", "w", "y")])
    assert peaks[0] == pytest.approx(peaks[1], rel=0.01, abs=1e-6)


def test_a_tilt_table_loads_the_wheels_as_a_bank_of_its_angle_does(reference):
    """After it has stopped; parked, with locked wheels."""
    tilted = road({"kind": "tilt_table", "angles": [[0.0, 0.0], [1.0, 10.0]]})
    loads = []
    for each in (tilted, Road(bank=np.tan(np.radians(10.0)))):
        simulation = Simulation(reference, step=2e-3, road=each)
        simulation.reset(0.0)
        braked = ramp_and_hold(0.0, 0.0, 0.0, brake_torque=5000.0)
        simulation.step(braked, 20.0)
        loads.append(simulation.outputs["normal_force"].copy())
    assert loads[0] == pytest.approx(loads[1], rel=1e-4)  # the way there differs


def test_friction_differs_from_wheel_to_wheel(reference):
    simulation = Simulation(reference, road=road({**FEATURES["patch"], "start": -50.0}))
    assert simulation.outputs["road_friction"].tolist() == [1.0, 0.3, 1.0, 0.3]
