"""Ride figures of a drive: rms of accelerations of the body, and dynamic load coefficients."""

import math

import numpy as np

from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import rms

LONGEST_SAMPLE = 0.0101
"""s: up to this interval splines follow a wheel that bounces at 12 Hz within 0.3 %."""


def body_accelerations(history: History) -> dict[str, np.ndarray]:
    """Vertical, lateral (m/s^2) and roll acceleration (rad/s^2) of the sprung mass at all samples.

    Vertical is along z of the ground and of the c.g., roll about x of the body. Both are slopes of
    cubic splines through velocities; the lateral acceleration is that of the equations.
    """
    from scipy.interpolate import CubicSpline  # scipy takes 0.25 s to import

    roll, pitch = history["roll"], history["pitch"]
    across = history["v"] * np.sin(roll) + history["w"] * np.cos(roll)
    upwards = across * np.cos(pitch) - history["u"] * np.sin(pitch)

    def slope(values: np.ndarray) -> np.ndarray:
        return CubicSpline(history["time"], values)(history["time"], 1)

    return {
        "vertical": slope(upwards),
        "lateral": history["lateral_acceleration"],
        "roll": slope(history["roll_rate"]),
    }


def dynamic_load_coefficients(loads: np.ndarray, static: np.ndarray) -> np.ndarray:
    """rms of the dynamic load over the static one, shape (4,).

    loads: normal loads of the tires (N), shape (n, 4), evenly spaced. static: at rest, (4,).
    """
    return rms(loads - static) / static


def is_sampled_closely(history: History) -> bool:
    """Whether the samples are close enough for `body_accelerations`."""
    steps = np.diff(history["time"])
    return len(steps) > 2 and bool(steps.max() < LONGEST_SAMPLE) and bool(steps.min() > 0.0)


def ride_lines(history: History, part: np.ndarray) -> dict[str, str]:
    """The lines of a report. part: a boolean for each row, those that count, shape (rows,).

    The first row of the history is the vehicle at rest.
    """
    if not (part.any() and is_sampled_closely(history)):
        return {"ride": "unknown: too few samples on the road, or more than 10 ms apart"}
    accelerations = {name: rms(a[part]) for name, a in body_accelerations(history).items()}
    loads = history.wheels("normal_force")
    coefficients = dynamic_load_coefficients(loads[part], loads[0])
    lines = {
        "rms vertical acceleration": f"{accelerations['vertical']:.4f} m/s^2",
        "rms lateral acceleration": f"{accelerations['lateral']:.4f} m/s^2",
        "rms roll acceleration": f"{math.degrees(accelerations['roll']):.3f} deg/s^2",
    }
    for wheel, value in zip(WHEELS, coefficients, strict=True):
        lines[f"dynamic load coefficient {wheel}"] = f"{value:.4f}"
    return lines
