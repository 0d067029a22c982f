"""The linear model against the nonlinear response, steady states, closed forms, mirror images."""

import dataclasses
import importlib.util
import math

import numpy as np
import pytest
from linear_studies import (
    REFERENCE,
    SPEED,
    command_of,
    mirror,
    reference_model,
    simulation_in,
)
from scipy.linalg import expm

from vehicle_roll_sim import InputError, Options
from vehicle_roll_sim.analysis import linear_model
from vehicle_roll_sim.analysis.level_road_model import INPUT_NAMES, WIND_NAMES, typical
from vehicle_roll_sim.analysis.linear_model import as_control_system, linearize, outputs_of
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.model.records import LF, TIRE_COMPRESSION
from vehicle_roll_sim.simulation.options import MODELS

SAMPLE, SAMPLES = 0.05, 30
"""Sample time (s) and number of samples: by the end the roll motion has decayed."""
SMALL_STEPS = {"steering": 1e-3, "wheel_torque_rf": 10.0, "normal_force_lr": 50.0}
"""rad, N m, N: what is left after the linear response is a hundredth of it, and not rounding."""


AIR = {
    "drag_area": 0.7,
    "side_force_area": 2.0,
    "front_lift_area": 0.2,
    "rear_lift_area": 0.1,
    "pressure_centre_ahead": 0.3,
    "pressure_centre_height": 0.2,
}
GUST = 0.2
"""m/s, 1.4 % of the speed, with the square of which the forces go."""


def linear_response(model, inputs: np.ndarray) -> np.ndarray:
    """Changes of the outputs after a step of the inputs, exact at the samples: (samples, 10)."""
    count = len(model.a)
    held = np.zeros((count + 1, count + 1))
    held[:count, :count], held[:count, count] = model.a, model.b @ inputs
    onward, state = expm(held * SAMPLE), np.append(np.zeros(count), 1.0)
    rows = []
    for _ in range(SAMPLES):
        state = onward @ state
        rows.append(model.c @ state[:count] + model.d @ inputs)
    return np.array(rows)


def nonlinear_response(model, inputs: np.ndarray) -> np.ndarray:
    """The same changes in a simulation that starts from the trim."""
    simulation, rows = simulation_in(model.trim), []
    command = command_of(model.trim.inputs + inputs)
    for _ in range(SAMPLES):
        simulation.step(command, SAMPLE)
        rows.append(outputs_of(simulation.state_vector, simulation.outputs) - model.trim_output)
    return np.array(rows)


@pytest.mark.parametrize("name", SMALL_STEPS)
@pytest.mark.parametrize("choice", ["1", "1a", "1b-no-strut", "1c-i", "2", "8dof"])
def test_the_response_to_a_small_step_is_that_of_the_model_but_for_its_square(choice, name):
    model = reference_model(choice, 3.0)
    step = SMALL_STEPS[name] * np.eye(len(INPUT_NAMES))[INPUT_NAMES.index(name)]
    missed = []
    for size in (1.0, 2.0):
        linear = linear_response(model, size * step)
        response = nonlinear_response(model, size * step)
        largest = np.abs(response).max(axis=0)
        missed.append(np.abs(linear - response).max(axis=0) / largest)
        assert missed[-1].max() < 0.02 * size
    growth = missed[1] / missed[0]  # relative to a response that is twice as large
    assert np.median(growth) == pytest.approx(2.0, rel=0.05)


@pytest.mark.parametrize("name", WIND_NAMES)
@pytest.mark.parametrize("choice", ["1", "2"])
def test_so_is_that_to_a_gust_along_or_across_the_heading(choice, name):
    trim = find_trim(REFERENCE.with_values(AIR), Options(model=choice), speed=SPEED)
    model = linearize(trim)
    assert model.input_names == (*INPUT_NAMES, *WIND_NAMES)
    step = GUST * np.eye(len(model.input_names))[model.input_names.index(name)]
    linear, response = linear_response(model, step), nonlinear_response(model, step)
    largest = np.abs(response).max(axis=0)
    moved = largest > 1e-6 * np.abs(model.trim_output).max()  # a headwind turns nothing
    assert moved.sum() >= 4
    assert (np.abs(linear - response).max(axis=0)[moved] < 0.02 * largest[moved]).all()


@pytest.mark.parametrize("choice", ["1", "2", "8dof"])
def test_steady_gains_at_constant_speed_are_those_between_two_trims(choice):
    model, change = reference_model(choice, 3.0), 1e-4
    u, torques = model.state_names.index("u"), [4, 5]
    unknown = model.a.copy()
    unknown[:, u] = model.b[:, torques].sum(axis=1)  # the torque instead of the speed
    found = np.linalg.solve(unknown, -model.b[:, 0])
    inputs = np.eye(10)[0]
    inputs[torques] = found[u]
    state = np.where(np.arange(len(found)) == u, 0.0, found)
    gains = model.c @ state + model.d @ inputs
    there, back = (
        linearize(
            find_trim(
                REFERENCE,
                Options(model=choice),
                speed=SPEED,
                steering=math.radians(3) + direction * change,
            )
        )
        for direction in (1, -1)
    )
    expected = (there.trim_output - back.trim_output) / (2 * change)
    moved = (there.trim_state - back.trim_state) / (2 * change)
    assert gains == pytest.approx(expected, rel=1e-4, abs=1e-6)  # the gains bend over the change
    assert state == pytest.approx(moved, rel=1e-3, abs=1e-4)


@pytest.mark.parametrize("choice", ["1", "2", "8dof"])
def test_the_model_of_a_right_turn_is_the_mirror_image_of_a_left_turn(choice):
    left, right = reference_model(choice, 3.0), reference_model(choice, -3.0)
    states, inputs, outputs = map(mirror, (left.state_names, INPUT_NAMES, left.output_names))
    for one, other, rows, columns in (
        (left.a, right.a, states, states),
        (left.b, right.b, states, inputs),
        (left.c, right.c, outputs, states),
        (left.d, right.d, outputs, inputs),
    ):
        size = np.abs(one).max()
        assert rows @ one @ columns == pytest.approx(other, abs=1e-8 * size)


@pytest.mark.parametrize("factor", [0.25, 2.0])
@pytest.mark.parametrize("steering", [0.0, 3.0])
def test_another_step_gives_the_same_slopes(monkeypatch, steering, factor):
    model = reference_model("1", steering)
    monkeypatch.setattr(linear_model, "STEP", factor * linear_model.STEP)
    other = linearize(model.trim)
    scale = typical(model.state_names)
    one, two = (each.a * scale / scale[:, np.newaxis] for each in (model, other))
    assert one == pytest.approx(two, abs=1e-8 * np.abs(one).max())
    assert other.step_error == pytest.approx(factor**2 * model.step_error, rel=0.1)
    assert model.step_error < 1e-5


@pytest.mark.parametrize("slip", [False, True])
@pytest.mark.parametrize("choice", [model for model in MODELS if model != "1c-iii"])
def test_every_model_has_states_without_redundancy_and_one_neutral_one(choice, slip):
    options = Options(model=choice, steady_state_slip=slip)
    model = linearize(find_trim(REFERENCE, options, speed=SPEED))
    count = (9 if options.has_eight_dof else 21) + (0 if slip else 8)
    assert model.a.shape == (count, count) == (len(model.state_names),) * 2
    assert (model.b.shape, model.c.shape, model.d.shape) == ((count, 10), (10, count), (10, 10))
    assert len(model.input_names) == len(model.output_names) == 10
    poles = np.linalg.eigvals(model.a)
    assert (np.abs(poles) < 1e-6).sum() == 1  # any speed is steady straight ahead
    assert np.sort(poles.real)[-2] < -0.1


def test_a_wheel_that_is_about_to_lift_has_no_slope():
    trim = find_trim(REFERENCE, speed=SPEED)
    state = trim.state.copy()
    state[TIRE_COMPRESSION.start + LF] = 5e-6
    with pytest.raises(InputError, match="kink"):
        linearize(dataclasses.replace(trim, state=state))


def test_the_file_is_read_without_pickle_and_has_everything_by_name(tmp_path):
    model = reference_model("1", 3.0)
    model.write_npz(tmp_path / "model")
    with np.load(tmp_path / "model", allow_pickle=False) as read:
        for name in ("A", "B", "C", "D"):
            assert np.array_equal(read[name], getattr(model, name.lower()))
        for name in ("state_names", "input_names", "output_names"):
            assert tuple(read[name]) == getattr(model, name)
        assert np.array_equal(read["trim_state"], model.trim_state)
        assert np.array_equal(read["trim_input"], model.trim.inputs)
        assert np.array_equal(read["trim_output"], model.trim_output)
    assert [path.name for path in tmp_path.iterdir()] == ["model"]


@pytest.mark.skipif(
    importlib.util.find_spec("control") is None, reason="the package control is not installed"
)
def test_a_control_system_has_the_same_matrices_names_and_poles():
    model = reference_model("1", 3.0)
    system = as_control_system(model)
    for name in ("A", "B", "C", "D"):
        assert np.array_equal(getattr(system, name), getattr(model, name.lower()))
    assert tuple(system.state_labels) == model.state_names
    assert tuple(system.input_labels) == model.input_names
    assert tuple(system.output_labels) == model.output_names
    poles = np.sort_complex(np.linalg.eigvals(model.a))
    assert np.sort_complex(system.poles()) == pytest.approx(poles, rel=1e-9)
