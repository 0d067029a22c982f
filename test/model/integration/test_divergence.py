"""Divergence: detected before the next step; names the state; freezes the last plausible state."""

import dataclasses
import math

import numpy as np
import pytest
from programmes import SOURCE, j_turn, with_tire

from vehicle_roll_sim import WHEELS, Command, Condition, InputError, Options, Simulation
from vehicle_roll_sim.model.integration.events import plausible_magnitudes
from vehicle_roll_sim.model.records import COMMAND, STATE_NAMES

STEP = 0.001
"""s"""
EIGHT_DOF = Options(model="8dof")
KINDS = {
    "transient": Options(),
    "steady-state": SOURCE,
    "8dof": EIGHT_DOF,
    "8dof-steady": dataclasses.replace(EIGHT_DOF, steady_state_slip=True),
}
WHEEL_ANGLES = tuple(f"wheel_angle_{wheel}" for wheel in WHEELS)
"""Quantities that every model integrates but that do not occur in its equations."""
SUMS = ("x", "y", "yaw", *WHEEL_ANGLES)
"""States that may grow without limit: distances and angles."""
HUGE = (1e10, 1e308, -1e308)
"""Finite values; sums and products of the last ones overflow."""


@pytest.fixture
def simulation(reference):
    return Simulation(reference, step=STEP)


def vector(simulation) -> np.ndarray:
    """The state as the flat vector of STATE_NAMES."""
    return simulation.state_vector


def integrated(simulation) -> list[int]:
    """Indices of everything that is integrated."""
    return [STATE_NAMES.index(name) for name in (*simulation.state_names, *WHEEL_ANGLES)]


def is_finite(simulation) -> bool:
    """Whether all published states, loads and forces are finite."""
    outputs = simulation.outputs
    numbers = [
        vector(simulation)[integrated(simulation)],
        *(outputs[name] for name in ("normal_force", "longitudinal_force", "lateral_force")),
        *(outputs[name] for name in ("slip_ratio", "slip_angle", "loaded_radius")),
        *(outputs[name][:2] for name in ("acceleration", "specific_force")),
    ]
    return all(np.isfinite(part).all() for part in numbers)


def everything(simulation) -> bytes:
    return b"".join(part.tobytes() for part in (simulation.state, simulation.outputs))


def goes_on_after_a_reset(simulation) -> None:
    simulation.reset()
    assert (simulation.condition, simulation.implausible) == (Condition.RUNNING, None)
    assert simulation.step(Command(), STEP) is Condition.RUNNING
    assert is_finite(simulation)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e15, -1e15])
@pytest.mark.parametrize("kind", KINDS)
def test_a_value_that_no_vehicle_has_is_found_before_a_step_whatever_the_state(
    reference, kind, value
):
    simulation = Simulation(reference, KINDS[kind], step=STEP)
    for place in integrated(simulation):
        simulation.reset()
        simulation.step(Command(), 10 * STEP)
        before = everything(simulation)
        vector(simulation)[place] = value
        for _ in range(2):  # it stays so
            assert simulation.step(Command(), 5 * STEP) is Condition.DIVERGED
            assert simulation.implausible == STATE_NAMES[place]
            assert simulation.time == 10 * STEP
            assert everything(simulation) == before  # of which all messages are made
        goes_on_after_a_reset(simulation)


@pytest.mark.parametrize("name", [n for n in STATE_NAMES if "_slip_" in n])
def test_tires_may_have_slid_however_far(simulation, name):
    vector(simulation)[STATE_NAMES.index(name)] = 1e3
    assert simulation.step(Command(steering=0.02), 0.1) is Condition.RUNNING


@pytest.mark.parametrize("name", SUMS)
def test_distances_and_angles_may_be_those_of_months(simulation, name):
    """1e9 m at 100 m/s take 116 days."""
    vector(simulation)[STATE_NAMES.index(name)] = 1e9
    assert simulation.step(Command(steering=0.02), 0.1) is Condition.RUNNING


@pytest.mark.parametrize("kind", ["transient", "steady-state"])
def test_a_run_that_diverges_by_itself_stops_at_its_last_plausible_state(reference, kind):
    """With a step of 0.1 s the integration of the J-turn is unstable."""
    simulation = Simulation(reference, KINDS[kind], step=0.1, check_step=False)
    assert simulation.step(j_turn(), 6.0) is Condition.DIVERGED
    assert 0.0 < simulation.time < 6.0
    assert simulation.implausible in STATE_NAMES
    places = integrated(simulation)
    largest = plausible_magnitudes().view(float)
    assert (np.abs(vector(simulation)) <= largest)[places].all()
    assert is_finite(simulation)
    again = Simulation(reference, KINDS[kind], step=0.1, check_step=False)
    again.step(j_turn(), simulation.time)  # as far as the other got
    assert again.condition is Condition.RUNNING
    assert again.state.tobytes() == simulation.state.tobytes()


COMMANDS = {
    "drive": ("wheel_speed", lambda value: Command(wheel_torque=(0.0, 0.0, value, 0.0))),
    "hold": ("wheel_speed", lambda value: Command(speed_hold_gain=value, speed_hold_target=99.0)),
    "lift": ("unsprung_velocity", lambda value: Command(normal_force=(value, 0.0, 0.0, 0.0))),
}
"""The states that an unlimited command drives beyond any bound, by model."""


@pytest.mark.parametrize("value", HUGE)
@pytest.mark.parametrize("name", COMMANDS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_huge_command_is_divergence_of_what_it_drives(reference, kind, name, value):
    simulation = Simulation(reference, KINDS[kind], step=STEP)
    simulation.step(Command(), 10 * STEP)
    states, command = COMMANDS[name]
    assert simulation.step(command(value), 10.0) is Condition.DIVERGED
    assert is_finite(simulation)
    if any(state.startswith(states) for state in simulation.state_names):
        assert simulation.implausible.startswith(states)
    goes_on_after_a_reset(simulation)


@pytest.mark.parametrize("value", HUGE)
@pytest.mark.parametrize("name", ["steering", "rear_steering", "brake_torque"])
@pytest.mark.parametrize("kind", KINDS)
def test_after_any_finite_command_all_that_is_told_is_finite(reference, kind, name, value):
    """An angle is one between 0 and a full turn; the torque of a brake is limited to a wheel's."""
    simulation = Simulation(reference, KINDS[kind], step=STEP)
    given = (abs(value),) * 4 if name == "brake_torque" else value
    simulation.step(Command(**{name: given}), 3.0)
    assert is_finite(simulation)
    assert (simulation.implausible is None) == (simulation.condition is not Condition.DIVERGED)
    goes_on_after_a_reset(simulation)


@pytest.mark.parametrize("kind", KINDS)
def test_a_step_into_a_state_without_a_rate_is_taken_back(reference, kind):
    """Its forces would be told as nan: here those of a command that is no number at its end."""

    def programme(times: np.ndarray) -> np.ndarray:
        commands = np.zeros(len(times), COMMAND)
        commands["steering"][times > 0.0195] = math.nan
        return commands

    simulation = Simulation(reference, KINDS[kind], step=STEP)
    assert simulation.step(programme, 0.1) is Condition.DIVERGED
    assert simulation.time == pytest.approx(0.019)
    assert simulation.implausible in simulation.state_names
    assert is_finite(simulation)


@pytest.mark.parametrize("kind", KINDS)
def test_a_vehicle_without_a_finite_rate_at_rest_is_refused_with_the_state(reference, kind):
    """The slip stiffness of this tire, exp(PKX3 dfz), is infinite below its nominal load."""
    vehicle = with_tire(reference, PKX3=-1e7)
    for begin in (Simulation.reset, lambda simulation: simulation.step(Command(), STEP)):
        simulation = Simulation(vehicle, KINDS[kind], step=STEP)
        with pytest.raises(InputError) as refusal:
            begin(simulation)
        assert refusal.value.field == "vehicle"
        assert "is not finite" in str(refusal.value)
        assert simulation.time == 0.0
