"""The table of all runs, for other programs: one row for each, in SI units and radians."""

import dataclasses
import math
from collections.abc import Iterable, Iterator, Sequence

from vehicle_roll_sim.scoring.alarms import Alarm
from vehicle_roll_sim.scoring.braking import Braking
from vehicle_roll_sim.scoring.figures import Cost, Figures
from vehicle_roll_sim.scoring.results import Result, Score

FIGURES = tuple(field.name for field in dataclasses.fields(Figures))
COSTS = {"distance": "distance", "speed": "speed_lost", "energy": "additional_energy"}
ALARMS = {"first": "first_warning", "danger": "danger"}
STOPS = {"distance": "stopping_distance", "yaw": "largest_yaw", "deviation": "course_deviation"}
COLUMNS = (
    *("controller", "test", "variant", "side", "level", "failed", "ending", "end"),
    *FIGURES,
    *COSTS.values(),
    *ALARMS.values(),
    *STOPS.values(),
)
"""Those of costs, alarms and stops are empty where there are none."""
WITHOUT = "without"


def run_rows(scores: Iterable[Score]) -> Iterator[list]:
    """The rows of all runs: without a controller, then with each."""
    scored = [score for score in scores if not score.failure]
    for score in scored[:1]:
        yield from _rows(score, WITHOUT)
    for score in scored:
        yield from _rows(score, score.controller)


def _rows(score: Score, name: str) -> Iterator[list]:
    for climb in score.climbs:
        ladder = climb.ladder
        results = climb.alone if name == WITHOUT else climb.controlled
        for result in results.values():
            yield [name, ladder.test, ladder.variant, ladder.side, *_values(result)]


def _values(result: Result) -> Sequence:
    cost, alarm = result.cost, result.alarm
    return [
        result.level,
        int(result.has_failed),
        result.ending,
        result.end,
        *dataclasses.astuple(result.figures),
        *_fields(cost, Cost, COSTS),
        *_fields(alarm, Alarm, ALARMS),
        *_fields(result.braking, Braking, STOPS),
    ]


def _fields(record, kind: type, names: Iterable[str]) -> list:
    if not isinstance(record, kind):
        return [""] * len(list(names))
    values = [getattr(record, name) for name in names]
    return ["" if math.isnan(value) else value for value in values]
