"""The figures of a run, and of a run with a controller beside the one without it."""

import dataclasses

import numpy as np

from vehicle_roll_sim.model.integration.events import VALUE
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import load_transfer_ratio
from vehicle_roll_sim.scoring.driven import Outcome


@dataclasses.dataclass(frozen=True)
class Figures:
    """The figures of one run.

    peak_roll (rad), peak_roll_rate (rad/s), load_transfer_ratio: largest magnitudes. lift_time:
    time during which at least one wheel is off the ground (s). energy: work of the actuators (J).
    brake_torque, drive_torque (N m), active_force (N), rear_steering (rad): the largest at a wheel.
    """

    peak_roll: float
    peak_roll_rate: float
    load_transfer_ratio: float
    lift_time: float
    energy: float
    brake_torque: float
    drive_torque: float
    active_force: float
    rear_steering: float


def figures_of(outcome: Outcome) -> Figures:
    """The figures of a run from its samples; the largest roll angle is that of all steps."""
    history = outcome.history
    return Figures(
        peak_roll=abs(float(outcome.events.peak_roll[VALUE])),
        peak_roll_rate=_largest(history["roll_rate"]),
        load_transfer_ratio=_largest(load_transfer_ratio(history.wheels("normal_force"))),
        lift_time=lift_time(history),
        energy=actuator_energy(history),
        brake_torque=_largest(history.command("brake_torque")),
        drive_torque=_largest(history.command("wheel_torque")),
        active_force=_largest(history.command("active_force")),
        rear_steering=_largest(history.command("rear_steering")),
    )


def _largest(values: np.ndarray) -> float:
    return float(np.nanmax(np.abs(values), initial=0.0))


def lift_time(history: History) -> float:
    """Time (s) during which at least one wheel carries no load: intervals that end so."""
    lifted = (history.wheels("normal_force") <= 0.0).any(axis=1)
    return float(np.diff(history["time"])[lifted[1:]].sum())


def actuator_energy(history: History) -> float:
    """Work (J) of brakes, active suspension and drives, each by its magnitude.

    Brakes: the torque times the spin of each wheel. Active forces: the force times the change of
    the compression of the suspension. Drives: the torque times the spin, that of the speed hold
    included. Steering is left out: the model has no steering forces. By the trapezoidal rule over
    the samples; forces are those that act in the interval.
    """
    spin = np.nan_to_num(history.wheels("wheel_speed"))
    travel = np.nan_to_num(np.diff(history.wheels("suspension_compression"), axis=0))
    interval = np.diff(history["time"])[:, np.newaxis]
    turned = np.abs(spin[1:] + spin[:-1]) / 2.0 * interval
    torques = history.command("brake_torque") + np.abs(history.command("wheel_torque"))
    work = torques[1:] * turned + np.abs(history.command("active_force")[1:] * travel)
    return float(work.sum())


@dataclasses.dataclass(frozen=True)
class Cost:
    """What a controller costs, up to the end of the shorter of both runs.

    distance: largest distance between the vehicles at equal times (m). speed: forward speed lost at
    the end, compared with the vehicle without it (m/s). energy: work of the actuators beyond that
    without it (J).
    """

    distance: float
    speed: float
    energy: float


def cost_of(alone: Outcome, controlled: Outcome) -> Cost:
    """The cost of a run with a controller, compared with the one without it."""
    end = min(alone.history["time"][-1], controlled.history["time"][-1])
    parts = [each.history.part(each.history["time"] <= end) for each in (alone, controlled)]
    times = parts[0]["time"]
    x, y = (_at(parts[1], name, times) - parts[0][name] for name in ("x", "y"))
    last = [_at(part, "u", end) for part in parts]
    energies = [actuator_energy(part) for part in parts]
    return Cost(float(np.hypot(x, y).max()), float(last[0] - last[1]), energies[1] - energies[0])


def _at(history: History, name: str, times):
    return np.interp(times, history["time"], history[name])
