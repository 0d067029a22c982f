"""Cars of any size and shape: a scaled car moves alike, and the c.g. may lie below the wheels."""

import math

import numpy as np
import pytest
from programmes import Evaluation, ramp_and_hold, record_run, with_tire
from random_states import mirrored, random_command, random_state

from vehicle_roll_sim import LF, LR, Command, InputError, Options, Simulation, Vehicle, preset
from vehicle_roll_sim.declaration import parameters_of

ALIKE = {0.1: 1e-5, 0.25: 1e-12}
"""By length of a model car over that of the car, the share of the peak by which they may differ.

Masses are scaled with the cube of the length, times with its square root, so that accelerations and
angles remain. At 0.1 the step is rounded to 1 ns, 7e-7 of it; at 0.25 only powers of 2 are left."""
EXPONENTS = {"": 0, "rad": 0, "m": 1, "m^2": 2, "kg": 3, "N/m": 2, "N s/m": 2.5, "kg m^2": 5}
"""Of the scale in a value of this unit."""
OPTIONS = {"model 1": Options(), "model 2": Options(model="2")}
SPEED = 50 / 3.6
STEPS = 1500
"""Of 1 ms: beyond the lift-off of both inner wheels."""
DRIFT = 1e-9
LOW = {
    "cg_height": 0.2,
    "front_roll_centre_depth": 0.15,
    "rear_roll_centre_depth": 0.12,
}
"""m; the wheel centres are at 0.265 m."""


def scaled(vehicle: Vehicle, scale: float) -> Vehicle:
    """A model car, on tires whose nominal load and radius are scaled with it."""
    units = {name: about.unit for name, about in parameters_of(Vehicle).items()}
    values = {
        name: value * scale ** EXPONENTS[units[name]]
        for name in vehicle.given
        if isinstance(value := getattr(vehicle, name), float)
    }
    values["minimum_relaxation_length"] = vehicle.minimum_relaxation_length * scale
    tire = vehicle.tire.coefficients
    own = {"FNOMIN": tire["FNOMIN"] * scale**3}
    own["UNLOADED_RADIUS"] = tire["UNLOADED_RADIUS"] * scale
    return with_tire(vehicle.with_values(values), **own)


def swerve(vehicle: Vehicle, options: Options, slower: float = 1.0):
    """A J-turn through lift-off; slower: the unit of time (s)."""
    simulation = Simulation(vehicle, options, step=1e-3 * slower)
    simulation.reset(SPEED * slower)
    step = simulation.step_ns * 1e-9
    turn = ramp_and_hold(0.2 * slower, 40.0 / slower, 10.0)
    return record_run(simulation, turn, STEPS * step)


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_a_small_car_moves_like_a_large_one_in_its_own_time(options):
    large = swerve(preset(), options)
    assert large.outputs["normal_force"][:, [LF, LR]].min(axis=0).tolist() == [0.0, 0.0]
    for scale, share in ALIKE.items():
        small = swerve(scaled(preset(), scale), options, math.sqrt(scale))
        for name, exponent in (("roll", 0), ("yaw", 0), ("x", 1), ("z", 1), ("u", 0.5)):
            expected = large.state[name] * scale**exponent
            difference = np.abs(small.state[name] - expected).max()
            assert difference < share * np.abs(expected).max(), (scale, name)
        loads = large.outputs["normal_force"] * scale**3
        difference = np.abs(small.outputs["normal_force"] - loads).max()
        assert difference < share * loads.max(), scale


def test_a_wheel_too_light_for_the_step_is_refused_with_the_largest_stable_step():
    light = scaled(preset(), 0.1)
    assert light.wheel_inertia == pytest.approx(1e-5)
    with pytest.raises(InputError, match=r"at most .* s at 0\.5 m/s") as refusal:
        Simulation(light, step=0.01).reset(0.5)
    largest = float(str(refusal.value).split("at most ")[1].split()[0])
    Simulation(light, step=largest).reset(0.5)


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_a_car_with_its_cg_below_the_wheel_centres_stays_in_equilibrium(options):
    low = preset().with_values(LOW)
    assert (low.static_strut_length < 0.0).all()
    simulation = Simulation(low, options)
    start = simulation.model_state.copy()
    simulation.step(Command(), 10.0)
    moved = np.abs(simulation.model_state - start)
    still = [n not in ("x",) and "wheel_angle" not in n for n in simulation.state_names]
    assert moved[still].max() < DRIFT


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_the_equations_of_a_car_with_its_cg_below_the_wheel_centres_mirror(options):
    low, rng = preset().with_values(LOW), np.random.default_rng(3)
    evaluation = Evaluation(low, options)
    for _ in range(20):
        state, command = random_state(low, rng), random_command(rng)
        mine = evaluation.rates(state, command).copy()
        theirs = mirrored(evaluation.rates(mirrored(state), mirrored(command)))
        for name in mine.dtype.names:
            there = np.nan_to_num(mine[name])
            assert there == pytest.approx(np.nan_to_num(theirs[name]), rel=1e-9, abs=1e-6), name
