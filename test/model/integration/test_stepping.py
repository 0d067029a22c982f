"""Stepping: time, commands, and independence of how a run is divided into calls."""

import math

import numpy as np
import pytest
from programmes import j_turn, record_run

from vehicle_roll_sim import LF, RF, Command, Condition, InputError, Simulation
from vehicle_roll_sim.model.records import COMMAND

STEP = 0.001
"""s"""
MOST_GRIP = 1.5
"""Friction of the reference tire at any load, with something to spare."""
HOUR_OF_STEPS = 3_600_000
NANOSECONDS_PER_STEP = 1_000_000


@pytest.fixture
def simulation(reference):
    return Simulation(reference, step=STEP)


def everything(simulation) -> bytes:
    records = (simulation.state, simulation.outputs, simulation.events)
    return b"".join(record.tobytes() for record in records)


@pytest.mark.parametrize(
    "command",
    [
        pytest.param(Command(steering=0.05, wheel_torque=(0.0, 0.0, 90.0, 80.0)), id="held"),
        pytest.param(j_turn(wheel_torque=(10.0, 20.0, 30.0, 40.0)), id="programme"),
    ],
)
@pytest.mark.parametrize("vehicle_step", [STEP, 0.7e-3])
def test_a_thousand_steps_at_once_are_a_thousand_single_steps_to_the_last_bit(
    reference, command, vehicle_step
):
    at_once = Simulation(reference, step=vehicle_step)
    one_by_one = Simulation(reference, step=vehicle_step)
    for _ in range(2):  # the second thousand turns, and lifts a wheel
        at_once.step(command, 1000 * vehicle_step)
        for _ in range(1000):
            one_by_one.step(command, vehicle_step)
    assert at_once.time_ns == one_by_one.time_ns
    assert everything(at_once) == everything(one_by_one)


@pytest.mark.parametrize("command", [Command(steering=0.05), j_turn()], ids=["held", "programme"])
def test_a_recorded_run_of_the_tests_has_what_single_steps_give(reference, command):
    run = record_run(Simulation(reference, step=STEP), command, 1.2)
    one_by_one = Simulation(reference, step=STEP)
    for time, state, outputs in zip(run.time, run.state, run.outputs, strict=True):
        assert time == one_by_one.time
        assert state.tobytes() == one_by_one.state.tobytes()
        assert outputs.tobytes() == one_by_one.outputs.tobytes()
        one_by_one.step(command, STEP)


def test_time_is_counted_in_whole_nanoseconds_and_never_drifts(reference):
    simulation = Simulation(reference, step=STEP)
    for _ in range(1000):
        simulation.step(Command(), STEP)
    assert isinstance(simulation.time_ns, int)
    assert simulation.time_ns == 1000 * NANOSECONDS_PER_STEP
    assert simulation.time == 1.0
    simulation.time_ns = HOUR_OF_STEPS * NANOSECONDS_PER_STEP  # as after an hour
    simulation.step(Command(), STEP)
    assert simulation.time_ns == (HOUR_OF_STEPS + 1) * NANOSECONDS_PER_STEP


def test_a_step_of_a_third_of_a_millisecond_is_rounded_to_whole_nanoseconds(reference):
    simulation = Simulation(reference, step=1e-3 / 3)
    simulation.step(Command(), 0.333_333)
    assert simulation.time_ns == 1000 * 333_333


@pytest.mark.parametrize(
    "duration", [0.0, -STEP, STEP / 2, 1.5 * STEP, 1.0004, math.nan, math.inf, -math.inf]
)
def test_a_duration_that_is_no_multiple_of_the_step_is_refused_and_nothing_moves(
    simulation, duration
):
    before = everything(simulation)
    with pytest.raises(InputError) as refusal:
        simulation.step(Command(), duration)
    assert refusal.value.field == "duration"
    assert "\n" not in str(refusal.value)
    assert (simulation.time_ns, everything(simulation)) == (0, before)


@pytest.mark.parametrize("steps", [1, 3, 7, 33, 4999])
def test_multiples_that_decimals_only_nearly_give_are_taken(simulation, steps):
    simulation.step(Command(), steps * STEP)
    assert simulation.time_ns == steps * NANOSECONDS_PER_STEP


@pytest.mark.parametrize("step", [0.0, -STEP, 9e-7, 0.11, math.nan, math.inf])
def test_a_step_outside_its_range_is_refused(reference, step):
    with pytest.raises(InputError) as refusal:
        Simulation(reference, step=step)
    assert refusal.value.field == "step"


@pytest.mark.parametrize("angle", [0.0, -1.0, 2.0, math.nan])
def test_a_rollover_angle_outside_its_range_is_refused(reference, angle):
    with pytest.raises(InputError) as refusal:
        Simulation(reference, rollover_angle=angle)
    assert refusal.value.field == "rollover_angle"


def test_a_programme_is_asked_at_the_beginning_middle_and_end_of_every_step(simulation):
    asked = []

    def programme(times):
        asked.append(times)
        return np.zeros(len(times), COMMAND)

    simulation.step(Command(), 0.25)
    simulation.step(programme, 3 * STEP)
    expected = 0.25 + np.arange(7) * STEP / 2
    np.testing.assert_allclose(asked[0], expected, rtol=1e-14)  # seconds since the reset


def test_outputs_after_a_step_belong_to_the_new_state_and_the_last_command(reference):
    simulation = Simulation(reference)
    simulation.step(j_turn(), 1.2)
    outputs, state = simulation.outputs, simulation.state
    assert outputs.steering[LF] == pytest.approx(math.radians(8.0), rel=1e-12)
    load = reference.front_tire_stiffness * state.tire_compression[RF]
    assert outputs.normal_force[RF] == pytest.approx(load, rel=1e-12)


def test_reset_gives_the_first_state_back_bit_by_bit(simulation):
    fresh = everything(simulation)
    simulation.step(j_turn(), 6.0)
    assert simulation.condition is Condition.ROLLED_OVER
    simulation.reset()
    assert everything(simulation) == fresh
    assert simulation.time_ns == 0
    assert simulation.condition is Condition.RUNNING
    assert simulation.implausible is None


def test_a_run_after_a_reset_is_the_first_run_again_bit_by_bit(simulation):
    simulation.step(j_turn(), 2.0)
    first = everything(simulation)
    simulation.reset()
    simulation.step(j_turn(), 2.0)
    assert everything(simulation) == first


def test_a_tire_never_pulls_on_the_road_and_a_lifted_one_makes_no_force(simulation):
    run = record_run(simulation, j_turn(wheel_torque=(200.0,) * 4), 6.0)
    load = run.outputs["normal_force"]
    lifted = run.state["tire_compression"] <= 0.0
    assert lifted.any()
    assert load.min() == 0.0
    assert (load[lifted] == 0.0).all()
    assert (load[~lifted] > 0.0).all()
    for force in ("longitudinal_force", "lateral_force"):
        assert (run.outputs[force][lifted] == 0.0).all()
    unloaded = run.outputs["loaded_radius"][lifted]
    assert (unloaded == simulation.vehicle.tire_radius).all()


def test_at_contact_a_force_begins_at_zero_without_a_jump(simulation):
    run = record_run(simulation, j_turn(wheel_torque=(200.0,) * 4), 6.0)
    load, squeezed = run.outputs["normal_force"], np.maximum(run.state["tire_compression"], 0.0)
    stiffness = simulation.vehicle.per_wheel("tire_stiffness")
    changes = np.abs(np.diff(load, axis=0))
    assert (np.diff(load == 0.0, axis=0)).sum() >= 2  # wheels leave the ground on the way
    rounding = 1e-9 * load.max()
    assert (changes <= stiffness * np.abs(np.diff(squeezed, axis=0)) + rounding).all()
    for force in ("longitudinal_force", "lateral_force"):
        assert (np.abs(run.outputs[force]) <= MOST_GRIP * load).all()


def test_an_active_force_beyond_the_load_of_a_wheel_lifts_it(simulation):
    pull = (-8000.0, 0.0, 0.0, 0.0)  # N, more than twice the load of the wheel
    run = record_run(simulation, Command(normal_force=pull), 0.2)
    lowest = run.outputs["normal_force"].min(axis=0)
    assert lowest[LF] == 0.0
    assert (lowest[RF:] > 0.0).all()
    first = run.time[np.argmax(run.outputs["normal_force"][:, LF] == 0.0)]
    lift_off = simulation.events.lift_off_time
    assert first - STEP <= lift_off[LF] <= first
    assert np.isnan(lift_off[RF:]).all()


def test_an_active_force_that_pushes_the_body_up_presses_the_wheel_down(simulation):
    before = simulation.outputs.normal_force[LF]
    simulation.step(Command(normal_force=(2000.0, 0.0, 0.0, 0.0)), 0.02)
    assert simulation.outputs.normal_force[LF] > before + 100.0  # N
    assert simulation.state.roll > 0.0  # the left side rises
    assert simulation.state.pitch < 0.0  # and the front
