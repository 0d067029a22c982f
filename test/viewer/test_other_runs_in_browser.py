"""Pages of several runs, of other models and of odd runs, in a real browser."""

import math

import numpy as np
import pytest
from test_in_browser import picture_of
from viewed_runs import (
    FAST,
    ROAD,
    SLOW,
    fishhook,
    of_columns,
    over_crests,
    scene,
    viewed,
    viewed_history,
)

from vehicle_roll_sim import preset, run
from vehicle_roll_sim.model.kinematic.guidance import carriers, look_up, paths
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.viewer.recording import ViewedRun
from vehicle_roll_sim.viewer.study_map import Quantity, StudyMap

pytestmark = pytest.mark.unmeasured

ROUNDING = 1e-6
"""m: of 32-bit numbers that are below 100 m."""
HOSTILE = "</script><script>window.hacked = 1</script><img src=x onerror='window.hacked = 1'>&amp;"


def test_several_runs_lie_over_one_another_and_each_can_be_followed(opened):
    slow, fast = fishhook(SLOW), fishhook(FAST)
    page = opened(viewed(fast, "fast"), viewed(slow, "slow"))
    time = float(fast.history["time"][-1])
    assert page.at(time)["lamps"] == [True] * 5
    page.driver.find_elements("css selector", "#legend button")[1].click()
    state = page.at(time)
    assert (state["run"], state["lamps"][-1]) == (1, False)
    row = int(np.searchsorted(slow.history["time"], time))
    expected = preset().record()[0].tire_radius - slow.history.wheels("tire_compression")[row]
    heights = [place[2] for place in state["wheels"]]
    np.testing.assert_allclose(heights, expected, rtol=0, atol=2e-4)  # 10 ms of a calm run
    assert page.complaints == []


def test_wheels_that_are_guided_are_where_the_model_has_them(opened):
    """Model 2: forward, sideways and up, from the states and outputs at the end of the run."""
    options = Options(model="2")
    result = run("nhtsa_fishhook", options=options, speed=SLOW, duration=2.0)
    page = opened(viewed(result, model="2"))
    simulation = Simulation(preset(), options)
    simulation.reset(SLOW)
    end = result.history
    found = np.array(page.at(float(end["time"][-1]))["wheels"])
    compressions = end.wheels("suspension_compression")[-1]
    travel = compressions - simulation.static_suspension_compression
    assert np.abs(travel).max() > 0.01
    expected = places_of_wheels(end, guided(options, travel))
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-5)  # positions of some 30 m
    assert page.complaints == []


def guided(options: Options, travel: np.ndarray) -> np.ndarray:
    """Places of the wheel centres in frame 1 by the equations of the model, shape (4, 3) (m)."""
    simulation = Simulation(preset(), options)
    simulation.reset(SLOW)
    state = simulation.state.copy()
    state["suspension_compression"] += travel
    record, outputs = preset().record(), simulation.outputs.copy()
    vector = np.ascontiguousarray(state).view(np.float64).ravel()
    look_up(vector, record[0], outputs)
    carriers(record[0], outputs)
    paths(record[0], outputs)
    return np.array(outputs["suspension_terms"]["wheel"]).reshape(3, 4).T


def places_of_wheels(history, places: np.ndarray) -> np.ndarray:
    """Turn and move points from frame 1 to the ground, for the last row of a history."""
    roll, pitch, yaw = (float(history[name][-1]) for name in ("roll", "pitch", "yaw"))
    (cr, cp, cy), (sr, sp, sy) = (f([roll, pitch, yaw]) for f in (np.cos, np.sin))
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    here = np.array([history[name][-1] for name in "xyz"])
    return places @ (about_z @ about_y @ about_x).T + here


@pytest.mark.parametrize(
    ("history", "title"),
    [
        (of_columns(1), HOSTILE),
        (of_columns(50, x=math.nan, roll=math.nan, z=math.nan), "nothing known"),
        (of_columns(50, lateral_acceleration=math.inf, z=1e300), "huge"),
    ],
    ids=["one row, hostile names", "nan", "infinite"],
)
def test_odd_runs_are_shown_and_nothing_in_them_is_run(opened, history, title):
    page = opened(viewed_history(history, title), title=title)
    assert page.complaints == []
    assert page("document.title") == title
    assert page("window.hacked") is None
    assert page("document.querySelectorAll('script').length") == 3
    assert page.at(0.2)["lamps"] == [True] * 4 + [False]  # it has no load at all


def test_a_model_without_heave_keeps_its_wheels_on_the_ground(opened):
    result = run("step_steer", options=Options(model="8dof"), duration=2.0)
    page = opened(ViewedRun(result.history, result.events, "8dof", scene("8dof")))
    record = preset().record()[0]
    heights = [place[2] for place in page.at(2.0)["wheels"]]
    at_rest = record.tire_radius - record.static_tire_compression
    np.testing.assert_allclose(heights, at_rest, rtol=0, atol=ROUNDING)
    assert page.complaints == []


def test_of_many_runs_the_reader_chooses_those_to_show(opened):
    runs = [viewed(fishhook(SLOW if k % 2 else FAST), f"run {k}") for k in range(5)]
    page = opened(*runs, shown=[2])
    boxes = "[...document.querySelectorAll('#choice input')]"
    ticked = f"{boxes}.map((each) => each.checked)"
    assert page(ticked) == [False, False, True, False, False]
    assert page("document.querySelector('#choice label').textContent") == " run 0 (rollover)"
    page(f"(document.getElementById('choice').open = true, {boxes}[4].click())")
    page.wait_for("document.querySelectorAll('#legend button').length === 2")
    assert page(ticked) == [False, False, True, False, True]
    legend = "[...document.querySelectorAll('#legend button')].map((each) => each.innerText.trim())"
    assert page(legend) == ["run 2", "run 4"]
    assert page.complaints == []


def test_a_point_on_the_map_of_a_study_opens_its_run(opened):
    """Five runs, of which the page has two; they differ in speed, one has an unknown event."""
    speeds = np.array([SLOW, 16.0, 18.0, 20.0, FAST])
    happened = np.array([0.0, 0.0, np.nan, 1.0, 1.0])
    quantities = [
        *(Quantity("speed (m/s)", speeds), Quantity("roll (rad)", speeds / 100)),
        Quantity(HOSTILE, happened, ("no", "yes")),
    ]
    study = StudyMap(np.arange(5), quantities, {0: 0, 4: 1}, (0, 1, 2))
    runs = [viewed(fishhook(SLOW), "run 0"), viewed(fishhook(FAST), "run 4")]
    page = opened(*runs, shown=[0], study=study)
    legend = "[...document.querySelectorAll('#legend button')].map((each) => each.innerText.trim())"
    assert page(legend) == ["run 0"]
    assert page("document.querySelectorAll('#map > svg circle').length") == 5
    assert page("document.querySelectorAll('#map circle.unknown').length") == 1
    slow, fast = page.driver.find_elements("css selector", "#map [role=button]")
    assert slow.location["x"] < fast.location["x"]
    assert slow.location["y"] > fast.location["y"]
    assert fast.get_attribute("aria-label").startswith("Open run 4: speed (m/s) 22, roll")
    fast.click()
    page.wait_for("document.querySelector('#legend button')?.innerText.trim() === 'run 4'")
    assert page.at(1e9)["lamps"] == [True] * 5
    page.driver.find_elements("css selector", "#map [role=button]")[0].send_keys("\ue008\ue007")
    page.wait_for("document.querySelectorAll('#legend button').length === 2")
    assert page(legend) == ["run 4", "run 0"]
    assert page("window.hacked") is None
    assert page.complaints == []


def test_without_webgl_all_but_the_vehicle_is_shown_and_the_page_says_so(opened, driver):
    source = """
        const { prototype } = HTMLCanvasElement, plain = prototype.getContext;
        prototype.getContext = function (kind) {
            return kind === "2d" ? plain.call(this, kind) : null;
        };
    """
    added = driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": source})
    try:
        page = opened(fishhook())
    finally:
        driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)
    assert "no WebGL" in page("document.getElementById('stage').innerText")
    state = page.at(float(fishhook().history["time"][-1]))
    assert (state["lamps"], state["wheels"]) == ([True] * 5, None)
    assert page("document.querySelectorAll('.panel').length") > 8


def test_wheels_stand_on_the_road_that_is_drawn_with_its_friction_and_its_tilt(opened):
    """On crests, between ice on the left and asphalt, on a table that tilts to the right."""
    page = opened(viewed(over_crests()))
    legend = "[...document.querySelectorAll('#surfaces li')].map((each) => each.innerText)"
    assert page(legend) == ["friction × 0.00", "friction × 1.00"]
    radius, heights = preset().record()[0].tire_radius[0], []
    for time in (0.3, 0.6, 0.9):
        for x, y, z in page.at(time)["wheels"]:
            heights.append(ROAD.surface(x, y)[0])
            # compressed by the load of a wheel, 20 mm at rest, or just off the ground
            assert -0.06 < z - heights[-1] - radius < 0.03
    assert max(heights) > 0.19
    page("(window.viewer.paint('light'), window.viewer.use('top'))")
    page.at(0.3)
    left, right = sides(picture_of(page))
    assert left[2] - left[0] > 60  # blue
    assert abs(right[2] - right[0]) < 30  # grey
    page("window.viewer.use('rear')")
    level, level_too = skies(picture_of(page))
    page.at(1.5)
    low, high = skies(picture_of(page))
    assert abs(level - level_too) < 0.02 < 0.1 < high - low
    assert "15.00" in page("document.getElementById('numbers').innerText")
    page("window.viewer.use('chase')")
    assert page.complaints == []


def sides(picture) -> tuple[np.ndarray, np.ndarray]:
    """Mean colours of the left and the right sixth of a picture, below what is written on it."""
    pixels = np.asarray(picture, float)
    height, width, _ = pixels.shape
    part = width // 6
    below = pixels[height // 2 : -height // 4]
    return below[:, :part].mean(axis=(0, 1)), below[:, -part:].mean(axis=(0, 1))


def skies(picture) -> tuple[float, float]:
    """How much of the left and the right edge of a picture has the colour of its upper corners."""
    pixels = np.asarray(picture, float)
    edges = pixels[:, 0], pixels[:, -1]
    return tuple(
        float((np.abs(edge - pixels[0, pixels.shape[1] // 2]).max(axis=1) < 8).mean())
        for edge in edges
    )
