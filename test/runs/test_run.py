"""A run from start to end: rows at the requested times, commands as given."""

import math

import numpy as np
import pytest
from signals import everything, turn

from vehicle_roll_sim import Command, Condition, InputError, Simulation, preset
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.runs.columns import row_of
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.command import command_at

NS = 1_000_000_000


@pytest.fixture
def other() -> Simulation:
    """A second simulation, stepped without `run`."""
    return Simulation(preset())


def milliseconds(history) -> list[int]:
    return np.rint(history["time"] * 1e3).astype(int).tolist()


@pytest.mark.parametrize(
    ("duration", "sample", "expected"),
    [
        (0.03, 0.01, [0, 10, 20, 30]),
        (0.25, 0.1, [0, 100, 200, 250]),
        (0.05, 1.0, [0, 50]),
        (0.003, 0.001, [0, 1, 2, 3]),
    ],
)
def test_there_is_a_row_at_the_start_at_every_sample_and_at_the_end(
    simulation, duration, sample, expected
):
    history = run(simulation, turn(4.0), duration, sample=sample)
    assert milliseconds(history) == expected
    assert simulation.time_ns == round(duration * NS)


@pytest.mark.parametrize("period", [0.004, 0.025])
def test_a_period_of_commands_adds_no_rows(simulation, period):
    history = run(simulation, turn(4.0), 0.07, sample=0.02, command_period=period)
    assert milliseconds(history) == [0, 20, 40, 60, 70]


def all_commands(times: np.ndarray) -> np.ndarray:
    """A programme with every command, each another one, and a speed hold."""
    records = np.zeros(len(times), COMMAND)
    records["rear_steering"] = 0.01 * times
    for place, name in enumerate(("wheel_torque", "brake_torque", "normal_force")):
        records[name] = (place + 1 + np.arange(4)) * (1.0 + times[:, np.newaxis])
    records["speed_hold_gain"], records["speed_hold_target"] = 200.0, 15.0
    return records


def test_a_programme_has_its_own_commands_at_each_row_with_the_torque_that_holds_the_speed(
    simulation,
):
    history = run(simulation, all_commands, 0.07, sample=0.02)
    for k, time in enumerate(history["time"]):
        held = command_at(all_commands, time, {"u": history["u"][k]})
        assert history.command("rear_steering")[k] == held.rear_steering
        np.testing.assert_allclose(history.command("wheel_torque")[k], held.wheel_torque)
        assert tuple(history.command("brake_torque")[k]) == held.brake_torque
        assert tuple(history.command("active_force")[k]) == held.normal_force


def test_held_commands_are_those_of_the_period_that_ends_with_the_row(simulation):
    history = run(simulation, all_commands, 0.08, sample=0.02, command_period=0.02)
    began = [history["time"][:-1], history["u"][:-1]]
    held = [command_at(all_commands, time, {"u": u}) for time, u in zip(*began, strict=True)]
    expected = [Command(), *held]
    for k, command in enumerate(expected):
        assert history.command("rear_steering")[k] == command.rear_steering
        assert tuple(history.command("wheel_torque")[k]) == command.wheel_torque
        assert tuple(history.command("active_force")[k]) == command.normal_force


def test_a_run_that_stops_ends_with_the_row_of_its_last_moment(simulation):
    history = run(simulation, turn(12.0), 9.0, sample=0.5)
    assert simulation.condition is Condition.ROLLED_OVER
    assert history["time"][-1] == simulation.time < 9.0
    assert history["time"][-2] == math.floor(simulation.time * 2) / 2
    assert abs(history["roll"][-1]) >= math.radians(85.0) > abs(history["roll"][-2])
    np.testing.assert_array_equal(history.rows[-1], row_of(simulation))


def test_a_run_that_has_stopped_before_has_one_row_and_stays(simulation):
    simulation.step(turn(12.0), 9.0)
    before = everything(simulation)
    history = run(simulation, turn(0.0), 1.0)
    assert len(history.rows) == 1
    assert everything(simulation) == before


def test_a_programme_drives_every_stage_as_in_a_simulation_stepped_by_hand(simulation, other):
    history = run(simulation, turn(6.0), 0.5, sample=0.02)
    rows = [row_of(other)]
    for _ in range(25):
        other.step(turn(6.0), 0.02)
        rows.append(row_of(other))
    np.testing.assert_array_equal(history.rows, rows)


def test_with_a_period_commands_are_those_of_its_beginning_held(simulation, other):
    programme, rows = turn(6.0), [row_of(other)]
    history = run(simulation, programme, 0.5, sample=0.01, command_period=0.025)
    for ms in range(0, 500, 5):  # both intervals are multiples of 5 ms
        if ms % 25 == 0:
            sampled = programme(np.array([other.time]))[0]
            command = Command(steering=sampled.steering, wheel_torque=tuple(sampled.wheel_torque))
        other.step(command, 0.005)
        if ms % 10 == 5:
            rows.append(row_of(other))
    assert len(set(history["steering"])) > 5  # it did turn, in stairs
    np.testing.assert_array_equal(history.rows, rows)


def test_sampled_commands_are_not_those_of_every_stage(simulation, other):
    by_stage = run(simulation, turn(6.0), 0.5)
    sampled = run(other, turn(6.0), 0.5, command_period=0.01)
    difference = np.abs(by_stage["roll"] - sampled["roll"]).max()
    assert 0.0 < difference < 0.01 * np.abs(by_stage["roll_rate"]).max()  # at most a period late


def test_rows_do_not_change_the_run(simulation, other):
    often = run(simulation, turn(6.0), 0.5, sample=0.001)
    seldom = run(other, turn(6.0), 0.5, sample=0.5)
    np.testing.assert_array_equal(often.rows[[0, -1]], seldom.rows)
    assert everything(simulation) == everything(other)


def test_a_run_goes_on_from_where_the_simulation_is(simulation, other):
    other.step(turn(6.0), 0.5)
    first, second = (run(simulation, turn(6.0), 0.25) for _ in range(2))
    assert (first["time"][-1], second["time"][0], second["time"][-1]) == (0.25, 0.25, 0.5)
    assert everything(simulation) == everything(other)


def test_a_programme_that_is_held_is_its_command_of_that_time_with_the_torque_of_the_speed_hold():
    answer = command_at(turn(6.0, start=0.0, seconds=1.0), 0.5, {"u": 12.0})
    assert answer == Command(math.radians(3.0), wheel_torque=(0.0, 0.0, 25.0, 25.0))
    records = turn(6.0, start=0.0, seconds=1.0)(np.array([0.5]))
    records["speed_hold_gain"], records["speed_hold_target"] = 100.0, 12.5
    answer = command_at(lambda _: records, 0.5, {"u": 12.0})
    assert answer.wheel_torque == (0.0, 0.0, 75.0, 75.0)
    assert answer.speed_hold_gain == 0.0


@pytest.mark.parametrize("value", [0.0015, 1e-4, -0.01, math.nan, math.inf])
@pytest.mark.parametrize("argument", ["duration", "sample", "command_period"])
def test_times_that_are_no_multiples_of_the_step_are_refused_by_name(simulation, argument, value):
    before = everything(simulation)
    with pytest.raises(InputError) as refusal:
        run(simulation, turn(4.0), **({"duration": 1.0} | {argument: value}))
    assert argument.replace("_", " ") in refusal.value.field.replace("-", " ").replace("_", " ")
    assert "0.001" in str(refusal.value)
    assert everything(simulation) == before


@pytest.mark.parametrize("degrees", [0.0, 12.0], ids=["to the end", "to the rollover"])
def test_progress_adds_up_to_the_time_that_was_simulated(simulation, degrees):
    stretches = []
    run(simulation, turn(degrees), 6.0, sample=0.25, progress=stretches.append)
    assert len(stretches) > 5
    assert math.fsum(stretches) == pytest.approx(simulation.time, abs=1e-9)  # sums of ns
