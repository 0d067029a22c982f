"""Runs of a study that are driven again, and which they are."""

import json

import numpy as np
import pytest

from vehicle_roll_sim import run
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.integration.events import VALUE
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.studies.driven_again import drive_again, kept_results, numbers_to_show
from vehicle_roll_sim.studies.results import results_of
from vehicle_roll_sim.studies.store import Store

SHORT = {
    "manoeuvre": "step_steer",
    "fixed": {"manoeuvre.duration": 1.2},
    "factors": {"manoeuvre.speed": [15.0, 25.0], "options.model": ["1", "8dof"]},
}
SPEEDS = {"lowest": 10.0, "highest": 30.0, "count": 41}
"""m/s: 0.5 apart."""


@pytest.fixture
def kept(study, tmp_path):
    """The folder of a short study whose runs have been made."""
    short = study(**SHORT)
    store = Store(tmp_path)
    with store.opened(short, "folder"):
        results_of(short, store)
    return tmp_path


@pytest.fixture
def computed(study, tmp_path, by_formula):
    """computed(**changes): the results of a study whose runs are a formula."""

    def call(**changes):
        changed = study(**changes)
        store = Store(tmp_path / "study")
        with store.opened(changed, "folder"):
            return results_of(changed, store)

    return call


def test_a_run_that_is_driven_again_is_that_of_its_row_to_the_last_bit(kept):
    """Its metrics are those of the row, its history is that of a single run."""
    results = kept_results(kept, "--view")
    driven = drive_again(results, [2, 1], "--runs")
    rows = {row["run"]: row for row in results.runs}
    assert [(each.number, each.is_same) for each in driven] == [(2, True), (1, True)]
    for each in driven:
        row = rows[each.number]
        options = Options(model=row["options.model"])
        single = run("step_steer", options=options, speed=row["manoeuvre.speed"], duration=1.2)
        np.testing.assert_array_equal(each.outcome.history.rows, single.history.rows)
        assert each.outcome.events.peak_roll[VALUE] == row["peak_roll"] != 0.0


def test_a_run_that_differs_from_its_row_is_known(kept):
    path = Store(kept).path(0)
    content = json.loads(path.read_text())
    place = kept_results(kept, "--view").runs.columns.index("peak_roll")
    content["rows"][0][place] = np.nextafter(content["rows"][0][place], 1.0)
    path.write_text(json.dumps(content))
    driven = drive_again(kept_results(kept, "--view"), [0, 2], "--runs")
    assert [each.is_same for each in driven] == [False, True]


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"vehicle": "0" * 64}, "has the results of a vehicle that is not here"),
        ({"version": "0.0.1"}, "has the results of version 0.0.1 of the program"),
    ],
)
def test_the_runs_of_another_vehicle_or_version_are_not_driven_again(kept, change, problem):
    path = kept / "study.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | change))
    with pytest.raises(InputError, match=problem):
        kept_results(kept, "--view")


def test_a_vehicle_file_that_is_not_here_is_named(study, tmp_path):
    identity = study(**SHORT).identity
    identity["study"] |= {"vehicle": "mine.yaml"}
    (tmp_path / "study.json").write_text(json.dumps(identity))
    with pytest.raises(InputError, match=r"--view: .*mine\.yaml.* repeating"):
        kept_results(tmp_path, "--view")


def test_a_run_that_failed_or_is_not_there_is_refused(computed):
    results = computed()
    with pytest.raises(InputError, match=r"^--runs: diverged at 1\.000 s: u: a run that did not"):
        drive_again(results, [9], "--runs")
    with pytest.raises(InputError, match=r"^--runs: 12 is not allowed: a run of the study, 0 to 1"):
        drive_again(results, [12], "--runs")


def test_of_a_small_study_all_runs_that_did_not_fail_are_shown(computed):
    assert numbers_to_show(computed()) == [*range(9)]  # the others diverge


def test_of_many_runs_those_nearest_to_the_threshold_are_shown(computed):
    """Heights of 0.4 m roll over from sqrt(400 / 0.4) = 31.6 m/s on, 0.64 m from 25 m/s."""
    results = computed(factors={"vehicle.cg_height": [0.4, 0.64], "manoeuvre.speed": SPEEDS})
    rows = {row["run"]: row for row in results.runs}
    shown = [rows[number] for number in numbers_to_show(results, 10)]
    assert {row["vehicle.cg_height"] for row in shown} == {0.64}
    speeds = sorted(row["manoeuvre.speed"] for row in shown)
    np.testing.assert_allclose(speeds, 22.5 + 0.5 * np.arange(10), rtol=0, atol=1e-9)


def test_all_along_a_threshold_runs_are_shown(computed):
    """Near a curve through the plane: both ends of it are among the runs."""
    heights = {"lowest": 0.5, "highest": 0.75, "count": 13}
    speeds = {"lowest": 20.0, "highest": 30.0, "count": 13}
    results = computed(factors={"vehicle.cg_height": heights, "manoeuvre.speed": speeds})
    rows = {row["run"]: row for row in results.runs}
    shown = [rows[number] for number in numbers_to_show(results)]
    assert len(shown) == 30
    limits = [400.0 / row["manoeuvre.speed"] ** 2 - row["vehicle.cg_height"] for row in shown]
    assert np.abs(limits).max() < 0.07  # m: a step of the speed changes it by up to 0.06
    found = [row["vehicle.cg_height"] for row in shown]
    assert min(found) < 0.53
    assert max(found) > 0.72


def test_if_the_event_never_happens_runs_at_equal_distances_are_shown(computed):
    slow = {"lowest": 5.0, "highest": 10.0, "count": 100}
    results = computed(factors={"manoeuvre.speed": slow})
    assert numbers_to_show(results, 10) == [*range(0, 100, 11)]
