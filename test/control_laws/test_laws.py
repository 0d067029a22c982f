"""The laws of the examples: closed forms, limits, and the same to the left as to the right."""

import dataclasses
import math

import pytest

from vehicle_roll_sim import preset
from vehicle_roll_sim.analysis.rollover_prediction import RolloverPredictor
from vehicle_roll_sim.control_laws.active_roll_bar import ActiveRollBar
from vehicle_roll_sim.control_laws.catalogue import LAWS
from vehicle_roll_sim.control_laws.rear_steering import RearSteering
from vehicle_roll_sim.control_laws.roll_braking import Braking, RollBraking, predicted, roll_of
from vehicle_roll_sim.control_laws.yaw_control import GRAVITY, YawControl
from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.model.frames import quaternion
from vehicle_roll_sim.runs.control_law import COMMANDED

LEFT, RIGHT = (0, 2), (1, 3)
ROUNDING = 1e-12
"""Relative: of some ten operations."""


def test_the_bars_take_their_share_of_the_moment_and_leave_the_load_of_an_axle():
    law = ActiveRollBar()
    forces = law.forces(2.0, 0.1)
    moment = law.track / 2 * sum(forces[right] - forces[left] for left, right in ((0, 1), (2, 3)))
    assert moment == pytest.approx(0.7 * 900.0 * 2.0 + 4000.0 * 0.1, rel=ROUNDING)
    assert forces[0] + forces[1] == forces[2] + forces[3] == 0.0
    assert forces[1] / forces[3] == pytest.approx(0.6 / 0.4, rel=ROUNDING)
    assert law.forces(-2.0, -0.1) == [-force for force in forces]


def test_forces_and_angles_end_at_their_limits():
    assert ActiveRollBar().forces(50.0, 0.0) == [-3000.0, 3000.0, -3000.0, 3000.0]
    assert [RearSteering().angle(rate) for rate in (0.5, 5.0, -5.0)] == [0.06, 0.1, -0.1]


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_outer_front_wheel_is_braked_beyond_the_threshold(side):
    law = Braking(threshold=0.75, gain=1000.0)
    outer = 1 if side > 0.0 else 0
    torques = law.torques(side, math.inf)
    assert torques[outer] == 250.0
    assert sum(torques) == 250.0
    assert law.torques(0.7 * side, math.inf) == [0.0] * 4
    assert law.torques(0.7 * side, 0.3)[outer] == law.largest_torque


@pytest.mark.parametrize("steering", [0.05, -0.05])
def test_the_yaw_rate_of_the_reference_needs_no_braking_and_a_higher_one_the_outer_wheel(steering):
    law, speed, loads = YawControl(), 15.0, [4000.0] * 4
    steady = speed * steering / (2.54 + 0.0015 * speed**2)
    wanted = math.copysign(min(abs(steady), 0.6 * GRAVITY / speed), steering)
    assert law.wanted(speed, steering) == pytest.approx(wanted, rel=ROUNDING)
    assert law.torques(speed, steering, wanted, loads) == [0.0] * 4
    outer_front, inner_rear = (1, 2) if steering > 0.0 else (0, 3)
    more = law.torques(speed, steering, wanted * 1.2, loads)
    expected = 6000.0 * (0.2 * abs(wanted) - 0.03)
    assert more[outer_front] == pytest.approx(expected, rel=ROUNDING)
    assert law.torques(speed, steering, wanted * 0.5, loads)[inner_rear] > 0.0
    assert max(law.torques(speed, steering, 10 * wanted, loads)) == 0.25 * 4000.0


def test_the_roll_angle_and_the_force_along_the_ground_come_from_the_attitude():
    """A body at rest at a roll angle feels gravity only: nothing along the ground."""
    roll = 0.2
    attitude = quaternion(roll, 0.1, 1.0)
    assert roll_of(*attitude) == pytest.approx(roll, rel=ROUNDING)
    specific = [0.0, 9.81 * math.sin(roll), 9.81 * math.cos(roll)]
    found = predicted(RolloverPredictor(preset()), 0.0, attitude, 0.3, specific)
    expected = RolloverPredictor(preset()).update(0.0, roll, 0.3, 0.0)
    pairs = zip(dataclasses.astuple(found), dataclasses.astuple(expected), strict=True)
    for one, other in pairs:
        assert one == pytest.approx(other, rel=1e-9)  # of forces that cancel, 1e-15 of gravity


def test_each_named_law_has_default_parameters_and_says_what_it_commands():
    for name, kind in LAWS.items():
        assert {*kind.commands} <= {*COMMANDED}, name
        assert all(getattr(kind(), each) is not None for each in parameters_of(kind)), name
    assert {"threshold", "horizon"} <= parameters_of(RollBraking).keys()
