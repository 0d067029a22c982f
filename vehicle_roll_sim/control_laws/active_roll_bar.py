"""Active roll bars take up part of the roll moment and damp the roll.

The roll moment of the body is m h ay, where ay is the lateral specific force (it includes gravity
as the body rolls), m the sprung mass and h the height of its c.g. above the roll axis. With the
roll rate p, the bars apply the moment

    M = share m h ay + damping p

as a pair of opposite forces M / track on each axle, distributed front to rear by `front_share`. If
that share exceeds the front share of the spring roll stiffness, the vehicle understeers more.
"""

import dataclasses

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.runs.control_law import ControlLaw, Sensed


@dataclasses.dataclass(kw_only=True)
class ActiveRollBar(ControlLaw):
    """The forces of the bars at the corners."""

    commands = ("normal_force",)

    share: float = parameter("share of the roll moment, below 1", "", -10.0, 10.0, default=0.7)
    moment: float = parameter(
        "sprung mass times the height of its c.g. above the roll axis",
        "kg m",
        0.0,
        1e6,
        default=900.0,
    )
    damping: float = parameter("roll damping", "N m s/rad", -1e6, 1e6, default=4000.0)
    front_share: float = parameter("front share of the moment", "", 0.0, 1.0, default=0.6)
    track: float = parameter("track width", "m", 0.1, 10.0, default=1.5)
    largest_force: float = parameter("largest force at a corner", "N", 0.0, 1e6, default=3000.0)

    def answer(self, sensed: Sensed) -> dict:
        lateral = float(sensed.outputs["specific_force"][1])
        return {"normal_force": self.forces(lateral, float(sensed.state["roll_rate"]))}

    def forces(self, lateral_specific_force: float, roll_rate: float) -> list[float]:
        """Force (N) at lf, rf, lr, rr, positive pushes the body up; from m/s^2 and rad/s."""
        moment = self.share * self.moment * lateral_specific_force
        moment += self.damping * roll_rate
        front = self._limited(self.front_share * moment / self.track)
        rear = self._limited((1 - self.front_share) * moment / self.track)
        return [-front, front, -rear, rear]

    def _limited(self, force: float) -> float:
        return max(-self.largest_force, min(self.largest_force, force))
