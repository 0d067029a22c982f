"""`paper`: all results in a folder and a verdict on each claim, or one line and nothing."""

import contextlib
import dataclasses
import errno
import io
import sys
from pathlib import Path

import pytest
from studies import Rerun
from tqdm import tqdm

from vehicle_roll_sim.analysis.drawing import SteadyLayout
from vehicle_roll_sim.command_line import paper as paper_module
from vehicle_roll_sim.command_line.main import main
from vehicle_roll_sim.paper import figures
from vehicle_roll_sim.paper.claim import FAILS, HOLDS, NOT_CHECKED
from vehicle_roll_sim.paper.report import (
    NO_ENGINE,
    as_markdown,
    as_text,
    check_claims,
    numbers_as_markdown,
    numbers_as_text,
)
from vehicle_roll_sim.paper.study import RUNS, Study

pytestmark = [pytest.mark.unmeasured, pytest.mark.usefixtures("unplaced")]

pytest.importorskip("mujoco", reason="the multibody engine is not installed")

NUMBERS = ("06", "07", "08", "09", "10", "11", "12", "13", "14", "15", "17", "18")
TABLES = ("claims.md", "claims.txt")
ROLL_PLANE = "roll_plane"
SUFFIXES = ("csv", "png")
BEYOND = (ROLL_PLANE, "transient_slip")
"""Figures that are not in the paper."""
RESULTS = {
    *(f"figure_{number}.{suffix}" for number in NUMBERS for suffix in SUFFIXES),
    *(f"{figure}.{suffix}" for figure in BEYOND for suffix in SUFFIXES),
    *TABLES,
}
QUICK = 11
"""The figure with a run that no claim uses."""
QUICK_RESULTS = {
    *(f"{figure}.{suffix}" for figure in (f"figure_{QUICK}", *BEYOND) for suffix in SUFFIXES),
    *TABLES,
}
"""Output of a command that draws only this one of the time-history figures."""
FALSE = {"1a": "1c-i"}
"""A case replaced by another, so that claims fail."""


@dataclasses.dataclass(frozen=True)
class Results:
    """What the command left that reruns and draws everything, and the study that it made."""

    status: int
    out: str
    err: str
    folder: Path
    study: Study


@pytest.fixture(scope="module")
def complete(tmp_path_factory, study) -> Results:
    """The command as a user types it, in an empty folder, with runs that are made already."""
    folder, studies = tmp_path_factory.mktemp("paper"), []

    def keep(vehicle, done) -> Study:
        assert vehicle == study.vehicle
        studies.append(Rerun(study, done=done))
        return studies[-1]

    with pytest.MonkeyPatch.context() as patched, contextlib.chdir(folder):
        patched.setattr(paper_module, "Study", keep)
        patched.setattr(SteadyLayout, "execute", lambda *_: None)  # as `unplaced` does
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = main(["paper", "--out", "results", "--strict"])
    return Results(status, out.getvalue(), err.getvalue(), folder, *studies)


@pytest.fixture(scope="module")
def save_once():
    """save(figure, path): writes what was written under that name before, if anything was."""
    save, written = figures.save_figure, {}

    def save_or_copy(figure, path):
        if path.name in written:
            path.write_bytes(written[path.name])
        else:
            save(figure, path)
            written[path.name] = path.read_bytes()

    return save_or_copy


@pytest.fixture
def paper(command, study, save_once, monkeypatch):
    """Runs `paper` with runs that are made already, and one figure, each of whose files is drawn
    once; with cases taken for others."""

    def call(*words, instead=None):
        monkeypatch.setattr(paper_module, "Study", lambda _, done: Rerun(study, instead, done))
        return command("paper", *words)

    monkeypatch.setattr(figures, "save_figure", save_once)
    monkeypatch.setattr(figures, "FIGURES", [f for f in figures.FIGURES if f.number == QUICK])
    return call


def names(folder: Path) -> set[str]:
    """Names of all files in a folder, including hidden ones."""
    return {entry.name for entry in folder.iterdir()}


def test_it_reruns_everything_and_prints_what_it_writes(complete):
    assert (complete.status, complete.err) == (0, "")
    assert names(complete.folder) == {"results"}
    folder = complete.folder / "results"
    assert names(folder) == RESULTS
    assert all((folder / name).stat().st_size > 1000 for name in RESULTS)
    text = (folder / "claims.txt").read_text(encoding="utf-8")
    assert complete.out == f"{text}\nresults: results\n"
    findings = check_claims(complete.study)
    assert text == f"{as_text(findings)}\n\n{numbers_as_text(complete.study)}\n"
    table = (folder / "claims.md").read_text(encoding="utf-8")
    assert table == f"{as_markdown(findings)}\n\n{numbers_as_markdown(complete.study)}\n"


def test_without_a_folder_the_results_go_to_paper(paper, folder):
    result = paper()
    assert (result.status, result.err) == (0, "")
    assert names(folder) == {"paper"}
    assert names(folder / "paper") == QUICK_RESULTS
    assert result.out.splitlines()[-1] == "results: paper"


@pytest.mark.parametrize(
    ("instead", "engine", "words", "status"),
    [
        (None, True, (), 0),
        (None, True, ("--strict",), 0),
        (FALSE, True, (), 0),
        (FALSE, True, ("--strict",), 1),
        (None, False, (), 0),
        (None, False, ("--strict",), 1),
    ],
)
def test_only_with_strict_the_status_tells_a_claim_that_fails_or_is_not_checked(
    paper, folder, monkeypatch, instead, engine, words, status
):
    if not engine:
        monkeypatch.setitem(sys.modules, "mujoco", None)
    result = paper("--out", "results", *words, instead=instead)
    assert result.status == status
    assert names(folder / "results") == QUICK_RESULTS
    assert result.out.startswith((folder / "results/claims.txt").read_text(encoding="utf-8"))
    verdicts = {line[5:].split("  ")[0] for line in result.out.splitlines() if line[:3].strip()}
    assert (FAILS in verdicts) == bool(instead)
    assert HOLDS in verdicts
    if not engine:
        assert NOT_CHECKED in verdicts
        assert result.err == f"vehicle_roll_sim paper: {NO_ENGINE}; claim 22 is not checked\n"


def test_what_lies_in_the_folder_stays_but_for_older_results(paper, folder):
    results = folder / "results"
    results.mkdir()
    (results / "notes.txt").write_text("mine")
    (results / "claims.txt").write_text("old")
    assert paper("--out", results).status == 0
    assert names(results) == {*QUICK_RESULTS, "notes.txt"}
    assert (results / "notes.txt").read_text() == "mine"
    assert (results / "claims.txt").read_text(encoding="utf-8").startswith("  1  holds")


def test_folders_above_are_made_if_need_be(paper, folder):
    assert paper("--out", "new/results").status == 0
    assert names(folder) == {"new"}
    assert names(folder / "new/results") == QUICK_RESULTS


def test_progress_counts_every_run_and_figure(paper, monkeypatch):
    shown, bars = io.StringIO(), []

    def bar(**about) -> tqdm:
        bars.append(tqdm(**about | {"disable": False, "file": shown}))
        return bars[-1]

    monkeypatch.setattr(paper_module, "tqdm", bar)
    assert paper().status == 0
    assert [(bar.n, bar.total) for bar in bars] == [(len(RUNS) + 1, len(RUNS) + 1)]


FAILURES = {
    KeyboardInterrupt(): ({130}, "interrupted"),
    OSError(errno.ENOSPC, "No space left on device"): ({1}, "No space left on device"),
}
"""Failure, exit status, and words in the message."""
PLACES = (
    "vehicle_roll_sim.paper.study.Study.step",
    "vehicle_roll_sim.paper.figures.save_figure",
    "vehicle_roll_sim.paper.figures.draw_roll_plane",
    "pathlib.Path.write_text",
    "pathlib.Path.replace",
)


def everything(folder: Path) -> dict[Path, str]:
    return {path: path.read_text() if path.is_file() else "" for path in folder.rglob("*")}


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("failure", FAILURES, ids=lambda failure: type(failure).__name__)
def test_what_goes_wrong_half_way_is_one_line_and_leaves_everything_as_it_was(
    paper, folder, monkeypatch, failure, place
):
    def fail(*_args, **_kwargs):
        raise failure

    (folder / "results").mkdir()
    for name in ("claims.txt", "notes.txt"):
        (folder / "results" / name).write_text("old")
    before = everything(folder)
    with monkeypatch.context() as patched:
        patched.setattr("vehicle_roll_sim.arguments._write_no_more", lambda: None)  # of pytest's
        patched.setattr(place, fail)
        result = paper("--out", "results")
    status, words = FAILURES[failure]
    assert result.status in status
    assert result.out == ""
    assert words in result.err
    assert len(result.err.splitlines()) == 1
    assert everything(folder) == before


@pytest.mark.parametrize("name", ["results", "new/results"])
def test_an_error_in_the_program_leaves_no_folder(paper, folder, monkeypatch, name):
    monkeypatch.setattr(figures, "draw_roll_plane", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        paper("--out", name)
    assert not names(folder)


def test_a_folder_in_the_place_of_a_result_is_one_line_and_no_result_appears(paper, folder):
    name = max(QUICK_RESULTS)
    (folder / "results" / name).mkdir(parents=True)
    result = paper("--out", "results")
    assert (result.status, result.out) == (2, "")
    assert name in result.err
    assert len(result.err.splitlines()) == 1
    assert names(folder / "results") == {name}
