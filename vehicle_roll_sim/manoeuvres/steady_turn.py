"""Common parts of the ISO 4138 circles: gradients, and a slowly rising speed."""

import dataclasses
import math
from collections.abc import Callable, Mapping

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.base import LONGEST, Manoeuvre
from vehicle_roll_sim.manoeuvres.slowly_increasing_steer import TOO_LITTLE, band_of_the_fit
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import roll_gradient, understeer_gradient
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.parameters import Vehicle

ENOUGH = 0.4 * GRAVITY
"""m/s^2: speed times yaw rate above which the speed stops rising; just above the 0.375 g needed."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class SteadyTurn(Manoeuvre):
    """A quasi-steady turn: every sample counts as steady state.

    `for_vehicle` sets the wheelbase (m; nan before).
    """

    wheelbase: float = math.nan
    steady_from = 0.0
    """Time (s) from which data is evaluated."""

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "SteadyTurn":
        """A copy with the vehicle's wheelbase (m)."""
        wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
        return dataclasses.replace(super().for_vehicle(vehicle, options), wheelbase=wheelbase)

    def gradients(self, history: History) -> tuple[float, float]:
        """Understeer gradient, at the road wheels, and roll gradient (deg/(m/s^2)).

        They are the slopes, over lateral acceleration from 0.1 to 0.375 g, of two angles: the
        road-wheel angle less the Ackermann angle, steering - wheelbase * yaw rate / speed, and the
        roll angle. At constant radius the Ackermann angle is constant; at constant handwheel angle
        the steering is. nan without enough data.
        """
        history = History(history.rows[history["time"] >= self.steady_from])
        band = band_of_the_fit(history) if len(history.rows) else None
        if band is None:
            return math.nan, math.nan
        names = ("lateral_acceleration", "steering", "yaw_rate", "u", "roll")
        acceleration, *turn, roll = (history[name][band] for name in names)
        understeer = understeer_gradient(acceleration, *turn, self.wheelbase)
        return math.degrees(understeer), math.degrees(roll_gradient(acceleration, roll))

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        labels = ("understeer gradient", "roll gradient")
        return {
            label: TOO_LITTLE if math.isnan(slope) else f"{slope:.4f} deg/(m/s^2)"
            for label, slope in zip(labels, self.gradients(history), strict=True)
        }


@dataclasses.dataclass(frozen=True, kw_only=True)
class RisingSpeed(SteadyTurn):
    """A turn at a slowly rising speed."""

    acceleration: float = parameter(
        "rate of change of the speed", "m/s^2", 1e-4, 10.0, default=0.05
    )
    rises_from: float = parameter(
        "time at which the speed begins to rise", "s", 0.0, LONGEST, default=5.0
    )

    @property
    def steady_from(self) -> float:
        """Time (s) by which the initial transient has settled."""
        return self.rises_from


class RisingSpeedDriver(Feedback):
    """Raises the speed until there is enough data, then holds it.

    steer: function that returns the road-wheel angle (rad) for a time (s) and a state. `enough`:
    the time (s) from which the speed is held; inf until then.
    """

    def __init__(self, manoeuvre: RisingSpeed, steer: Callable[[float, Mapping], float]):
        self.manoeuvre, self.steer = manoeuvre, steer
        self.enough = math.inf

    def command(self, time: float, state) -> np.ndarray:
        commands = self.manoeuvre.straight_ahead(np.array([time]))
        if abs(state["u"] * state["yaw_rate"]) > ENOUGH:
            self.enough = min(self.enough, time)
        rising = max(min(time, self.enough) - self.manoeuvre.rises_from, 0.0)
        commands["speed_hold_target"] += self.manoeuvre.acceleration * rising
        commands["steering"] = self.steer(time, state)
        return commands
