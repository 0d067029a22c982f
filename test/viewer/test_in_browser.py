"""The page in a real browser, with a renderer that needs no graphics card."""

import base64
import contextlib
import io
import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from viewed_runs import FAST, SLOW, fishhook, of_columns, scene, viewed, viewed_history

from vehicle_roll_sim import preset, run
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.viewer.recording import ViewedRun

pytestmark = pytest.mark.unmeasured

PICTURE = Path(__file__).with_name("fishhook.png")
PICTURE_TIME = 1.9
"""s: in the run of the kept picture, with two wheels high above the ground."""
ROUNDING = 1e-6
"""m: of 32-bit numbers that are below 100 m."""
HOSTILE = "</script><script>window.hacked = 1</script><img src=x onerror='window.hacked = 1'>&amp;"
UNNAMED = """[...document.querySelectorAll("button, input, select, canvas, section")].filter(
    (each) => !each.getAttribute("aria-label") && !(each.textContent.trim())
        && !each.labels?.length).length"""


@pytest.fixture(scope="module")
def page(opened):
    """The fishhook that ends in rollover; each test sets the time that it looks at."""
    return opened(fishhook())


def test_a_page_opens_without_complaint_and_asks_for_nothing_but_itself(opened):
    page = opened(fishhook(), title="a fishhook")
    assert page.complaints == []
    (address,) = page.requests
    assert address.startswith("file:///")
    assert page("document.title") == "a fishhook"


def test_a_wheel_is_as_high_as_in_the_run(page):
    """In model 1 a wheel centre is one tire radius less the tire compression above the ground."""
    history, radius = fishhook().history, preset().record()[0].tire_radius
    for row in (0, 120, 180, 200, len(history.rows) - 1):
        state = page.at(float(history["time"][row]))
        heights = [place[2] for place in state["wheels"]]
        expected = radius - history.wheels("tire_compression")[row]
        np.testing.assert_allclose(heights, expected, rtol=0, atol=ROUNDING)
    assert max(heights) > 1.0  # it has rolled over


def test_a_click_on_a_lift_off_goes_to_its_time_and_the_lamp_lights(page):
    lift_off = fishhook().events.lift_off_time
    first = int(np.nanargmin(lift_off))
    assert not page.at(lift_off[first] - 0.002)["lamps"][first]
    page.driver.find_element("css selector", "#event-list button").click()
    state = page.state
    assert state["time"] == lift_off[first]
    assert state["lamps"] == [wheel == first for wheel in range(4)] + [False]
    lit = page("[...document.querySelectorAll('.lamp.on')].map((each) => each.textContent)")
    assert lit == [WHEELS[first]]
    assert f"{WHEELS[first]} off the ground" in page("document.getElementById('spoken').innerText")


def test_the_lamp_of_the_rollover_stays_on_from_then_on(page):
    time = fishhook().events.rollover_time[0]
    assert not page.at(time - 0.001)["lamps"][-1]
    assert page.at(time)["lamps"][-1]
    assert page.at(1e9)["lamps"] == [True] * 5


def test_it_plays_to_the_end_and_stops(page):
    page.at(0.0)
    page("window.viewer.play(true)")
    page.driver.set_script_timeout(60)
    end = page.driver.execute_async_script(
        "const done = arguments[0], look = () => (window.viewer.state().isPlaying"
        " ? requestAnimationFrame(look) : done(window.viewer.state().time)); look();"
    )
    assert end == fishhook().history["time"][-1]


def test_keys_step_by_samples_and_go_to_events(page):
    time, keys = fishhook().history["time"], page.driver.find_element("css selector", "body")
    page.at(float(time[100]))
    keys.send_keys("\ue014")  # arrow to the right
    assert page.state["time"] == time[101]
    keys.send_keys("\ue012\ue012")  # arrow to the left
    assert page.state["time"] == time[99]
    keys.send_keys("n")
    assert page.state["time"] == np.nanmin(fishhook().events.lift_off_time)
    keys.send_keys("3")
    assert page("document.querySelector('[aria-pressed=true][data-camera]').textContent") == "top"
    keys.send_keys("1")


def test_a_press_on_a_plot_goes_to_that_time_and_its_values_are_those_of_the_run(page):
    canvas = page.driver.find_elements("css selector", ".panel canvas")[1]
    page.driver.execute_script("arguments[0].scrollIntoView()", canvas)
    canvas.click()  # in its middle
    time, history = page.state["time"], fishhook().history
    assert 0.4 < time / history["time"][-1] < 0.5  # the axis has its labels on the left
    title, value = page(
        "[...document.querySelectorAll('.panel')[1].querySelectorAll('figcaption > span')]"
        ".map((each) => each.textContent)"
    )
    assert title == "roll angle (deg)"
    roll = np.degrees(np.interp(time, history["time"], history["roll"]))
    assert float(value) == pytest.approx(roll, abs=0.006)  # two decimals


def test_the_plots_show_a_part_of_the_time_about_the_cursor_and_follow_it(page):
    page.at(1.5)
    zoom = "document.querySelector('[data-zoom=\"{}\"]').click()"
    page(zoom.format(4))
    canvas = page.driver.find_elements("css selector", ".panel canvas")[1]
    page.driver.execute_script("arguments[0].scrollIntoView()", canvas)
    quarter = fishhook().history["time"][-1] / 4
    try:
        canvas.click()
        assert abs(page.state["time"] - 1.5) < 0.1 * quarter
        page.at(0.2)  # outside: the plots turn to it
        canvas.click()
        assert 0.2 - 0.1 * quarter < page.state["time"] < 0.2 + quarter
    finally:
        page(zoom.format(0))


def test_everything_has_a_name_for_a_screen_reader(page):
    assert page(UNNAMED) == 0
    label = page("document.querySelectorAll('.panel canvas')[1].getAttribute('aria-label')")
    assert label.startswith("roll angle (deg) over time. fishhook: 0.00 to 85")


def test_a_telephone_needs_no_scrolling_to_the_side(page):
    with size_of(page, 390, 844):
        assert page("document.documentElement.scrollWidth") == 390


def test_the_picture_is_the_kept_one(page, tmp_path):
    """On average within 3 of 255 levels: renderers smooth edges in their own ways.

    An empty stage, or one without the vehicle, is off by more than 10.
    """
    with size_of(page, 1024, 768):
        page.at(PICTURE_TIME)
        page("(window.viewer.paint('light'), window.viewer.use('chase'))")
        found = picture_of(page)
    found.save(tmp_path / "found.png")
    kept = np.asarray(Image.open(PICTURE).convert("RGB"), float)
    assert found.size == Image.open(PICTURE).size
    difference = np.abs(np.asarray(found, float) - kept).mean()
    assert difference < 3.0, f"if it should look like this, keep {tmp_path}/found.png"


@contextlib.contextmanager
def size_of(page, width: int, height: int):
    """Give the page a size in pixels, whatever the browser adds to its window."""
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500}
    page.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    page.driver.execute_async_script("requestAnimationFrame(() => setTimeout(arguments[0]))")
    try:
        yield
    finally:
        page.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def picture_of(page) -> Image.Image:
    """The stage, at half its size."""
    address = page(
        "(window.viewer.render(), document.getElementById('picture').toDataURL('image/png'))"
    )
    content = base64.b64decode(address.partition(",")[2])
    picture = Image.open(io.BytesIO(content)).convert("RGB")
    return picture.resize((picture.width // 2, picture.height // 2), Image.Resampling.BOX)


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
    from vehicle_roll_sim.model.kinematic.guidance import carriers, look_up, paths

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
    ("viewed_run", "title"),
    [
        (viewed_history(of_columns(1), HOSTILE), HOSTILE),
        (viewed_history(of_columns(50, x=math.nan, roll=math.nan, z=math.nan)), "nothing known"),
        (viewed_history(of_columns(50, lateral_acceleration=math.inf, z=1e300)), "huge"),
    ],
    ids=["one row, hostile names", "nan", "infinite"],
)
def test_odd_runs_are_shown_and_nothing_in_them_is_run(opened, viewed_run, title):
    page = opened(viewed_run, title=title)
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


def test_dragging_frees_the_camera(page):
    page("window.viewer.use('top')")
    canvas = page.driver.find_element("id", "picture")
    page.driver.execute_script("arguments[0].scrollIntoView()", canvas)
    page.drag(canvas, 40, -30)
    pressed = "document.querySelector('[data-camera][aria-pressed=true]').textContent"
    assert page(pressed) == "free"
    page("window.viewer.use('chase')")
