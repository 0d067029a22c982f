"""Tilt table after SAE J2180: the angle at which the wheels of the raised side lift off."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import LONGEST, SIDES, OpenLoop
from vehicle_roll_sim.manoeuvres.on_roads.own_road import OnOwnRoad
from vehicle_roll_sim.roads.surfaces import LARGEST_FRICTION, Patch
from vehicle_roll_sim.roads.tilt import STEEPEST, TiltTable
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import LEFT, RIGHT
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.road import Road

PARKED = 1e5
"""N m: brake torque at each wheel that holds any vehicle."""
FALLING = math.radians(5.0)
"""rad/s: a roll rate that the vehicle has only while it falls."""
BEHIND = -1000.0
"""m: the friction of the table begins this far behind the vehicle."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class TiltTableTest(OnOwnRoad, OpenLoop):
    """A parked vehicle on a table whose one side is raised slowly until the vehicle falls."""

    rate: float = parameter("tilt rate of the table", "deg/s", 1e-3, 1.0, default=0.25)
    steepest: float = parameter(
        "angle at which the table stops", "deg", 0.1, STEEPEST, default=60.0
    )
    friction: float = parameter(
        "factor on LMUX and LMUY of the tires, in place of the rail that prevents sliding",
        "",
        0.0,
        LARGEST_FRICTION,
        default=3.0,
    )
    side: str = parameter("side that is raised", choices=tuple(SIDES), default="left")
    start: float = parameter("time at which the table begins to tilt", "s", 0.0, LONGEST)

    def __post_init__(self):
        super().__post_init__()
        if self.speed:
            raise InputError("speed", self.speed, "0: the vehicle is parked on the table")

    @property
    def commanded(self) -> tuple[str, ...]:
        return (*super().commanded, "brake_torque")

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        commands["brake_torque"] = PARKED

    def own_road(self) -> Road:
        end = SIDES[self.side] * self.steepest
        table = TiltTable(angles=((self.start, 0.0), (self.start + self.steepest / self.rate, end)))
        return Road(features=(table, Patch(start=BEHIND, friction=self.friction)))

    def tilt(self, time: float) -> float:
        """Magnitude of the angle of the table at a time (s), in rad; nan at a time of nan."""
        tilted = self.rate * (time - self.start)
        return math.radians(min(max(tilted, 0.0), self.steepest)) if time == time else math.nan

    def angles(self, history: History) -> tuple[float, float, float]:
        """Angles of the table (rad) at which the first wheel and two wheels are off, and at which
        the vehicle begins to fall; nan for never."""
        raised = history.wheels("normal_force")[:, LEFT if self.side == "left" else RIGHT] <= 0.0
        time = history["time"]
        slow = np.flatnonzero(~(np.abs(history["roll_rate"]) > FALLING))
        falls = len(slow) and slow[-1] + 1 < len(time)
        times = (*map(_first(time), (raised.any(axis=1), raised.all(axis=1))),)
        return tuple(map(self.tilt, (*times, time[slow[-1]] if falls else math.nan)))

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        labels = ("first wheel off at tilt angle", "two wheels off at tilt angle")
        first, two, fall = self.angles(history)
        lines = dict(zip(labels, (first, two), strict=True)) | {"falls at tilt angle": fall}
        ratio = "none" if math.isnan(two) else f"{math.tan(two):.4f}"
        texts = {label: _text(angle) for label, angle in lines.items()}
        return texts | {"tilt table ratio": ratio}


def _first(time: np.ndarray):
    """A function that returns the first time (s) at which a condition holds; nan for never."""
    return lambda is_so: float(time[np.argmax(is_so)]) if is_so.any() else math.nan


def _text(angle: float) -> str:
    return "none" if math.isnan(angle) else f"{math.degrees(angle):.3f} deg"


TILT_TABLE = TiltTableTest(speed=0.0, start=1.0, duration=250.0)
"""A left side that is raised at 0.25 deg/s."""
