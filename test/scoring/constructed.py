"""Runs that are put together from numbers, for figures with closed forms."""

import math

import numpy as np

from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.model.integration.events import Condition, no_events
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.runs.columns import COLUMNS, COMMANDS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import peak
from vehicle_roll_sim.scoring.driven import Outcome

INTERVAL = 0.01
"""s between the rows."""


def history(seconds: float, commands: dict | None = None, **columns) -> History:
    """A history with these columns; others are 0, normal loads 4000 N.

    A value is a number or an array over the rows; that of a quantity of wheels is for all of them.
    """
    time = np.arange(round(seconds / INTERVAL) + 1) * INTERVAL
    rows, others = np.zeros((len(time), len(COLUMNS))), np.zeros((len(time), len(COMMANDS)))
    rows[:, 0] = time
    _fill(rows, COLUMNS, {"normal_force": 4000.0, **columns})
    _fill(others, COMMANDS, commands or {})
    return History(rows, others)


def _fill(rows: np.ndarray, names: tuple[str, ...], values: dict) -> None:
    for name, value in values.items():
        for each in [name] if name in names else [f"{name}_{wheel}" for wheel in WHEELS]:
            rows[:, names.index(each)] = value


def outcome(
    driven: History,
    condition: Condition = Condition.RUNNING,
    warned_at: float = math.inf,
    has_failed: bool = False,
) -> Outcome:
    """An outcome with this history; warned_at: the time (s) from which on it is warned."""
    events = no_events()
    events["peak_roll"] = peak(driven["time"], driven["roll"])
    warned = driven["time"] >= warned_at
    return Outcome(STANDARD["j_turn"], driven, events[0], condition, warned, has_failed)
