"""Double wishbones seen from the front: four-bar linkages, each solved in closed form.

Points are those of a left wheel, (to the left, up) from the sprung c.g. of a vehicle at rest.
"""

import dataclasses

import numpy as np

from vehicle_roll_sim import LF, LR, Vehicle

FIRST_WHEELS = {"front": LF, "rear": LR}
SHAPES = {
    "front": ((-0.38, -0.07), (-0.04, -0.11), (-0.32, 0.12), (-0.09, 0.16)),
    "rear": ((-0.42, -0.08), (-0.03, -0.11), (-0.33, 0.12), (-0.08, 0.15)),
}
"""Inner and outer joint of the lower arm, then of the upper arm, from the wheel centre (m)."""
LARGEST_TURN = 0.5
"""rad: of a lower arm in the tables."""


def turned(vector: np.ndarray, angle: float) -> np.ndarray:
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.array([cosine * vector[0] - sine * vector[1], sine * vector[0] + cosine * vector[1]])


@dataclasses.dataclass
class Linkage:
    """The linkage of an axle. wheel: its left wheel centre at rest; radius: static loaded (m)."""

    wheel: np.ndarray
    radius: float
    lower: np.ndarray
    ball: np.ndarray
    upper: np.ndarray
    top: np.ndarray

    @classmethod
    def of(cls, vehicle: Vehicle, axle: str) -> "Linkage":
        at = FIRST_WHEELS[axle]
        up = float(vehicle.static_wheel_height[at]) - vehicle.cg_height
        wheel = np.array([getattr(vehicle, f"{axle}_track") / 2, up])
        return cls(wheel, float(vehicle.static_loaded_radius[at]), *(wheel + SHAPES[axle]))

    def carrier_turn(self, arm_turn: float) -> float:
        """Turn of the carrier (rad) at a turn of the lower arm: its top joint is on a circle."""
        ball, top = self.ball_at(arm_turn), self.top - self.ball
        across = self.upper - ball
        length, reach = np.hypot(*(self.top - self.upper)), np.hypot(*top)
        distance = np.hypot(*across)
        cosine = (reach**2 + distance**2 - length**2) / (2 * reach * distance)
        at_rest = np.arctan2(top[1], top[0])
        return np.arctan2(across[1], across[0]) - np.arccos(cosine) - at_rest

    def ball_at(self, arm_turn: float) -> np.ndarray:
        return self.lower + turned(self.ball - self.lower, arm_turn)

    def wheel_at(self, arm_turn: float) -> np.ndarray:
        turn = self.carrier_turn(arm_turn)
        return self.ball_at(arm_turn) + turned(self.wheel - self.ball, turn)

    def centre_at(self, arm_turn: float) -> np.ndarray:
        """Instant centre of the carrier: where the lines of both arms meet."""
        ball, turn = self.ball_at(arm_turn), self.carrier_turn(arm_turn)
        top = ball + turned(self.top - self.ball, turn)
        along = np.column_stack((ball - self.lower, self.upper - top))
        share, _ = np.linalg.solve(along, self.upper - self.lower)
        return self.lower + share * (ball - self.lower)

    def ratio(self, arm_turn: float) -> tuple[float, float]:
        """First and second derivative of the carrier's turn by that of the arm.

        The first from the velocities of the joints, which the instant centre gives.
        """
        step = 1e-4

        def first(turn: float) -> float:
            arm = self.ball_at(turn) - self.lower
            from_centre = self.ball_at(turn) - self.centre_at(turn)
            return arm @ arm / (arm @ from_centre)

        around = [first(arm_turn + k * step) for k in (-2, -1, 1, 2)]
        second = (around[0] - 8 * around[1] + 8 * around[2] - around[3]) / (12 * step)
        return first(arm_turn), second

    def arm_turn(self, travel: float) -> float:
        """The turn of the lower arm at a travel of the wheel centre (m), by Newton's method."""
        turn = travel / (self.wheel - self.lower)[0]
        for _ in range(30):
            rate = (self.wheel_at(turn) - self.centre_at(turn))[0] * self.ratio(turn)[0]
            turn -= (self.wheel_at(turn)[1] - self.wheel[1] - travel) / rate
        return turn


def tables(vehicle: Vehicle, axle: str, points: int = 63) -> dict:
    """Half-track change and camber change of an axle, as a rig would measure them."""
    linkage = Linkage.of(vehicle, axle)
    turns = np.linspace(-LARGEST_TURN, LARGEST_TURN, points)
    carrier = np.array([linkage.carrier_turn(turn) for turn in turns])
    moved = np.array([linkage.wheel_at(turn) for turn in turns]) - linkage.wheel
    outwards = moved[:, 0] + linkage.radius * np.sin(carrier)
    pairs = {"half_track_change": outwards, "camber_change": -carrier}
    return {
        f"{axle}_{name}": tuple(zip(moved[:, 1].tolist(), values.tolist(), strict=True))
        for name, values in pairs.items()
    }


def on_wishbones(vehicle: Vehicle) -> Vehicle:
    return vehicle.with_values(tables(vehicle, "front") | tables(vehicle, "rear"))
