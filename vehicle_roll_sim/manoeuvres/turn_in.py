"""A near step of the handwheel to the angle that gives a steady lateral acceleration."""

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import LONGEST
from vehicle_roll_sim.manoeuvres.driving import history_of
from vehicle_roll_sim.manoeuvres.handwheel import LARGEST_HANDWHEEL, HandwheelProgramme
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.steering_gear import to_handwheel

STEADY_WINDOW = 0.5
"""s: the steady value is the mean over this time at the end of a run."""
CLOSE_ENOUGH = 1e-3
"""m/s^2: tolerance of the steady lateral acceleration."""
ATTEMPTS = 20
SLOWEST = 1.0
"""m/s: lowest speed assumed for the first guess."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class TurnIn(HandwheelProgramme):
    """Straight ahead at constant speed, then a near step of the handwheel angle.

    `for_vehicle` determines the angle that gives the lateral acceleration, unless it is given.
    """

    lateral_acceleration: float = parameter(
        "target steady lateral acceleration, left positive", "m/s^2", -20.0, 20.0
    )
    handwheel_angle: float = parameter(
        "handwheel angle, left positive; 0: determined from lateral_acceleration",
        "deg",
        -LARGEST_HANDWHEEL,
        LARGEST_HANDWHEEL,
        default=0.0,
    )
    rise: float = parameter("time in which the full handwheel angle is reached", "s", 1e-3, LONGEST)

    @property
    def without_effect(self) -> Mapping[str, str]:
        if not self.handwheel_angle:
            return {}
        return {"lateral_acceleration": "only without a handwheel_angle"}

    @property
    def amplitude(self) -> float:
        return self.handwheel_angle

    def handwheel(self, times: np.ndarray) -> np.ndarray:
        return self.handwheel_angle * np.clip((times - self.start) / self.rise, 0.0, 1.0)

    def turning_only(self) -> "TurnIn":
        """A copy that ends in the steady turn, for the search for the handwheel angle."""
        return self

    def filled_in(self, vehicle: Vehicle, options: Options) -> "TurnIn":
        """A copy with the handwheel angle.

        Raises InputError if no angle gives the lateral acceleration.
        """
        if self.handwheel_angle or not self.lateral_acceleration:
            return self
        angle = self.turning_only()._angle_for_acceleration(vehicle, options)
        return dataclasses.replace(self, handwheel_angle=angle)

    def _angle_for_acceleration(self, vehicle: Vehicle, options: Options) -> float:
        """Handwheel angle (deg) for the target acceleration, by the secant method.

        The first guess is the Ackermann angle.
        """
        wanted = self.lateral_acceleration
        wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
        curvature = wanted / max(self.speed, SLOWEST) ** 2
        before, missed_before = 0.0, -wanted
        angle = float(to_handwheel(math.degrees(wheelbase * curvature), self.gear))
        for _ in range(ATTEMPTS):
            if abs(angle) > LARGEST_HANDWHEEL:
                break
            missed = self._steady_acceleration(angle, vehicle, options) - wanted
            if abs(missed) < CLOSE_ENOUGH:
                return angle
            if math.isnan(missed) or missed == missed_before:
                break
            step = missed * (angle - before) / (missed - missed_before)
            before, missed_before, angle = angle, missed, angle - step
        problem = f"no handwheel angle gives a steady {wanted:g} m/s^2"
        allowed = "a lower value, another speed, or handwheel_angle instead"
        raise InputError("lateral_acceleration", wanted, allowed, problem)

    def _steady_acceleration(self, angle: float, vehicle: Vehicle, options: Options) -> float:
        """Steady lateral acceleration (m/s^2) after a step to `angle` (deg); nan if a run stops."""
        simulation = Simulation(vehicle, options)
        simulation.reset(self.speed)
        step = dataclasses.replace(self, handwheel_angle=angle)
        history = history_of(simulation, step, self.duration)
        return steady(history, "lateral_acceleration", self.duration)


def steady(history: History, name: str, duration: float) -> float:
    """Mean of a signal over the last STEADY_WINDOW of a run; nan if it ended before `duration`."""
    time = history["time"]
    if time[-1] < duration - STEADY_WINDOW:
        return math.nan
    return float(np.mean(history[name][time > time[-1] - STEADY_WINDOW]))
