"""`view` and `run --view`: a page of recorded runs, and clear refusals."""

import importlib.util
import os
import shutil
import tempfile

import pytest

from vehicle_roll_sim.command_line import view_pictures
from vehicle_roll_sim.viewer import browser

HAVE_BAGS = importlib.util.find_spec("rosbags") is not None
NEEDS_BAGS = pytest.mark.skipif(not HAVE_BAGS, reason="rosbags is not installed")
TURN = ("step_steer", "--duration", "1.5")


@pytest.fixture
def recorded(command, folder):
    """A run as `run.csv`."""
    assert command("run", *TURN, "--csv", "run.csv").status == 0
    return folder / "run.csv"


def test_a_csv_file_becomes_a_page_beside_it_with_its_name(command, recorded, data):
    result = command("view", "run.csv")
    assert (result.status, result.err, result.value) == (0, "", {"page": "run.html"})
    told = data("run.html")
    assert [run["label"] for run in told["runs"]] == ["run"]
    assert "the reference vehicle" in told["notes"][0]


def test_the_page_of_run_is_that_of_its_csv_file_and_names_the_events_it_prints(command, data):
    printed = command("run", "j_turn", "--csv", "j_turn.csv", "--view", "own.html")
    assert printed.value["page"] == "own.html"
    assert command("view", "j_turn.csv", "--out", "other.html").status == 0
    (own,), (other,) = data("own.html")["runs"], data("other.html")["runs"]
    events = {each["name"]: each["time"] for each in own["events"]}
    assert events["lr lifts off"] == pytest.approx(printed.number("lift-off lr"), abs=5e-4)
    assert events["rollover"] == pytest.approx(printed.number("rollover"), abs=5e-4)
    assert (own["time"], own["vehicle"]) == (other["time"], other["vehicle"])
    assert data("own.html")["notes"] == []


@NEEDS_BAGS
def test_a_bag_is_drawn_with_its_own_vehicle_beside_a_csv_file(command, recorded, data):
    assert command("run", *TURN, "--set", "front_track=1.7", "--bag", "bag").status == 0
    result = command("view", "bag", "run.csv", "--out", "both.html", "--title", "two")
    assert (result.status, result.err) == (0, "")
    bag, csv = data("both.html")["runs"]
    assert [bag["label"], csv["label"]] == ["bag", "run"]
    assert bag["vehicle"]["wheels"][0]["place"][1] == pytest.approx(0.85)
    assert csv["vehicle"]["wheels"][0]["place"][1] < 0.8


@NEEDS_BAGS
def test_the_vehicle_of_a_bag_is_not_changed_by_options(command, refused):
    assert command("run", *TURN, "--bag", "bag").status == 0
    refused(("view", "bag", "--set", "front_track=1.7"), "--set", "only for CSV files", "the run")
    refused(("view", "bag", "--model", "2"), "--model", "only for CSV files")


@NEEDS_BAGS
def test_a_run_is_shown_on_its_road_and_that_of_a_csv_file_is_named(command, refused, data, folder):
    (folder / "road.yaml").write_text("features: [{kind: wave, start: 5, length: 8, height: 0.1}]")
    on_road = ("--road", "road.yaml")
    files = ("--csv", "run.csv", "--view", "own.html")
    assert command("run", *TURN, *on_road, *files).status == 0
    assert command("run", *TURN, *on_road, "--bag", "bag").status == 0
    assert command("view", "run.csv", *on_road).status == 0
    assert command("view", "bag").status == 0
    roads = [data(name)["roads"] for name in ("own.html", "run.html", "bag.html")]
    assert roads[0] == roads[1]
    assert roads[0][0]["vertices"]
    assert roads[2][0]["vertices"]
    assert command("view", "run.csv", "--out", "plane.html").status == 0
    assert data("plane.html")["roads"] == []
    refused(("view", "bag", *on_road), "--road", "only for CSV files", "the run describes its road")
    refused(("view", "run.csv", "--road", "no.yaml"), "no.yaml")


def test_a_csv_file_is_drawn_with_the_vehicle_that_is_named(command, recorded, data):
    assert command("view", "run.csv", "--set", "front_track=1.7", "--model", "2").status == 0
    wheel = data("run.html")["runs"][0]["vehicle"]["wheels"][0]
    assert wheel["place"][1] == pytest.approx(0.85)
    assert "guide" in wheel


def test_a_run_that_begins_at_another_height_than_its_vehicle_is_warned_of(command, recorded):
    result = command("view", "run.csv", "--set", "cg_height=0.7")
    assert result.status == 0
    (line,) = result.err.splitlines()
    for word in ("warning: run.csv", "0.7 m", "--vehicle"):
        assert word in line


def test_a_part_with_another_limit_of_rollover_is_shown(command, folder, data):
    assert command("run", "j_turn", "--csv", "j.csv").status == 0
    assert command("view", "j.csv", "--begin", "1", "--end", "2", "--stop-roll", "10").status == 0
    (run,) = data("j.html")["runs"]
    assert 1.0 < run["rollover"] < 2.0


def test_the_cones_of_a_manoeuvre_are_shown(command, recorded, data):
    name = "iso_severe_double_lane_change"
    assert command("view", "run.csv", "--manoeuvre", name).status == 0
    cones = data("run.html")["cones"]
    assert command("run", name, "--duration", "0.1", "--view", "own.html").status == 0
    assert data("own.html")["cones"] == cones
    assert len(cones) == 18


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("--out", "page.txt"), ("--out", "page.txt", ".html")),
        (("--out", "none/page.html"), ("--out", "none does not exist")),
        (("run.csv",), ("--out", "missing", "several runs")),
        (("run.csv",) * 4, ("RUN", "5 files", "at most 4")),
        (("--begin", "1", "--end", "0.5"), ("--end", "0.5", "more than")),
        (("--label", "a", "--label", "b"), ("--label", "2 labels", "1 file")),
        (("--manoeuvre", "j_turn"), ("--manoeuvre", "j_turn", "iso_double_lane_change")),
        (("--camera", "top"), ("--camera", "together with --png")),
        (("--vehicle", "none.yaml"), ("none.yaml",)),
    ],
)
def test_options_that_make_no_sense_are_refused(refused, recorded, words, expected):
    refused(("view", "run.csv", *words), *expected)


def test_an_empty_run_and_other_files_are_refused(refused, folder, recorded):
    header = recorded.read_text().splitlines()[0]
    (folder / "empty.csv").write_text(header + "\n")
    refused(("view", "empty.csv"), "empty.csv", "no rows", "at least one row")
    refused(("view", "none.csv"), "none.csv", "No such file")


def test_the_page_of_a_run_replaces_no_other_result(refused):
    refused(("run", *TURN, "--view", "page.pdf"), "--view", "page.pdf", ".html")
    refused(("run", *TURN, "--view", "a.html", "--csv", "a.html"), "--view", "different")


def test_a_picture_is_of_a_time_that_the_runs_have(refused, recorded, monkeypatch):
    monkeypatch.setattr(browser, "browser", lambda: "/bin/false")
    refused(("view", "run.csv", "--png", "1.6"), "--png", "1.6", "0 to 1.5 s")


def test_without_a_browser_no_picture_is_taken(refused, recorded, monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    refused(("view", "run.csv", "--png", "1"), "--png", "chromium", "install Chromium")


@pytest.mark.parametrize(
    ("option", "missing", "expected"),
    [
        ("--gif", "chromium", ("none of chromium", "install Chromium")),
        ("--gif", "chromedriver", ("chromedriver is not installed", "apt install chromium-driver")),
        ("--mp4", "ffmpeg", ("ffmpeg is not installed", "apt install ffmpeg")),
        ("--gif", "selenium", ("no Python package selenium", "vehicle_roll_sim[film]")),
    ],
)
def test_a_film_says_what_it_lacks(refused, recorded, monkeypatch, option, missing, expected):
    monkeypatch.setattr(browser, "BROWSERS", ("chromium",))
    monkeypatch.setattr(shutil, "which", lambda name: None if name == missing else "/bin/false")
    there = importlib.util.find_spec("json")
    spec = {"selenium": None if missing == "selenium" else there}
    monkeypatch.setattr(importlib.util, "find_spec", spec.get)
    refused(("view", "run.csv", option, f"film.{option[2:]}"), option, *expected)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("--gif", "film.mp4"), ("--gif: 'film.mp4'", "a file name ending in .gif")),
        (("--gif", "film.gif", "--fps", "30"), ("--fps", "30", "divides 100")),
        (("--mp4", "none/film.mp4"), ("--mp4", "none does not exist")),
        (("--png", "1", "--fps", "20"), ("--fps", "together with --mp4 or --gif")),
        (("--mp4", "film.mp4", "--png", "1.6"), ("--png", "1.6", "0 to 1.5 s")),
    ],
)
def test_films_that_make_no_sense_are_refused(refused, recorded, monkeypatch, words, expected):
    monkeypatch.setattr(view_pictures, "need_for_film", lambda *names: None)
    monkeypatch.setattr(browser, "browser", lambda: "/bin/false")
    refused(("view", "run.csv", *words), *expected)


def test_a_film_of_hours_is_refused(folder, refused, recorded, monkeypatch):
    monkeypatch.setattr(view_pictures, "need_for_film", lambda *names: None)
    lines = recorded.read_text().splitlines()
    later = "3600" + lines[2][lines[2].index(",") :]
    (folder / "long.csv").write_text("\n".join([*lines[:2], later, ""]))
    words = ("view", "long.csv", "--gif", "film.gif")
    refused(words, "--gif: '72001 pictures'", "at most 3000", "--fps")


def test_a_browser_that_fails_leaves_no_picture(command, folder, recorded, monkeypatch):
    monkeypatch.setattr(browser, "browser", lambda: "/bin/false")
    result = command("view", "run.csv", "--png", "1")
    assert result.status == 1
    assert "--png: /bin/false failed" in result.err
    assert sorted(path.name for path in folder.iterdir()) == ["run.csv", "run.html"]


def test_no_process_goes_on_of_a_browser_that_takes_too_long(
    command, folder, recorded, monkeypatch
):
    """It is ended as after an interruption, which would end this process too at a wrong moment."""
    os.mkfifo(folder / "alive")
    fake, temporary = folder / "browser", folder / "temporary"
    temporary.mkdir()
    monkeypatch.setenv("TMPDIR", str(temporary))
    monkeypatch.setattr(tempfile, "tempdir", None)  # so that it is looked for again
    begins = f"exec 3>{folder}/alive\nmktemp\nsleep 1000 &\necho began >&3\nwait"
    fake.write_text(f"#!/bin/sh\n{begins}\n")
    fake.chmod(0o700)
    monkeypatch.setattr(browser, "browser", lambda: str(fake))
    monkeypatch.setattr(browser, "LONGEST", 1.0)
    alive = os.open(folder / "alive", os.O_RDONLY | os.O_NONBLOCK)
    result = command("view", "run.csv", "--png", "1")
    assert result.status == 1
    assert "failed (TimeoutExpired)" in result.err
    os.set_blocking(alive, True)
    with os.fdopen(alive) as told:  # up to the end of the last process that has it open
        assert told.read() in ("began\n", "")  # nothing yet on a busy machine
    assert not (folder / "run.png").exists()
    assert not [*temporary.iterdir()]


@pytest.mark.unmeasured
@pytest.mark.skipif(browser.browser() is None, reason="no Chromium or Chrome is installed")
def test_a_picture_is_taken_at_a_time(command, folder, recorded):
    result = command("view", "run.csv", "--png", "1.2", "--camera", "rear", "--theme", "dark")
    assert (result.status, result.err) == (0, "")
    assert result.value == {"page": "run.html", "picture": "run.png"}
    content = (folder / "run.png").read_bytes()
    assert content.startswith(b"\x89PNG")
    size = [int.from_bytes(content[k : k + 4], "big") for k in (16, 20)]
    assert size == list(browser.SIZE)


def test_a_namespace_is_for_bags(refused, recorded):
    refused(("view", "run.csv", "--namespace", "car"), "--namespace", "no bag", "only for bags")
    refused(("plot", "run.csv", "--namespace", "car"), "--namespace", "no bag", "only for bags")
