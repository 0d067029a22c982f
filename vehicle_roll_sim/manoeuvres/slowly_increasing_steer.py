"""NHTSA's slowly increasing steer: determines the handwheel angle at 0.3 g."""

import dataclasses
import functools
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED, hold_for
from vehicle_roll_sim.manoeuvres.driving import history_of
from vehicle_roll_sim.manoeuvres.handwheel import (
    LARGEST_HANDWHEEL,
    METRES_PER_SECOND_OF_A_MPH,
    HandwheelProgramme,
    largest_handwheel,
    ramp,
)
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.steering_gear import Gear, to_handwheel

LEVEL = 0.3
"""g: lateral acceleration at which the handwheel angle is determined."""
FIT_FROM, FIT_TO = 0.1, 0.375
"""g: range of lateral acceleration for the linear fit."""
FEWEST = 10
"""Minimum number of samples for the fit."""
TOO_LITTLE = f"not enough samples between {FIT_FROM:g} and {FIT_TO:g} g"
STANDARD_ANGLE = 270.0
"""deg: final handwheel angle of the standard, reduced if the road wheels cannot turn that far."""
KEPT = 100
"""Number of vehicles whose handwheel angle at 0.3 g is kept, for further runs with them."""
STRETCH = 1.0
"""s: interval between checks for enough data."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class SlowlyIncreasingSteer(HandwheelProgramme):
    """The handwheel is turned slowly to a final angle at constant speed.

    The throttle is dropped above 0.375 g, so that drive torque does not cause a spin.
    """

    handwheel_angle: float = parameter(
        "final handwheel angle, left positive",
        "deg",
        -LARGEST_HANDWHEEL,
        LARGEST_HANDWHEEL,
    )
    handwheel_rate: float = parameter("rate of the handwheel angle", "deg/s", 1e-3, 1e5)
    complete: float = math.inf

    @property
    def throttle_dropped(self) -> float:
        """Time (s) at which the vehicle exceeds 0.375 g; set by `for_vehicle`."""
        return self.complete

    def filled_in(self, vehicle: Vehicle, options: Options) -> "SlowlyIncreasingSteer":
        """A copy with the time at which the vehicle exceeds 0.375 g on a level road."""
        steer = self.within_the_wheels()
        history = history_to_the_level(steer, vehicle, options)
        passed = np.abs(history["lateral_acceleration"]) > FIT_TO * GRAVITY
        if not passed.any():
            return steer
        return dataclasses.replace(steer, complete=float(history["time"][np.argmax(passed)]))

    def within_the_wheels(self) -> "SlowlyIncreasingSteer":
        """Reduce the standard's angle to the largest one of the vehicle; keep any other angle."""
        largest = largest_handwheel(self.gear)
        if abs(self.handwheel_angle) != STANDARD_ANGLE or largest >= STANDARD_ANGLE:
            return self
        angle = math.copysign(largest, self.handwheel_angle)
        return dataclasses.replace(self, handwheel_angle=angle)

    @property
    def amplitude(self) -> float:
        return self.handwheel_angle

    def handwheel(self, times: np.ndarray) -> np.ndarray:
        return ramp(times, self.start, self.handwheel_rate, self.handwheel_angle)

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        angle = angle_at_level(history, self.gear)
        found = TOO_LITTLE if math.isnan(angle) else f"{angle:.3f} deg"
        return {"handwheel angle at 0.3 g": found, **self.limit_line()}


SLOWLY_INCREASING_STEER = SlowlyIncreasingSteer(
    speed=50 * METRES_PER_SECOND_OF_A_MPH,
    handwheel_angle=STANDARD_ANGLE,
    handwheel_rate=13.5,
    duration=22.0,
    speed_hold=ADAPTED,
)
"""50 mph; 13.5 deg/s to 270 deg, or to the largest handwheel angle of the vehicle."""


def angle_at_level(history: History, gear: Gear) -> float:
    """Magnitude of the handwheel angle (deg) at a lateral acceleration of 0.3 g.

    From a linear fit to the data between 0.1 and 0.375 g; nan without enough data.
    """
    band = band_of_the_fit(history)
    if band is None:
        return math.nan
    acceleration = np.abs(history["lateral_acceleration"][band]) / GRAVITY
    handwheel = to_handwheel(np.abs(np.degrees(history["steering"][band])), gear)
    slope, intercept = np.polyfit(handwheel, acceleration, 1)
    return float((LEVEL - intercept) / slope)


def band_of_the_fit(history: History) -> slice | None:
    """Rows whose lateral acceleration is between 0.1 and 0.375 g, to either side.

    None if 0.375 g is not reached from below, or if there are fewer than FEWEST rows.
    """
    acceleration = np.abs(history["lateral_acceleration"]) / GRAVITY
    first, end = np.argmax(acceleration >= FIT_FROM), np.argmax(acceleration > FIT_TO)
    return slice(first, end) if end - first >= FEWEST else None


def steering_at_03g(vehicle: Vehicle, options: Options) -> float:
    """Handwheel angle (deg) at 0.3 g: mean of a slowly increasing steer to the left and the right.

    On a level road. One run to each side is enough because simulated runs are repeatable. Raises
    InputError if the vehicle does not reach 0.375 g, or too quickly for a fit.
    """
    return _steering_at_03g(_Same(vehicle), options)


@functools.lru_cache(maxsize=KEPT)
def _steering_at_03g(same: "_Same", options: Options) -> float:
    vehicle = same.vehicle
    angles = [_angle_to_a_side(vehicle, options, side) for side in (1.0, -1.0)]
    if any(map(math.isnan, angles)):
        problem = "the slowly increasing steer of this vehicle has " + TOO_LITTLE
        allowed = (
            "a number above 0 deg, such as slowly_increasing_steer prints at a lower speed or "
            "handwheel_rate"
        )
        raise InputError("steering_at_03g", 0.0, allowed, problem)
    return float(np.mean(angles))


class _Same:
    """A vehicle as a key: a vehicle never changes, and equals itself only."""

    def __init__(self, vehicle: Vehicle):
        self.vehicle = vehicle

    def __eq__(self, other) -> bool:
        return self.vehicle is other.vehicle

    def __hash__(self) -> int:
        return id(self.vehicle)


def _angle_to_a_side(vehicle: Vehicle, options: Options, side: float) -> float:
    steer = dataclasses.replace(
        SLOWLY_INCREASING_STEER,
        handwheel_angle=side * STANDARD_ANGLE,
        speed_hold=hold_for(vehicle),
        gear=vehicle.gear,
    ).within_the_wheels()
    return angle_at_level(history_to_the_level(steer, vehicle, options), steer.gear)


def history_to_the_level(
    steer: SlowlyIncreasingSteer, vehicle: Vehicle, options: Options
) -> History:
    """Run until just above 0.375 g, or until the run ends."""
    simulation, rows = Simulation(vehicle, options), []
    simulation.reset(steer.speed)
    is_beyond = False
    while not is_beyond:
        rows.append(history_of(simulation, steer, STRETCH).rows[:-1])
        is_beyond = np.any(np.abs(History(rows[-1])["lateral_acceleration"]) > FIT_TO * GRAVITY)
        if simulation.condition is not Condition.RUNNING or simulation.time >= steer.duration:
            break
    return History(np.concatenate(rows))
