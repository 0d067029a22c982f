"""The model with which a predictive controller looks ahead: a bicycle that rolls and brakes.

Many predictions are computed side by side, as arrays. The states are forward and lateral velocity,
yaw rate, roll angle and roll rate; inputs are the rear road-wheel angle and the brake forces Bl and
Br of the front wheels, while the driver's steering angle d stays as it is:

    m (du/dt - v r) = -Ff sin d - Bl - Br
    m (dv/dt + u r) = Ff cos d + Fr = m f
    J dr/dt = a Ff cos d - b Fr + T/2 (Bl - Br)

The roll angle follows from f as in `RollPlaneMotion`, which also gives the load transfer ratio. The
lateral forces Ff and Fr of the axles are those of the vehicle's tires at static load, at the slip
angle of the axle. By the friction ellipse, a front wheel with the load N and the brake force B
keeps sqrt(1 - (B / (friction N))^2) of its lateral force.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.model.records import LF, LR
from vehicle_roll_sim.model.roll_plane_motion import RollPlaneMotion
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire_evaluation import evaluate

STEEPEST, POINTS = 0.6, 121
"""Slip angles (rad) between which the forces of an axle are tabulated, and their number."""
FULLY_BRAKED = 0.98
"""Largest share of the friction that a brake uses in the prediction."""
SLOWEST = 1.0
"""m/s: lowest speed of the prediction, below which slip angles mean nothing."""


class Inputs(NamedTuple):
    """Inputs of one step: rear road-wheel angle (rad), brake forces in front (N); each (n,)."""

    rear_steering: np.ndarray
    left_brake: np.ndarray
    right_brake: np.ndarray


class AxleForce:
    """Lateral force (N) of the two tires of an axle over its slip angle; an odd function."""

    def __init__(self, vehicle: Vehicle, wheel: int):
        name = "front" if wheel == LF else "rear"
        tire = getattr(vehicle, f"{name}_tire") or vehicle.tire
        self.load = static_load(vehicle, wheel)
        self._angles = np.linspace(-STEEPEST, STEEPEST, POINTS)
        pair = [evaluate(tire, self.load, 0.0, -self._angles, side=s) for s in ("left", "right")]
        force = pair[0].lateral_force + pair[1].lateral_force
        self._force = 0.5 * (force - force[::-1])
        self.friction = float(self._force.max()) / (2.0 * self.load)

    def __call__(self, slip_angle: np.ndarray) -> np.ndarray:
        return np.interp(slip_angle, self._angles, self._force)


def static_load(vehicle: Vehicle, wheel: int) -> float:
    """Load of a wheel at rest (N)."""
    car = vehicle.record()[0]
    carried = car["sprung_mass"] * car["axle_load_share"][wheel] + car["unsprung_mass"][wheel]
    return float(car["gravity"] * carried)


class PredictionModel:
    """The prediction model of one vehicle.

    dt: step of the prediction (s). Attributes: `front_grip`, the lateral force that a front tire
    can exert at static load (N), and `front_radius` (m).
    """

    def __init__(self, vehicle: Vehicle, dt: float):
        record = vehicle.record()
        car = record[0]
        self.dt = dt
        self._roll_plane = RollPlaneMotion(record)
        self._front, self._rear = AxleForce(vehicle, LF), AxleForce(vehicle, LR)
        self._mass = self._roll_plane.weight / float(car["gravity"])
        self._half_track = self._roll_plane.track / 2.0
        self._ahead, self._behind = float(car["x"][LF]), -float(car["x"][LR])
        distances = car["x"] ** 2 + car["y"] ** 2
        inertia = car["yaw_inertia"] + (car["unsprung_mass"] * distances).sum()
        self._yaw_inertia = float(inertia)
        self.front_grip = self._front.friction * self._front.load
        self.front_radius = float(car["tire_radius"][LF])

    def ratios(self, motion: Mapping[str, float], steps: list[Inputs]) -> np.ndarray:
        """The load transfer ratio in each step ahead, shape (steps, n).

        motion: the signals from which the prediction starts. steps: the inputs of each step.
        """
        count = len(steps[0].rear_steering)
        names = ("u", "v", "yaw_rate", "roll", "roll_rate")
        u, v, yaw_rate, roll, roll_rate = (np.full(count, motion[name]) for name in names)
        sine, cosine = math.sin(motion["steering"]), math.cos(motion["steering"])
        ratio, found = np.zeros(count), []
        for inputs in steps:
            slowing, remaining, turning = self._braked(inputs, ratio)
            speed = np.maximum(u, SLOWEST)
            slip = motion["steering"] - np.arctan((v + self._ahead * yaw_rate) / speed)
            front = remaining * self._front(slip)
            slip = inputs.rear_steering - np.arctan((v - self._behind * yaw_rate) / speed)
            rear = self._rear(slip)
            force = (front * cosine + rear) / self._mass
            roll_acceleration = self._roll_plane.roll_acceleration(roll, roll_rate, force)
            ratio = self._roll_plane.load_transfer_ratio_of(roll, roll_acceleration, force)
            found.append(ratio)
            moment = self._ahead * front * cosine - self._behind * rear
            du = v * yaw_rate - (slowing + front * sine) / self._mass
            dv = force - u * yaw_rate
            yaw_rate = yaw_rate + self.dt * (moment + turning) / self._yaw_inertia
            u, v = u + self.dt * du, v + self.dt * dv
            roll_rate = roll_rate + self.dt * roll_acceleration
            roll = roll + self.dt * roll_rate  # with the new rate: no numerical damping
        return np.array(found)

    def _braked(self, inputs: Inputs, ratio: np.ndarray):
        """Brake force (N), remaining share of the front lateral force, and yaw moment (N m).

        ratio: load transfer ratio of the last step.
        """
        slowing, remaining, turning = 0.0, 0.0, 0.0
        brakes = (inputs.left_brake, inputs.right_brake)
        for brake, side in zip(brakes, (1.0, -1.0), strict=True):
            load = 1.0 - side * np.clip(ratio, -1.0, 1.0)  # over the static one
            grip = self.front_grip * load
            force = np.minimum(brake, FULLY_BRAKED * grip)
            used = force / np.maximum(grip, 1.0)
            slowing = slowing + force
            remaining = remaining + 0.5 * load * np.sqrt(1.0 - used**2)
            turning = turning + side * self._half_track * force
        return slowing, remaining, turning
