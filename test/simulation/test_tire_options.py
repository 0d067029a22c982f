"""Tire moments and contact patch shift: resolved once, described, and rebuilt from that."""

import dataclasses
import json

import numpy as np
import pytest
from signals import everything, turn

from vehicle_roll_sim import Command, InputError, Options, Simulation, Tire, Vehicle, preset
from vehicle_roll_sim.runs.summary import choices
from vehicle_roll_sim.simulation.description import describe, described, difference
from vehicle_roll_sim.simulation.options import MODELS, SWITCHES
from vehicle_roll_sim.vehicle.tire.keys import COEFFICIENTS

PERIOD = 10_000_000
"""ns"""
OTHERS = [model for model in MODELS if model != "1"]
MOMENTS = {"QSX3": 0.03, "QSY1": 0.01, "QDZ1": 0.09, "QBZ1": 10.0, "QCZ1": 1.2}
OF_VERSION_6 = {
    "NOMPRES": 2.2e5,
    "PFZ1": 0.7,
    "PPX1": -0.3,
    "UNLOADED_RADIUS": 0.31,
    "VERTICAL_STIFFNESS": 2.1e5,
    "BREFF": 8.0,
    "DREFF": 0.27,
    "FREFF": 0.07,
    "PKY6": -0.8,
}


def of_ones_own(**fields) -> Vehicle:
    """A vehicle whose file says nothing of either."""
    return dataclasses.replace(preset(), tire_moments=True, contact_patch_shift=True, **fields)


def chosen(options: Options) -> tuple[str, str]:
    return options.tire_moments, options.contact_patch_shift


@pytest.mark.parametrize("name", SWITCHES)
@pytest.mark.parametrize("model", OTHERS)
def test_only_model_1_has_them_and_auto_says_so(model, name):
    with pytest.raises(InputError, match=f"^{name}: 'on' is not allowed: an option of model 1"):
        Options(model, **{name: "on"})
    Options(model, **{name: "off"})
    assert chosen(Options(model).for_vehicle(of_ones_own())) == ("off", "off")
    line = choices(of_ones_own(), Options(model).for_vehicle(of_ones_own()))
    assert line[name.replace("_", " ")] == f"off: model {model} does not have it"


@pytest.mark.parametrize("name", SWITCHES)
def test_auto_is_what_the_vehicle_says_and_on_and_off_are_what_they_say(name):
    assert getattr(Options().for_vehicle(of_ones_own()), name) == "on"
    assert getattr(Options().for_vehicle(preset()), name) == "off"
    assert getattr(Options(**{name: "on"}).for_vehicle(preset()), name) == "on"
    assert getattr(Options(**{name: "off"}).for_vehicle(of_ones_own()), name) == "off"
    assert choices(preset(), Options().for_vehicle(preset())) == {}


@pytest.mark.parametrize("name", SWITCHES)
@pytest.mark.parametrize(("given", "meant"), [(True, "on"), (False, "off"), ("on", "on")])
def test_a_parameter_file_may_say_on_and_off_which_yaml_reads_as_true_and_false(name, given, meant):
    assert getattr(Options(**{name: given}), name) == meant
    for wrong in ("yes", 1, None):
        with pytest.raises(InputError, match=f"^{name}: ({wrong!r} is not allowed|missing)"):
            Options(**{name: wrong})


def test_the_summary_has_the_lateral_stiffness_of_each_axle():
    vehicle = of_ones_own().with_values({"rear_tire_lateral_stiffness": 1.5e5})
    lines = choices(vehicle, Options().for_vehicle(vehicle))
    assert lines["tire moments"] == "on"
    assert lines["contact patch shift"].endswith(
        "front lateral stiffness 92.99 kN/m, rear lateral stiffness 150 kN/m"
    )
    moments = vehicle.tire.with_coefficients(**MOMENTS)
    vehicle = dataclasses.replace(vehicle, tire=None, front_tire=moments, rear_tire=moments)
    lines = choices(vehicle, Options().for_vehicle(vehicle))
    contained = "contained in the overturning moment"
    assert lines["contact patch shift"] == f"on, front {contained}, rear {contained}"


def test_the_summary_says_so_if_the_tires_have_moments_that_do_not_count():
    """Such as other tires on the reference vehicle, whose file has both options off."""
    tire = preset().tire.with_coefficients(**MOMENTS)
    vehicle = dataclasses.replace(preset(), tire=tire)
    lines = choices(vehicle, Options().for_vehicle(vehicle))
    assert lines == {"tire moments": "off", "contact patch shift": "off"}


def rich() -> Vehicle:
    """A vehicle with all that a description could forget."""
    known = COEFFICIENTS["6.1"]
    kept = {n: v for n, v in preset().tire.coefficients.items() if n in known}
    front = Tire(kept | MOMENTS | OF_VERSION_6, "right", version="6.1")
    rear = preset().tire.with_coefficients(UNLOADED_RADIUS=0.3, LGAY=1.0, **MOMENTS)
    leaning = {"front_camber": -0.02, "rear_camber": 0.01, "front_tire_pressure": 2e5}
    numbers = {n: v for n, v in preset().given.items() if n not in ("tire_radius", *leaning)}
    del numbers["front_tire_stiffness"]
    return Vehicle(**numbers | leaning, front_tire=front, rear_tire=rear)


@pytest.mark.parametrize(
    ("vehicle", "options"),
    [
        (preset(), Options()),
        (preset(), Options(contact_patch_shift="on")),
        (of_ones_own(), Options("1b")),
        (of_ones_own(), Options(tire_moments="off")),
        (rich(), Options()),
        (rich(), Options(contact_patch_shift="off")),
    ],
    ids=["reference", "shift asked for", "simplified", "shift alone", "rich", "moments alone"],
)
def test_a_description_gives_the_same_simulation(vehicle, options):
    simulation = Simulation(vehicle, options)
    text = describe(simulation, PERIOD)
    again = described(text).simulation
    assert difference(simulation, again) is None
    assert describe(again, PERIOD) == text
    assert chosen(again.options) == chosen(simulation.options)
    for each in (simulation, again):
        each.step(turn(3.0), 0.3)
    assert everything(simulation) == everything(again)
    assert np.abs(simulation.state.roll) > 1e-3


def test_what_older_versions_did_not_have_is_described_only_if_it_counts():
    told = json.loads(describe(Simulation(preset()), PERIOD))
    assert not {*SWITCHES} & {*told["model"]}
    assert not {"front_camber", "tire_pressure"} & {*told["vehicle"]}
    assert not {"PDY3", "LGAY", "UNLOADED_RADIUS"} & {*told["tire"]}
    assert {"tire", "tire_side"} == {name for name in told if "tire" in name}
    told = json.loads(describe(Simulation(of_ones_own()), PERIOD))
    assert {name: told["model"][name] for name in SWITCHES} == dict.fromkeys(SWITCHES, "on")
    assert told["vehicle"]["front_tire_lateral_stiffness"] == pytest.approx(92987.2, abs=0.1)


def test_the_shift_loads_the_outer_wheels_by_its_moment():
    """Level and straight ahead, with a lateral slip: the first instant, before anything moves."""
    vehicle = preset().with_values(
        {"front_tire_lateral_stiffness": 1e5, "rear_tire_lateral_stiffness": 2e5}
    )
    simulation = Simulation(vehicle, Options(contact_patch_shift="on"))
    simulation.state["lateral_slip"] = -0.05
    simulation.step(Command(), 1e-3)
    outputs = simulation.outputs
    shift = outputs.tire_lateral / [1e5, 1e5, 2e5, 2e5]
    assert (shift > 5e-3).all()  # m, to the left, as the force
    np.testing.assert_allclose(outputs.overturning_moment, shift * outputs.normal_force, rtol=1e-12)
    np.testing.assert_allclose(
        outputs.aligning_moment, -shift * outputs.tire_longitudinal, rtol=1e-12, atol=1e-12
    )
    assert (outputs.rolling_resistance_moment == 0.0).all()


def test_a_run_notes_when_a_tire_that_depends_on_inclination_leaves_its_range():
    limit, times = 0.03, {}
    for weight in (0.0, 1.0):
        tire = preset().tire.with_coefficients(LGAY=weight, CAMMIN=-limit, CAMMAX=limit)
        simulation = Simulation(dataclasses.replace(preset(), tire=tire))
        simulation.reset(15.0)
        while simulation.time < 1.0:
            simulation.step(Command(steering=0.05), 0.01)
            if np.abs(simulation.outputs.inclination).max() > limit:
                times.setdefault(weight, simulation.time)
        times[weight, "noted"] = simulation.events.out_of_range_time[3]
    assert np.isnan(times.pop((0.0, "noted")))
    assert 0.1 < times[1.0] - 0.01 < times[1.0, "noted"] <= times[1.0]
