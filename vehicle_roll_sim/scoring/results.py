"""The results of a score: runs side by side, limits of ladders, and the worst run."""

import dataclasses
import math
from collections.abc import Iterable, Iterator, Mapping

from vehicle_roll_sim.scoring.alarms import Alarm, Alarms, alarm_of
from vehicle_roll_sim.scoring.braking import Braking, braking_of
from vehicle_roll_sim.scoring.driven import Driven, Outcome
from vehicle_roll_sim.scoring.figures import Cost, Figures, cost_of, figures_of
from vehicle_roll_sim.scoring.plan import Ladder
from vehicle_roll_sim.scoring.responses import Response, response_of


@dataclasses.dataclass(frozen=True)
class Result:
    """What is kept of one run. Without a controller there is neither cost nor alarm."""

    level: float
    has_failed: bool
    ending: str
    end: float
    figures: Figures
    response: Response
    braking: Braking = Braking()  # noqa: RUF009 - it cannot be changed
    cost: Cost | None = None
    alarm: Alarm | None = None
    notes: tuple[str, ...] = ()


def result_alone(level: float, outcome: Outcome) -> Result:
    """The result of a run without a controller."""
    return Result(
        level,
        outcome.has_failed,
        outcome.ending,
        float(outcome.history["time"][-1]),
        figures_of(outcome),
        response_of(outcome),
        braking_of(outcome.manoeuvre, outcome.history),
    )


def result_controlled(level: float, alone: Outcome, found: Outcome, driven: Driven) -> Result:
    """The result of a run with a controller, compared with the one without it."""
    alarm = alarm_of(alone, found) if len(found.warned) else None
    return dataclasses.replace(
        result_alone(level, found), cost=cost_of(alone, found), alarm=alarm, notes=driven.notes
    )


@dataclasses.dataclass(frozen=True)
class Climb:
    """The runs of a ladder: without the controller at all levels, with it up to the first failure.

    Both by level, rising.
    """

    ladder: Ladder
    alone: Mapping[float, Result]
    controlled: Mapping[float, Result]

    @property
    def limit_alone(self) -> float:
        """Level of the first failure without the controller, inf if there is none."""
        return _first_failure(self.alone.values())

    @property
    def limit(self) -> float:
        """Level of the first failure with the controller, inf if there is none."""
        return _first_failure(self.controlled.values())

    @property
    def compared(self) -> float:
        """The level at which both are compared: the lower limit, or the highest level."""
        return min(self.limit_alone, self.limit, max(self.alone))

    @property
    def pair(self) -> tuple[Result, Result]:
        """The results there, without and with the controller."""
        return self.alone[self.compared], self.controlled[self.compared]


def _first_failure(results: Iterable[Result]) -> float:
    return next((each.level for each in results if each.has_failed), math.inf)


@dataclasses.dataclass(frozen=True)
class Score:
    """The results of one controller. failure: why it was not scored, in one line, or ''."""

    controller: str
    climbs: tuple[Climb, ...]
    failure: str = ""

    def of_test(self, test: str, variant: str | None = None) -> list[Climb]:
        """The climbs of a test, with all variants or one."""
        return [
            each
            for each in self.climbs
            if each.ladder.test == test and variant in (None, each.ladder.variant)
        ]

    def runs(self) -> Iterator[tuple[Climb, Result]]:
        """Every run with the controller."""
        for climb in self.climbs:
            for result in climb.controlled.values():
                yield climb, result

    @property
    def alarms(self) -> Alarms | None:
        """The warnings of all runs, None if the controller does not warn."""
        alarms = [run.alarm for _, run in self.runs() if run.alarm]
        return Alarms.of(alarms) if alarms else None

    @property
    def notes(self) -> list[str]:
        """What happened to its commands in some run, with the number of these runs."""
        found: dict[str, int] = {}
        for _, run in self.runs():
            for note in run.notes:
                found[note] = found.get(note, 0) + 1
        return [f"{note} ({count} runs)" for note, count in found.items()]

    @property
    def worst(self) -> tuple[Ladder, float]:
        """The run with the largest roll angle; of those that roll over, the one that is over first.

        As its ladder and level.
        """

        def badness(found: tuple[Climb, Result]) -> tuple[float, float]:
            _, run = found
            return (round(run.figures.peak_roll, ROUNDED), -run.end)

        climb, run = max(self.runs(), key=badness)
        return climb.ladder, run.level


ROUNDED = 2
"""Digits of a roll angle (rad): all runs that end in a rollover end at about the same angle."""
