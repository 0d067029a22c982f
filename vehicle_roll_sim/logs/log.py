"""A log ready to be compared: SI units, axes of ISO 8855, one clock, filtered, at the c.g."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs import conditioning
from vehicle_roll_sim.logs.doubts import doubts_about
from vehicle_roll_sim.logs.map_file import AT_CG, LogMap
from vehicle_roll_sim.logs.quantities import (
    ACCELERATION,
    BODY,
    COMPARED,
    MEASURED,
    QUANTITIES,
    SPEED,
    TIME,
)
from vehicle_roll_sim.logs.raw_log import Channel, RawLog
from vehicle_roll_sim.logs.settings import Conditioning
from vehicle_roll_sim.logs.units import factor
from vehicle_roll_sim.vehicle.plausibility import LARGEST_STEERING, doubtful_steering

LONGEST_LOG = 3600.0
"""s"""
SLOWEST = 0.1
"""s: largest usual interval between rows."""
USUAL_CUTOFF = 10.0
"""Hz"""
HIGHEST_SHARE = 0.4
"""Of the sampling rate: highest cutoff of the filter."""
NEEDED_FOR = {
    "lateral_acceleration": ("yaw_rate", "roll_rate", "pitch_rate"),
    "sideslip_angle": ("yaw_rate", "roll_rate"),
}
"""Rates that the transfer of a quantity from the place of its sensor to the c.g. uses."""


@dataclasses.dataclass(frozen=True)
class Log:
    """Signals of a log. time: of the samples (s), from its first row on, shape (n,), evenly spaced.

    interval: between samples (s). signals: of MEASURED, filtered and at the c.g., (n,) each.
    inputs: speed and commands as they were sampled, times and values. frame: of the lateral
    acceleration. cutoff: of the filter (Hz), 0 for none. notes: what was assumed and corrected.
    doubts: contradictions, one line each.
    """

    time: np.ndarray
    interval: float
    signals: dict[str, np.ndarray]
    inputs: dict[str, Channel]
    frame: str
    cutoff: float
    notes: list[str]
    doubts: list[str]

    @property
    def compared(self) -> list[str]:
        """The measured quantities that are compared, without the speed."""
        return [name for name in COMPARED if name in self.signals]


def log_of(raw: RawLog, log_map: LogMap, conditions: Conditioning) -> Log:
    """Give the columns of a log their meaning; raises InputError naming the quantity."""
    channels, notes = _channels(raw, log_map), list(raw.notes)
    channels = {name: _part(each, conditions, name) for name, each in channels.items()}
    for name, channel in channels.items():
        channels[name], note = conditioning.filled(channel, log_map.columns[name].field)
        notes += [f"{name}: {note}"] if note else []
    measured = {name: each for name, each in channels.items() if name in MEASURED}
    _check_needed(channels, measured)
    time, interval = _grid(measured)
    cutoff = _cutoff(conditions.cutoff, interval)
    signals = {
        name: conditioning.low_pass(conditioning.held(each, time), cutoff, interval)
        for name, each in measured.items()
    }
    if oldest := _oldest(measured, time):
        notes.append(
            f"resampled every {interval:g} s by the last value, at most {oldest:.3g} s old"
        )
    order = 2 * conditioning.ORDER
    text = f"Butterworth, zero phase, order {order}, {cutoff:g} Hz" if cutoff else "none"
    notes.append(f"filter of both sides: {text}")
    notes += _move_to_cg(signals, log_map, interval)
    steering = channels.get("steering") or channels.get("handwheel")
    turned = signals | ({"steering": conditioning.held(steering, time)} if steering else {})
    frame = log_map.columns[ACCELERATION].frame if ACCELERATION in signals else BODY
    inputs = {name: each for name, each in channels.items() if name not in COMPARED}
    doubts = [*_large_steering(channels), *doubts_about(turned, interval)]
    return Log(time, interval, signals, inputs, frame, cutoff, notes, doubts)


def _large_steering(channels: dict[str, Channel]) -> list[str]:
    """A line for each road-wheel angle that is not plausible."""
    largest = {
        name: float(np.abs(channels[name][1]).max())
        for name in ("steering", "rear_steering")
        if name in channels
    }
    return [
        doubtful_steering(f"{name} of the log", angle)
        for name, angle in largest.items()
        if angle > LARGEST_STEERING
    ]


def _channels(raw: RawLog, log_map: LogMap) -> dict[str, Channel]:
    """Times from the first row on (s) and values in SI units of every mapped quantity."""
    field = log_map.columns[TIME].field if TIME in log_map.columns else "columns: time"
    if raw.times and TIME in log_map.columns:
        raise InputError(field, log_map.columns[TIME].name, "nothing: the file has its own times")
    names = [name for name in log_map.columns if name != TIME]
    if raw.times:
        times = {name: raw.times[log_map.columns[name].name] for name in names}
    else:
        if TIME not in log_map.columns:
            raise InputError(field, None, "the column of times")
        times = dict.fromkeys(names, _scaled(raw, log_map, TIME))
    fields = {name: log_map.columns[name].field if raw.times else field for name in names}
    kept = {name: conditioning.checked_times(times[name], fields[name]) for name in names}
    start = min((times[name][0] for name in names), default=0.0)
    return {
        name: (times[name][kept[name]] - start, _scaled(raw, log_map, name)[kept[name]])
        for name in names
    }


def _scaled(raw: RawLog, log_map: LogMap, name: str) -> np.ndarray:
    """The values of a quantity in its SI unit; raises InputError if they are not plausible."""
    column, quantity = log_map.columns[name], QUANTITIES[name]
    unit = raw.units.get(column.name) if column.unit is None else column.unit
    if not unit:
        raise InputError(
            f"{column.field}: unit", None, f"that of the column, such as {quantity.unit}"
        )
    scale = factor(unit, quantity.unit, f"{column.field}: unit") * log_map.sign(name)
    values = raw.columns[column.name] * scale
    if not np.isfinite(values).any() or name == TIME:
        return values
    lowest, largest = float(np.nanmin(values)), float(np.nanmax(np.abs(values)))
    if largest > quantity.largest:
        allowed = f"at most {quantity.largest:.4g} {quantity.unit}: is the unit {unit} right?"
        raise InputError(column.field, "", allowed, f"{largest:.4g} {quantity.unit}")
    if lowest < quantity.lowest:
        allowed = f"at least {quantity.lowest:g}: is the sign right?"
        raise InputError(column.field, "", allowed, f"{lowest:.4g} {quantity.unit}")
    return values


def _part(channel: Channel, conditions: Conditioning, name: str) -> Channel:
    """The samples of the chosen part."""
    time, values = channel
    end = math.inf if conditions.end is None else conditions.end
    inside = (time >= conditions.begin - conditioning.ROUNDING) & (
        time <= end + conditioning.ROUNDING
    )
    if inside.sum() < conditioning.FEWEST:
        problem = f"{inside.sum()} rows of {name} from {conditions.begin:g} s"
        allowed = f"at least {conditioning.FEWEST} rows of the log, {time[0]:g} to {time[-1]:g} s"
        raise InputError("begin" if end == math.inf else "end", "", allowed, problem)
    return time[inside], values[inside]


def _check_needed(channels: dict[str, Channel], measured: dict[str, Channel]) -> None:
    if SPEED not in channels:
        raise InputError("columns: speed", None, "the column of the forward speed")
    if "steering" in channels and "handwheel" in channels:
        raise InputError("columns: handwheel", "", "only one of the two", "together with steering")
    if not {"steering", "handwheel"} & channels.keys():
        raise InputError("columns: steering", None, "the column of steering or handwheel")
    if not set(COMPARED) & measured.keys():
        raise InputError(
            "columns", "", "one or more of " + ", ".join(COMPARED), "nothing to compare"
        )


def _grid(measured: dict[str, Channel]) -> tuple[np.ndarray, float]:
    """Times that all measured channels cover (s), and the interval of the fastest of them."""
    interval = min(conditioning.interval_of(time) for time, _ in measured.values())
    if not interval <= SLOWEST:
        problem = f"a row every {interval:g} s"
        allowed = f"at most {SLOWEST:g} s between rows: is its unit right?"
        raise InputError("columns: time", "", allowed, problem)
    begin = max(time[0] for time, _ in measured.values())
    end = min(time[-1] for time, _ in measured.values())
    count = math.floor((end - begin + conditioning.ROUNDING) / interval) + 1
    if count < conditioning.FEWEST or end - begin > LONGEST_LOG:
        allowed = f"{conditioning.FEWEST} rows to {LONGEST_LOG:g} s that all columns have"
        raise InputError("columns: time", "", allowed, f"{end - begin:g} s")
    return begin + interval * np.arange(count), interval


def _oldest(measured: dict[str, Channel], grid: np.ndarray) -> float:
    """The largest age of a held value (s), 0 if all are of the times of the grid."""
    ages = [grid - conditioning.held((time, time), grid) for time, _ in measured.values()]
    oldest = float(max(age.max() for age in ages))
    return oldest if oldest > conditioning.ROUNDING else 0.0


def _cutoff(wanted: float | None, interval: float) -> float:
    highest = HIGHEST_SHARE / interval
    if wanted is None:
        return min(USUAL_CUTOFF, highest)
    if wanted > highest:
        raise InputError("cutoff", wanted, f"at most {highest:g} Hz for a row every {interval:g} s")
    return wanted


def _move_to_cg(signals: dict[str, np.ndarray], log_map: LogMap, interval: float) -> list[str]:
    """Move what was measured elsewhere to the c.g., in place; returns notes."""
    notes = []
    for name, rates in NEEDED_FOR.items():
        if name not in signals or log_map.columns[name].place == AT_CG:
            continue
        column = log_map.columns[name]
        for rate in rates[:2]:
            if rate not in signals:
                allowed = f"{rate} in the log, or no place"
                raise InputError(f"{column.field}: place", "", allowed, f"no {rate}")
        still = np.zeros(len(signals[name]))
        yaw_rate, roll_rate = signals["yaw_rate"], signals["roll_rate"]
        if name == ACCELERATION:
            turning = (roll_rate, signals.get("pitch_rate", still), yaw_rate)
            moved = conditioning.lateral_acceleration_at_cg(
                signals[name], turning, column.place, interval
            )
        else:
            moved = conditioning.sideslip_at_cg(
                signals[name], signals[SPEED], roll_rate, yaw_rate, column.place
            )
        signals[name] = moved
        missing = [rate for rate in rates if rate not in signals]
        assumed = f", {missing[0]} taken as 0" if missing else ""
        place = ", ".join(f"{each:g}" for each in column.place)
        notes.append(f"{name}: moved from [{place}] m to the c.g.{assumed}")
    return notes
