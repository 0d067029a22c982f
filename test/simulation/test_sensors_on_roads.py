"""Sensors on roads that are not planes: they feel the road and change nothing of the motion."""

import math

import numpy as np
import pytest
from measured import measured
from road_kinds import ROADS, TILT, road

from vehicle_roll_sim import Command, Simulation, preset
from vehicle_roll_sim.vehicle.derived_values import GRAVITY

TURN = Command(steering=0.02)


@pytest.mark.parametrize("name", ["random profile", "corkscrew ramp"])
def test_they_change_no_bit_of_the_motion(name):
    """Steps end where samples are taken, so what a road keeps must not depend on that."""
    plain = Simulation(preset(), road=ROADS[name])
    others = [Simulation(measured(), road=ROADS[name]) for _ in range(2)]
    for each in (plain, *others):
        each.reset(15.0)
    plain.step(TURN, 0.9)
    others[0].step(TURN, 0.9)
    for _ in range(30):
        others[1].step(TURN, 0.03)
    assert np.ptp(plain.outputs["road_height"]) > 0.0
    for each in others:
        assert each.state.tobytes() == plain.state.tobytes()
        assert each.outputs.tobytes() == plain.outputs.tobytes()
    assert others[0].sensors.readings().tobytes() == others[1].sensors.readings().tobytes()


def test_an_imu_feels_the_road():
    """A perfect one at the c.g. reads the specific force there, at each sample."""
    simulation = Simulation(preset().with_values({"imu_period": 0.01}), road=ROADS["crests"])
    simulation.reset(15.0)
    heaviest = 0.0
    for _ in range(80):
        simulation.step(Command(), 0.01)
        felt = simulation.sensors["accelerometer"]
        assert felt == pytest.approx(simulation.outputs["specific_force"], rel=1e-12, abs=1e-12)
        heaviest = max(heaviest, abs(felt[2] - GRAVITY))
    assert heaviest > 0.1 * GRAVITY


def test_an_imu_feels_the_tilt_of_a_table():
    """A vehicle that stands on it feels all of gravity, turned by the tilt and the roll."""
    standing = preset().with_values({"imu_period": 0.01})
    simulation = Simulation(standing, road=road(TILT))
    simulation.reset(0.0)
    simulation.step(Command(brake_torque=(2000.0,) * 4), 5.0)
    tilt = simulation.road.tilt.angle(5.0)
    felt = simulation.sensors["accelerometer"]
    assert tilt > math.radians(5.0)
    # what accelerates it, as its roll follows the table, is below 0.02 m/s^2
    assert math.hypot(*felt) == pytest.approx(GRAVITY, abs=0.02)
    angle = math.atan2(abs(felt[1]), felt[2])
    assert angle == pytest.approx(tilt + abs(float(simulation.state["roll"])), abs=0.002)
