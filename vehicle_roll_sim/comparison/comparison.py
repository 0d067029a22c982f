"""A log and the model driven by it, compared quantity by quantity."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.comparison import corridor, steady
from vehicle_roll_sim.comparison.agreement import Agreement, agreement, shifted, time_shift
from vehicle_roll_sim.comparison.corridor import Tolerances
from vehicle_roll_sim.comparison.driving import TORQUES_APPLIED, Driven, Driving
from vehicle_roll_sim.comparison.fleet_driving import drive_all
from vehicle_roll_sim.comparison.steady import Gradients
from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.conditioning import FEWEST, low_pass
from vehicle_roll_sim.logs.log import Log
from vehicle_roll_sim.logs.quantities import ACCELERATION, QUANTITIES, SPEED
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.plausibility import LARGEST_STEERING, doubtful_steering, warn

STEERING = "steering"
NOT_STEADY = (ACCELERATION, "roll_rate")
"""Without a cross plot over the lateral acceleration."""


@dataclasses.dataclass(frozen=True)
class Judged:
    """One quantity. measured: as compared, nan at an end where aligning left nothing; lower, upper:
    the corridor around the simulated signal; all (n,) in SI units. inside: share of the measured
    samples in it, 0 to 1. accepted: None if neither side is large enough to be judged.
    """

    agreement: Agreement
    measured: np.ndarray
    simulated: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    inside: float
    accepted: bool | None


@dataclasses.dataclass(frozen=True)
class SteadyPart:
    """The quasi-steady part. chosen: its samples, a boolean for each, (n,). measured, simulated:
    the gradients of both. inside: by quantity, the share of the measured samples in the corridor of
    its cross plot over lateral acceleration. accepted: None without a cross plot.
    """

    chosen: np.ndarray
    measured: Gradients
    simulated: Gradients
    inside: dict[str, float]
    accepted: bool | None


@dataclasses.dataclass(frozen=True)
class Compared:
    """A log and its simulation. time: s, (n,); judged: by quantity. driven: what the model did, and
    whether it drove to the end of the log.
    """

    log: Log
    time: np.ndarray
    driven: Driven
    driving: Driving
    tolerances: Tolerances
    judged: dict[str, Judged]
    steady: SteadyPart | None

    @property
    def stopped_early(self) -> bool:
        """Whether the model stopped, as in a rollover, before the end of the log.

        It may do so by the tolerance of time: the vehicle may have rolled over there, too.
        """
        missing = self.log.time[-1] - self.time[-1]
        has_stopped = self.driven.condition is not Condition.RUNNING
        return has_stopped and missing > self.tolerances.time_tolerance

    @property
    def accepted(self) -> bool | None:
        """Whether the model passes: it drove to the end, and every quantity that can be judged is
        inside its corridor. None if nothing can be judged.
        """
        if self.stopped_early:
            return False
        verdicts = [each.accepted for each in self.judged.values()]
        verdicts += [self.steady.accepted] if self.steady else []
        known = [verdict for verdict in verdicts if verdict is not None]
        return all(known) if known else None


def compare(
    log: Log, simulation: Simulation, driving: Driving, tolerances: Tolerances, align: bool = False
) -> Compared:
    """Drive the simulation by the log and judge it.

    align: whether to remove the time shift of each measured quantity first. Raises InputError.
    """
    (driven,) = drive_all([(log, simulation)], driving, workers=1)
    _warn_of_large_angles({STEERING: driven.steering} | _rear_steering(log))
    count = len(driven.steering)
    if count < FEWEST:
        allowed = f"a model that drives for at least {FEWEST} rows of the log"
        problem = f"{driven.condition.name.lower().replace('_', ' ')} after {count} rows"
        raise InputError("simulation", "", allowed, problem)
    measured = {name: values[:count] for name, values in log.signals.items()}
    simulated = {
        name: low_pass(values, log.cutoff, log.interval) for name, values in driven.signals.items()
    }
    names = [SPEED] if driving.drive_by == TORQUES_APPLIED else []
    judged = {
        name: _judged(name, measured[name], simulated[name], log.interval, tolerances, align)
        for name in [*names, *log.compared]
    }
    aligned = measured | {name: each.measured for name, each in judged.items()}
    part = _steady_part(log, aligned, simulated, driven, simulation, tolerances)
    return Compared(log, log.time[:count], driven, driving, tolerances, judged, part)


def _rear_steering(log: Log) -> dict[str, np.ndarray]:
    return {name: values for name, (_, values) in log.inputs.items() if name == "rear_steering"}


def _warn_of_large_angles(angles: dict[str, np.ndarray]) -> None:
    """Issue a PlausibilityWarning for angles of road wheels that no vehicle has."""
    for name, values in angles.items():
        if (largest := np.abs(values).max(initial=0.0)) > LARGEST_STEERING:
            warn([doubtful_steering(f"{name} of the log", float(largest))])


def _judged(
    name: str,
    measured: np.ndarray,
    simulated: np.ndarray,
    interval: float,
    tolerances: Tolerances,
    align: bool,
) -> Judged:
    shift = time_shift(measured, simulated, interval)
    if align and not math.isnan(shift):
        measured = shifted(measured, -shift, interval)
    known = np.isfinite(measured)
    found = agreement(measured[known], simulated[known], interval)
    lower, upper = corridor.over_time(simulated, found.peak, interval, tolerances)
    inside = corridor.share_inside(measured[known], lower[known], upper[known])
    is_large = max(found.peak, float(np.abs(simulated).max())) >= QUANTITIES[name].least
    accepted = tolerances.accepts(inside) if is_large else None
    found = dataclasses.replace(found, shift=shift)
    return Judged(found, measured, simulated, lower, upper, inside, accepted)


def _steady_part(
    log: Log,
    measured: dict,
    simulated: dict,
    driven: Driven,
    simulation: Simulation,
    tolerances: Tolerances,
) -> SteadyPart | None:
    """The quasi-steady part, None if there is none with a turn."""
    is_known = np.isfinite(np.sum([measured[name] for name in log.compared], axis=0))
    chosen = steady.quasi_steady(simulated, log.interval) & is_known
    if ACCELERATION not in measured or not steady.has_range(simulated[ACCELERATION], chosen):
        return None
    vehicle = simulation.vehicle
    wheelbase = vehicle.wheelbase
    sides = [
        steady.gradients(side, driven.steering, chosen, wheelbase) for side in (measured, simulated)
    ]
    both = {name: (measured[name], simulated[name]) for name in log.compared}
    both[STEERING] = driven.steering, driven.steering
    at, along = measured[ACCELERATION], simulated[ACCELERATION]
    inside = {}
    for name, (left, right) in both.items():
        if name in NOT_STEADY:
            continue
        lower, upper = cross_corridor(left, right, at, along, chosen, tolerances)
        inside[name] = corridor.share_inside(left[chosen], lower, upper)
    accepted = all(tolerances.accepts(share) for share in inside.values()) if inside else None
    return SteadyPart(chosen, *sides, inside, accepted)


def cross_corridor(
    measured: np.ndarray,
    simulated: np.ndarray,
    at: np.ndarray,
    acceleration: np.ndarray,
    chosen: np.ndarray,
    tolerances: Tolerances,
) -> tuple[np.ndarray, np.ndarray]:
    """The boundaries of a cross plot at the chosen measured accelerations `at`.

    acceleration: simulated. All are (n,); the result is two arrays, (m,), of the m chosen samples.
    """
    half = tolerances.half_width(simulated, float(np.nanmax(np.abs(measured))))
    along = tolerances.half_width(np.zeros(1), float(np.nanmax(np.abs(at))))[0]
    return corridor.over_acceleration(
        at[chosen], acceleration[chosen], simulated[chosen], (float(along), half[chosen])
    )
