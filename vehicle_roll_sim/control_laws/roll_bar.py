"""Active roll bars driven by state feedback: M = -K x, as pairs of forces at both axles."""

import dataclasses
from collections.abc import Mapping

from vehicle_roll_sim.control_laws.law import ControlLaw
from vehicle_roll_sim.declaration import keep_validated, parameter

FED_BACK = ("v", "yaw_rate", "roll", "roll_rate")
"""The states that are fed back."""
GAINS = ("lateral_velocity_gain", "yaw_rate_gain", "roll_gain", "roll_rate_gain")
"""The gain of each."""


@dataclasses.dataclass(frozen=True)
class RollBarGains:
    """Gains of the state feedback, and the bars that it drives."""

    lateral_velocity_gain: float = parameter("roll moment per lateral velocity", "N s", -1e7, 1e7)
    yaw_rate_gain: float = parameter("roll moment per yaw rate", "N m s", -1e7, 1e7)
    roll_gain: float = parameter("roll moment per roll angle", "N m", -1e7, 1e7)
    roll_rate_gain: float = parameter("roll moment per roll rate", "N m s", -1e7, 1e7)
    front_share: float = parameter("share of the roll moment at the front axle", "", 0.0, 1.0)
    front_track: float = parameter("front track width", "m", 0.1, 10.0)
    rear_track: float = parameter("rear track width", "m", 0.1, 10.0)
    largest_force: float = parameter("largest force at a corner", "N", 0.0, 1e6)

    def __post_init__(self):
        keep_validated(self)


class LqrRollBar(ControlLaw):
    """The roll moment -K x of the bars, at both axles limited to `largest_force` at a corner."""

    commanded = ("normal_force",)

    def __init__(self, gains: RollBarGains):
        self.gains = gains
        super().__init__()

    def law(self, motion: Mapping[str, float]) -> dict:
        front, rear = self.forces(self.moment(motion))
        return {"normal_force": (-front, front, -rear, rear)}

    def moment(self, motion: Mapping[str, float]) -> float:
        """The roll moment on the body (N m); a positive one turns it to the left."""
        pairs = zip(GAINS, FED_BACK, strict=True)
        return sum(getattr(self.gains, gain) * motion[state] for gain, state in pairs)

    def forces(self, moment: float) -> tuple[float, float]:
        """Forces at the right corners in front and in the rear (N); opposite ones at the left."""
        gains, largest = self.gains, self.gains.largest_force
        front = gains.front_share * moment / gains.front_track
        rear = (1.0 - gains.front_share) * moment / gains.rear_track
        return max(-largest, min(largest, front)), max(-largest, min(largest, rear))
