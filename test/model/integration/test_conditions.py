"""End of a run: rolled over or too slow; it stays stopped until a reset."""

import math

import numpy as np
import pytest
from programmes import SOURCE, j_turn, record_run

from vehicle_roll_sim import Command, Condition, InputError, Options, Simulation
from vehicle_roll_sim.model.integration.events import MINIMUM_SPEED

STEP = 0.001
"""s"""
BRAKES = Command(wheel_torque=(-800.0,) * 4)


@pytest.fixture
def simulation(reference):
    return Simulation(reference, step=STEP)


@pytest.fixture
def steady(reference):
    """One with steady-state slip, which needs a lowest speed."""
    return Simulation(reference, SOURCE, step=STEP)


def everything(simulation) -> bytes:
    records = (simulation.state, simulation.outputs, simulation.events)
    return b"".join(record.tobytes() for record in records)


def stays_stopped(simulation, condition: Condition) -> None:
    time, before = simulation.time_ns, everything(simulation)
    assert simulation.step(Command(), 10 * STEP) is condition
    assert simulation.condition is condition
    assert (simulation.time_ns, everything(simulation)) == (time, before)


def goes_on_after_a_reset(simulation) -> None:
    simulation.reset()
    assert simulation.step(Command(), STEP) is Condition.RUNNING
    assert simulation.time == STEP


def test_a_vehicle_that_rolled_over_stays_so_until_a_reset(simulation):
    assert simulation.step(j_turn(), 6.0) is Condition.ROLLED_OVER
    assert simulation.time < 6.0
    stays_stopped(simulation, Condition.ROLLED_OVER)
    goes_on_after_a_reset(simulation)


@pytest.mark.parametrize("degrees", [10.0, 30.0, 90.0])
def test_the_rollover_angle_says_where_a_run_stops(reference, degrees):
    simulation = Simulation(reference, rollover_angle=math.radians(degrees))
    run = record_run(simulation, j_turn(), 6.0)
    roll = np.degrees(run.state["roll"])
    assert simulation.condition is Condition.ROLLED_OVER
    assert roll[-2] < degrees <= roll[-1]
    share = (degrees - roll[-2]) / (roll[-1] - roll[-2])  # linear between the last two steps
    expected = run.time[-2] + share * STEP
    assert simulation.events.rollover_time[0] == pytest.approx(expected, abs=1e-9)


def test_rolling_over_to_the_right_counts_as_well(simulation):
    simulation.step(lambda times: mirrored(j_turn()(times)), 6.0)
    assert simulation.condition is Condition.ROLLED_OVER
    assert simulation.state.roll <= -math.radians(85.0)


def mirrored(commands: np.ndarray) -> np.ndarray:
    commands["steering"] *= -1.0
    return commands


def test_with_steady_state_slip_a_run_that_slows_to_the_lowest_speed_stops_there(steady):
    run = record_run(steady, BRAKES, 10.0)
    assert steady.condition is Condition.TOO_SLOW
    assert run.state["u"][-1] < MINIMUM_SPEED <= run.state["u"][-2]
    assert MINIMUM_SPEED == 3.5  # m/s
    stays_stopped(steady, Condition.TOO_SLOW)
    goes_on_after_a_reset(steady)


@pytest.mark.parametrize("model", ["1", "8dof"])
def test_with_transient_slip_a_run_that_slows_goes_on_backwards(reference, model):
    """Negative torques, which no brake is, turn wheels back as soon as they stand."""
    simulation = Simulation(reference, Options(model=model), step=STEP)
    assert simulation.step(BRAKES, 10.0) is Condition.RUNNING
    assert simulation.state.u < -MINIMUM_SPEED


def test_the_lowest_speed_itself_is_allowed_for_as_long_as_it_is_kept(steady):
    steady.reset(MINIMUM_SPEED)
    assert steady.step(Command(), 60.0) is Condition.RUNNING


def test_with_transient_slip_a_vehicle_may_stand_for_as_long_as_it_wants(simulation):
    simulation.reset(0.0)
    assert simulation.step(Command(), 60.0) is Condition.RUNNING
    assert abs(simulation.state.x) < 1e-9  # m: rounding of 60,000 steps


@pytest.mark.parametrize(
    ("options", "speed"),
    [
        *((SOURCE, speed) for speed in (3.499, 0.0)),
        *((o, speed) for o in (SOURCE, Options()) for speed in (-14.0, 100.1, math.nan, math.inf)),
        (Options(), -1e-9),
    ],
)
def test_a_reset_to_a_speed_outside_the_range_is_refused_and_changes_nothing(
    reference, options, speed
):
    simulation = Simulation(reference, options, step=STEP)
    simulation.step(j_turn(), 1.5)
    time, before = simulation.time_ns, everything(simulation)
    with pytest.raises(InputError) as refusal:
        simulation.reset(speed)
    assert refusal.value.field == "speed"
    assert "\n" not in str(refusal.value)
    assert (simulation.time_ns, everything(simulation)) == (time, before)
