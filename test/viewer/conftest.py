"""A headless browser for the module, and pages opened in it."""

import json
import os
import shutil

import pytest
from patience import PATIENCE
from viewed_runs import viewed

from vehicle_roll_sim.viewer.browser import browser as found_browser
from vehicle_roll_sim.viewer.browser import options_of_browser
from vehicle_roll_sim.viewer.page import write_page

SIZE = (1280, 900)
DRIVER = "GL Driver Message"
"""What the software renderer says of its own speed."""


class OpenPage:
    """A page in the browser."""

    def __init__(self, driver, address: str):
        self.driver = driver
        for kind in ("browser", "performance"):
            driver.get_log(kind)  # of the page before
        driver.get(address)

    def __call__(self, script: str, *arguments):
        """The value of a JavaScript expression."""
        return self.driver.execute_script(f"return ({script})", *arguments)

    def wait_for(self, condition: str) -> None:
        """Wait until a condition holds, also on a page that is opened anew."""
        from selenium.webdriver.support.wait import WebDriverWait

        WebDriverWait(self.driver, PATIENCE).until(lambda _: self(condition))

    def drag(self, element, right: int, down: int) -> None:
        """Press the pointer in the middle of an element and move it (pixels)."""
        from selenium.webdriver import ActionChains

        actions = ActionChains(self.driver).move_to_element(element).click_and_hold()
        actions.move_by_offset(right, down).release().perform()

    @property
    def state(self) -> dict:
        return self("window.viewer.state()")

    def at(self, time: float) -> dict:
        """The state at a time (s)."""
        return self("(window.viewer.seek(arguments[0]), window.viewer.state())", time)

    @property
    def complaints(self) -> list[str]:
        """What is on the console."""
        said = (entry["message"] for entry in self.driver.get_log("browser"))
        return [message for message in said if DRIVER not in message]

    @property
    def requests(self) -> list[str]:
        """The addresses that were asked for."""
        entries = (json.loads(each["message"]) for each in self.driver.get_log("performance"))
        return [
            entry["message"]["params"]["request"]["url"]
            for entry in entries
            if entry["message"]["method"] == "Network.requestWillBeSent"
        ]


def _why_not() -> str:
    """Why there is no browser to test with, or ''."""
    try:
        import selenium  # noqa: F401
    except ImportError:
        return "selenium is not installed"
    programs = {"Chromium or Chrome": found_browser(), "chromedriver": shutil.which("chromedriver")}
    missing = [name for name, path in programs.items() if path is None]
    return f"not installed: {', '.join(missing)}" if missing else ""


@pytest.fixture(scope="session")
def driver():
    """A headless browser; where there is none its tests are skipped, but not by `.ci/run`."""
    if reason := _why_not():
        if os.environ.get("VIEWER_TESTS") == "required":
            pytest.fail(reason)
        pytest.skip(reason)
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.binary_location = found_browser()
    for each in (*options_of_browser(), f"--window-size={SIZE[0]},{SIZE[1]}"):
        options.add_argument(each)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    service = webdriver.ChromeService(executable_path=shutil.which("chromedriver"))
    driver = webdriver.Chrome(options=options, service=service)
    yield driver
    driver.quit()


@pytest.fixture(scope="module")
def opened(driver, tmp_path_factory):
    """opened(*runs, title, cones): a page with these runs, in the browser."""

    def call(*runs, title: str = "run", **settings) -> OpenPage:
        path = tmp_path_factory.mktemp("page") / "page.html"
        write_page(path, [viewed(run) for run in runs], title, **settings)
        return OpenPage(driver, path.as_uri())

    return call


@pytest.fixture
def opened_at(driver):
    """opened_at(address): the page at an address, in the browser, which leaves it afterwards."""
    yield lambda address: OpenPage(driver, address)
    driver.get("about:blank")
