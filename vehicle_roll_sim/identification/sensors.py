"""Sensors as they are: scale, bias and delay of each quantity, and the offset of the steering.

measured(t) = scale * true(t - delay) + bias. One sensor serves in all logs.
"""

import dataclasses
from collections.abc import Mapping

import numpy as np

from vehicle_roll_sim.identification.free_value import Free
from vehicle_roll_sim.logs.conditioning import low_pass
from vehicle_roll_sim.logs.log import Log
from vehicle_roll_sim.logs.quantities import QUANTITIES, SPEED
from vehicle_roll_sim.logs.raw_log import Channel

BIAS, DELAY, SCALE = KINDS = ("bias", "delay", "scale")
LATEST = 0.5
"""s: bound of a delay to both sides; negative if the steering of the log is late."""
LARGEST_OFFSET = 1.0
"""rad: bound of the offset of the steering."""
COMMANDS = ("steering", "handwheel")
SMOOTHED = 0.5
"""s: over which the speed is smoothed."""


@dataclasses.dataclass(frozen=True)
class SensorValue:
    """Declaration of one value of a sensor. unit: '' for that of the quantity."""

    name: str
    start: float
    bounds: tuple[float, float]
    scale: float
    unit: str
    about: str

    def free(self, quantity: str) -> Free:
        """The value of the sensor of a quantity, as one to be identified; '' for OFFSET."""
        lower, upper, scale, unit = *self.bounds, self.scale, self.unit
        if self.name == BIAS:
            largest = QUANTITIES[quantity].largest
            lower, upper, scale = -largest, largest, QUANTITIES[quantity].least
            unit = QUANTITIES[quantity].unit
        name = sensor_name(quantity, self.name) if quantity else self.name
        about = self.about.format(quantity)
        return Free(name, self.start, lower, upper, scale, unit, about, is_reading=bool(quantity))


OFFSET = SensorValue(
    "steering_offset",
    0.0,
    (-LARGEST_OFFSET, LARGEST_OFFSET),
    0.1,
    "rad",
    "to be added to the steering or handwheel angle of the logs",
)
SENSOR_VALUES = {
    each.name: each
    for each in (
        SensorValue(BIAS, 0.0, (0.0, 0.0), 1.0, "", "what the sensor of {} reads at 0"),
        SensorValue(DELAY, 0.0, (-LATEST, LATEST), 0.1, "s", "how late the sensor of {} is"),
        SensorValue(SCALE, 1.0, (0.1, 10.0), 1.0, "", "reading of the sensor of {} over the truth"),
    )
}


def sensor_name(quantity: str, kind: str) -> str:
    """The name of a value of a sensor, such as `yaw_rate_bias`."""
    return f"{quantity}_{kind}"


def smooth(time: np.ndarray, speed: np.ndarray) -> Channel:
    """A speed (m/s) smoothed by parabolas over SMOOTHED, also at its ends.

    The model starts with the first value and rolls on with it, so that its noise would be felt to
    the end of the log.
    """
    from scipy.signal import savgol_filter  # scipy takes 0.25 s to import

    width = 2 * int(0.5 * SMOOTHED / float(np.median(np.diff(time)))) + 1
    return time, savgol_filter(speed, width, 2) if 3 < width <= len(speed) else speed


@dataclasses.dataclass(frozen=True)
class Sensors:
    """Values of sensors by name; those not given are those of a perfect sensor."""

    values: Mapping[str, float]

    def of(self, quantity: str, kind: str) -> float:
        """One value of the sensor of a quantity."""
        return self.values.get(sensor_name(quantity, kind), SENSOR_VALUES[kind].start)

    def driving(self, log: Log) -> Log:
        """The log with the steering as it was, and a smooth speed."""
        offset = self.values.get(OFFSET.name, 0.0)
        inputs = {
            name: (time, values + offset) if name in COMMANDS else (time, values)
            for name, (time, values) in log.inputs.items()
        }
        inputs[SPEED] = smooth(*inputs[SPEED])
        return dataclasses.replace(log, inputs=inputs)

    def reading(self, quantity: str, true: np.ndarray, log: Log) -> np.ndarray:
        """What the log has of a true signal, filtered; (n,) at its times."""
        delay = self.of(quantity, DELAY)
        if delay:
            from scipy.interpolate import CubicSpline  # scipy takes 0.25 s to import

            at = np.clip(log.time - delay, log.time[0], log.time[-1])
            true = CubicSpline(log.time, true)(at)
        filtered = low_pass(true, log.cutoff, log.interval)
        return self.of(quantity, SCALE) * filtered + self.of(quantity, BIAS)

    def corrected(self, log: Log) -> Log:
        """The log as perfect sensors would have measured it; the ends of late signals are held."""
        signals = dict(log.signals)
        for name in log.compared:
            delay = self.of(name, DELAY)
            values = (signals[name] - self.of(name, BIAS)) / self.of(name, SCALE)
            signals[name] = np.interp(log.time + delay, log.time, values) if delay else values
        return dataclasses.replace(self.driving(log), signals=signals)
