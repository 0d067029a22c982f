"""A run as the page gets it: columns of numbers, curves of the plots, events and vehicle."""

import dataclasses
import math
from collections.abc import Iterable, Sequence

import numpy as np

from vehicle_roll_sim.analysis.panels import LOAD_TRANSFER, Signal, signals_of
from vehicle_roll_sim.model.integration.events import TIME, VALUE
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.runs.columns import ROLL_CENTRES
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.viewer.decimation import MOST_ROWS, kept_rows
from vehicle_roll_sim.viewer.packing import packed
from vehicle_roll_sim.viewer.road import under

MOTION = ("x", "y", "z", "roll", "pitch", "yaw", "u", "roll_rate", "lateral_acceleration")
OF_WHEELS = (
    *("suspension_compression", "tire_compression"),
    *("normal_force", "longitudinal_force", "lateral_force"),
)
"""Columns of a history from which the vehicle is drawn."""
LEAST_SPAN = 0.1
"""Smallest range of a vertical axis, in its unit."""
KILO = 1e3


@dataclasses.dataclass(frozen=True)
class ViewedRun:
    """A run to show: its history, EVENTS record, label, vehicle (`scene_of`), and road."""

    history: History
    events: np.record
    label: str
    scene: dict
    road: Road | None = None


def panels_of(
    runs: Sequence[ViewedRun], anyway: Iterable[Signal] = ()
) -> tuple[list[dict], list[Signal]]:
    """The panels of the page, and the signals of those before the normal loads of the wheels.

    anyway: as for `signals_of`. wheel: index of the wheel whose load a panel shows, or None.
    limits: of a fixed axis, or None.
    """
    signals = signals_of((run.history for run in runs), anyway)
    panels = [_panel(signal.label) for signal in signals]
    panels[signals.index(LOAD_TRANSFER)] |= {"limits": [-1.05, 1.05], "digits": 3}
    loads = [_panel(f"normal load {name} (kN)", place) for place, name in enumerate(WHEELS)]
    return panels + loads, signals


def _panel(label: str, wheel: int | None = None) -> dict:
    title = " ".join(label.split())
    return {"title": title, "wheel": wheel, "limits": None, "span": LEAST_SPAN, "digits": 2}


def recording(
    run: ViewedRun, signals: Sequence[Signal], most: int = MOST_ROWS, are_apart: bool = False
) -> dict:
    """The data of a run for the page.

    signals: of its panels. most: as for `kept_rows`. are_apart: whether each wheel has a curve of
    its own even if all have the same command.
    """
    history, curves = run.history, []
    columns = _motion(history) | under(history, run.road, run.scene)
    for place, signal in enumerate(signals):
        lines = _lines(signal, history, are_apart)
        names = [f"panel_{place}_{k}" for k in range(len(lines))]
        columns |= dict(zip(names, lines.values(), strict=True))
        curves.append([{"column": c, "name": n} for c, n in zip(names, lines, strict=True)])
    for quantity, load in _of_wheels("load", history.wheels("normal_force") / KILO).items():
        columns[quantity] = load
        curves.append([{"column": quantity, "name": ""}])
    events = events_in(run)
    plotted = [columns[line["column"]] for lines in curves for line in lines]
    rows = kept_rows(history, plotted, [each["time"] for each in events], most)
    values = np.array([values[rows] for values in columns.values()])
    return {
        "label": run.label,
        "vehicle": run.scene,
        "time": packed(history["time"][rows], "<f8"),
        "columns": list(columns),
        "values": packed(values, "<f4"),
        "curves": curves,
        "events": events,
        "rollover": _known(run.events.rollover_time[0]),
        "is_thinned": len(rows) < len(history.rows),
    }


def _motion(history: History) -> dict[str, np.ndarray]:
    """The columns from which the vehicle is drawn."""
    columns = {name: history[name] for name in (*MOTION, "steering")}
    for quantity in OF_WHEELS:
        columns |= _of_wheels(quantity, history.wheels(quantity))
    columns |= _of_wheels("wheel_angle", _spin_angles(history))
    if history.commands is not None:
        columns["rear_steering"] = history.command("rear_steering")
    if history.roll_centres is not None:
        columns |= dict(zip(ROLL_CENTRES, history.roll_centres.T, strict=True))
    return columns


def _of_wheels(quantity: str, values: np.ndarray) -> dict[str, np.ndarray]:
    return {f"{quantity}_{wheel}": of for wheel, of in zip(WHEELS, values.T, strict=True)}


def _spin_angles(history: History) -> np.ndarray:
    """Angles of the wheels from their speeds by the trapezoidal rule, shape (n, 4) (rad)."""
    speeds = np.nan_to_num(history.wheels("wheel_speed"))
    steps = np.diff(history["time"])[:, np.newaxis] * (speeds[1:] + speeds[:-1]) / 2
    return np.concatenate((np.zeros((1, len(WHEELS))), np.cumsum(steps, axis=0)))


def _lines(signal: Signal, history: History, are_apart: bool) -> dict[str, np.ndarray]:
    """The curves of a panel by name; wheels with the same command share one, as in the figure."""
    values = signal.of(history)
    if signal.is_of_axles:
        return dict(zip(("front", "rear"), values.T, strict=True))
    if not signal.is_command or values.ndim == 1:
        return {"": values}
    if are_apart:
        return dict(zip(WHEELS, values.T, strict=True))
    groups: dict[bytes, list[int]] = {}
    for wheel in range(len(WHEELS)):
        groups.setdefault(values[:, wheel].tobytes(), []).append(wheel)
    names = [" ".join(WHEELS[wheel] for wheel in wheels) for wheels in groups.values()]
    names = [""] if len(names) == 1 else names
    return {n: values[:, w[0]] for n, w in zip(names, groups.values(), strict=True)}


def events_in(run: ViewedRun) -> list[dict]:
    """Lift-offs, rollover and peaks of a run, in order of time."""
    events, found = run.events, []
    for wheel, time in zip(WHEELS, events.lift_off_time.tolist(), strict=True):
        found.append((time, f"{wheel} lifts off", True))
    found.append((float(events.rollover_time[0]), "rollover", True))
    roll, acceleration = events.peak_roll, events.peak_lateral_acceleration
    if roll[VALUE]:
        found.append((float(roll[TIME]), f"peak roll {math.degrees(roll[VALUE]):.1f} deg", False))
    if acceleration[VALUE]:
        name = f"peak lateral acceleration {acceleration[VALUE]:.2f} m/s²"
        found.append((float(acceleration[TIME]), name, False))
    begin, end = run.history["time"][[0, -1]]
    shown = [event for event in found if begin <= event[0] <= end]
    return [dict(zip(("time", "name", "isSevere"), each, strict=True)) for each in sorted(shown)]


def _known(value: float) -> float | None:
    return None if math.isnan(value) else float(value)
