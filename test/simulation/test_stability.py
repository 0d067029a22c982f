"""The largest step: every mode decays at it; a larger one is unstable and refused."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import Command, Condition, InputError, Options, Simulation, preset
from vehicle_roll_sim.model.records import STATE_NAMES
from vehicle_roll_sim.simulation.options import MODELS
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.stability import growth, largest_stable_step

KMH_50 = 50 / 3.6
"""m/s"""
TRANSIENT, STEADY = Options(), Options(steady_state_slip=True)
STIFF = {"front_tire_stiffness": 1e8}
LIGHT = {"wheel_inertia": 0.01}
UNDAMPED = {"front_damping": 0.0, "rear_damping": 0.0}
CASES = {
    "at rest": (TRANSIENT, 0.0, {}),
    "hardly moving": (TRANSIENT, 1e-6, {}),
    "walking pace": (TRANSIENT, 0.5, {}),
    "transient slip": (TRANSIENT, KMH_50, {}),
    "fast": (TRANSIENT, 100.0, {}),
    "slow, steady-state slip": (STEADY, 3.6, {}),
    "steady-state slip": (STEADY, KMH_50, {}),
    "fast, steady-state slip": (STEADY, 100.0, {}),
    "8 DOF": (Options(model="8dof"), KMH_50, {}),
    "8 DOF, steady-state slip": (Options(model="8dof", steady_state_slip=True), KMH_50, {}),
    "stiff tires": (TRANSIENT, KMH_50, STIFF),
    "light wheels": (TRANSIENT, KMH_50, LIGHT),
    "light wheels at rest": (TRANSIENT, 0.0, LIGHT),
    "light wheels, steady-state slip": (STEADY, KMH_50, LIGHT),
    "no dampers": (TRANSIENT, KMH_50, UNDAMPED),
    "hard dampers": (TRANSIENT, KMH_50, {"front_damping": 1e6}),
    "rolling resistance": (TRANSIENT, KMH_50, {"rolling_resistance_coefficient": 0.02}),
}
"""Options, speed (m/s) and values of the vehicle."""
FREE = ("x", "y", "yaw", "wheel_angle")
"""What may go on growing."""
DISTURBANCE = 1e-6
"""SI units: small enough for the slopes to hold, large beside rounding."""
STEPS = 1000


def prepared(case: str, step: float) -> Simulation:
    options, speed, values = CASES[case]
    vehicle = preset().with_values(values)
    simulation = Simulation(vehicle, options, step=step, check_step=False)
    simulation.reset(speed)
    return simulation


def left_of_a_disturbance(case: str, step: float) -> float:
    """The largest that is left of it in any state after 1000 steps, inf if that run diverges."""
    disturbed, other = prepared(case, step), prepared(case, step)
    kept = [
        place
        for place, name in enumerate(STATE_NAMES)
        if name in disturbed.state_names and not name.startswith(FREE)
    ]
    disturbed.state_vector[kept] += DISTURBANCE * np.cos(kept)  # of all modes something
    for simulation in (disturbed, other):
        simulation.step(Command(), STEPS * simulation.step_ns / 1e9)
    if disturbed.condition is not Condition.RUNNING:
        return math.inf
    return float(np.abs(disturbed.state_vector - other.state_vector)[kept].max())


@pytest.mark.parametrize("case", CASES)
def test_up_to_the_largest_step_a_disturbance_stays_small_and_beyond_it_grows(case):
    """Some 200 times: a slip becomes a speed of the wheel that is as many times as large.

    10 % beyond, since tires at rest have a kink, which keeps what grows slowly small.
    """
    largest = prepared(case, 1e-3).largest_stable_step()
    assert left_of_a_disturbance(case, 0.98 * largest) < 300 * DISTURBANCE
    assert left_of_a_disturbance(case, 1.1 * largest) > 1e4 * DISTURBANCE


@pytest.mark.parametrize("case", CASES)
def test_a_reset_refuses_a_larger_step_in_one_line_with_the_largest_and_changes_nothing(case):
    options, speed, values = CASES[case]
    vehicle = preset().with_values(values)
    largest = prepared(case, 1e-3).largest_stable_step()
    simulation = Simulation(vehicle, options, step=1.01 * largest)
    before = simulation.state.tobytes(), simulation.outputs.tobytes()
    with pytest.raises(InputError) as refusal:
        simulation.reset(speed)
    assert refusal.value.field == "step"
    assert f"at {speed:.4g} m/s" in str(refusal.value)
    assert "\n" not in str(refusal.value)
    assert (simulation.state.tobytes(), simulation.outputs.tobytes()) == before
    told = float(refusal.value.allowed.split()[2])  # at most 0.0031 s
    assert 0.9 * largest <= told <= largest
    Simulation(vehicle, options, step=told).reset(speed)


def test_the_spin_of_a_wheel_against_steady_state_slip_gives_the_step_by_hand():
    """Kx r^2 / (Jw u) of a front wheel, on the real axis; the body gives way by 2.4 %."""
    vehicle = preset()
    simulation = Simulation(vehicle, STEADY)
    tire, load = vehicle.tire.coefficients, simulation.outputs.normal_force[0]
    radius = simulation.outputs.loaded_radius[0]
    excess = load / (tire["LFZO"] * tire["FNOMIN"]) - 1
    stiffness = load * (tire["PKX1"] + tire["PKX2"] * excess) * math.exp(tire["PKX3"] * excess)
    rate = stiffness * radius**2 / (vehicle.wheel_inertia * KMH_50)
    assert simulation.largest_stable_step() == pytest.approx(2.785 / rate, rel=0.03)


def test_the_hop_of_a_wheel_without_damping_gives_the_step_by_hand():
    """sqrt((ks + kt) / mu) of the lightest wheel, on the imaginary axis; the body is heavy."""
    vehicle = preset().with_values(UNDAMPED | STIFF | {"rear_tire_stiffness": 1e8})
    frequency = math.sqrt(
        (vehicle.front_spring_stiffness + 1e8)
        / min(vehicle.front_unsprung_mass, vehicle.rear_unsprung_mass)
    )
    expected = math.sqrt(8.0) / frequency
    assert Simulation(vehicle).largest_stable_step() == pytest.approx(expected, rel=0.01)


def test_the_lag_of_a_tire_gives_the_step_by_hand():
    """u / sigma of every tire, on the real axis; the wheel it slides on is heavy here."""
    vehicle = preset().with_values({"wheel_inertia": 1e4})
    tire = vehicle.tire.with_coefficients(PTX1=0.0, PTX2=0.0, PTY1=0.0)
    simulation = Simulation(type(vehicle)(**vars_of(vehicle), tire=tire))
    simulation.reset(100.0)
    expected = 2.785 / (100.0 / vehicle.minimum_relaxation_length)
    assert simulation.largest_stable_step() == pytest.approx(expected, rel=0.01)


def vars_of(vehicle) -> dict:
    names = vehicle.__dataclass_fields__
    return {name: getattr(vehicle, name) for name in names if name != "tire"}


@pytest.mark.parametrize("degrees", [90.0, 100.0, 120.0, 135.0, 150.0, 180.0])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e6])
def test_in_the_largest_step_the_quickest_mode_just_does_not_grow(degrees, size):
    pole = size * np.exp(1j * math.radians(degrees))
    step = largest_stable_step(np.array([pole, pole.conjugate(), -size / 3, 0.0]), 1e9)
    assert growth(np.array([pole * step])) <= 1 + 2e-9
    assert growth(np.array([pole * step * (1 + 1e-3)])) > 1


def test_what_grows_by_itself_asks_for_no_smaller_step():
    assert largest_stable_step(np.array([1e6, 0.0]), 0.1) == 0.1
    assert largest_stable_step(np.array([1e-9 + 100j]), 0.1) == pytest.approx(math.sqrt(8) / 100)


def test_without_a_reset_the_first_step_refuses_and_a_reset_to_a_fitting_speed_helps():
    simulation = Simulation(preset(), STEADY, step=0.01)
    with pytest.raises(InputError, match=r"at most 0\.0053 s at 13\.89 m/s"):
        simulation.step(Command(), 0.01)
    assert simulation.time == 0.0
    simulation.reset(50.0)
    assert simulation.step(Command(), 0.01) is Condition.RUNNING


def test_a_knowingly_coarse_run_may_be_asked_for():
    simulation = Simulation(preset(), STEADY, step=0.01, check_step=False)
    simulation.reset(KMH_50)
    assert simulation.step(Command(), 0.1) is Condition.RUNNING


@pytest.mark.parametrize("speed", [0.0, KMH_50, 100.0])
@pytest.mark.parametrize("model", MODELS)
def test_the_usual_step_is_small_enough_for_every_model_on_any_slope(model, speed):
    for options in (Options(model=model), Options(model=model, steady_state_slip=True)):
        simulation = Simulation(preset(), options, road=Road(grade=0.3, bank=-0.2))
        if speed or not options.steady_state_slip:
            simulation.reset(speed)
            assert simulation.largest_stable_step() > 0.001


def test_the_present_state_says_when_a_step_has_become_too_large():
    """With steady-state slip in proportion to the speed; the load is back when it coasts again."""
    simulation = Simulation(preset(), STEADY)
    before = simulation.largest_stable_step()
    simulation.step(Command(brake_torque=(300.0,) * 4), 2.0)
    simulation.step(Command(), 3.0)
    seen = [part.tobytes() for part in (simulation.state, simulation.outputs, simulation.events)]
    now = simulation.largest_stable_step()
    assert now < 0.005 < before
    assert now == pytest.approx(before * simulation.state.u / KMH_50, rel=0.01)
    parts = (simulation.state, simulation.outputs, simulation.events)
    assert [part.tobytes() for part in parts] == seen


def test_a_held_command_counts_where_it_has_a_slope():
    """A speed hold makes the torque of the rear wheels one of the speed."""
    simulation = Simulation(preset(), STEADY)
    held = Command(speed_hold_gain=1e6, speed_hold_target=KMH_50)
    assert simulation.largest_stable_step(held) != simulation.largest_stable_step()


def test_where_there_are_no_numbers_there_is_no_largest_step():
    simulation = Simulation(preset())
    simulation.state.u = math.nan
    assert math.isnan(simulation.largest_stable_step())


def test_the_largest_step_is_found_without_a_change_of_the_state():
    simulation = Simulation(preset("van"), Options(model="2"))
    simulation.reset(17.0)
    simulation.step(Command(steering=0.05), 0.05)
    before = simulation.snapshot()
    assert simulation.largest_stable_step(Command(steering=0.1)) > 0.001
    assert simulation.snapshot() == before
