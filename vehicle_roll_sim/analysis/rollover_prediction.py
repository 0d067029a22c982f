"""How soon the inner wheels will lift: load transfer foreseen with the roll-plane model, online.

Time to rollover after B.-C. Chen and H. Peng, "Differential-braking-based rollover prevention for
sport utility vehicles with human-in-the-loop evaluations", Vehicle System Dynamics 36 (2001): a
simple model runs ahead of the vehicle. Theirs foresees the lateral motion too, with the steering
held; here the lateral force of the tires goes on as it has changed of late, which needs neither
steering nor tire data, in the sense of the predicted load transfer ratio of C. Larish,
D. Piyabongkarn, V. Tsourapas and R. Rajamani, IEEE Trans. Vehicular Technology 62 (2013).
"""

import dataclasses
import math

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.model.roll_plane_motion import RollPlaneMotion
from vehicle_roll_sim.vehicle.parameters import Vehicle

LIFTED = 1.0
"""Load transfer ratio at which the inner wheels carry nothing any more."""


@dataclasses.dataclass(frozen=True)
class Foresight:
    """How far, and how, the predictor looks ahead."""

    horizon: float = parameter("how far to look ahead", "s", 0.01, 10.0, default=0.6)
    interval: float = parameter("step of the prediction", "s", 1e-3, 0.1, default=0.01)
    persistence: float = parameter(
        "time constant with which the tires' force stops changing",
        "s",
        0.0,
        10.0,
        default=0.15,
    )
    smoothing: float = parameter(
        "time constant of the filter of that change", "s", 0.0, 10.0, default=0.03
    )


@dataclasses.dataclass(frozen=True)
class Prediction:
    """load_transfer_ratio: now, as the model has it. predicted_load_transfer_ratio: the largest
    within the horizon, with its sign, beyond 1 where the inner wheels lift. time_to_rollover: until
    they do (s), inf if they do not within the horizon.
    """

    load_transfer_ratio: float
    predicted_load_transfer_ratio: float
    time_to_rollover: float


class RolloverPredictor:
    """Foresees the load transfer of a vehicle from what an inertial sensor at its c.g. measures."""

    def __init__(self, vehicle: Vehicle, foresight: Foresight | None = None):
        self.model = RollPlaneMotion(vehicle.record())
        self.foresight = foresight or Foresight()
        self.reset()

    def reset(self) -> None:
        """Forget what was measured."""
        self._time, self._force, self._change = math.inf, 0.0, 0.0

    def update(
        self, time: float, roll: float, roll_rate: float, lateral_acceleration: float
    ) -> Prediction:
        """The prediction at a time (s), which begins anew if that is not after the last.

        roll (rad), roll_rate (rad/s); lateral_acceleration of the sprung c.g. along the ground,
        across the heading (m/s^2).
        """
        force = self.model.tire_force(roll, roll_rate, lateral_acceleration)
        passed = time - self._time
        if passed > 0.0:
            measured = (force - self._force) / passed
            weight = passed / (self.foresight.smoothing + passed)
            self._change += weight * (measured - self._change)
        else:
            self._change = 0.0
        self._time, self._force = time, force
        return self._look_ahead(roll, roll_rate)

    def _look_ahead(self, roll: float, roll_rate: float) -> Prediction:
        """Integrate the roll (symplectic Euler: it neither gains nor loses energy by itself)."""
        ahead, model, interval = self.foresight, self.model, self.foresight.interval
        ratios, lifted = [], math.inf
        for step in range(round(ahead.horizon / interval) + 1):
            force = self._force + self._change * self._persisting(step * interval)
            acceleration = model.roll_acceleration(roll, roll_rate, force)
            ratios.append(model.load_transfer_ratio_of(roll, acceleration, force))
            if abs(ratios[-1]) >= LIFTED:
                lifted = min(lifted, step * interval)
            roll_rate += acceleration * interval
            roll += roll_rate * interval
        return Prediction(ratios[0], max(ratios, key=abs), lifted)

    def _persisting(self, ahead: float) -> float:
        """For how long (s) the present change will have worked by then, as it dies away."""
        persistence = self.foresight.persistence
        return persistence * -math.expm1(-ahead / persistence) if persistence else 0.0
