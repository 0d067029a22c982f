"""Driver model: MacAdam's optimal preview control.

C. C. MacAdam, "Application of an optimal preview control for simulation of closed-loop automobile
driving", IEEE Transactions on Systems, Man, and Cybernetics 11(6), 393-399, 1981.
"""

import bisect
import math
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.manoeuvres.driver.single_track import SingleTrack
from vehicle_roll_sim.simulation.memory import Remembering

POINTS = 20
"""Number of preview points; more of them change the road-wheel angle by less than 0.1 %."""
NUMBERS = np.arange(1, POINTS + 1)
IDENTITY = np.eye(5)
"""Of the states of the driver's model, with its angle: y, psi, v, r, delta."""
SLOWEST = 1.0
"""m/s: lowest speed in the driver's internal model; keeps the slip angles finite at standstill."""
ROUNDING = 1e-9
"""s"""

PathAhead = Callable[[float, float, float], np.ndarray]
"""Function of x, y and a distance (m) that returns points (n, 2) of the path (m), in order, from
beside (x, y) to beyond the distance."""


class PreviewSteering(Remembering):
    """The steering angle which, held over the preview time, best brings the vehicle to its path.

    The internal model is the linear single-track model. In the vehicle axes at the present time,
    the lateral position after a time eta is predicted as

        y(eta) = c Phi(eta) x + A(eta) delta

    where Phi is the transition matrix of the states x = (y, psi, v, r), c = (1, 0, 0, 0), and A is
    the response to a constant road-wheel angle of 1 rad. The angle minimizes the integral of
    (f - y)^2 over the preview time, where f is the lateral position of the path (equation 11):

        delta = integral (f - c Phi x) A / integral A^2

    It takes effect after the delay, within the limits of rate and angle.

    preview, delay: times (s). rate, limit: of the road-wheel angle (rad/s, rad). Without a model
    all angles are nan.
    """

    def __init__(
        self,
        model: SingleTrack | None,
        path: PathAhead,
        *,
        preview: float,
        delay: float,
        rate: float,
        limit: float,
    ):
        self.model, self.path = model, path
        self.preview, self.delay, self.rate, self.limit = preview, delay, rate, limit
        self._times, self._wanted = [], []
        self._angle = 0.0

    def angle(self, time: float, state) -> float:
        """The road-wheel angle (rad) from `time` (s) on; call in order of increasing time."""
        passed = time - self._times[-1] if self._times else 0.0
        self._times.append(time)
        self._wanted.append(self.best_angle(state))
        decided = bisect.bisect_right(self._times, time - self.delay + ROUNDING)
        wanted = self._wanted[decided - 1] if decided else 0.0
        wanted = min(max(wanted, -self.limit), self.limit)
        most = self.rate * passed
        self._angle += min(max(wanted - self._angle, -most), most)
        return self._angle

    def best_angle(self, state) -> float:
        """delta (rad), before delay and limits are applied."""
        if self.model is None:
            return math.nan
        speed = max(float(state["u"]), SLOWEST)
        motion = np.array([float(state["v"]), float(state["yaw_rate"])])
        free, response = self.prediction(speed, motion)
        distances = speed * self.preview * NUMBERS / POINTS
        missing = self._path_across(state, distances) - free
        return float(missing @ response / (response @ response))

    def prediction(self, speed: float, motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """c Phi x (m) and A (m/rad) at the preview points, each of shape (POINTS,).

        speed: forward speed (m/s). motion: present v and r (m/s, rad/s), shape (2,).
        """
        rates, steer = self.model.rates(speed)
        system = np.zeros_like(IDENTITY)
        system[0, 1], system[0, 2], system[1, 3] = speed, 1.0, 1.0
        system[2:4, 2:4], system[2:4, 4] = rates, steer
        step, now = transition(system * (self.preview / POINTS)), IDENTITY
        rows = np.empty((POINTS, 5))
        for k in range(POINTS):
            now = now.dot(step)  # takes half as long as @
            rows[k] = now[0]
        return rows[:, 2:4] @ motion, rows[:, 4]

    def _path_across(self, state, distances: np.ndarray) -> np.ndarray:
        """f: lateral position of the path (n,) (m, left positive) at distances ahead (n,) (m)."""
        x, y, yaw = (float(state[name]) for name in ("x", "y", "yaw"))
        points = self.path(x, y, float(distances[-1])) - (x, y)
        ahead = points @ (math.cos(yaw), math.sin(yaw))
        left = points @ (-math.sin(yaw), math.cos(yaw))
        return np.interp(distances, np.maximum.accumulate(ahead), left)


def transition(exponent: np.ndarray) -> np.ndarray:
    """Matrix exponential by the diagonal Pade approximant of order two.

    Its error is the fifth power of the exponent over 720. It is A-stable: decaying modes decay
    however fast they are, as at low speed.
    """
    even, odd = np.eye(len(exponent)) + exponent.dot(exponent) / 12.0, exponent / 2.0
    return np.linalg.solve(even - odd, even + odd)
