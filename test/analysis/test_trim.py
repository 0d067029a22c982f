"""Trim: a simulation that starts in it stays there; an impossible one is refused."""

import math

import numpy as np
import pytest
from linear_studies import REFERENCE, SPEED, command_of, mirror, simulation_in
from programmes import SHIFTS, ramp_and_hold, with_tire

from vehicle_roll_sim import InputError, Options, Simulation
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.model.records import ROLL
from vehicle_roll_sim.simulation.options import MODELS

TURN = 4.0
"""m/s^2"""
VARIANTS = (
    {"no_roll_centre": True},
    {"tire_normal_to_ground": True},
    {"link_load_transfer": "asymmetric"},
    {"euler_terms": True},
    {"steady_state_slip": True},
)
CHOICES = [Options(model=model) for model in MODELS if model != "1c-iii"] + [
    Options(**each) for each in VARIANTS
]
ROUNDING = 1e-8
"""Absolute, over a second: of a trim that is found to 1e-8 of typical changes per second."""


@pytest.mark.parametrize("options", CHOICES, ids=str)
def test_a_simulation_that_begins_in_a_trim_stays_in_it(options):
    trim = find_trim(REFERENCE, options, speed=SPEED, lateral_acceleration=TURN)
    simulation = simulation_in(trim)
    simulation.step(command_of(trim.inputs), 1.0)
    places = trim.plant.places
    assert simulation.state_vector[places] == pytest.approx(trim.state[places], abs=ROUNDING)
    assert simulation.outputs.acceleration[1] == pytest.approx(TURN, abs=1e-6)
    assert simulation.outputs.normal_force == pytest.approx(trim.outputs.normal_force, abs=1e-3)


@pytest.mark.parametrize(("choice", "apart"), [("1", 1e-9), ("8dof", 1e-9), ("1a", 5e-5)])
def test_a_run_that_turns_in_slowly_and_holds_its_speed_settles_in_it(choice, apart):
    """Simplified models do not keep the compression of the tires to the height of the body."""
    trim = find_trim(REFERENCE, Options(model=choice), speed=SPEED, lateral_acceleration=5.0)
    simulation = Simulation(REFERENCE, Options(model=choice))
    held = {"speed_hold_gain": 2000.0, "speed_hold_target": SPEED}
    held["wheel_torque"] = trim.inputs[2:6]
    simulation.reset(SPEED)
    simulation.step(ramp_and_hold(0.0, 0.5, math.degrees(trim.inputs[0]), **held), 40.0)
    assert simulation.state.u == pytest.approx(SPEED, abs=1e-5)
    assert simulation.state.roll == pytest.approx(trim.state[ROLL], abs=apart)
    assert simulation.outputs.acceleration[1] == pytest.approx(5.0, abs=apart)
    loads = simulation.outputs.normal_force
    assert loads == pytest.approx(trim.outputs.normal_force, abs=1e4 * apart)


def test_straight_ahead_without_resistance_it_is_the_static_equilibrium():
    trim = find_trim(REFERENCE, speed=SPEED)
    simulation = simulation_in(trim)
    begun = trim.state.copy()
    simulation.reset(SPEED)
    assert begun == pytest.approx(simulation.state_vector, abs=1e-12)
    assert trim.inputs == pytest.approx(np.zeros(10), abs=1e-9)


def test_the_rear_wheels_carry_drag_and_rolling_resistance():
    vehicle = REFERENCE.with_values({"drag_area": 0.7, "rolling_resistance_coefficient": 0.012})
    trim = find_trim(vehicle, speed=30.0)
    weight, radius = (1440 + 4 * 80) * 9.81, trim.outputs.loaded_radius
    drag = 1.225 / 2 * 0.7 * 30.0**2
    loads = trim.outputs.normal_force
    forces = np.array([-0.012 * loads[:2].sum(), drag + 0.012 * loads[:2].sum()])  # by axle
    rolling = 0.012 * (loads * radius)[2:].sum()
    pitched = 1e-4  # relative: forces are along the ground, torques about the axles
    assert loads.sum() == pytest.approx(weight, rel=pitched)
    assert trim.outputs.longitudinal_force[:2].sum() == pytest.approx(forces[0], rel=1e-3)
    assert trim.outputs.longitudinal_force[2:].sum() == pytest.approx(forces[1], rel=1e-3)
    assert 2 * trim.drive_torque == pytest.approx(forces[1] * radius[2] + rolling, rel=1e-3)


def test_the_steering_for_an_acceleration_is_the_one_that_gives_it():
    wanted = find_trim(REFERENCE, speed=SPEED, lateral_acceleration=TURN)
    found = find_trim(REFERENCE, speed=SPEED, steering=float(wanted.inputs[0]))
    assert found.state == pytest.approx(wanted.state, abs=ROUNDING)


def test_tires_that_push_aside_do_so_from_both_sides_and_leave_it_straight_ahead():
    trim = find_trim(with_tire(REFERENCE, **SHIFTS), speed=SPEED)
    left, right = trim.outputs.lateral_force[::2], trim.outputs.lateral_force[1::2]
    assert np.abs(left).min() > 1.0
    assert left == pytest.approx(-right, rel=1e-6)
    assert trim.outputs.acceleration[1] == pytest.approx(0.0, abs=1e-8)


def test_in_a_turn_the_yaw_rate_is_that_of_the_circle():
    trim = find_trim(REFERENCE, speed=SPEED, lateral_acceleration=TURN)
    names = trim.plant.state_names
    state = dict(zip(names, trim.state[trim.plant.places], strict=True))
    turning = math.hypot(state["yaw_rate"], state["pitch_rate"], state["roll_rate"])
    # along the axle of the turn the c.g. is accelerated with speed times yaw rate
    assert turning * math.hypot(state["u"], state["v"]) == pytest.approx(TURN, rel=3e-3)


@pytest.mark.parametrize("options", [Options(), Options(model="2"), Options(model="8dof")], ids=str)
def test_a_right_turn_is_the_mirror_image_of_a_left_turn(options):
    left = find_trim(REFERENCE, options, speed=SPEED, steering=math.radians(3))
    right = find_trim(REFERENCE, options, speed=SPEED, steering=math.radians(-3))
    places, image = left.plant.places, mirror(left.plant.state_names)
    assert image @ left.state[places] == pytest.approx(right.state[places], abs=ROUNDING)
    assert left.state[ROLL] > 0.0


REFUSED = {
    "standing": ({"speed": 0.0}, "speed", "from 1 to 100 m/s"),
    "too fast": ({"speed": 101.0}, "speed", "from 1 to 100 m/s"),
    "no number": ({"speed": math.nan}, "speed", "from 1 to 100 m/s"),
    "nan steering": ({"speed": SPEED, "steering": math.nan}, "steering", "finite"),
    "inner wheel too slow": ({"speed": 1.05, "steering": 0.3}, "speed", "at least 1 m/s"),
    "too tight": ({"speed": SPEED, "steering": 0.3}, "steering", "at most"),
    "too hard": ({"speed": SPEED, "lateral_acceleration": 9.0}, "lateral_acceleration", "at most"),
    "too hard to the right": (
        {"speed": SPEED, "lateral_acceleration": -9.0},
        *("lateral_acceleration", "at most -7"),
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_where_there_is_no_steady_driving_it_is_said(case):
    given, field, words = REFUSED[case]
    with pytest.raises(InputError, match=words) as refused:
        find_trim(REFERENCE, **given)
    assert refused.value.field == field


def test_with_steady_state_slip_the_slowest_is_that_of_a_run():
    options = Options(steady_state_slip=True)
    with pytest.raises(InputError, match=r"from 3\.5 to 100"):
        find_trim(REFERENCE, options, speed=3.4)
    assert find_trim(REFERENCE, options, speed=3.5).state[ROLL] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_where_a_wheel_would_lift_there_is_no_steady_turn(axle):
    vehicle = REFERENCE.with_values({f"{axle}_spring_stiffness": 4e5, f"{axle}_track": 1.0})
    with pytest.raises(InputError, match=r"at most \d.* m/s\^2, in tighter turns a wheel lifts"):
        find_trim(vehicle, speed=SPEED, lateral_acceleration=8.0)


def test_a_resistance_that_the_rear_wheels_cannot_overcome_is_said():
    draggy = REFERENCE.with_values({"drag_area": 100.0})
    with pytest.raises(InputError, match="hold straight ahead"):
        find_trim(draggy, speed=100.0)


def test_a_model_in_which_nothing_says_how_far_tires_are_compressed_is_refused():
    with pytest.raises(InputError, match="height and attitude") as refused:
        find_trim(REFERENCE, Options(model="1c-iii"), speed=SPEED)
    assert refused.value.field == "model"
