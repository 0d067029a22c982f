"""The page in a real browser, with a renderer that needs no graphics card."""

import base64
import contextlib
import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from viewed_runs import fishhook

from vehicle_roll_sim import preset
from vehicle_roll_sim.model.records import WHEELS

pytestmark = pytest.mark.unmeasured

PICTURE = Path(__file__).with_name("fishhook.png")
PICTURE_TIME = 1.9
"""s: in the run of the kept picture, with two wheels high above the ground."""
ROUNDING = 1e-6
"""m: of 32-bit numbers that are below 100 m."""
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
    keys.send_keys("1iot+-")
    assert page.complaints == []


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


def test_dragging_frees_the_camera(page):
    page("window.viewer.use('top')")
    canvas = page.driver.find_element("id", "picture")
    page.driver.execute_script("arguments[0].scrollIntoView()", canvas)
    page.drag(canvas, 40, -30)
    pressed = "document.querySelector('[data-camera][aria-pressed=true]').textContent"
    assert page(pressed) == "free"
    page("window.viewer.use('chase')")
