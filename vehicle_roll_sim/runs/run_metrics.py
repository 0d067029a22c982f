"""The metrics of one run by name, from its rows and from the events of all its steps."""

import math

import numpy as np

from vehicle_roll_sim.model.integration.events import TIME, VALUE
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import load_transfer_ratio, peak, two_wheel_lift_time

METRIC_UNITS = {
    "peak_roll": "rad",
    "peak_roll_time": "s",
    "peak_lateral_acceleration": "m/s^2",
    "peak_lateral_acceleration_time": "s",
    "peak_load_transfer_ratio": "",
    "peak_load_transfer_ratio_time": "s",
    **{f"lift_off_time_{wheel}": "s" for wheel in WHEELS},
    "two_wheel_lift_time": "s",
    "peak_wheel_lift": "m",
    "peak_wheel_lift_time": "s",
    "rollover_time": "s",
    "end_time": "s",
}
"""Unit of each metric, in the order of `metrics_of`; '' for a ratio."""


def metrics_of(history: History, events: np.record, time: float) -> dict[str, float]:
    """The metrics of a run by name, see `metrics_of_series`, from its rows.

    events: EVENTS record of all integration steps. time: end of the run (s).
    """
    series = (history.wheels("normal_force"), history.wheel_lift())
    return metrics_of_series(history["time"], *series, events, time)


def metrics_of_series(
    times: np.ndarray,
    loads: np.ndarray,
    lifts: np.ndarray,
    events: np.record,
    time: float,
) -> dict[str, float]:
    """The metrics of a run by name, in SI units and radians; times (s) are nan for never.

    times: of the rows (s), shape (n,). loads, lifts: of the wheels (N, m), shape (n, 4). events:
    EVENTS record of all integration steps. time: end of the run (s). Peaks are signed values of the
    largest magnitude. Those of roll and lateral acceleration are taken over all integration steps;
    that of the load transfer ratio (-1 to 1), the largest lift of a wheel and the time of the
    two-wheel lift over the rows. Models without tire compression do not have the last two: nan.
    """
    roll, acceleration = events.peak_roll, events.peak_lateral_acceleration
    ratio, ratio_time = peak(times, load_transfer_ratio(loads))
    lift, lift_time = peak(times, lifts.max(axis=1))
    lift_offs = zip(WHEELS, events.lift_off_time.tolist(), strict=True)
    return {
        "peak_roll": float(roll[VALUE]),
        "peak_roll_time": float(roll[TIME]) if roll[VALUE] else math.nan,
        "peak_lateral_acceleration": float(acceleration[VALUE]),
        "peak_lateral_acceleration_time": (
            float(acceleration[TIME]) if acceleration[VALUE] else math.nan
        ),
        "peak_load_transfer_ratio": ratio,
        "peak_load_transfer_ratio_time": ratio_time,
        **{f"lift_off_time_{wheel}": time for wheel, time in lift_offs},
        "two_wheel_lift_time": two_wheel_lift_time(times, lifts),
        "peak_wheel_lift": lift,
        "peak_wheel_lift_time": lift_time if lift else math.nan,
        "rollover_time": float(events.rollover_time[0]),
        "end_time": time,
    }
