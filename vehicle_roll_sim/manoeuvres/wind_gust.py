"""A gust of wind from the side, while the steering is held straight ahead."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.manoeuvres.base import ADAPTED, LONGEST, OpenLoop
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import peak
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.limits import MAXIMUM_SPEED
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.air_parameters import has_air_forces
from vehicle_roll_sim.vehicle.parameters import Vehicle

COSINE, TRAPEZOID = "one_minus_cosine", "trapezoid"
RAMP_TIME = 0.2
"""s: duration of each ramp of a trapezoid, unless it is given."""
ACROSS = 1
"""Index of the component of the wind across the initial heading."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class WindGust(OpenLoop):
    """Straight ahead at constant speed, with a gust across the initial heading.

    The wind is the same everywhere along the vehicle, as if it entered the gust at once.
    """

    wind_speed: float = parameter(
        "largest speed of the wind, positive if it blows to the left",
        "m/s",
        -MAXIMUM_SPEED,
        MAXIMUM_SPEED,
    )
    shape: str = parameter(
        "shape of the gust over time: W / 2 (1 - cos), or constant between two ramps",
        choices=(COSINE, TRAPEZOID),
        default=COSINE,
    )
    gust_time: float = parameter("duration of the gust", "s", 0.01, LONGEST, default=2.0)
    ramp_time: float | None = parameter(
        "duration of each ramp of a trapezoid",
        "s",
        1e-3,
        LONGEST,
        none=f"{RAMP_TIME:g} if the shape is a trapezoid",
        default=None,
    )
    start: float = parameter("time at which the gust begins", "s", 0.0, LONGEST, default=1.0)

    needs_vehicle = True

    def __post_init__(self):
        super().__post_init__()
        if self.shape == COSINE and self.ramp_time is not None:
            raise InputError("ramp_time", self.ramp_time, f"only with shape {TRAPEZOID}")
        if self.shape == TRAPEZOID and 2 * self.ramp > self.gust_time:
            allowed = f"at most half the gust_time, {self.gust_time / 2:g} s"
            raise InputError("ramp_time", self.ramp, allowed)

    @property
    def ramp(self) -> float:
        """Duration of each ramp of a trapezoid (s)."""
        return RAMP_TIME if self.ramp_time is None else self.ramp_time

    def for_vehicle(self, vehicle: Vehicle, options: Options) -> "WindGust":
        """A copy with the gain of the speed hold; raises InputError without air forces."""
        if not has_air_forces(vehicle):
            allowed = "a vehicle with air forces, such as a side_force_area"
            raise InputError("wind_speed", self.wind_speed, allowed)
        return super().for_vehicle(vehicle, options)

    @property
    def commanded(self) -> tuple[str, ...]:
        return (*super().commanded, "wind")

    @property
    def end(self) -> float:
        """Time (s) at which the gust ends."""
        return self.start + self.gust_time

    def wind(self, times: np.ndarray) -> np.ndarray:
        """Speed of the wind (m/s, to the left) at times (s)."""
        passed = np.clip(times - self.start, 0.0, self.gust_time)
        if self.shape == COSINE:
            return self.wind_speed / 2 * (1.0 - np.cos(2 * np.pi * passed / self.gust_time))
        ramps = np.minimum(passed, self.gust_time - passed) / self.ramp
        return self.wind_speed * np.minimum(ramps, 1.0)

    def drive(self, times: np.ndarray, commands: np.ndarray) -> None:
        commands["wind"][:, ACROSS] = self.wind(times)

    def report(self, history: History, driver: Programme | Feedback) -> dict[str, str]:
        time, rates = history["time"], np.degrees(history["yaw_rate"])
        after = time >= self.end
        deviations = np.interp([self.end, self.end + 1.0], time, history["y"], right=math.nan)
        return {
            "peak yaw rate in the gust": _text(peak(time[~after], rates[~after])[0], "deg/s"),
            "peak yaw rate after it": _text(peak(time[after], rates[after])[0], "deg/s"),
            "deviation at its end": _text(deviations[0], "m"),
            "deviation 1 s later": _text(deviations[1], "m"),
        }


def _text(value: float, unit: str) -> str:
    return "unknown: the run is too short" if math.isnan(value) else f"{value:.3f} {unit}"


WIND_GUST = WindGust(speed=100 / 3.6, wind_speed=20.0, duration=6.0, speed_hold=ADAPTED)
"""100 km/h, 20 m/s from the right for 2 s."""
