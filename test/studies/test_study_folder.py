"""The folder of a study: every run once, the same bytes however often it was interrupted."""

import csv
import dataclasses
import json
import multiprocessing
import os
import random
import signal

import pytest
from formula_runs import formula
from patience import PATIENCE
from scipy import stats

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.studies import chunks, store
from vehicle_roll_sim.studies.folder import run_study, show_study

KILLS, INTERRUPTED = 10, 130
STOPS = (signal.SIGKILL, -signal.SIGKILL), (signal.SIGINT, INTERRUPTED)
"""Signals, and the status with which a process then ends."""
SEARCH = {
    "factors": {"vehicle.cg_height": [0.5, 0.6, 0.7]},
    "search": {
        "factor": "manoeuvre.speed",
        "event": "rollover",
        "lowest": 10,
        "highest": 40,
        "resolution": 0.2,
    },
}
RARE = {
    "factors": {"vehicle.cg_height": {"distribution": "normal", "mean": 0.5, "sd": 0.05}},
    "seed": 2,
    "chunk": 20,
    "events": {"high": {"metric": "peak_roll", "above": 0.27}},
    "rare": {"event": "high", "level_runs": 100},
}
DRAWN = {
    "grid": {"map_rollover", "map_two_wheel_lift", "map_peak_roll"},
    "search": {"curve_thresholds"},
    "rare": set(),
}
"""Figures by kind of study."""


def content(folder) -> dict[str, bytes]:
    """All files of a folder by name."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def run_until_stopped(study, folder, moments: int, stop: signal.Signals) -> None:
    """Run a study in this process, which stops itself at one of its steps on the way to disk."""

    def counted(function):
        def call(*arguments, **options):
            nonlocal moments
            moments -= 1
            if not moments:
                os.kill(os.getpid(), stop)
            return function(*arguments, **options)

        return call

    chunks.evaluate = counted(formula)
    store.os.fsync = counted(os.fsync)
    store.os.close = counted(os.close)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        run_study(study, folder, "csv")
    except KeyboardInterrupt:
        os._exit(INTERRUPTED)


@pytest.mark.parametrize("changes", [{}, SEARCH], ids=["grid", "search"])
def test_killed_ten_times_it_gives_the_same_bytes(study, tmp_path, by_formula, changes):
    """By SIGKILL and, every other time, by Ctrl-C."""
    given = study(chunk=1, **changes)
    run_study(given, tmp_path / "undisturbed", "csv")
    chance, processes = random.Random(1), multiprocessing.get_context("fork")
    killed = 0
    while killed < KILLS:
        stop, status = STOPS[killed % 2]
        arguments = (given, tmp_path / "killed", chance.randint(1, 6), stop)
        process = processes.Process(target=run_until_stopped, args=arguments)
        process.start()
        process.join(PATIENCE)
        assert process.exitcode == status, "it was over before it was killed ten times"
        killed += 1
    run_study(given, tmp_path / "killed", "csv")
    assert content(tmp_path / "killed") == content(tmp_path / "undisturbed")


@pytest.mark.parametrize("changes", [{}, SEARCH, RARE], ids=["grid", "search", "rare"])
def test_no_run_is_computed_twice(study, tmp_path, by_formula, changes):
    given = study(**{"chunk": 2, **changes})

    def stop(runs, kept):
        if len(by_formula) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_study(given, tmp_path, "csv", progress=stop)
    done = sum(by_formula)
    report = run_study(given, tmp_path, "csv")
    assert 0 < done < sum(by_formula) == len(report.results.runs)
    run_study(given, tmp_path, "csv")
    assert sum(by_formula) == len(report.results.runs)


def test_a_failed_run_is_a_row_with_its_reason(study, tmp_path, by_formula):
    bank = {"distribution": "normal", "mean": 0.9, "sd": 0.2}
    factors = {"vehicle.cg_height": [0.5, 0.8], "road.bank": bank}
    run_study(study(factors=factors, design="random", runs=3, seed=1), tmp_path, "csv")
    with (tmp_path / "runs.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        is_refused, is_high = float(row["road.bank"]) > 1.0, row["vehicle.cg_height"] == "0.8"
        expected = "refused" if is_refused else "diverged" if is_high else "complete"
        assert row["condition"] == expected
        assert (row["peak_roll"] == "") == (row["condition"] != "complete")
    reasons = {row["condition"]: row["reason"] for row in rows}
    assert reasons["complete"] == ""
    assert reasons["diverged"] == "diverged at 1.000 s: u"
    assert reasons["refused"].startswith("refused: bank: 1.")
    failed = sum(row["condition"] != "complete" for row in rows)
    assert f"## Runs that failed: {failed}" in (tmp_path / "summary.md").read_text(encoding="utf-8")


def test_the_summary_has_in_words_what_no_number_stands_for(study, tmp_path, by_formula):
    report = run_study(study(fixed={"manoeuvre.speed_hold": None}), tmp_path, "csv")
    assert "- fixed: manoeuvre.speed_hold = adapted to the vehicle" in report.summary


def test_parquet_and_csv_have_the_same_rows_and_the_types_that_they_need(
    study, tmp_path, by_formula
):
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    run_study(study(), tmp_path, "csv")
    run_study(study(), tmp_path, "parquet")
    table = parquet.read_table(tmp_path / "runs.parquet")
    with (tmp_path / "runs.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == table.column_names
    texts = [["" if v is None else str(v) for v in row.values()] for row in table.to_pylist()]
    assert texts == rows
    types = {field.name: str(field.type) for field in table.schema}
    assert (types["run"], types["condition"], types["peak_roll"]) == ("int64", "string", "double")
    assert table.schema.field("peak_roll").metadata == {b"unit": b"rad"}


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({"manoeuvre": "step_steer"}, "another value of manoeuvre"),
        ({"chunk": 6}, "another value of chunk"),
        ({"vehicle": "suv"}, "the results of another vehicle"),
    ],
)
def test_another_study_or_vehicle_is_refused_and_not_mixed(
    study, tmp_path, by_formula, changes, problem
):
    run_study(study(), tmp_path, "csv")
    before = content(tmp_path)
    with pytest.raises(InputError, match=problem):
        run_study(study(**changes), tmp_path, "csv")
    assert content(tmp_path) == before


def test_a_vehicle_file_that_was_changed_is_another_vehicle(study, tmp_path, by_formula):
    given = study()
    run_study(given, tmp_path, "csv")
    heavier = dataclasses.replace(given, vehicle=given.vehicle.with_values({"drag_area": 0.7}))
    with pytest.raises(InputError, match="the results of another vehicle"):
        run_study(heavier, tmp_path, "csv")


def test_a_road_file_that_was_changed_is_another_study(study, tmp_path, by_formula, monkeypatch):
    monkeypatch.chdir(tmp_path)
    ramp = "features: [{{kind: ramp, start: 5, length: 4, height: {}}}]"
    (tmp_path / "road.yaml").write_text(ramp.format(0.2))
    run_study(study(road="road.yaml"), tmp_path / "study", "csv")
    (tmp_path / "road.yaml").write_text(ramp.format(0.3))
    with pytest.raises(InputError, match="a study with another value of road"):
        run_study(study(road="road.yaml"), tmp_path / "study", "csv")


def test_a_folder_with_other_files_is_not_taken(study, tmp_path, by_formula):
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(InputError, match="a new folder, or that of the same study"):
        run_study(study(), tmp_path, "csv")
    assert content(tmp_path) == {"thesis.txt": b"mine"}


@pytest.mark.parametrize("text", ['{"version": "0", "study": 5}', "{", '{"study": {}}', "[]"])
def test_a_damaged_definition_of_a_study_is_refused(study, tmp_path, by_formula, text):
    run_study(study(), tmp_path, "csv")
    (tmp_path / "study.json").write_text(text)
    for again in (lambda: run_study(study(), tmp_path, "csv"), lambda: show_study(tmp_path)):
        with pytest.raises(InputError, match=r"study.json: it was changed: .* in another folder"):
            again()


def test_two_processes_do_not_run_the_same_study_at_a_time(study, tmp_path, by_formula):
    with (
        store.Store(tmp_path).opened(study(), "out"),
        pytest.raises(InputError, match="another process runs this study"),
    ):
        run_study(study(), tmp_path, "csv")


@pytest.mark.parametrize(
    ("spoil", "problem"),
    [
        (lambda text: text[:40], "it was changed"),
        (lambda text: "[" * 5000, "it was changed"),
        (lambda text: text.replace("0.5", "0.55"), "it has other runs"),
        (lambda text: '{"rows": 3}', "it has other runs"),
        (lambda text: text.replace("]", ", 1]", 1), "it has other runs"),
    ],
)
def test_a_chunk_that_was_changed_is_refused(study, tmp_path, by_formula, spoil, problem):
    run_study(study(), tmp_path, "csv")
    path = tmp_path / "chunks" / "000000.json"
    path.write_text(spoil(path.read_text()))
    with pytest.raises(InputError, match=f"000000.json: {problem}"):
        run_study(study(), tmp_path, "csv")


@pytest.mark.parametrize("changes", [{}, SEARCH, RARE], ids=["grid", "search", "rare"])
def test_shown_again_a_study_has_the_same_summary_and_figures(
    study, tmp_path, by_formula, figures, changes
):
    run_study(study(**changes), tmp_path, "csv")
    before, computed = content(tmp_path), sum(by_formula)
    drawn = {path.stem for path in tmp_path.glob("*.png")}
    assert drawn == DRAWN[next(iter(changes.keys() & DRAWN.keys()), "grid")]
    for path in (*tmp_path.glob("*.png"), tmp_path / "summary.md"):
        path.unlink()
    show_study(tmp_path)
    assert (content(tmp_path), sum(by_formula)) == (before, computed)


def test_what_an_interrupted_study_has_done_can_be_shown(study, tmp_path, by_formula):
    def stop(runs, kept):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_study(study(), tmp_path, "csv", progress=stop)
    report = show_study(tmp_path)
    assert "- runs: 5, more to come" in report.summary
    assert json.loads((tmp_path / "study.json").read_text())["study"]["chunk"] == 5


def test_thresholds_of_a_search_are_those_of_the_formula(study, tmp_path, by_formula):
    """A rollover from height * speed^2 = 400 on."""
    run_study(study(**SEARCH), tmp_path, "csv")
    with (tmp_path / "thresholds.csv").open(newline="") as file:
        rows = [{name: float(v) for name, v in row.items()} for row in csv.DictReader(file)]
    for row in rows:
        exact = (400.0 / row["vehicle.cg_height"]) ** 0.5
        assert row["below"] < exact <= row["threshold"] <= row["below"] + 0.2


def test_a_rare_event_that_is_not_reached_has_an_interval(study, tmp_path, by_formula):
    never = {"high": {"metric": "peak_roll", "above": 0.36}}  # five standard deviations away
    rare = {"event": "high", "level_runs": 100, "most_levels": 1}
    report = run_study(study(**RARE | {"events": never, "rare": rare}), tmp_path, "csv")
    assert "last of them, whose probability is 0.1 (95 % interval 0.05" in report.summary


def test_a_rare_event_has_the_probability_of_the_formula(study, tmp_path, by_formula):
    given = study(**RARE)
    report = run_study(given, tmp_path, "csv")
    low, high = report.results.estimate.interval
    height = 0.27 * 400.0 / given.manoeuvre.speed**2
    assert low < stats.norm.sf((height - 0.5) / 0.05) < high
    assert "by subset simulation" in report.summary
