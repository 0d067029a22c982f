"""Critical speeds of a rigid block against its motion, integrated as a free body."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from vehicle_roll_sim import preset
from vehicle_roll_sim.manoeuvres.on_roads import rigid_block

GRAVITY = 9.81
BLOCK = (0.75, 0.66, 0.72)
"""m: half track, height of the c.g., radius of gyration; about those of the reference vehicle."""


def test_the_critical_speed_is_that_of_a_uniform_block():
    """Of width b and height H: J about the edge is m (b^2 + H^2) / 3."""
    width, height = 1.5, 1.3
    about_edge, reach = (width**2 + height**2) / 3, math.hypot(width, height) / 2
    wanted = math.sqrt(2 * GRAVITY * (reach - height / 2) * about_edge) / (height / 2)
    gyration = math.sqrt((width**2 + height**2) / 12)
    found = rigid_block.critical_speed_at_curb(width / 2, height / 2, gyration)
    assert found == pytest.approx(wanted, rel=1e-12)


def test_a_block_like_a_vehicle_has_its_static_stability_factor():
    half_track, height, gyration = rigid_block.block_like(preset())
    assert half_track / height == pytest.approx(1.1336, rel=1e-3)
    assert 0.5 < gyration < half_track + 0.1


def energy_left(speed: float, resistance: float) -> float:
    """What a block of 1 kg has left, or lacks, to rise over its edge, by Newton and Euler (J/kg).

    Unknowns: speed of the edge, its way, angle and rate. The edge keeps to the ground: the load is
    what the c.g. above it needs.
    """
    half_track, height, gyration = BLOCK
    reach, rest = math.hypot(half_track, height), math.atan2(height, half_track)

    def rates(_, unknowns):
        edge, _, angle, rate = unknowns
        y, z = reach * math.cos(rest + angle), reach * math.sin(rest + angle)
        # the c.g. rises at y rate, and its moment is that of the load less that of the furrow:
        # k^2 rate' = a z - N y with N = g + (y rate)' per unit of mass
        turning = (resistance * z - (GRAVITY - z * rate**2) * y) / (gyration**2 + y**2)
        # the c.g. moves at edge + z rate and is slowed by the furrow alone
        return [-resistance - z * turning - y * rate**2, edge, rate, turning]

    def stops(_, unknowns):
        return unknowns[0]

    stops.terminal = True
    start = [speed, 0.0, 0.0, 0.0]
    motion = solve_ivp(rates, (0.0, 5.0), start, events=stops, rtol=1e-11, atol=1e-12)
    _, way, angle, rate = motion.y[:, -1]
    kinetic = (gyration**2 + reach**2) * rate**2 / 2
    rise = reach * math.sin(rest + angle) - height
    # what the furrow has taken is its force times the way of the edge
    balance = speed**2 / 2 - resistance * way - kinetic - GRAVITY * rise
    assert abs(balance) < 1e-8 * speed**2
    return kinetic - GRAVITY * (reach - height - rise)


@pytest.mark.parametrize("share", [1.05, 1.3, 3.0])
def test_the_critical_speed_in_a_furrow_is_that_of_the_integrated_motion(share):
    """The sum over the angle has an error of 1e-5."""
    resistance = share * GRAVITY * BLOCK[0] / BLOCK[1]
    found = rigid_block.critical_speed_in_furrow(*BLOCK, resistance)
    exact = brentq(energy_left, 0.7 * found, 1.4 * found, args=(resistance,), xtol=1e-9)
    assert found == pytest.approx(exact, rel=1e-4)


def test_a_furrow_that_stops_it_at_once_is_a_curb_and_a_weak_one_never_tips_it():
    curb = rigid_block.critical_speed_at_curb(*BLOCK)
    assert rigid_block.critical_speed_in_furrow(*BLOCK, 1e6) == pytest.approx(curb, rel=1e-3)
    weakest = GRAVITY * BLOCK[0] / BLOCK[1]
    assert math.isinf(rigid_block.critical_speed_in_furrow(*BLOCK, 0.999 * weakest))
    speeds = [rigid_block.critical_speed_in_furrow(*BLOCK, k * weakest) for k in (1.1, 2, 10)]
    assert (np.diff(speeds) < 0).all()
    assert min(speeds) > curb > rigid_block.least_tripping_speed(*BLOCK[:2])
