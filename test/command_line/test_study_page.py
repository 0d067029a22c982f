"""`study --view`: a page whose map opens runs of the study; and `view` of such a run."""

import json

import pytest

from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS

TEXT = """\
manoeuvre: step_steer
vehicle: car.yaml
fixed: {manoeuvre.duration: 1.2}
factors:
  options.model: ["1", 8dof]
  manoeuvre.speed: [10, 20]
  vehicle.front_track: [1.6, 1.7]
"""


@pytest.fixture
def made(command, folder):
    """The study in the folder `turns`; what the command printed, with its page `map.html`."""
    assert command("template", "car.yaml").status == 0
    (folder / "turn.yaml").write_text(TEXT)
    words = ("--out", "turns", "--format", "csv", "--view", "map.html")
    result = command("study", "turn.yaml", *words)
    assert (result.status, result.err) == (0, "")
    return result


def test_the_page_of_a_study_has_its_runs_and_where_they_are_on_the_map(made, data):
    assert made.value["page"] == "map.html"
    told = data("map.html")
    first, *_, last = told["runs"]
    assert first["label"] == ("run 0, options.model 1, manoeuvre.speed 10, vehicle.front_track 1.6")
    assert last["vehicle"]["wheels"][0]["place"][1] == pytest.approx(0.85)
    assert (told["notes"], told["cones"]) == ([], [])
    study = told["study"]
    labels = [each["label"] for each in study["quantities"]]
    assert [labels[axis] for axis in study["axes"]] == [
        *("manoeuvre.speed (m/s)", "vehicle.front_track (m)", "rollover")
    ]
    assert study["points"] == [{"run": number, "place": number} for number in range(8)]
    assert study["quantities"][0] == {
        "label": "options.model",
        "texts": ["1", "8dof"],
        "values": [0.0] * 4 + [1.0] * 4,
    }
    assert study["quantities"][labels.index("two_wheel_lift")]["values"] == [0.0] * 4 + [None] * 4
    (rolled,) = told["shown"]
    peaks = study["quantities"][labels.index("|peak_roll| (rad)")]["values"]
    assert peaks[rolled] == max(peaks)


def test_the_runs_that_are_named_are_shown_and_a_page_in_the_folder_needs_no_folder(
    command, made, folder, data
):
    words = ("--out", "again", "--format", "csv", "--view", "again/map.html", "--runs", "5,2")
    assert command("study", "turn.yaml", *words).status == 0
    assert command("study", "--show", "turns", "--view", "shown.html", "--runs", "5,2").status == 0
    own, shown = data("again/map.html"), data("shown.html")
    assert own == shown
    assert [run["label"].partition(",")[0] for run in own["runs"]] == ["run 5", "run 2"]
    points = own["study"]["points"]
    assert [each["place"] for each in points] == [None, None, 1, None, None, 0, None, None]


def test_a_run_of_a_study_is_seen_and_plotted_like_a_file(command, made, data):
    assert command("view", "turns#7", "turns#2", "--out", "two.html").status == 0
    told = data("two.html")
    assert [run["label"] for run in told["runs"]] == ["turns#7", "turns#2"]
    whole = data("map.html")["runs"]
    for run, number in zip(told["runs"], (7, 2), strict=True):
        assert (run["time"], run["values"]) == (whole[number]["time"], whole[number]["values"])
        assert run["vehicle"] == whole[number]["vehicle"]
    assert command("plot", "turns#7").value == {"plot": "turns#7.png"}


def test_a_run_that_differs_from_the_table_is_said_to(command, made, folder, data):
    path = folder / "turns/chunks/000000.json"
    content = json.loads(path.read_text())
    width = len(content["rows"][2]) - len(METRIC_UNITS)
    content["rows"][2][width] += 1e-12  # its first metric
    path.write_text(json.dumps(content))
    result = command("view", "turns#2")
    assert result.status == 0
    assert "warning: turns: driven again, run 2 differs from the table" in result.err
    assert command("study", "--show", "turns", "--view", "map.html", "--runs", "1,2").status == 0
    assert [note.partition(" as ")[0] for note in data("map.html")["notes"]] == [
        "Driven again, run 2 differs from the table of the study,"
    ]


def test_what_is_no_run_of_a_study_is_refused(command, refused, made, folder):
    refused(("view", "turns"), "RUN: 'turns'", "such as turns#0")
    refused(("view", "turns#8"), "RUN: 8", "0 to 7")
    refused(("view", "turns#7", "--model", "2"), "--model", "only for CSV files")
    refused(("view", "none#7"), "none#7: No such file")
    (folder / "car.yaml").unlink()
    refused(("view", "turns#7"), "RUN: turns: ", "car.yaml", "study STUDY.yaml --out DIR")
