"""Double lane changes of ISO 3888: a driver follows a path between cones."""

import dataclasses
import math
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED, SIDES
from vehicle_roll_sim.manoeuvres.body_outline import BodySettings, Outline
from vehicle_roll_sim.manoeuvres.criteria import ROUNDING, two_wheel_lift_line
from vehicle_roll_sim.manoeuvres.driver.path_following import PathFollowing
from vehicle_roll_sim.manoeuvres.lane_change_track import (
    Track,
    double_lane_change_track,
    obstacle_avoidance_track,
)
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

SPACING = 0.1
"""m between points of the path; linear interpolation suffices because its bends are at least 5 m
long."""
BESIDE = 5.0
"""m of the path provided behind the vehicle and beyond the preview distance."""
COARSEST = 0.05
"""s: longest sample interval at which cone strikes are accurate to a centimetre."""
UNKNOWN = Outline(math.nan, math.nan, math.nan)
"""The outline before `for_vehicle`."""
KMH = 3.6
"""km/h per m/s."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class DoubleLaneChange(BodySettings, PathFollowing):
    """Into the second lane and back; `for_vehicle` sets the track and the outline.

    The vehicle starts on the centre line of the first lane, with its front `approach` (m) before
    the lane. The path is followed by the sprung c.g. (8 DOF model: by the roll axis below it).
    layout: function of vehicle width (m) and side (1 or -1) that returns the track.
    """

    side: str = parameter("side of the first lane change", choices=tuple(SIDES), default="left")
    approach: float = parameter(
        "distance from the front of the vehicle to the track at the start",
        "m",
        0.0,
        1e4,
        default=10.0,
    )
    layout: Callable[[float, float], Track]
    release: float = math.inf
    """Distance of the vehicle's front into the first lane at which the throttle is released (m)."""
    track: Track | None = None
    outline: Outline = UNKNOWN

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "DoubleLaneChange":
        ready = super().for_vehicle(vehicle, options)
        outline = self.outline_of(vehicle)
        track = self.layout(outline.width, SIDES[self.side])
        return dataclasses.replace(ready, outline=outline, track=track)

    @property
    def track_begins(self) -> float:
        """x of the beginning of the track on the ground (m); the c.g. is at 0 at reset."""
        return self.outline.ahead + self.approach

    @property
    def cones(self) -> np.ndarray:
        """Positions of the cones on the ground, shape (n, 2) (m)."""
        return self.track.cones + np.array([self.track_begins, 0.0])

    def path_ahead(self, x: float, y: float, distance: float) -> np.ndarray:
        places = np.arange(x - BESIDE, x + distance + BESIDE, SPACING)
        return np.column_stack((places, self.track.path(places - self.track_begins)))

    def driver(self) -> "LaneChangeDriver":
        return LaneChangeDriver(self)

    def result(self, history: History) -> "LaneChangeResult":
        """Evaluate cones struck, lanes missed and the deviation from the path."""
        x, y = history["x"] - self.track_begins, history["y"]
        on_track = (x >= 0.0) & (x <= self.track.end)
        away = np.where(on_track, np.abs(y - self.track.path(x)), -1.0)
        is_out = x - self.outline.behind > self.track.end
        out = int(np.argmax(is_out)) if is_out.any() else None
        return LaneChangeResult(
            strikes=self.outline.strike_times(history, self.cones),
            missed=int(np.count_nonzero(self.track.missed_lanes(x, y))),
            deviation=float(away.max()) if on_track.any() else math.nan,
            deviation_at=float(x[np.argmax(away)]) if on_track.any() else math.nan,
            finished=float(history["time"][out]) if out is not None else math.nan,
            final_speed=float(history["u"][out]) if out is not None else math.nan,
            interval=history.interval,
        )

    def report(self, history: History, driver: Feedback) -> dict[str, str]:
        result = self.result(history)
        end, away = "not reached", "not on the track"
        if not math.isnan(result.finished):
            end = f"{result.finished:.3f} s at {result.final_speed * KMH:.1f} km/h"
        if not math.isnan(result.deviation):
            away = f"{result.deviation:.3f} m, {result.deviation_at:.1f} m into the track"
        return {
            "vehicle width": f"{self.outline.width:.3f} m",
            "cones struck": self._cones_struck(result),
            "lanes missed": f"{result.missed} of {len(self.track.lanes)}",
            "deviation from the path": away,
            "end of the track": end,
            "verdict": _verdict(result),
            **two_wheel_lift_line(history),
        }

    def _cones_struck(self, result: "LaneChangeResult") -> str:
        if not result.is_known:
            return f"unknown: samples are more than {COARSEST:g} s apart"
        text = f"{result.struck} of {len(result.strikes)}"
        if not result.struck:
            return text
        first = int(np.nanargmin(result.strikes))
        x, y = self.track.cones[first].tolist()
        return f"{text}, first at {result.strikes[first]:.3f} s: x {x:.1f} m, y {y:.2f} m"


@dataclasses.dataclass(frozen=True)
class LaneChangeResult:
    """Results of one run.

    strikes: time at which each cone was struck (n,) (s), nan if it was not. missed: number of lanes
    missed. deviation, deviation_at: largest lateral deviation from the path (m) and its position
    along the track (m), nan if the track was not entered. finished, final_speed: time at which the
    rear left the track (s) and the forward speed then (m/s), nan if it did not. interval: longest
    sample interval (s).
    """

    strikes: np.ndarray
    missed: int
    deviation: float
    deviation_at: float
    finished: float
    final_speed: float
    interval: float

    @property
    def struck(self) -> int:
        """Number of cones struck."""
        return int(np.count_nonzero(~np.isnan(self.strikes)))

    @property
    def is_known(self) -> bool:
        """Whether the sample interval is short enough to determine which cones were struck."""
        return self.interval <= COARSEST + ROUNDING

    @property
    def is_passed(self) -> bool:
        """Whether every lane and the end of the track were passed without striking a cone."""
        is_through = self.missed == 0 and not math.isnan(self.finished)
        return self.is_known and is_through and self.struck == 0


def _verdict(result: LaneChangeResult) -> str:
    if not result.is_known:
        return "unknown"
    return "passed" if result.is_passed else "failed"


class LaneChangeDriver(Feedback):
    """Follows the path, and holds the speed until the throttle is released.

    `released`: time (s) of the first command period that begins beyond the point of release; inf
    until then.
    """

    def __init__(self, manoeuvre: DoubleLaneChange):
        self.manoeuvre, self.steering = manoeuvre, manoeuvre.steering()
        self.released = math.inf

    def command(self, time: float, state) -> np.ndarray:
        manoeuvre = self.manoeuvre
        commands = manoeuvre.straight_ahead(np.array([time]))
        front = float(state["x"]) + manoeuvre.outline.ahead * math.cos(float(state["yaw"]))
        if front >= manoeuvre.track_begins + manoeuvre.release:
            self.released = min(self.released, time)
        if time >= self.released:
            commands["speed_hold_gain"] = 0.0
        commands["steering"] = self.steering.angle(time, state)
        return commands


ISO_DOUBLE_LANE_CHANGE = DoubleLaneChange(
    speed=80 / KMH,
    duration=15.0,
    speed_hold=ADAPTED,
    preview_time=0.8,
    layout=double_lane_change_track,
)
"""80 km/h; the speed is held throughout."""
ISO_SEVERE_DOUBLE_LANE_CHANGE = DoubleLaneChange(
    speed=50 / KMH,
    duration=10.0,
    speed_hold=ADAPTED,
    preview_time=0.65,
    layout=obstacle_avoidance_track,
    release=2.0,
)
"""50 km/h; the throttle is released 2 m into the first lane."""
