"""Implausible values of a vehicle or of steering cause a warning with the number."""

import dataclasses
import functools
import math
import warnings
from pathlib import Path

import pytest

from vehicle_roll_sim import (
    Command,
    PlausibilityWarning,
    Simulation,
    load_tire,
    plausibility,
    preset,
)
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.manoeuvres.command_file import load_commands

USUAL = {
    "reference": {},
    "empty car": {"sprung_mass": 900.0, "roll_inertia": 250.0, "cg_height": 0.7},
    "city bus": {
        "sprung_mass": 13e3,
        "roll_inertia": 13.5e3,
        "pitch_inertia": 113.5e3,
        "yaw_inertia": 115e3,
        "cg_to_front_axle": 4.0,
        "cg_to_rear_axle": 3.2,
        "cg_height": 1.4,
        "front_track": 2.0,
        "rear_track": 1.86,
        "tire_radius": 0.5,
        "front_spring_stiffness": 370e3,
        "rear_spring_stiffness": 710e3,
        "front_damping": 20e3,
        "rear_damping": 35e3,
        "wheel_inertia": 12.0,
        "front_unsprung_mass": 400.0,
        "rear_unsprung_mass": 600.0,
        "front_tire_stiffness": 900e3,
        "rear_tire_stiffness": 1.8e6,
    },
    "formula car, its c.g. below the wheel centres": {
        "sprung_mass": 740.0,
        "roll_inertia": 150.0,
        "pitch_inertia": 700.0,
        "yaw_inertia": 750.0,
        "cg_height": 0.25,
        "front_unsprung_mass": 40.0,
        "front_spring_stiffness": 120e3,
        "rear_spring_stiffness": 90e3,
        "front_roll_centre_height": 0.06,
        "rear_roll_centre_height": -0.02,
    },
    "model car of 1 : 10": {
        "sprung_mass": 3.2,
        "roll_inertia": 0.025,
        "pitch_inertia": 0.045,
        "yaw_inertia": 0.047,
        "cg_to_front_axle": 0.16,
        "cg_to_rear_axle": 0.17,
        "cg_height": 0.074,
        "front_track": 0.24,
        "rear_track": 0.24,
        "tire_radius": 0.05,
        "front_spring_stiffness": 800.0,
        "rear_spring_stiffness": 800.0,
        "front_damping": 12.0,
        "rear_damping": 12.0,
        "wheel_inertia": 1.7e-4,
        "front_unsprung_mass": 0.12,
        "rear_unsprung_mass": 0.12,
        "front_tire_stiffness": 6e3,
        "rear_tire_stiffness": 6e3,
        "front_roll_centre_depth": 0.05,
        "rear_roll_centre_depth": 0.05,
    },
}
ODD = {
    "front_damping: 2.5 N s/m gives a damping ratio of 0.000321 at the front": {
        "front_damping": 2.5
    },
    "rear_damping: 0 N s/m gives a damping ratio of 0 at the rear": {"rear_damping": 0.0},
    "front_damping: 25000 N s/m gives a damping ratio of 3.21 at the front": {
        "front_damping": 25e3
    },
    "roll_inertia: 9 kg m^2 gives a radius of gyration of 0.0791 m, 0.0527 times the track": {
        "roll_inertia": 9.0
    },
    "pitch_inertia: 9e+06 kg m^2 gives a radius of gyration of 79.1 m, 31.1 times the wheelb": {
        "roll_inertia": 900.0,
        "pitch_inertia": 9e6,
        "yaw_inertia": 9e6,
    },
    "wheel_inertia: 10000 kg m^2 gives a radius of gyration of 11.2 m, 39.2 times the tire": {
        "wheel_inertia": 1e4
    },
    "front_spring_stiffness: 3500 N/m gives a static deflection of 1.21 m": {
        "front_spring_stiffness": 3500.0
    },
    "rear_spring_stiffness: 2500 N/m gives a ride frequency of 0.466 Hz at the rear": {
        "rear_spring_stiffness": 2500.0
    },
    "front_spring_stiffness: 3e+06 N/m gives a ride frequency of 11.6 Hz at the ": {
        "front_spring_stiffness": 3e6,
        "front_damping": 25e3,
        "front_tire_stiffness": 1e7,
    },
    "rear_tire_stiffness: 30000 N/m gives a static compression of 0.422 times the tire": {
        "rear_tire_stiffness": 30e3
    },
    "front_roll_centre_depth: 0.65 m below a c.g. at 0.6 m puts the roll centre 0.05 m below": {
        "cg_height": 0.6
    },
    "rear_roll_centre_height: 1.5 m puts the roll centre 0.75 m above the sprung c.g.": {
        "rear_roll_centre_height": 1.5
    },
    "cg_height: 0.1 m with wheel centres at 0.26": {
        "cg_height": 0.1,
        "front_roll_centre_height": 0.0,
        "rear_roll_centre_height": 0.0,
    },
}
"""How a line begins, and what is odd of the reference vehicle."""


@pytest.mark.parametrize("name", USUAL)
def test_usual_vehicles_are_plausible(name):
    assert plausibility(preset().with_values(USUAL[name])) == []


@pytest.mark.parametrize("told", ODD)
def test_an_odd_value_is_told_by_name_in_one_line_with_its_figure_and_what_is_usual(told):
    lines = plausibility(preset().with_values(ODD[told]))
    (found,) = [line for line in lines if line.startswith(told)]
    assert found.isprintable()
    assert "typically" in found or "above the road" in found
    assert all(line.partition(":")[0] in {*ODD[told], told.partition(":")[0]} for line in lines)


PRESSURIZED = Path(__file__).parents[1] / "model/tire/data/mf61.tir"
OUTSIDE = "Pa is outside the range of the tire file (PRESMIN, PRESMAX)"
TYPICALLY = "typically 100000 to 500000 Pa"


@pytest.mark.parametrize(
    ("given", "lines"),
    [
        ({}, []),
        ({"tire_pressure": 1e5}, []),
        ({"tire_pressure": 5e5}, []),
        ({"tire_pressure": 2e4}, [f"tire_pressure: 20000 {OUTSIDE}: {TYPICALLY}"]),
        ({"rear_tire_pressure": 6e5}, [f"rear_tire_pressure: 600000 {OUTSIDE}: {TYPICALLY}"]),
    ],
)
def test_a_pressure_outside_the_range_of_the_tire_file_is_told_once(given, lines):
    vehicle = dataclasses.replace(preset(), tire=load_tire(PRESSURIZED)).with_values(given)
    assert plausibility(vehicle) == lines


def test_a_range_of_pressures_without_an_end_is_told_as_such():
    tire = load_tire(PRESSURIZED).with_coefficients(PRESMAX=math.inf)
    vehicle = dataclasses.replace(preset(), tire=tire).with_values({"tire_pressure": 2e4})
    assert plausibility(vehicle) == [
        f"tire_pressure: 20000 {OUTSIDE}: typically at least 100000 Pa"
    ]


@pytest.mark.parametrize("use", [Simulation, functools.partial(find_trim, speed=20.0)])
def test_a_vehicle_that_is_put_to_use_is_warned_of_once_where_that_is_done(use):
    vehicle = preset().with_values({"rear_damping": 0.0})
    with pytest.warns(PlausibilityWarning, match="^rear_damping: 0 N s/m") as caught:
        use(vehicle)
    assert [warning.filename for warning in caught] == [__file__]


def test_a_plausible_one_is_not_and_the_warnings_can_be_made_errors():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Simulation(preset())
        with pytest.raises(PlausibilityWarning, match="rear_damping"):
            Simulation(preset().with_values({"rear_damping": 0.0}))


@pytest.mark.parametrize("name", ["steering", "rear_steering"])
def test_steering_of_a_command_in_degrees_is_warned_of(name):
    with pytest.warns(PlausibilityWarning, match=f"^{name} of a command: -5 rad is -286.5 deg"):
        Command(**{name: -5.0})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Command(**{name: 1.0471})  # the limit that a node has


def test_steering_of_a_command_file_in_degrees_is_warned_of_once_for_each_column(tmp_path):
    file = tmp_path / "commands.csv"
    file.write_text("time,steering,rear_steering\n0,0,0\n1,2,0.3\n2,-5,0.3\n")
    with pytest.warns(PlausibilityWarning) as caught:
        load_commands(file)
    (told,) = (str(warning.message) for warning in caught)
    assert told.startswith(f"{file}: steering at 2 s: -5 rad is -286.5 deg")
