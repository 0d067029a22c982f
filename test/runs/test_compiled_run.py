"""A run in one call of compiled code has the bits of a run period by period."""

import dataclasses
import math

import numpy as np
import pytest
from actuated import actuated

from vehicle_roll_sim import Condition, InputError, Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.manoeuvres.command_file import command_table
from vehicle_roll_sim.manoeuvres.nhtsa import FishhookDriver
from vehicle_roll_sim.model.compiled.jit import CACHE
from vehicle_roll_sim.model.integration.drive import drive
from vehicle_roll_sim.runs import compiled_run as module
from vehicle_roll_sim.runs.columns import COMMANDS
from vehicle_roll_sim.runs.compiled_run import compiled_run
from vehicle_roll_sim.runs.run import run

AT_03G = {"steering_at_03g": 20.0}
SLOW = {"cg_height": 0.55}
"""A vehicle that the fishhook does not tip."""
DRIVEN = {
    "step_steer": {"duration": 1.6},
    "ramp_steer": {"duration": 1.5},
    "slowly_increasing_steer": {"duration": 2.0},
    "nhtsa_j_turn": {"duration": 2.0} | AT_03G,
    "nhtsa_fishhook": {"duration": 3.0} | AT_03G,
    "sine_with_dwell": {"duration": 3.0} | AT_03G,
    "iso_step_steer": {"duration": 2.0, "handwheel_angle": 30.0},
    "steady_state_circle": {"duration": 1.5},
    "braking_in_a_turn": {"duration": 2.5, "handwheel_angle": 30.0, "brakes_from": 1.7},
}
"""All of the catalogue that is compiled, for as long as something happens."""
TABLE = command_table(
    {
        "time": [0.0, 0.3, 0.3, 0.3335, 0.3335, 0.507, 0.507, 0.8],
        "steering": [0.0, 0.02, 0.05, 0.05, 0.03, 0.03, -0.02, 0.0],
        "wheel_torque_lr": [0.0, 100.0, 50.0, 50.0, 50.0, 50.0, 200.0, 0.0],
        "brake_torque_rf": [0.0, 0.0, 300.0, 300.0, 300.0, 0.0, 0.0, 0.0],
    }
)
"""Steps with a row, between two rows, and in the middle of an integration step."""


def everything(simulation, driver, history) -> list:
    """All that is known after a run, bit for bit."""
    centres = history.roll_centres
    return [
        history.rows.tobytes(),
        history.commands.tobytes(),
        None if centres is None else centres.tobytes(),
        *(simulation.events.tobytes(), simulation.state_vector.tobytes()),
        *(simulation.time_ns, simulation.condition, simulation.implausible),
        *(getattr(driver, "reversal", None), getattr(driver, "roll_rate", None)),
    ]


def both_ways(simulation, manoeuvre, **settings):
    """What is known after either kind of run of a manoeuvre."""
    found = []
    for driven in (run, compiled_run):
        simulation.reset(manoeuvre.speed)
        driver = manoeuvre.driver()
        history = driven(simulation, driver, manoeuvre.duration, **settings)
        found.append(everything(simulation, driver, history))
    return found


def ready(name: str, simulation: Simulation, **values):
    manoeuvre = dataclasses.replace(STANDARD[name], **DRIVEN[name] | values)
    return manoeuvre.for_vehicle(simulation.vehicle, simulation.options)


@pytest.mark.parametrize("name", DRIVEN)
def test_a_manoeuvre_has_the_same_bits(name):
    simulation = Simulation(preset().with_values(SLOW))
    one, other = both_ways(simulation, ready(name, simulation))
    assert one == other


class InWind(FishhookDriver):
    """A fishhook in a side wind that changes from period to period."""

    def commands(self, times: np.ndarray) -> np.ndarray:
        commands = super().commands(times)
        commands["wind"][:, 1] = 20.0 * np.sin(times)
        return commands


def test_wind_has_the_same_bits():
    vehicle = preset().with_values(SLOW | {"side_force_area": 3.0})
    simulation = Simulation(vehicle)
    fishhook, found = ready("nhtsa_fishhook", simulation, duration=1.0), []
    for driven, drive_in in ((run, InWind), (compiled_run, InWind), (run, FishhookDriver)):
        simulation.reset(fishhook.speed)
        driver = drive_in(fishhook)
        history = driven(simulation, driver, fishhook.duration)
        found.append((everything(simulation, driver, history), history.wind.tobytes()))
    assert found[0] == found[1]
    assert found[0][0][0] != found[2][0][0]  # the wind acts
    gust = command_table({"time": [0.0, 0.2, 0.5], "wind_y": [0.0, 20.0, 5.0]})
    one, other = both_ways(simulation, gust.for_vehicle(vehicle, simulation.options))
    assert one == other


@pytest.mark.parametrize("name", ["nhtsa_fishhook", "steady_state_circle"])
def test_actuators_have_the_same_bits(name):
    simulation = Simulation(actuated(**SLOW))
    one, other = both_ways(simulation, ready(name, simulation, duration=1.5))
    assert one == other


def test_the_commands_in_a_history_are_what_the_actuators_let_act():
    """Here a lag of 0.05 s after a dead time of 0.03 s."""
    braking = command_table({"time": [0.0, 0.3], "brake_torque_rf": [100.0, 100.0]})
    history = compiled_run(Simulation(actuated()), braking, 0.3)
    after = np.maximum(history["time"] - 0.03, 0.0)
    found = history.commands[:, COMMANDS.index("brake_torque_rf")]
    np.testing.assert_allclose(found, 100.0 * (1 - np.exp(-after / 0.05)), atol=1e-10)


@pytest.mark.parametrize("model", ["1a", "2", "8dof"])
def test_every_kind_of_model_has_the_same_bits(model):
    simulation = Simulation(preset(), Options(model=model), step=0.005)
    one, other = both_ways(simulation, ready("nhtsa_fishhook", simulation))
    assert one == other


def test_the_fishhook_is_reversed_in_compiled_code():
    simulation = Simulation(preset().with_values(SLOW))
    manoeuvre = ready("nhtsa_fishhook", simulation)
    simulation.reset(manoeuvre.speed)
    driver = manoeuvre.driver()
    history = compiled_run(simulation, driver, manoeuvre.duration)
    before = history["time"] <= driver.reversal
    assert 1.2 < driver.reversal < 2.5
    assert driver.roll_rate <= manoeuvre.reversal_roll_rate
    assert history["steering"][before][-1] > 0.0 > history["steering"][-1]


def test_steps_of_a_command_table_are_exact():
    one, other = both_ways(Simulation(preset()), TABLE)
    assert one == other


@pytest.mark.parametrize("sample", [0.004, 0.03])
def test_rows_are_those_asked_for(sample):
    simulation = Simulation(preset(), step=0.002)
    one, other = both_ways(simulation, ready("step_steer", simulation), sample=sample)
    assert one == other


@pytest.mark.parametrize("name", ["nhtsa_fishhook", "step_steer"])
def test_commands_found_in_many_blocks_are_the_same(name, monkeypatch):
    monkeypatch.setattr(module, "LONGEST_BLOCK", 3)
    simulation = Simulation(preset().with_values(SLOW), step=0.005)
    one, other = both_ways(simulation, ready(name, simulation))
    assert one == other


def test_a_run_that_rolls_over_or_diverges_ends_alike():
    simulation = Simulation(preset(), step=0.002)
    one, other = both_ways(simulation, dataclasses.replace(STANDARD["j_turn"], duration=4.0))
    assert one == other
    assert simulation.condition is Condition.ROLLED_OVER
    torque = command_table({"time": [0.0, 0.1, 0.3], "wheel_torque_lf": [0.0, 1e12, 1e12]})
    one, other = both_ways(simulation, torque)
    assert one == other
    assert simulation.condition is Condition.DIVERGED


@pytest.mark.parametrize("vehicle", [preset(), actuated()], ids=["plain", "with actuators"])
@pytest.mark.parametrize("name", ["step_steer", "nhtsa_fishhook"])
def test_a_run_goes_on_from_the_present_state(name, vehicle):
    """Even from the middle of a command period: the driver is asked at once."""
    simulation, found = Simulation(vehicle), []
    manoeuvre = ready(name, simulation)
    for driven in (run, compiled_run):
        simulation.reset(manoeuvre.speed)
        driver = manoeuvre.driver()
        histories = [driven(simulation, driver, duration) for duration in (1.095, 0.503, 0.01)]
        found.append([everything(simulation, driver, each) for each in histories])
    assert found[0] == found[1]


def test_a_driver_that_is_refused_is_refused_alike():
    simulation = Simulation(preset(), step=0.003)
    for driven in (run, compiled_run):
        with pytest.raises(InputError, match=r"command period: 0\.01 is not allowed"):
            driven(simulation, ready("nhtsa_fishhook", simulation).driver(), 3.0, sample=0.03)
        with pytest.raises(InputError, match=r"brake_torque: -1\.0 is not allowed"):
            driven(simulation, braking_backwards, 0.03, sample=0.03)


def braking_backwards(times: np.ndarray) -> np.ndarray:
    commands = STANDARD["j_turn"](times)
    commands["brake_torque"] = -1.0
    return commands


def test_a_programme_may_return_one_command_for_all_times():
    simulation = Simulation(preset())
    constant = lambda times: STANDARD["j_turn"](np.array([1.05]))  # noqa: E731
    found = []
    for driven in (run, compiled_run):
        simulation.reset(15.0)
        found.append(everything(simulation, None, driven(simulation, constant, 0.2)))
    assert found[0] == found[1]
    assert not math.isnan(simulation.state.roll)


@pytest.mark.skipif(CACHE is None, reason="only compiled code is cached")
def test_the_loop_is_compiled_once_and_beforehand():
    """In one form, for a fishhook as for a table, which comes from the cache."""
    simulation = Simulation(preset())
    compiled_run(simulation, ready("nhtsa_fishhook", simulation).driver(), 0.02)
    compiled_run(simulation, TABLE, 0.02)
    assert len(drive.signatures) == 1
    assert not drive.stats.cache_misses
