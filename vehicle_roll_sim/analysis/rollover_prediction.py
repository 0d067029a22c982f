"""Online rollover prediction: time until the inner wheels lift, from the roll-plane model.

Time to rollover after B.-C. Chen and H. Peng, "Differential-braking-based rollover prevention for
sport utility vehicles with human-in-the-loop evaluations", Vehicle System Dynamics 36 (2001): a
simple model runs ahead of the vehicle. Their model also predicts the lateral motion, with constant
steering. Here the lateral tire force is extrapolated from its recent rate of change instead, which
requires neither steering nor tire data, similar to the predicted load transfer ratio of C. Larish,
D. Piyabongkarn, V. Tsourapas and R. Rajamani, IEEE Trans. Vehicular Technology 62 (2013).
"""

import dataclasses
import math

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.model.roll_plane_motion import RollPlaneMotion
from vehicle_roll_sim.vehicle.parameters import Vehicle

LIFTED = 1.0
"""Magnitude of the load transfer ratio at which the inner wheels lift off."""


@dataclasses.dataclass
class Foresight:
    """Parameters of the prediction."""

    horizon: float = parameter("prediction horizon", "s", 0.01, 10.0, default=0.6)
    interval: float = parameter("time step of the prediction", "s", 1e-3, 0.1, default=0.01)
    persistence: float = parameter(
        "time constant with which the extrapolated rate of change of the tire force decays",
        "s",
        0.0,
        10.0,
        default=0.15,
    )
    smoothing: float = parameter(
        "filter time constant of the measured rate of change of the tire force",
        "s",
        0.0,
        10.0,
        default=0.03,
    )


@dataclasses.dataclass(frozen=True)
class Prediction:
    """A prediction.

    load_transfer_ratio: present value, from the model. predicted_load_transfer_ratio: signed value
    of the largest magnitude within the horizon; a magnitude above 1 means that the inner wheels
    lift. time_to_rollover: time until they lift (s); inf if they do not within the horizon.
    """

    load_transfer_ratio: float
    predicted_load_transfer_ratio: float
    time_to_rollover: float


class RolloverPredictor:
    """Predicts the load transfer of a vehicle from the signals of an inertial sensor at its c.g."""

    def __init__(self, vehicle: Vehicle, foresight: Foresight | None = None):
        self.model = RollPlaneMotion(vehicle.record())
        self.foresight = foresight or Foresight()
        self.reset()

    def reset(self) -> None:
        """Discard previous measurements."""
        self._time, self._force, self._change = math.inf, 0.0, 0.0

    def update(
        self, time: float, roll: float, roll_rate: float, lateral_acceleration: float
    ) -> Prediction:
        """The prediction at `time` (s); a time that is not after the previous one restarts it.

        roll: rad. roll_rate: rad/s. lateral_acceleration: of the sprung c.g., horizontal and normal
        to the heading (m/s^2).
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
        """Integrate the roll motion by symplectic Euler, which adds no numerical damping."""
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
        """Integral of the decaying weight of the present rate of change up to `ahead` (s)."""
        persistence = self.foresight.persistence
        return persistence * -math.expm1(-ahead / persistence) if persistence else 0.0
