"""Active roll bars driven by state feedback: M = -K x, as pairs of forces at both axles.

By default the gains are those designed for the reference vehicle, in lqr_roll_bar.yaml, which is
also a ROS parameter file.
"""

import dataclasses
from collections.abc import Mapping
from pathlib import Path

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.files.yaml_file import read_mapping
from vehicle_roll_sim.runs.control_law import ControlLaw, Sensed

FED_BACK = ("v", "yaw_rate", "roll", "roll_rate")
"""The states that are fed back."""
GAINS = ("lateral_velocity_gain", "yaw_rate_gain", "roll_gain", "roll_rate_gain")
"""The gain of each."""
NODE, PARAMETERS = "lqr_roll_bar", "ros__parameters"
"""Where the parameters are in a file of gains."""
GAINS_FILE = Path(__file__).with_name("lqr_roll_bar.yaml")
"""The gains for the reference vehicle, written by `examples/design_lqr_roll_bar.py`."""
_REFERENCE = read_mapping(GAINS_FILE, "gains file", "gains for the reference vehicle")[0]


def _gain(name: str, description: str, unit: str, lowest: float, highest: float):
    """A parameter whose default is the value for the reference vehicle."""
    default = _REFERENCE[NODE][PARAMETERS][name]
    return parameter(description, unit, lowest, highest, default=default)


@dataclasses.dataclass(kw_only=True)
class LqrRollBar(ControlLaw):
    """The roll moment -K x of the bars, at both axles limited to `largest_force` at a corner."""

    commands = ("normal_force",)

    lateral_velocity_gain: float = _gain(
        "lateral_velocity_gain", "roll moment per lateral velocity", "N s", -1e7, 1e7
    )
    yaw_rate_gain: float = _gain("yaw_rate_gain", "roll moment per yaw rate", "N m s", -1e7, 1e7)
    roll_gain: float = _gain("roll_gain", "roll moment per roll angle", "N m", -1e7, 1e7)
    roll_rate_gain: float = _gain("roll_rate_gain", "roll moment per roll rate", "N m s", -1e7, 1e7)
    front_share: float = _gain(
        "front_share", "share of the roll moment at the front axle", "", 0.0, 1.0
    )
    front_track: float = _gain("front_track", "front track width", "m", 0.1, 10.0)
    rear_track: float = _gain("rear_track", "rear track width", "m", 0.1, 10.0)
    largest_force: float = _gain("largest_force", "largest force at a corner", "N", 0.0, 1e6)

    def answer(self, sensed: Sensed) -> dict:
        return {"normal_force": self.forces({name: float(sensed.state[name]) for name in FED_BACK})}

    def forces(self, state: Mapping[str, float]) -> list[float]:
        """Force (N) at lf, rf, lr, rr, positive pushes the body up, for the states FED_BACK."""
        moment = self.moment(state)
        front = self._limited(self.front_share * moment / self.front_track)
        rear = self._limited((1.0 - self.front_share) * moment / self.rear_track)
        return [-front, front, -rear, rear]

    def moment(self, state: Mapping[str, float]) -> float:
        """The roll moment on the body (N m); a positive one turns it to the left."""
        pairs = zip(GAINS, FED_BACK, strict=True)
        return sum(getattr(self, gain) * state[name] for gain, name in pairs)

    def _limited(self, force: float) -> float:
        return max(-self.largest_force, min(self.largest_force, force))
