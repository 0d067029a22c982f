"""The text of a page: complete in itself, the same twice, and safe whatever it shows."""

import base64
import hashlib
import html
import json
import os
import re

import numpy as np
import pytest
from scipy.integrate import trapezoid
from viewed_runs import FAST, SLOW, fishhook, of_columns, viewed, viewed_history

from vehicle_roll_sim import preset
from vehicle_roll_sim.viewer import page as pages
from vehicle_roll_sim.viewer.page import MOST_RUNS, SCRIPTS, page, write_page
from vehicle_roll_sim.viewer.scene import TRAVELS
from vehicle_roll_sim.viewer.study_map import MOST_POINTS, Quantity, StudyMap

SCRIPT = re.compile(r"<script>(.*?)</script>", re.DOTALL)
STYLE = re.compile(r"<style>(.*?)</style>", re.DOTALL)
DATA = re.compile(r'<script type="application/json" id="data">(.*?)</script>', re.DOTALL)
POLICY = re.compile(r'http-equiv="Content-Security-Policy" content="(.*?)"')
HOSTILE = "</script><script>alert(1)</script><!-- {{data}} {{script}} &amp; \u2028 ä"
TEN_SECONDS = 1001
LARGEST = 3_000_000
"""Bytes of a page of 10 s."""


def data_of(text: str) -> dict:
    (found,) = DATA.findall(text)
    return json.loads(found)


def columns_of(told: dict) -> dict[str, np.ndarray]:
    """The columns of a run as the page reads them."""
    values = np.frombuffer(base64.b64decode(told["values"]), "<f4")
    return dict(zip(told["columns"], values.reshape(len(told["columns"]), -1), strict=True))


def time_of(told: dict) -> np.ndarray:
    return np.frombuffer(base64.b64decode(told["time"]), "<f8")


@pytest.fixture(scope="module")
def text() -> str:
    return page([viewed(fishhook())], "a title")


def test_a_page_has_its_scripts_and_asks_for_no_other_file(text):
    assert len(SCRIPT.findall(text)) == 2
    assert "{{" not in DATA.sub("", SCRIPT.sub("", text))
    assert not re.findall(r"<(?:link|img|script|iframe)[^>]* (?:src|href)=\"(?!data:)", text)


def test_only_these_scripts_may_run_and_nothing_may_be_requested(text):
    policy = html.unescape(POLICY.search(text)[1])
    rules = dict(rule.split(" ", 1) for rule in policy.split("; "))
    assert rules.keys() == {"default-src", "script-src", "style-src", "img-src"}
    assert (rules["default-src"], rules["img-src"]) == ("'none'", "data:")
    for kind, found in (("script-src", SCRIPT), ("style-src", STYLE)):
        digests = [hashlib.sha256(part.encode()).digest() for part in found.findall(text)]
        expected = [f"'sha256-{base64.b64encode(each).decode()}'" for each in digests]
        assert rules[kind].split() == expected


def test_the_licence_of_the_library_is_in_the_page(text):
    assert "Permission is hereby granted, free of charge" in text
    assert "three.js authors" in text


def test_the_columns_are_those_of_the_run(text):
    (told,) = data_of(text)["runs"]
    history, found = fishhook().history, columns_of(told)
    assert not told["is_thinned"]
    np.testing.assert_array_equal(time_of(told), history["time"])
    for name in ("roll", "z", "tire_compression_lr", "lateral_force_rf"):
        np.testing.assert_array_equal(found[name], history[name].astype("f4"))
    panels = {each["title"]: k for k, each in enumerate(data_of(text)["panels"])}
    (curve,) = told["curves"][panels["roll angle (deg)"]]
    np.testing.assert_allclose(found[curve["column"]], np.degrees(history["roll"]), rtol=1e-6)
    assert {f"normal load {wheel} (kN)" for wheel in ("lf", "rf", "lr", "rr")} <= panels.keys()


def test_events_are_those_of_the_run_in_order_of_time(text):
    (told,) = data_of(text)["runs"]
    by_name = {each["name"]: each["time"] for each in told["events"]}
    lift_off, rollover = fishhook().events.lift_off_time, fishhook().events.rollover_time[0]
    assert by_name["lr lifts off"] == lift_off[2]
    assert by_name["rollover"] == told["rollover"] == rollover
    assert list(by_name.values()) == sorted(by_name.values())
    assert len(by_name) == 4 + 1 + 2  # wheels, rollover and two peaks


def test_angles_of_the_wheels_are_the_integrals_of_their_speeds(text):
    history, found = fishhook().history, columns_of(data_of(text)["runs"][0])
    driven = trapezoid(history["wheel_speed_lf"], history["time"])
    assert found["wheel_angle_lf"][[0, -1]] == pytest.approx([0.0, driven], rel=1e-6)


def test_the_same_run_gives_the_same_bytes(text):
    assert page([viewed(fishhook())], "a title") == text


def test_ten_seconds_of_every_curve_stay_below_three_megabytes():
    run = viewed_history(of_columns(TEN_SECONDS, roll=np.random.default_rng(0).random(TEN_SECONDS)))
    assert len(page([run], "ten seconds").encode()) < LARGEST


def test_what_is_written_in_names_ends_no_element_and_fills_no_place():
    run = viewed_history(of_columns(3), HOSTILE)
    text = page([run], HOSTILE, notes=[HOSTILE])
    assert len(SCRIPT.findall(text)) == 2
    assert data_of(text)["runs"][0]["label"] == HOSTILE
    assert data_of(text)["notes"] == [HOSTILE]
    assert re.search("<title>(.*)</title>", text)[1] == html.escape(HOSTILE)


def test_bytes_of_a_file_name_that_are_no_text_can_be_written(tmp_path):
    name = os.fsdecode(b"gr\xf6sse")
    write_page(tmp_path / "page.html", [viewed_history(of_columns(3), name)], name, notes=[name])
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "<title>gr?sse</title>" in text
    assert data_of(text)["runs"][0]["label"] == name


def test_unknown_and_infinite_values_are_no_obstacle():
    odd = of_columns(4, roll=np.nan, x=np.inf, lateral_acceleration=1e300)
    found = columns_of(data_of(page([viewed_history(odd)], "odd"))["runs"][0])
    assert np.isnan(found["roll"]).all()
    assert np.isinf(found["lateral_acceleration"]).all()


def test_no_script_of_the_package_can_end_its_element():
    for name in (*SCRIPTS, "three/three.min.js", "three/LICENSE", "style.css"):
        assert not re.search(r"</(script|style)|<!--|\r", pages._part(name)), name


def test_there_is_a_colour_for_each_run_in_both_themes(text):
    style = STYLE.search(text)[1]
    for run in range(MOST_RUNS):
        assert style.count(f"--run-{run}:") == 2
    assert f"--run-{MOST_RUNS}:" not in style
    assert len(data_of(page([viewed(fishhook(s)) for s in (FAST, SLOW)], ""))["runs"]) == 2


def test_a_vehicle_is_drawn_at_its_numbers():
    (told,) = data_of(page([viewed(fishhook(SLOW), model="2")], ""))["runs"]
    body, wheels = told["vehicle"]["body"], told["vehicle"]["wheels"]
    ahead, behind = preset().cg_to_front_axle, preset().cg_to_rear_axle
    assert [wheel["place"][0] for wheel in wheels] == [ahead, ahead, -behind, -behind]
    assert body["ahead"] - wheels[0]["place"][0] == pytest.approx(0.8)  # the overhang
    assert told["vehicle"]["height"] + body["bottom"] == pytest.approx(0.25)
    guide = wheels[1]["guide"]
    assert guide["travel"] == TRAVELS.tolist()
    assert guide["left"][len(TRAVELS) // 2] == pytest.approx(0.0, abs=1e-12)


def test_the_map_of_a_large_study_keeps_the_runs_that_open_and_about_as_many_points_as_it_may():
    count = 7 * MOST_POINTS
    values = np.linspace(0.0, 1.0, count)
    values[5] = np.inf
    opens = {5: 0, count - 3: 1}
    study = StudyMap(np.arange(count), [Quantity("share", values)], opens, (0, 0, 0))
    told = data_of(page([viewed(fishhook())] * 2, "", study=study))["study"]
    points = {each["run"]: each["place"] for each in told["points"]}
    assert told["count"] == count
    assert MOST_POINTS <= len(points) <= MOST_POINTS + 2
    assert {run: place for run, place in points.items() if place is not None} == opens
    places = dict(zip(points, told["quantities"][0]["values"], strict=True))
    assert places[5] is None
    assert places[count - 3] == pytest.approx(values[-3], rel=1e-5)
