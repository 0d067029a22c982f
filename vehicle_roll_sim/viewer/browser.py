"""Pictures of a page, taken with an installed Chromium or Chrome."""

import contextlib
import os
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path
from urllib.parse import urlencode

from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.input_errors import InputError, NotWrittenError

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
CAMERAS = ("chase", "rear", "top")
THEMES = ("light", "dark")
SIZE = (1280, 900)
"""Pixels of a picture."""
LONGEST = 120.0
"""s: time that the browser may take."""
LONGEST_END, LOOK = 2.0, 0.01
"""s: time that the processes of a killed browser may take to end, and interval between looks."""
SETTLED = 2000
"""ms of the page's own time before the picture is taken."""
OPTIONS = (
    *("--headless=new", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader"),
    *("--enable-unsafe-swiftshader", "--hide-scrollbars", "--force-device-scale-factor=1"),
    *("--no-first-run", "--disable-extensions", "--disable-background-networking"),
    "--disable-dev-shm-usage",  # which is small in containers
    "--disable-gpu-watchdog",  # which ends a browser that waits long for a busy processor
)
"""The picture does not depend on a graphics card, and nothing is fetched."""


def browser() -> str | None:
    """The path of the first browser found, or None."""
    return next((found for name in BROWSERS if (found := shutil.which(name))), None)


def need_browser(field: str) -> None:
    """Raise InputError naming `field` if there is no browser."""
    if browser() is None:
        allowed = "install Chromium or Chrome (Debian: apt install chromium)"
        raise InputError(field, "", allowed, f"none of {', '.join(BROWSERS)} is installed")


def environment_of_browser(folder: str) -> dict[str, str]:
    """The environment of a browser whose temporary files are in a folder.

    A browser that is killed leaves some behind.
    """
    return os.environ | {"TMPDIR": folder}


def options_of_browser() -> list[str]:
    """The options for a headless browser; root has no sandbox."""
    return [*OPTIONS, *(["--no-sandbox"] if os.geteuid() == 0 else [])]


def write_picture(page: Path, path: Path, moment: float, camera: str, theme: str) -> None:
    """Write a PNG of a page at a moment (s); raises NotWrittenError if the browser fails."""
    shown = urlencode({"time": repr(moment), "camera": camera, "theme": theme})
    # helpers of a browser that was just killed may still hold its profile
    folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
    with folder as profile, replaced_file(path) as partial:
        words = [
            str(browser()),
            *options_of_browser(),
            f"--user-data-dir={profile}",
            f"--window-size={SIZE[0]},{SIZE[1]}",
            f"--virtual-time-budget={SETTLED}",
            f"--screenshot={partial}",
            f"{page.resolve().as_uri()}#{shown}",
        ]
        try:
            _run(words, environment_of_browser(profile))
        except (OSError, subprocess.SubprocessError) as error:
            reason = f"{words[0]} failed ({type(error).__name__})"
            raise NotWrittenError("--png", "", "a browser that works", reason) from None
        if not partial.stat().st_size:
            raise NotWrittenError("--png", "", "a browser that works", f"{words[0]} wrote nothing")


def _run(words: list[str], environment: dict[str, str]) -> None:
    """Run a browser; if it takes too long or is interrupted, none of its processes goes on.

    Raises OSError and SubprocessError.
    """
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with subprocess.Popen(words, process_group=0, env=environment, **quiet) as process:
        try:
            status = process.wait(LONGEST)
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            _wait_for_end_of_group(process.pid)
            raise
    if status:
        raise subprocess.CalledProcessError(status, words)


def _wait_for_end_of_group(group: int) -> None:
    """Wait until a group that was killed has no process that could still write to the profile."""
    until = time.monotonic() + LONGEST_END
    with contextlib.suppress(ProcessLookupError):
        while time.monotonic() < until:
            os.killpg(group, 0)
            time.sleep(LOOK)
