"""A driver who sees the path ahead: MacAdam's optimal preview control.

C. C. MacAdam, "Application of an optimal preview control for simulation of closed-loop automobile
driving", IEEE Transactions on Systems, Man, and Cybernetics 11(6), 393-399, 1981.
"""

import bisect
import math
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.manoeuvres.driver.single_track import SingleTrack

POINTS = 20
"""Points of the preview: more of them change no road-wheel angle by a thousandth."""
SLOWEST = 1.0
"""m/s: below it the driver looks ahead as at this speed, and the slips stay finite."""
ROUNDING = 1e-9
"""s"""

PathAhead = Callable[[float, float, float], np.ndarray]
"""Points (n, 2) of the path (m), in order, from beside a place x, y to beyond a distance (m)."""


class PreviewSteering:
    """The handwheel's angle that brings a vehicle best to its path, held over the preview.

    The vehicle is expected to move as the linear single-track model does. In axes of the vehicle
    as it stands now, its lateral position after a time eta is

        y(eta) = c Phi(eta) x + A(eta) delta

    with Phi the transition matrix of the states x = (y, psi, v, r), c = (1, 0, 0, 0), and A the
    response to a road-wheel angle of 1 that is held. The angle is the one with the least integral
    of (f - y)^2 over the preview time, f being the path's lateral position (equation 11):

        delta = integral (f - c Phi x) A / integral A^2

    It takes effect after a delay, as far as the handwheel's rate and angle allow.

    preview, delay: times (s). rate, limit: of the road-wheel angle (rad/s, rad). Without a model no
    angle is known, and all are nan.
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
        """The road-wheel angle (rad) from `time` (s) on; to be asked in order of time."""
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
        """delta (rad), without delay and limits."""
        if self.model is None:
            return math.nan
        speed = max(float(state["u"]), SLOWEST)
        motion = np.array([float(state["v"]), float(state["yaw_rate"])])
        free, response = self.prediction(speed, motion)
        distances = speed * self.preview * np.arange(1, POINTS + 1) / POINTS
        missing = self._path_across(state, distances) - free
        return float(missing @ response / (response @ response))

    def prediction(self, speed: float, motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """c Phi x and A at the points of the preview (m, m/rad); motion: v and r now."""
        rates, steer = self.model.rates(speed)
        system = np.zeros((5, 5))  # y, psi, v, r, delta
        system[0, 1], system[0, 2], system[1, 3] = speed, 1.0, 1.0
        system[2:4, 2:4], system[2:4, 4] = rates, steer
        step, now = transition(system * (self.preview / POINTS)), np.eye(5)
        rows = np.empty((POINTS, 5))
        for k in range(POINTS):
            now = now @ step
            rows[k] = now[0]
        return rows[:, 2:4] @ motion, rows[:, 4]

    def _path_across(self, state, distances: np.ndarray) -> np.ndarray:
        """f: lateral position of the path (m, left positive) at distances ahead (m)."""
        x, y, yaw = (float(state[name]) for name in ("x", "y", "yaw"))
        points = self.path(x, y, float(distances[-1])) - (x, y)
        ahead = points @ (math.cos(yaw), math.sin(yaw))
        left = points @ (-math.sin(yaw), math.cos(yaw))
        return np.interp(distances, np.maximum.accumulate(ahead), left)


def transition(exponent: np.ndarray) -> np.ndarray:
    """The exponential of a matrix by the diagonal Pade approximant of second order.

    Its error is the fifth power of the exponent over 720; what decays, decays however fast it does,
    as at a low speed.
    """
    even, odd = np.eye(len(exponent)) + exponent @ exponent / 12.0, exponent / 2.0
    return np.linalg.solve(even - odd, even + odd)
