"""Vehicles whose values nobody knows, and their logs with noise, bias and delay."""

import dataclasses
from collections.abc import Mapping

import numpy as np

from vehicle_roll_sim import Simulation, Vehicle
from vehicle_roll_sim.comparison.driving import TORQUES_APPLIED, Driving
from vehicle_roll_sim.comparison.fleet_driving import drive_all
from vehicle_roll_sim.logs.log import Log, log_of
from vehicle_roll_sim.logs.map_file import map_of
from vehicle_roll_sim.logs.quantities import QUANTITIES
from vehicle_roll_sim.logs.raw_log import RawLog
from vehicle_roll_sim.logs.settings import Conditioning

INTERVAL = 0.01
"""s: of the rows of a log."""
SPEED = 22.0
"""m/s"""
RUN_UP = 0.3
"""s"""
STEP = 0.002
"""s: of the integration, for logs and models alike. With 4 ms, the peak of a landing jumps by half
the noise when the landing passes to the next step, and fits end where the sum of squares is so
uneven."""
NOISE = {
    "handwheel": np.radians(0.05),
    "speed": 0.02,
    "yaw_rate": np.radians(0.15),
    "roll_rate": np.radians(0.15),
    "lateral_acceleration": 0.05,
    "roll": np.radians(0.05),
    "sideslip_angle": np.radians(0.05),
}
"""Standard deviation of each row, in SI units."""
UNSEEN = ("sideslip_angle",)
"""Not in the logs of hidden vehicles: few cars measure it."""


def ramp_and_sine(time: np.ndarray) -> np.ndarray:
    """Road-wheel angle (rad): into a steady turn and out of it, then a sine that speeds up."""
    ramp = np.interp(time, (0.3, 1.8, 2.3, 2.6), (0.0, 0.03, 0.03, 0.0))
    swing = np.sin(2 * np.pi * (0.5 * (time - 2.8) + 0.25 * (time - 2.8) ** 2))
    return ramp + np.where((time > 2.8) & (time < 5.0), 0.03 * swing, 0.0)


def fishhook(time: np.ndarray) -> np.ndarray:
    """Road-wheel angle (rad): to one side, then further to the other, where wheels lift off."""
    return np.interp(time, (0.3, 0.6, 1.0, 1.5, 2.4, 2.9), (0.0, 0.06, 0.06, -0.07, -0.07, 0.0))


def overturning(time: np.ndarray) -> np.ndarray:
    """Road-wheel angle (rad) that ends in a rollover."""
    return np.interp(time, (0.5, 0.8), (0.0, 0.13))


MANOEUVRES = {"ramp_and_sine": ramp_and_sine, "fishhook": fishhook, "overturning": overturning}
DURATIONS = {"ramp_and_sine": 5.2, "fishhook": 3.3, "overturning": 2.5}


@dataclasses.dataclass(frozen=True)
class Faults:
    """Of the sensors. noise: factor of NOISE. bias, delay: by quantity (SI units, s). offset: of
    the handwheel (rad), to be added to what it says.
    """

    noise: float = 0.0
    bias: Mapping[str, float] = dataclasses.field(default_factory=dict)
    delay: Mapping[str, float] = dataclasses.field(default_factory=dict)
    offset: float = 0.0


def log_of_run(
    vehicle: Vehicle,
    manoeuvre: str = "ramp_and_sine",
    faults: Faults = Faults(),
    seed: int = 0,
    *,
    model: Simulation | None = None,
    duration: float | None = None,
    end: float | None = None,
    unseen: tuple[str, ...] = (),
) -> Log:
    """The log of a vehicle that rolls freely, as a file of it would be read.

    model: a simulation, in place of one of the vehicle. duration, end: of the manoeuvre, and of the
    part used (s). unseen: quantities that the log does not have.
    """
    simulation = model or Simulation(vehicle, step=STEP)
    time = np.arange(0.0, duration or DURATIONS[manoeuvre], INTERVAL)
    handwheel = simulation.vehicle.steering_ratio * MANOEUVRES[manoeuvre](time)
    clean = _driven(simulation, time, handwheel)
    columns = {"time": time, "handwheel": handwheel - faults.offset} | clean
    columns["drive_torque"] = np.zeros(len(time))
    noise = np.random.default_rng(seed)
    for name, spread in NOISE.items():
        values = columns[name]
        late = np.interp(time - faults.delay.get(name, 0.0), time, values)
        drawn = noise.normal(0.0, spread, len(time))
        columns[name] = late + faults.bias.get(name, 0.0) + faults.noise * drawn
    kept = {name: columns[name] for name in ("time", "drive_torque", *NOISE) if name not in unseen}
    lines = {name: {"column": name, "unit": QUANTITIES[name].unit} for name in kept}
    return log_of(RawLog(kept), map_of({"columns": lines}), Conditioning(end=end))


def _driven(
    simulation: Simulation, time: np.ndarray, handwheel: np.ndarray
) -> dict[str, np.ndarray]:
    """What perfect sensors see of a vehicle that is steered so and rolls freely."""
    still, speed = np.zeros(len(time)), np.full(len(time), SPEED)
    inputs = {
        name: (time, values)
        for name, values in (("handwheel", handwheel), ("speed", speed), ("drive_torque", still))
    }
    wanted = Log(time, INTERVAL, {"speed": speed}, inputs, "body", 0.0, [], [])
    driving = Driving(drive_by=TORQUES_APPLIED, run_up=RUN_UP)
    (driven,) = drive_all([(wanted, simulation)], driving, workers=1)
    count = len(time)
    return {n: np.pad(each, (0, count - len(each)), "edge") for n, each in driven.signals.items()}
