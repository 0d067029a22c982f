"""Figures of a vehicle at rest against numbers by hand, and implausible combinations."""

import dataclasses
import math

import pytest

from vehicle_roll_sim import preset
from vehicle_roll_sim.vehicle.combinations import combinations
from vehicle_roll_sim.vehicle.figures import figures_of

G = 9.81
SQUARE = {
    "sprung_mass": 1200.0,
    "cg_to_front_axle": 1.0,
    "cg_to_rear_axle": 2.0,
    "cg_height": 0.6,
    "front_track": 1.4,
    "rear_track": 1.6,
    "front_spring_stiffness": 40e3,
    "rear_spring_stiffness": 20e3,
    "front_tire_stiffness": 120e3,
    "rear_tire_stiffness": 180e3,
    "front_damping": 2e3,
    "front_unsprung_mass": 50.0,
    "rear_unsprung_mass": 25.0,
    "front_roll_centre_height": 0.1,
    "rear_roll_centre_height": 0.25,
    "tire_radius": 0.3,
    "front_anti_roll_bar_stiffness": 8e3,
}
"""A vehicle whose figures are easy to compute; the front axle carries 2/3 of the sprung mass."""


@pytest.fixture(scope="module")
def figures():
    return figures_of(preset().with_values(SQUARE))


def test_loads_and_compressions_follow_from_the_weight_on_each_corner(figures):
    front, rear = figures.axles["front"], figures.axles["rear"]
    assert front.wheel_load == pytest.approx((400 + 50) * G)
    assert rear.wheel_load == pytest.approx((200 + 25) * G)
    assert front.spring_compression == pytest.approx(400 * G / 40e3)
    assert rear.tire_compression == pytest.approx(225 * G / 180e3)


def test_beside_the_middle_the_left_wheels_carry_more(figures):
    assert figures.left_share == pytest.approx(0.5)
    beside = figures_of(preset().with_values(SQUARE | {"cg_offset": 0.07}))
    left = 800 * (0.5 + 0.07 / 1.4) + 400 * (0.5 + 0.07 / 1.6) + 50 + 25
    assert beside.left_share == pytest.approx(left / 1350)


def test_the_centre_of_gravity_of_the_whole_is_the_mean_over_all_masses(figures):
    mass = 1200 + 2 * 50 + 2 * 25
    front, rear = (0.3 - axle.tire_compression for axle in figures.axles.values())
    height = (1200 * 0.6 + 100 * front + 50 * rear) / mass
    assert (figures.mass, figures.wheelbase) == (mass, 3.0)
    assert figures.cg_height == pytest.approx(height)
    assert figures.cg_to_front_axle == pytest.approx((1200 * 1.0 + 50 * 3.0) / mass)
    assert figures.static_stability_factor == pytest.approx(1.5 / (2 * height))


def test_ride_and_roll_rates_are_those_of_springs_in_series_and_parallel(figures):
    front = figures.axles["front"]
    assert front.ride_rate == pytest.approx(30e3)  # 40 and 120 kN/m in series
    assert front.ride_frequency == pytest.approx(math.sqrt(30e3 / 400) / (2 * math.pi))
    assert front.hop_frequency == pytest.approx(math.sqrt(160e3 / 50) / (2 * math.pi))
    assert front.damping_ratio == pytest.approx(2e3 / (2 * math.sqrt(40e3 * 400)))
    springs, tires = 40e3 * 1.4**2 / 2, 120e3 * 1.4**2 / 2
    assert front.bar_roll_stiffness == pytest.approx(8e3)
    assert front.roll_stiffness == pytest.approx(1 / (1 / (springs + 8e3) + 1 / tires))
    rear = 18e3 * 1.6**2 / 2  # 20 and 180 kN/m in series
    assert figures.roll_stiffness == pytest.approx(front.roll_stiffness + rear)
    assert figures.front_share == pytest.approx(front.roll_stiffness / figures.roll_stiffness)


def test_the_roll_gradient_is_that_of_a_pendulum_upside_down_on_the_roll_axis(figures):
    depth = (2 * 0.5 + 1 * 0.35) / 3
    assert figures.roll_axis_depth == pytest.approx(depth)
    resisting = figures.roll_stiffness - 1200 * G * depth
    assert figures.roll_gradient == pytest.approx(1200 * depth / resisting)


@pytest.mark.parametrize(
    ("told", "values"),
    {
        "cg_height: 2 m with tracks of 1.4 and 1.6 m gives a static stability factor of 0.4": {
            "cg_height": 2.0,
            "front_roll_centre_height": 1.5,
            "rear_roll_centre_height": 1.5,
        },
        "rear_spring_stiffness: a roll stiffness of 2": {
            "front_spring_stiffness": 12e3,
            "rear_spring_stiffness": 8e3,
            "cg_height": 0.8,
        },
        "front_spring_stiffness: the front axle has 0.0": {"front_spring_stiffness": 2e3},
        "cg_to_front_axle: 2.8 m puts 0.": {"cg_to_front_axle": 2.8, "cg_to_rear_axle": 0.2},
        "tire: its static load of ": {"sprung_mass": 4e3},
    }.items(),
)
def test_a_combination_that_is_odd_is_told_with_its_figure(told, values):
    vehicle = preset().with_values(SQUARE | {"front_anti_roll_bar_stiffness": 0.0} | values)
    (found, *_) = [line for line in combinations(vehicle) if line.startswith(told)]
    assert found.isprintable()
    assert "typically" in found


def test_a_vehicle_whose_springs_cannot_hold_it_upright_is_told():
    soft = {"front_spring_stiffness": 4e3, "rear_spring_stiffness": 3e3, "cg_height": 0.9}
    vehicle = preset().with_values(SQUARE | {"front_anti_roll_bar_stiffness": 0.0} | soft)
    (found,) = [line for line in combinations(vehicle) if "topples" in line]
    assert found.startswith("rear_spring_stiffness: a roll stiffness of ")


def test_a_radius_far_from_that_on_which_the_tire_rolls_is_told():
    tire = preset().tire.with_coefficients(UNLOADED_RADIUS=0.285, FREFF=0.1)
    vehicle = dataclasses.replace(preset(), tire=tire)
    assert combinations(vehicle) == []
    front = vehicle.with_values({"front_tire_radius": 0.31})
    (told,) = combinations(front)
    assert told.startswith("front_tire_radius: 0.31 m, but ")
    assert "UNLOADED_RADIUS 0.285 m: typically 0.95 to 1.05 of it" in told
    assert len(combinations(vehicle.with_values({"tire_radius": 0.26}))) == 2  # one for each axle


def test_usual_vehicles_combine_well():
    assert combinations(preset()) == []
    assert combinations(preset().with_values(SQUARE)) == []
