"""A vehicle on a banked curve: at the neutral speed it needs no side force and leans on no side."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import Feedback, Road, Simulation, preset
from vehicle_roll_sim.manoeuvres.base import hold_for
from vehicle_roll_sim.manoeuvres.driver.preview_steering import PreviewSteering
from vehicle_roll_sim.manoeuvres.driver.single_track import SingleTrack
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.runs.metrics import load_transfer_ratio
from vehicle_roll_sim.runs.run import run

RADIUS, BANK, TRANSITION, START = 80.0, 0.2, 40.0, 10.0
"""m, m/m, m, m."""


def centreline() -> np.ndarray:
    """Points (n, 2) (m): straight, a clothoid and an arc, by summing the heading."""
    ds = 0.05
    s = np.arange(-50.0, 300.0, ds)
    curvature = np.clip((s - START) / TRANSITION, 0.0, 1.0) / RADIUS
    heading = np.cumsum(curvature) * ds
    points = np.cumsum(np.column_stack((np.cos(heading), np.sin(heading))), axis=0) * ds
    return points - points[np.searchsorted(s, 0.0)]


class AlongTheCurve(Feedback):
    def __init__(self, vehicle, speed: float):
        self.speed, self.gain, self.line = speed, hold_for(vehicle), centreline()
        limits = {"preview": 0.6, "delay": 0.0, "rate": 2.0, "limit": 0.5}
        self.steering = PreviewSteering(SingleTrack.of(vehicle), self.path, **limits)

    def path(self, x: float, y: float, distance: float) -> np.ndarray:
        nearest = int(np.argmin(((self.line - (x, y)) ** 2).sum(axis=1)))
        return self.line[nearest : nearest + int(distance / 0.05) + 200 : 5]

    def command(self, time: float, state) -> np.ndarray:
        commands = np.zeros(1, COMMAND)
        commands["speed_hold_gain"], commands["speed_hold_target"] = self.gain, self.speed
        commands["steering"] = self.steering.angle(time, state)
        return commands


def in_the_arc(speed: float) -> tuple[float, float, float]:
    """Side force over weight, load transfer ratio, and radius of the c.g.'s path (m)."""
    curve = {"kind": "banked_curve", "start": START, "radius": RADIUS, "arc": 200.0}
    curve |= {"transition": TRANSITION, "bank": BANK}
    vehicle = preset()
    simulation = Simulation(vehicle, road=Road.from_values({"features": [curve]}))
    simulation.reset(speed)
    history = run(simulation, AlongTheCurve(vehicle, speed), round(130.0 / speed, 2))
    steady = history["time"] > 100.0 / speed
    loads = history.wheels("normal_force")[steady]
    # contact forces are horizontal and vertical: turned into the banked plane
    yaw_rate, u, v = (history[name][steady].mean() for name in ("yaw_rate", "u", "v"))
    forces = history.wheels("lateral_force")[steady].sum(axis=1).mean()
    weight = vehicle.mass * 9.81
    angle = math.atan(BANK)
    along = (forces * math.cos(angle) - loads.sum(axis=1).mean() * math.sin(angle)) / weight
    rate = yaw_rate / math.cos(angle)  # about the vertical, of a rate about the body's axis
    return along, float(np.mean(load_transfer_ratio(loads))), math.hypot(u, v) / rate


def test_at_the_neutral_speed_side_force_and_load_transfer_vanish():
    """v^2 = g R tan(phi) with the radius R of the c.g.'s own path, which is inside that of the
    wheels. Between two speeds both change by the same law, so their zeros are interpolated in v^2,
    which finds the neutral speed within 1 %."""
    neutral = math.sqrt(9.81 * RADIUS * BANK)
    speeds = (0.9 * neutral, 1.1 * neutral)
    (side, ratio, radius), (other_side, other_ratio, other_radius) = map(in_the_arc, speeds)
    assert side < 0 < other_side
    assert abs(ratio) > 0.02
    wanted = 9.81 * (radius + other_radius) / 2 * BANK
    for below, above in ((side, other_side), (ratio, other_ratio)):
        share = below / (below - above)
        square = speeds[0] ** 2 + share * (speeds[1] ** 2 - speeds[0] ** 2)
        assert math.sqrt(square) == pytest.approx(math.sqrt(wanted), rel=0.01)
    assert radius == pytest.approx(RADIUS, rel=0.02)
