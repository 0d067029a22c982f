"""The dynamic roll-plane model: the static one at rest, and momentum about the ground."""

import pytest

from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.model.roll_plane_motion import RollPlaneMotion

G = 9.81
ROLL, ROLL_RATE, ACCELERATION = 0.05, -0.3, 6.0


def test_at_rest_in_a_turn_it_is_the_static_model(vehicle):
    static, motion = RollPlane(vehicle.record()), RollPlaneMotion(vehicle.record())
    roll = float(static.roll(ACCELERATION))
    assert motion.tire_force(roll, 0.0, ACCELERATION) == pytest.approx(ACCELERATION, abs=1e-9)
    # of the moments in balance, some 5 kN m, rounding leaves less than 1e-9
    assert motion.roll_acceleration(roll, 0.0, ACCELERATION) == pytest.approx(0.0, abs=1e-9)
    ratio = motion.load_transfer_ratio_of(roll, 0.0, ACCELERATION)
    assert ratio == pytest.approx(float(static.load_transfer_ratio(ACCELERATION)), rel=1e-9)


def test_the_force_of_the_tires_is_what_accelerates_both_masses(vehicle):
    """The c.g. stays behind the roll axis, on which the unsprung masses are, by h roll''."""
    motion = RollPlaneMotion(vehicle.record())
    a, b = vehicle.cg_to_front_axle, vehicle.cg_to_rear_axle
    depth = (vehicle.front_roll_centre_depth * b + vehicle.rear_roll_centre_depth * a) / (a + b)
    unsprung = 2 * (vehicle.front_unsprung_mass + vehicle.rear_unsprung_mass)
    force = motion.tire_force(ROLL, ROLL_RATE, ACCELERATION)
    roll_acceleration = motion.roll_acceleration(ROLL, ROLL_RATE, force)
    of_axis = ACCELERATION + depth * roll_acceleration
    together = vehicle.sprung_mass * ACCELERATION + unsprung * of_axis
    assert force == pytest.approx(together / (vehicle.sprung_mass + unsprung), rel=1e-12)


def test_the_other_way_everything_has_the_other_sign(vehicle):
    motion = RollPlaneMotion(vehicle.record())
    force = motion.tire_force(ROLL, ROLL_RATE, ACCELERATION)
    assert motion.tire_force(-ROLL, -ROLL_RATE, -ACCELERATION) == -force
    acceleration = motion.roll_acceleration(ROLL, ROLL_RATE, force)
    assert motion.roll_acceleration(-ROLL, -ROLL_RATE, -force) == -acceleration
    ratio = motion.load_transfer_ratio_of(ROLL, acceleration, force)
    assert motion.load_transfer_ratio_of(-ROLL, -acceleration, -force) == -ratio
