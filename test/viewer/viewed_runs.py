"""Runs to show on pages."""

import functools

import numpy as np

from vehicle_roll_sim import preset, run
from vehicle_roll_sim.offline.run_result import RunResult
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.sampled_events import events_of
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.viewer.recording import ViewedRun
from vehicle_roll_sim.viewer.scene import scene_of

FAST, SLOW = 22.0, 15.0
"""m/s: entry speeds of a fishhook with and without rollover."""


@functools.cache
def fishhook(speed: float = FAST, model: str = "1") -> RunResult:
    return run("nhtsa_fishhook", options=Options(model=model), speed=speed, duration=4.0)


ROAD = Road.from_values(
    {
        "features": [
            {"kind": "patch", "start": -100.0, "friction": 0.0, "right": 1.2},
            {"kind": "wave", "start": 4.0, "length": 12.0, "height": 0.2, "count": 2},
            {"kind": "tilt_table", "angles": [[0.5, 0.0], [1.0, 15.0]]},
        ]
    }
)
"""With everything that a page shows of a road; the ice is to the left of the vehicle."""


@functools.cache
def over_crests() -> RunResult:
    return run("step_steer", amplitude=0.0, speed=10.0, duration=1.6, road=ROAD)


@functools.cache
def scene(model: str = "1") -> dict:
    return scene_of(preset(), Options(model=model))


def viewed(result: RunResult | ViewedRun, label: str = "fishhook", model: str = "1") -> ViewedRun:
    if isinstance(result, ViewedRun):
        return result
    return ViewedRun(result.history, result.events, label, scene(model), result.road)


def of_columns(count: int, **columns) -> History:
    """A history of so many rows, 10 ms apart; columns that are not given are 0."""
    rows = np.zeros((count, len(COLUMNS)))
    rows[:, 0] = np.arange(count) / 100
    for name, values in columns.items():
        rows[:, COLUMNS.index(name)] = values
    return History(rows)


def viewed_history(history: History, label: str = "made up", model: str = "1") -> ViewedRun:
    return ViewedRun(history, events_of(history, 1.4), label, scene(model))
