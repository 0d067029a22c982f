"""The tables of a report, from the results of each controller."""

import math
import statistics
from collections.abc import Iterable, Sequence

from vehicle_roll_sim.scoring.blocks import Table
from vehicle_roll_sim.scoring.catalogue import TESTS, ScoredTest
from vehicle_roll_sim.scoring.figures import Figures
from vehicle_roll_sim.scoring.results import Climb, Result, Score
from vehicle_roll_sim.scoring.spread import NOMINAL, SPREAD

ARROW = " → "
SPLIT = "split_friction"
SUMMARY = (
    *("controller", "limits raised", "unchanged", "lowered", "largest distance"),
    *("most speed lost", "most energy", "largest command"),
)
WARNINGS = ("controller", "lead time, shortest", "median", "false alarms", "missed", "dangers")
BESIDE = (
    *("controller", "limit", "limit over the spread", "compared at", "peak roll"),
    *("peak roll rate", "load transfer ratio", "wheel lift", "distance", "speed lost", "energy"),
)
RESPONSES = (
    *("controller", "yaw response time", "roll overshoot"),
    *("largest roll gain", "at a frequency of"),
)
STOPS = ("controller", "compared at", "stopping distance", "yaw angle", "deviation")
NEGLIGIBLE = 0.5
"""J: less energy than this is rounding."""


def summary_table(scores: Sequence[Score]) -> Table:
    """One row for each controller, over all tests and variants."""
    return Table(SUMMARY, [_summary(score) for score in scores])


def _summary(score: Score) -> list[str]:
    if score.failure:
        return [_code(score.controller), f"not scored: {score.failure}", *[""] * (len(SUMMARY) - 2)]
    pairs = [(climb.limit_alone, climb.limit) for climb in score.climbs]
    raised, lowered = sum(b > a for a, b in pairs), sum(b < a for a, b in pairs)
    costs = [climb.pair[1].cost for climb in score.climbs]
    return [
        _code(score.controller),
        f"{raised} of {len(pairs)}",
        str(len(pairs) - raised - lowered),
        str(lowered),
        f"{max(cost.distance for cost in costs):.1f} m",
        _speed(max(cost.speed for cost in costs)),
        _energy(max(cost.energy for cost in costs)),
        _peaks([run.figures for _, run in score.runs()]),
    ]


def _peaks(figures: Iterable[Figures]) -> str:
    """The largest command on each topic that was used at all."""
    found = list(figures)
    largest = {
        "brake": (max(each.brake_torque for each in found), "{:.0f} N m"),
        "active force": (max(each.active_force for each in found), "{:.0f} N"),
        "rear steering": (
            math.degrees(max(each.rear_steering for each in found)),
            "{:.1f} deg",
        ),
    }
    used = [f"{name} {text.format(value)}" for name, (value, text) in largest.items() if value]
    return ", ".join(used) or "none"


def warning_table(scores: Sequence[Score]) -> Table | None:
    """The warnings, if one of the controllers warns."""
    rows = [_warnings(score) for score in scores if not score.failure and score.alarms]
    return Table(WARNINGS, rows) if rows else None


def _warnings(score: Score) -> list[str]:
    alarms = score.alarms
    leads = alarms.leads
    return [
        _code(score.controller),
        f"{min(leads):.2f} s" if leads else "none",
        f"{statistics.median(leads):.2f} s" if leads else "none",
        f"{alarms.false} of {alarms.runs - alarms.dangers}",
        str(alarms.missed),
        f"{alarms.dangers} of {alarms.runs} runs",
    ]


def table_of_test(name: str, scores: Sequence[Score]) -> Table:
    """One test: the nominal vehicle without and with each controller, on the worse side."""
    return Table(BESIDE, [_beside(TESTS[name], name, each) for each in scores if not each.failure])


def _beside(test: ScoredTest, name: str, score: Score) -> list[str]:
    nominal, every = score.of_test(name, NOMINAL), score.of_test(name)
    shown = max(nominal, key=lambda climb: climb.pair[1].figures.peak_roll)
    alone, found = shown.pair
    cost = found.cost
    return [
        _code(score.controller),
        _limits(nominal, test),
        _limits(every, test),
        level_text(shown.compared, test),
        _pair(alone, found, lambda run: f"{math.degrees(run.figures.peak_roll):.1f}") + " deg",
        _pair(alone, found, lambda run: f"{math.degrees(run.figures.peak_roll_rate):.0f}")
        + " deg/s",
        _pair(alone, found, lambda run: f"{run.figures.load_transfer_ratio:.2f}"),
        _pair(alone, found, lambda run: f"{run.figures.lift_time:.2f}") + " s",
        f"{cost.distance:.1f} m",
        _speed(cost.speed),
        _energy(cost.energy),
    ]


def _pair(alone: Result, found: Result, text) -> str:
    return text(alone) + ARROW + text(found)


def _limits(climbs: Sequence[Climb], test: ScoredTest) -> str:
    """The lowest limits of some climbs, without and with the controller."""
    lowest = (min(each.limit_alone for each in climbs), min(each.limit for each in climbs))
    return ARROW.join(limit_text(each, test) for each in lowest)


def limit_text(limit: float, test: ScoredTest) -> str:
    return "none" if math.isinf(limit) else level_text(limit, test)


def level_text(level: float, test: ScoredTest) -> str:
    return f"{level:g} {test.unit}".rstrip()


def response_table(scores: Sequence[Score]) -> Table | None:
    """The responses of the nominal vehicle to steering to the left, if they were driven."""
    rows = [_responses(score) for score in scores if not score.failure]
    return Table(RESPONSES, rows) if any(any(row[1:]) for row in rows) else None


def _responses(score: Score) -> list[str]:
    pairs = [
        [result.response for result in climb.pair]
        for test in ("step", "frequency")
        for climb in score.of_test(test, NOMINAL)[:1]
    ]
    cells = {
        "delay": (1.0, "{:.3f}", "s"),
        "overshoot": (100.0, "{:.0f}", "%"),
        "gain": (1.0, "{:.2f}", ""),
        "frequency": (1.0, "{:.2f}", "Hz"),
    }
    row = [_code(score.controller)]
    for name, (factor, text, unit) in cells.items():
        found = [[getattr(each, name) for each in pair] for pair in pairs]
        known = [pair for pair in found if not all(map(math.isnan, pair))]
        texts = ["none" if math.isnan(v) else text.format(factor * v) for p in known[:1] for v in p]
        row.append(f"{ARROW.join(texts)} {unit}".strip() if texts else "")
    return row


def braking_table(scores: Sequence[Score]) -> Table | None:
    """How the nominal vehicle stops on split friction, on the side with the larger yaw angle."""
    rows = [_stop(score) for score in scores if not score.failure and score.of_test(SPLIT)]
    return Table(STOPS, rows) if rows else None


def _stop(score: Score) -> list[str]:
    climbs = score.of_test(SPLIT, NOMINAL)
    shown = max(climbs, key=lambda climb: climb.pair[1].braking.yaw)
    alone, found = shown.pair
    return [
        _code(score.controller),
        level_text(shown.compared, TESTS[SPLIT]),
        _pair(alone, found, lambda run: _way(run.braking.distance)),
        _pair(alone, found, lambda run: f"{math.degrees(run.braking.yaw):.1f}") + " deg",
        _pair(alone, found, lambda run: f"{run.braking.deviation:.2f}") + " m",
    ]


def _way(distance: float) -> str:
    return "no stop" if math.isnan(distance) else f"{distance:.1f} m"


def spread_table(name: str, scores: Sequence[Score]) -> Table:
    """One test with each variant, without a controller and with each: the limits.

    If the test has only one level: the largest roll angles.
    """
    scored = [score for score in scores if not score.failure]
    test, rows = TESTS[name], []
    for variant in SPREAD:
        found = [score.of_test(name, variant) for score in scored]
        if not found[0]:
            continue
        if len(found[0][0].ladder.levels) == 1:
            pairs = [[each.pair for each in climbs] for climbs in found]
            runs = [[pair[0] for pair in pairs[0]], *([pair[1] for pair in one] for one in pairs)]
            cells = [_largest_roll(each) for each in runs]
        else:
            alone = min(each.limit_alone for each in found[0])
            limits = [min(each.limit for each in climbs) for climbs in found]
            cells = [limit_text(each, test) for each in (alone, *limits)]
        rows.append([_code(variant), *cells])
    return Table(("variant", "without", *(_code(each.controller) for each in scored)), rows)


def _largest_roll(runs: Iterable[Result]) -> str:
    return f"{math.degrees(max(run.figures.peak_roll for run in runs)):.1f} deg"


def _energy(joules: float) -> str:
    return "none" if joules < NEGLIGIBLE else f"{joules / 1e3:.1f} kJ"


def _speed(speed: float) -> str:
    return f"{round(speed, 1) + 0.0:.1f} m/s"  # without the sign of a negative zero


def _code(text: str) -> str:
    return f"`{text}`"
