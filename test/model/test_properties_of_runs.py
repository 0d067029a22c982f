"""Properties of runs for any vehicle, model, option, road and command."""

import numpy as np
import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st
from mechanics import energy, power_of_lever
from programmes import record_run
from random_vehicles import (
    NUMBERS,
    OPTIONS,
    ROADS,
    WITH_ONE_SOLUTION,
    allowed_vehicles,
    held_commands,
    ordinary_vehicles,
)
from test_mirror import OTHER_SIDE
from test_properties_of_rates import reflected

from vehicle_roll_sim import Condition, InputError, Options, Simulation
from vehicle_roll_sim.model.frames import quaternion
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.simulation.road import Road

pytestmark = pytest.mark.unmeasured

SOME = settings(max_examples=settings().max_examples // 2)
FEW = settings(max_examples=settings().max_examples // 5)
COUNT, PERIOD = 10, 0.02
"""Commands in a run, and how long each is held (s)."""
SPEEDS = st.floats(3.6, 60.0)
"""m/s, which every model can start with."""
ROUNDING = 1e-14
"""Of a quaternion of four products."""
GROWN = 1e-7
"""Of the largest value: rounding, 1e-16, grown by what is unstable for 0.2 s. Seen: 2e-11."""
SHARE = 1e-6
"""Of the kinetic energy at 20 m/s: what the rule of the lever's work leaves, seen 1e-8."""
WORDS = ("normal_force", "longitudinal_force", "lateral_force", "slip_ratio", "slip_angle")


def started(vehicle, options, speed, road) -> Simulation:
    """A simulation at that speed; the case does not count where it is refused."""
    try:
        simulation = Simulation(vehicle, options, road=road)
        simulation.reset(speed)
    except InputError:
        reject()
    return simulation


def drive(simulation, commands):
    """Hold one command after the other; a run that has stopped says why and stays where it is."""
    for number, command in enumerate(commands, 1):
        held = np.atleast_1d(command)
        simulation.step(lambda _, held=held: held, PERIOD)
        is_complete = simulation.time_ns == number * round(PERIOD * 1e9)
        assert is_complete or simulation.condition is not Condition.RUNNING
        yield


def check(simulation) -> None:
    """What holds after every step of every run, stopped or not."""
    state, outputs = simulation.state, simulation.outputs
    has_diverged = simulation.condition is Condition.DIVERGED
    has_eight_dof = simulation.options.has_eight_dof
    assert np.isfinite(simulation.model_state).all()
    if has_diverged and has_eight_dof:
        return  # it may find no agreement with the command of no force that outputs then belong to
    for name in WORDS:
        assert np.isfinite(outputs[name]).all(), name
    loads = outputs["normal_force"]
    assert (loads >= 0.0).all()
    assert ((loads == 0.0) == (outputs["support"] <= 0.0)).all()
    pitch = 0.0 if has_eight_dof else float(state.pitch)
    turned = quaternion(float(state.roll), pitch, float(state.yaw))
    assert np.linalg.norm(turned) == pytest.approx(1.0, abs=ROUNDING)
    if not has_diverged and not has_eight_dof:  # whose wheels may carry nothing from the start
        lifted = simulation.events["lift_off_time"]
        assert ((loads > 0.0) | (lifted <= simulation.time)).all()


@SOME
@given(ordinary_vehicles(), OPTIONS, ROADS, held_commands(COUNT), SPEEDS)
def test_an_ordinary_vehicle_stays_finite_and_never_diverges(
    vehicle, options, road, commands, speed
):
    """But for the 8 DOF model, whose loads and accelerations sometimes find no agreement."""
    simulation = started(vehicle, options, speed, road)
    for _ in drive(simulation, commands):
        check(simulation)
        assert simulation.condition is not Condition.DIVERGED or options.has_eight_dof


@given(allowed_vehicles(), OPTIONS, ROADS, held_commands(COUNT), SPEEDS)
def test_no_allowed_vehicle_gives_anything_but_numbers_or_a_named_end(
    vehicle, options, road, commands, speed
):
    """Most are no vehicles at all, far too stiff for the step or overturned by their weight."""
    try:
        simulation = Simulation(vehicle, options, road=road, check_step=False)
        simulation.reset(speed)
    except InputError:
        return  # a name, too
    for _ in drive(simulation, commands):
        check(simulation)


@FEW
@given(ordinary_vehicles(), WITH_ONE_SOLUTION, ROADS, held_commands(COUNT, 0.3), SPEEDS)
def test_a_mirrored_run_is_the_mirror_image(vehicle, options, road, commands, speed):
    here = started(vehicle, options, speed, road)
    there = started(vehicle, options, speed, Road(road.grade, -road.bank))
    across = [reflected(command) for command in commands]
    for _ in zip(drive(here, commands), drive(there, across), strict=True):
        back = reflected(there.state)
        for name in options.states:
            largest = max(1.0, np.abs(here.state[name]).max())
            assert np.abs(here.state[name] - back[name]).max() < GROWN * largest, name
        loads = here.outputs["normal_force"], there.outputs["normal_force"][OTHER_SIDE]
        assert np.abs(loads[0] - loads[1]).max() < GROWN * loads[0].max()


@st.composite
def idle_driving(draw):
    """Steering of both axles and brakes, smooth in time: nothing that brings energy in."""
    rng = draw(NUMBERS)
    (front, rear), (quick, slow) = rng.uniform(0.0, (0.4, 0.1)), rng.uniform(0.5, 12.0, 2)
    brakes = rng.uniform(0.0, 1500.0, 4)

    def programme(times: np.ndarray) -> np.ndarray:
        commands = np.zeros(len(times), COMMAND)
        commands["steering"] = front * np.sin(quick * times)
        commands["rear_steering"] = rear * np.sin(slow * times)
        commands["brake_torque"] = brakes * np.clip(2 * times, 0.0, 1.0)[:, None]
        return commands

    return programme


@FEW
@given(ordinary_vehicles(sides=("",)), ROADS, idle_driving(), st.floats(5.0, 40.0), st.booleans())
def test_energy_does_not_grow_without_drive_or_active_forces(
    vehicle, road, programme, speed, steady_state_slip
):
    """At no step of a run, in the exact mechanics, on a tire that asks for no force by itself.

    But for the work of the load's lever, which the source's point of contact brings (`powers`).
    """
    options = Options(no_roll_centre=True, steady_state_slip=steady_state_slip)
    simulation = started(vehicle, options, speed, road)
    run = record_run(simulation, programme, 0.6)
    lever = power_of_lever(run.state, run.outputs)
    work = np.cumsum((lever[1:] + lever[:-1]) / 2 * np.diff(run.time))
    held = np.array([energy(vehicle, road, state) for state in run.state])
    kinetic = vehicle.sprung_mass * 20.0**2 / 2
    assert np.max(held[1:] - held[0] - work) < SHARE * kinetic
