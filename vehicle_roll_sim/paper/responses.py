"""Response metrics of every model in the step steer and the ramp steer, side by side."""

import numpy as np

from vehicle_roll_sim.paper.study import (
    SIMPLIFIED,
    STEERING_HELD,
    VARIANTS,
    Response,
    Study,
)
from vehicle_roll_sim.runs import metrics
from vehicle_roll_sim.vehicle.derived_values import GRAVITY

HEADER = (
    *("model", "peak roll (deg)", "steady (deg)", "frequency (Hz)", "damping ratio"),
    *("roll gradient (deg/g)", "understeer (deg/g)", "first lift-off (s)", "85° of roll (s)"),
)
LINEAR_RANGE = 1.0, 4.0
"""m/s^2: range of lateral acceleration for the gradients in the ramp steer."""
PER_G = np.degrees(GRAVITY)
"""deg/g per rad/(m/s^2)."""


def response_rows(study: Study) -> list[tuple[str, ...]]:
    """One row of HEADER per model: four values from the step steer, four from the ramp steer."""
    wheelbase = study.vehicle.wheelbase
    rows = []
    for case in (*SIMPLIFIED, *VARIANTS):
        numbers = (*_of_step(study.step(case)), *_of_ramp(study.ramp(case), wheelbase))
        rows.append((case, *("-" if np.isnan(number) else f"{number:.3f}" for number in numbers)))
    return rows


def _of_step(response: Response) -> tuple[float, ...]:
    steady = response.steady_roll
    damping = metrics.damping_ratio(response.time, response.roll, STEERING_HELD, steady)
    return response.peak_roll, steady, response.frequency, damping


def _of_ramp(response: Response, wheelbase: float) -> tuple[float, ...]:
    """Roll and understeer gradient (deg/g) in LINEAR_RANGE, then times of events (s)."""
    names = ("lateral_acceleration", "roll", "steering", "yaw_rate", "u")
    lowest, highest = LINEAR_RANGE
    acceleration = response.history["lateral_acceleration"]
    end = np.argmax(acceleration > highest)
    linear = slice(np.argmax(acceleration > lowest), end)
    ay, roll, steering, yaw_rate, speed = (response.history[name][linear] for name in names)
    gradient = metrics.roll_gradient(ay, roll)
    understeer = metrics.understeer_gradient(ay, steering, yaw_rate, speed, wheelbase)
    return gradient * PER_G, understeer * PER_G, response.first_lift_off, response.rollover
