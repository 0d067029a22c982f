"""The speed hold of the standard manoeuvres: the same rate in a vehicle of any size."""

import dataclasses

import numpy as np
import pytest

from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.base import ADAPTED, hold_for
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.run import run

HOLDING = [name for name, each in STANDARD.items() if each.speed_hold is ADAPTED]
FREE = {"ramp_steer", "j_turn"}
"""The manoeuvres that hold no speed."""
LONG = {"slowly_increasing_steer", "steady_state_circle"}
"""They are driven once before they are complete."""
WITHOUT_RUNS = {"steering_at_03g": 1.0, "handwheel_angle": 1.0}
"""Values with which no run is needed to complete a manoeuvre."""
MODEL_2 = Options(model="2")


@pytest.fixture(scope="module")
def car():
    """A model car of 3.7 kg."""
    return preset("tenth_scale")


def completed(name: str, vehicle, **changes):
    known = {field.name for field in dataclasses.fields(STANDARD[name])}
    values = {n: v for n, v in WITHOUT_RUNS.items() if n in known} | changes
    return dataclasses.replace(STANDARD[name], **values).for_vehicle(vehicle, MODEL_2)


@pytest.mark.parametrize("name", sorted({*HOLDING} - LONG))
def test_the_gain_goes_with_mass_and_tire_radius(car, name):
    assert completed(name, preset()).speed_hold == 2000.0
    for vehicle, mass, radius in ((car, 3.74, 0.05), (preset("van"), None, None)):
        mass, radius = mass or vehicle.mass, radius or vehicle.per_wheel("tire_radius")[2]
        gain = completed(name, vehicle).speed_hold
        assert gain / (mass * radius) == pytest.approx(2000.0 / (1760.0 * 0.285))
        assert completed(name, vehicle, speed_hold=gain).speed_hold == gain
        for chosen in (0.0, 500.0, 2000.0):
            assert completed(name, vehicle, speed_hold=chosen).speed_hold == chosen


def test_a_model_car_keeps_its_speed(car):
    manoeuvre = completed("step_steer", car, speed=4.4, duration=2.0)
    simulation = Simulation(car, MODEL_2)
    simulation.reset(4.4)
    history = run(simulation, manoeuvre, 2.0)
    assert simulation.condition is Condition.RUNNING
    assert np.abs(history["u"] - 4.4).max() < 0.1
    assert history["lateral_acceleration"][-1] > 3.0


def test_a_model_car_is_told_how_to_measure_its_steering(car):
    told = r"^steering_at_03g: .* not enough samples .* prints at a lower speed or handwheel_rate$"
    with pytest.raises(InputError, match=told):
        STANDARD["nhtsa_j_turn"].for_vehicle(car, MODEL_2)


def test_a_manoeuvre_that_holds_no_speed_can_be_given_the_adapted_gain(car):
    assert {name for name, each in STANDARD.items() if not each.needs_vehicle} == FREE
    for name in FREE:
        assert completed(name, car).speed_hold == 0.0
        assert completed(name, car, speed_hold=None).speed_hold == hold_for(car)


@pytest.mark.parametrize("name", HOLDING)
def test_before_it_knows_its_vehicle_it_cannot_be_driven(name):
    simulation, unready = Simulation(preset()), STANDARD[name]
    with pytest.raises(InputError, match=r"^speed_hold: missing: a gain, or a manoeuvre comp"):
        run(simulation, unready.driver(), 0.1)
    assert simulation.time == 0.0
    assert unready.commanded[:2] == ("steering", "wheel_torque")


def test_no_other_value_of_a_manoeuvre_may_be_missing():
    with pytest.raises(InputError, match=r"^duration: missing: a number from 0 to 86400 s$"):
        dataclasses.replace(STANDARD["step_steer"], duration=None)
