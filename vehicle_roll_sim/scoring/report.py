"""The report of a score: tables, figures, worst runs, and under which conditions it was made."""

import dataclasses
import re
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path

from vehicle_roll_sim.analysis.drawing import save_figure
from vehicle_roll_sim.analysis.plots import DrawnRun, standard_figure
from vehicle_roll_sim.bags.run_bag import run_bag
from vehicle_roll_sim.files.output_file import filled_folder
from vehicle_roll_sim.files.table_file import write_rows
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.scoring import blocks as made_of
from vehicle_roll_sim.scoring import tables
from vehicle_roll_sim.scoring.catalogue import TESTS
from vehicle_roll_sim.scoring.driven import Driven, Outcome, drive_again, drive_alone
from vehicle_roll_sim.scoring.limit_figure import write_limit_figure
from vehicle_roll_sim.scoring.plan import Ladder, Setup
from vehicle_roll_sim.scoring.results import Score
from vehicle_roll_sim.scoring.run_table import COLUMNS, run_rows
from vehicle_roll_sim.scoring.spread import SPREAD
from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.viewer.page import write_page
from vehicle_roll_sim.viewer.recording import ViewedRun
from vehicle_roll_sim.viewer.scene import scene_of

TITLE = "Scores of controllers"
WITHOUT = "without"
PAGE, TEXT, RUNS, LIMITS = "report.html", "report.md", "runs.csv", "limits.svg"
"""Files of a report."""


@dataclasses.dataclass(frozen=True)
class Worst:
    """The worst run of a controller, without and with it."""

    ladder: Ladder
    level: float
    alone: Outcome
    found: Outcome
    driven: Driven

    @property
    def name(self) -> str:
        return self.ladder.name(self.level)


@dataclasses.dataclass(frozen=True)
class Report:
    """A score as it is reported.

    commands: of each controller, as it was started. versions: by what has them. is_quick: size.
    """

    setup: Setup
    scores: Sequence[Score]
    commands: Mapping[str, str]
    versions: Mapping[str, str]
    worst: Mapping[str, Worst]
    is_quick: bool

    @property
    def scored(self) -> list[Score]:
        return [score for score in self.scores if not score.failure]

    @property
    def tests(self) -> list[str]:
        """The tests that were driven, in order."""
        driven = {climb.ladder.test for score in self.scored for climb in score.climbs}
        return [name for name in TESTS if name in driven]


def slug(name: str) -> str:
    """The name of a controller as part of a file name."""
    return re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_") or "controller"


def write_report(report: Report, folder: Path) -> None:
    """Write all files of a report to a folder; each is complete or not there."""
    for name, worst in report.worst.items():
        _write_bag(report, worst, folder / f"worst_{slug(name)}")
    with filled_folder(folder) as partial:
        write_rows(partial / RUNS, COLUMNS, run_rows(report.scores))
        if report.scored:
            write_limit_figure(partial / LIMITS, report.tests, report.scored)
        for name, worst in report.worst.items():
            _write_worst(report, name, worst, partial)
        content = list(blocks_of(report))
        text = made_of.as_markdown(TITLE, content)
        (partial / TEXT).write_text(text, encoding="utf-8")
        page = made_of.as_page(TITLE, content, partial)
        (partial / PAGE).write_text(page, encoding="utf-8")


def _write_worst(report: Report, name: str, worst: Worst, folder: Path) -> None:
    """The figure of the worst run of a controller over the one without it, and their page."""
    labels = (name, WITHOUT)
    pairs = list(zip((worst.found, worst.alone), labels, strict=True))
    road = report.setup.road
    drawn = [DrawnRun(each.history, each.events, label, road) for each, label in reversed(pairs)]
    title = f"{name}: {worst.name}"
    save_figure(standard_figure(drawn, title), folder / f"worst_{slug(name)}.svg")
    scene = scene_of(report.setup.variant(worst.ladder.variant), report.setup.options)
    viewed = [ViewedRun(each.history, each.events, label, scene, road) for each, label in pairs]
    cones = getattr(worst.found.manoeuvre, "cones", ())
    write_page(folder / f"worst_{slug(name)}.html", viewed, title, cones)


def _write_bag(report: Report, worst: Worst, folder: Path) -> None:
    """The bag of the worst run, as a recording of the node; an earlier one is replaced."""
    if folder.exists():
        shutil.rmtree(folder)
    simulation = worst.ladder.simulation(report.setup)
    period = round(report.setup.period * NANOSECONDS)
    fields = [field.name for field in dataclasses.fields(Command)]
    with run_bag(simulation, fields, folder, period, "--out") as observer:
        drive_again(
            worst.ladder, worst.level, report.setup, worst.driven, simulation, observer=observer
        )


def worst_of(ladder: Ladder, level: float, setup: Setup, driven: Driven) -> Worst:
    """The worst run of a controller, driven again. driven: its commands."""
    alone, found = drive_alone(ladder, level, setup), drive_again(ladder, level, setup, driven)
    return Worst(ladder, level, alone, found, driven)


def blocks_of(report: Report):
    """The blocks of a report."""
    size, sides = ("quick", "to the left")
    if not report.is_quick:
        size, sides = "full", "to the left and to the right"
    yield made_of.Text(
        f"Each test is driven without and with each controller, in lockstep, {sides}, with each "
        "variant of the vehicle, at rising levels up to the first failure with the controller "
        f"({size} size). In 35 mph → none the first value is without, the second with the "
        "controller; none: no failure up to the highest level. A run ends with a rollover."
    )
    yield made_of.Heading("Summary")
    yield tables.summary_table(report.scores)
    if report.scored:
        yield from _of_results(report)
    yield from _of_conditions(report)


def _of_results(report: Report):
    if warnings := tables.warning_table(report.scores):
        yield made_of.Heading("Warnings")
        yield warnings
        yield made_of.Text(LEGEND_OF_WARNINGS)
    yield made_of.Heading("Limits")
    yield made_of.Figure(LIMITS, "The level of the first failure in each test, over the spread")
    yield made_of.Text(LEGEND_OF_TESTS)
    for name in report.tests:
        yield made_of.Heading(TESTS[name].title)
        yield made_of.Text(f"The limit is the {TESTS[name].limit}.")
        yield tables.table_of_test(name, report.scores)
        yield tables.spread_table(name, report.scores)
    if braking := tables.braking_table(report.scores):
        yield made_of.Heading("Stops on split friction")
        yield braking
        yield made_of.Text(LEGEND_OF_BRAKING)
    if responses := tables.response_table(report.scores):
        yield made_of.Heading("Responses to steering")
        yield responses
    yield made_of.Heading("Worst runs")
    for name, worst in report.worst.items():
        yield from _of_worst(name, worst)


def _of_worst(name: str, worst: Worst):
    file = f"worst_{slug(name)}"
    yield made_of.Heading(f"`{name}`: {worst.name}", 3)
    yield made_of.Figure(f"{file}.svg", f"{name} over the vehicle without it in {worst.name}")
    yield made_of.Links(
        [
            ("both vehicles in the viewer", f"{file}.html"),
            ("bag of the run with the controller", f"{file}/metadata.yaml"),
        ]
    )


LEGEND_OF_TESTS = (
    "The first table of each test has the figures of the nominal vehicle, on the side with the "
    "larger roll angle, at the level compared: the lower limit, or the highest level if there is "
    "none. The second table has the limits of all variants or, for a test with one level, the "
    "largest roll angles."
)
LEGEND_OF_BRAKING = (
    "Nominal vehicle, at the level compared. Yaw angle and deviation from the course are the "
    "largest values up to the stop."
)
LEGEND_OF_WARNINGS = (
    "A danger is a two-wheel lift, rollover or stop, in the run itself or without the controller. "
    "A false alarm is a warning without danger. A danger is missed if there was no warning before "
    "it. The lead time is from the first warning to the danger."
)


def _of_conditions(report: Report):
    yield made_of.Heading("Conditions")
    yield made_of.Table(
        ("controller", "started as"),
        [[f"`{name}`", f"`{command}`"] for name, command in report.commands.items()],
    )
    notes = [f"`{score.controller}`: {note}" for score in report.scored for note in score.notes]
    if notes:
        yield made_of.Points(notes)
    variants = {climb.ladder.variant for score in report.scored for climb in score.climbs}
    yield made_of.Table(
        ("variant", "vehicle", "changes"),
        [[f"`{n}`", v.title, v.changes] for n, v in SPREAD.items() if n in variants],
    )
    yield made_of.Table(
        ("test", "levels"),
        [[TESTS[name].title, _levels(report, name)] for name in report.tests],
    )
    yield made_of.Points([f"{what}: {version}" for what, version in report.versions.items()])
    yield made_of.Text(
        "No run depends on a clock. Random numbers are drawn only by sensors with noise, from the "
        "seeds among the parameters of the vehicle; the variants above name every change."
    )


def _levels(report: Report, name: str) -> str:
    levels = report.scored[0].of_test(name)[0].ladder.levels
    return ", ".join(f"{level:g}" for level in levels) + f" {TESTS[name].unit}".rstrip()
