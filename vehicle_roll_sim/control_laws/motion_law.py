"""Control laws that hear the topic `motion` and nothing else, in a node and without ROS alike."""

import abc
import dataclasses
import math
from collections.abc import Mapping, Sequence

from vehicle_roll_sim.runs.control_law import ControlLaw, Sensed
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

STATES = ("u", "v", "yaw_rate", "roll", "roll_rate")
"""The states that such a law hears (SI units, rad)."""


@dataclasses.dataclass(kw_only=True)
class MotionLaw(ControlLaw):
    """A law whose answers depend on the samples of `motion` since the last restart only."""

    def begin(self, vehicle: Vehicle, options: Options) -> None:
        self.restart()

    def restart(self) -> None:
        """Forget previous samples."""
        self._time = -math.inf

    def answer(self, sensed: Sensed) -> Mapping[str, float | Sequence[float]]:
        return self.answer_to(
            {
                "time": sensed.time,
                "steering": sensed.applied.steering,
                "rear_steering": sensed.applied.rear_steering,
                **{name: float(sensed.state[name]) for name in STATES},
            }
        )

    def answer_to(self, motion: Mapping[str, float]) -> Mapping[str, float | Sequence[float]]:
        """The commands of the period that begins with a sample: as `answer`.

        motion: by name, `time` (s), `steering` and `rear_steering` of the period that ends (rad),
        and STATES. A time that is not after the previous one restarts the law first, as when a
        simulator is reset.
        """
        if motion["time"] <= self._time:
            self.restart()
        self._time = motion["time"]
        return self.commanded(motion)

    @abc.abstractmethod
    def commanded(self, motion: Mapping[str, float]) -> Mapping[str, float | Sequence[float]]:
        """The law itself; argument and result are those of `answer_to`."""
