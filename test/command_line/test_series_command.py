"""`series`: a table with its verdict, the same as CSV, and refusals."""

import csv
import dataclasses
import itertools
import json

import pytest

from vehicle_roll_sim.command_line.series import VARIED
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.manoeuvres.series import catalogue

CENTRES = ("--set", "front_roll_centre_height=0.1", "--set", "rear_roll_centre_height=0.15")
STABLE = ("--set", "cg_height=0.5", *CENTRES)


def table_of(result) -> list[list[str]]:
    lines = result.out.splitlines()
    return [line.split() for line in lines if line.split()[0] in ("direction", "left", "right")]


def test_the_table_and_the_csv_have_the_same_runs(command, folder):
    result = command("series", "nhtsa_fishhook", *STABLE, "--csv", "series.csv")
    assert (result.status, result.err) == (0, "")
    with (folder / "series.csv").open(newline="") as file:
        written = list(csv.reader(file))
    shown = table_of(result)
    assert shown[0] == written[0]
    assert len(shown) == len(written) == 1 + 2 * 5
    for one, other in zip(shown[1:], written[1:], strict=True):
        assert (one[0], one[-1], one[-2]) == (other[0], other[-1], "-")
        for k in (1, 2, 3):
            assert float(one[k]) == pytest.approx(float(other[k]), abs=5.1e-4)
    assert result.value["verdict"] == "no two-wheel lift up to 50 mph"
    assert result.value["CSV"] == "series.csv"


def test_the_same_series_gives_the_same_bytes(command, folder):
    for name in ("one.csv", "other.csv"):
        assert command("series", "nhtsa_j_turn", "--csv", name).status == 0
    assert (folder / "one.csv").read_bytes() == (folder / "other.csv").read_bytes()


def test_the_reference_vehicle_lifts_two_wheels_at_once(command):
    result = command("series", "nhtsa_fishhook")
    expected = "two-wheel lift at 35 mph to the left, two-wheel lift at 35 mph to the right"
    assert result.value["verdict"] == expected


def test_the_road_is_that_of_the_file(command, folder):
    """On ice no wheel lifts; nor is ice forgotten in the next series of the process."""
    (folder / "ice.yaml").write_text("features: [{kind: patch, start: -100, friction: 0.2}]")
    result = command("series", "nhtsa_j_turn", "--road", "ice.yaml")
    assert result.value["verdict"] == "no two-wheel lift up to 60 mph"
    assert "two-wheel lift at" in command("series", "nhtsa_j_turn").value["verdict"]


def test_options_of_the_model_are_those_of_run(command):
    plain = command("series", "nhtsa_j_turn")
    simplified = command("series", "nhtsa_j_turn", "--model", "1b")
    assert plain.status == simplified.status == 0
    assert plain.out != simplified.out


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ((), ("MANOEUVRE", "--help")),
        (("nhtsa_jturn",), ("nhtsa_jturn", "nhtsa_j_turn")),
        (("constant_radius",), ("constant_radius", "sine_with_dwell")),
        (("nhtsa_j_turn", "--scalar", "3"), ("--scalar",)),
        (("nhtsa_j_turn", "--lowest-speed", "9", "--speed", "3"), ("--speed",)),
        (("j_turn", "--lowest-speed", "41"), ("--highest-speed", "more than lowest_speed")),
        (("j_turn", "--resolution", "0"), ("--resolution", "from 0.001")),
        (("iso_double_lane_change", "--lowest-speed", "9"), ("MANOEUVRE", "lane_change")),
        (("nhtsa_j_turn", "--speed", "3"), ("--speed",)),
        (("nhtsa_j_turn", "--csv", "none/x.csv"), ("--csv", "none")),
        (("nhtsa_j_turn", "--csv", ""), ("--csv",)),
        (("nhtsa_j_turn", "--model", "8dof", "--csv", "x.csv"), ("--model", "8dof", "heights")),
        (("nhtsa_j_turn", "--set", "cg_height=-1"), ("--set cg_height", "-1")),
        (("nhtsa_j_turn", "--preview-time", "1"), ("--preview-time",)),
        (("iso_double_lane_change", "--preview-time", "0"), ("--preview-time", "from 0.05")),
        (("iso_double_lane_change", "--vehicle-width", "1"), ("vehicle_width", "1.5 m")),
        (("iso_double_lane_change", "--speed", "20"), ("--speed",)),
    ],
)
def test_what_is_wrong_is_refused_in_one_line(refused, words, named):
    refused(("series", *words), *named)


def test_a_double_lane_change_takes_the_options_of_body_and_driver(command, monkeypatch):
    for which, step in (("COARSE", 20), ("FINE", 10)):  # km/h: fewer runs
        monkeypatch.setattr(f"vehicle_roll_sim.manoeuvres.series.entry_speed_search.{which}", step)
    name = "iso_severe_double_lane_change"
    shorter = dataclasses.replace(catalogue.SERIES[name], slowest=40)
    monkeypatch.setitem(catalogue.SERIES, name, shorter)
    narrow = ("--preview-time", "0.3", "--vehicle-width", "1.9", *STABLE)
    result = command("series", name, *narrow)
    assert (result.status, result.err) == (0, "")
    plain = command("series", name, *STABLE)
    assert result.value["verdict"] != plain.value["verdict"]
    first = result.out.splitlines()[1].split()
    assert first[:2] == ["left", "40"]
    assert first[2].isdigit()


@pytest.mark.parametrize("words", [(), ("iso_double_lane_change",)])
def test_help_has_the_options_of_the_series(command, capsys, words):
    with pytest.raises(SystemExit) as end:
        command("series", *words, "--help")
    assert end.value.code == 0
    assert "--preview-time" in capsys.readouterr().out


def test_a_range_of_speeds_is_driven_with_the_options_of_the_manoeuvre(command, folder):
    words = ("--lowest-speed", "11", "--highest-speed", "16", "--resolution", "0.5")
    result = command("series", "j_turn", *words, "--amplitude", "8", "--csv", "series.csv")
    assert (result.status, result.err) == (0, "")
    assert len(table_of(result)) == len((folder / "series.csv").read_text().splitlines()) > 9
    for event in ("wheel lift-off", "two-wheel lift", "rollover"):
        low, high = (float(result.value[f"first {event}"].split()[k]) for k in (1, 3))
        assert 0.0 < high - low <= 0.5
    assert result.value["verdict"].startswith("rollover at ")


def test_a_quick_steering_gets_its_verdict_and_where_the_amplitudes_end(command, monkeypatch):
    step = "vehicle_roll_sim.manoeuvres.series.catalogue.LADDER_STEP"
    monkeypatch.setattr(step, 10.0)  # fewer runs
    words = ("--set", "steering_ratio=4", *STABLE)
    result = command("series", "sine_with_dwell", *words)
    assert (result.status, result.err) == (0, "")
    assert result.value["amplitudes end at"].startswith("240 deg, which is 60 deg at the road")
    assert result.value["verdict"]


@pytest.fixture
def ends_at_the_second_run(monkeypatch):
    """Makes a series end with an exception after its first run."""

    def arrange(end: BaseException) -> None:
        driven = catalogue.driven
        runs = itertools.count(1)

        def interrupted(*given):
            if next(runs) > 1:
                raise end
            return driven(*given)

        monkeypatch.setattr(catalogue, "driven", interrupted)

    return arrange


SHORT = ("nhtsa_j_turn", "--set", "steering_ratio=1.5", *STABLE)
"""A series with few runs."""


def test_a_series_that_is_refused_in_the_middle_keeps_the_runs_before(
    command, folder, ends_at_the_second_run
):
    ends_at_the_second_run(InputError("model", "1", "another model"))
    result = command("series", *SHORT, "--csv", "series.csv")
    assert result.status == 2
    assert result.err.splitlines() == [
        "vehicle_roll_sim: error: --model: '1' is not allowed: another model"
    ]
    assert len(table_of(result)) == 2
    assert len((folder / "series.csv").read_text().splitlines()) == 2
    assert result.value["verdict"] == "none: the series ended after 1 run"
    assert result.value["CSV"] == "series.csv"


def test_a_series_that_is_interrupted_keeps_the_runs_before(
    command, folder, ends_at_the_second_run
):
    ends_at_the_second_run(KeyboardInterrupt())
    assert command("series", *SHORT, "--csv", "series.csv").status == 130
    assert len((folder / "series.csv").read_text().splitlines()) == 2


def test_amplitudes_of_a_standard_end_where_the_road_wheels_do(command):
    words = ("nhtsa_j_turn", "--set", "steering_ratio=4", "--steering-at-03g", "48")
    result = command("run", *words, "--duration", "1.2", *STABLE)
    assert result.status == 0
    assert result.value["handwheel amplitude"] == "240.000 deg"
    assert result.value["handwheel ends at"].startswith("240 deg, which is 60 deg at the road")
    beyond = command("run", *words, "--scalar", "8.1", *STABLE)
    assert beyond.status == 2
    assert "at most 240 deg, which is 60 deg at the road wheels" in beyond.err


def test_the_page_of_a_series_has_all_runs_in_order_and_shows_the_one_that_rolls_most(
    command, folder
):
    result = command("series", "nhtsa_j_turn", *STABLE, "--view", "series.html")
    assert (result.status, result.value["page"]) == (0, "series.html")
    text = (folder / "series.html").read_text(encoding="utf-8")
    data = json.loads(text.split('id="data">')[1].split("</script>")[0])
    rows = table_of(result)[1:]
    labels = [f"{row[0]}, {float(row[1]):g} mph" for row in rows]
    assert [run["label"] for run in data["runs"]] == labels
    peaks = [abs(float(row[3])) for row in rows]
    (shown,) = data["shown"]
    assert peaks[shown] == max(peaks)
    (peak,) = (e for e in data["runs"][shown]["events"] if e["name"].startswith("peak roll"))
    assert float(peak["name"].split()[2]) == pytest.approx(float(rows[shown][3]), abs=0.06)


def test_the_page_is_checked_before_the_series_is_driven(refused):
    refused(("series", "nhtsa_j_turn", "--view", "page.png"), "--view", "page.png", ".html")
    words = ("series", "nhtsa_j_turn", "--view", "a.html", "--csv", "a.html")
    refused(words, "--view", "different")


@pytest.mark.parametrize("name", [*catalogue.SERIES, *catalogue.SEARCHES])
def test_the_runs_of_every_series_have_a_label(name):
    for table in (catalogue.SERIES, catalogue.SEARCHES):
        if name in table:
            assert table[name].columns[1] in VARIED
