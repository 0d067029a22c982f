"""Films of a page: pictures at equal distances of time, taken in a browser and put together."""

import base64
import collections
import contextlib
import importlib.util
import io
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from urllib.parse import urlencode

import numpy as np

from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.input_errors import InputError, NotWrittenError
from vehicle_roll_sim.viewer.browser import (
    SIZE,
    browser,
    environment_of_browser,
    need_browser,
    options_of_browser,
)

MP4, GIF = ".mp4", ".gif"
MOST_FRAMES = 3000
ROUNDING = 1e-6
"""Share of a picture by which the last one may come after the end."""
TICKS = 100
"""A GIF states how long a picture is shown as a number of 1/TICKS s."""
DRAWN = """
const [time, done] = arguments;
window.viewer.seek(time);
requestAnimationFrame(() => requestAnimationFrame(done));
"""
"""Shows a time (s) and waits until the picture has been drawn."""
ENCODER = (
    *("-loglevel", "error", "-f", "image2pipe", "-c:v", "png"),
    *("-i", "-", "-c:v", "libx264", "-pix_fmt", "yuv420p"),
    *("-movflags", "+faststart", "-f", "mp4", "-y"),
)
"""Options of ffmpeg that come after the frame rate: pictures from its input, a film to a file."""


def frame_count(begin: float, end: float, rate: float) -> int:
    """The number of pictures from `begin` to at most `end` (s). rate: in 1/s."""
    return int((end - begin) * rate + ROUNDING) + 1


def frame_times(begin: float, end: float, rate: float) -> np.ndarray:
    """The times of these pictures (s)."""
    return begin + np.arange(frame_count(begin, end, rate)) / rate


def need_for_film(kind: str, field: str) -> None:
    """Raise InputError naming `field` if something is missing. kind: MP4 or GIF."""
    need_browser(field)
    if importlib.util.find_spec("selenium") is None:
        allowed = "pip install selenium, or vehicle_roll_sim[film]"
        raise InputError(field, "", allowed, "no Python package selenium")
    wanted = {"chromedriver": "chromium-driver"} | ({"ffmpeg": "ffmpeg"} if kind == MP4 else {})
    for program, package in wanted.items():
        if shutil.which(program) is None:
            allowed = f"install it (Debian: apt install {package})"
            raise InputError(field, "", allowed, f"{program} is not installed")


def check_rate(rate: float, kind: str, field: str) -> None:
    """Raise InputError naming `field` for pictures per second that a kind of film cannot have."""
    if kind == GIF and TICKS % rate:
        raise InputError(
            field, rate, f"for a GIF a rate that divides {TICKS}, such as 10, 20 or 25"
        )


def write_film(
    page: Path, path: Path, times: Iterable[float], rate: float, camera: str, theme: str
) -> None:
    """Write a film of a page with a picture at each time (s); the suffix of `path` is its kind.

    rate: pictures per second when it is played. Raises NotWrittenError if a program fails.
    """
    encode = _write_gif if path.suffix.lower() == GIF else _write_mp4
    with (
        replaced_file(path) as partial,
        contextlib.closing(_pictures(page, times, camera, theme)) as pictures,
    ):
        encode(pictures, partial, rate)


def _pictures(page: Path, times: Iterable[float], camera: str, theme: str) -> Iterator[bytes]:
    """Pictures of a page as PNG, SIZE pixels large."""
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException

    options = webdriver.ChromeOptions()
    options.binary_location = browser()
    for each in options_of_browser():
        options.add_argument(each)
    size = {"width": SIZE[0], "height": SIZE[1], "deviceScaleFactor": 1, "mobile": False}
    shown = urlencode({"camera": camera, "theme": theme})
    try:
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            service = webdriver.ChromeService(
                executable_path=shutil.which("chromedriver"), env=environment_of_browser(folder)
            )
            driver = webdriver.Chrome(options=options, service=service)
            try:
                driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
                driver.get(f"{page.resolve().as_uri()}#{shown}")
                for time in times:
                    driver.execute_async_script(DRAWN, float(time))
                    taken = driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})
                    yield base64.b64decode(taken["data"])
            finally:
                driver.quit()
    except (OSError, WebDriverException) as error:
        reason = f"{browser()} failed ({type(error).__name__})"
        raise NotWrittenError(f"film of {page}", "", "a browser that works", reason) from None


def _write_gif(pictures: Iterable[bytes], path: Path, rate: float) -> None:
    from PIL import Image

    opened = (Image.open(io.BytesIO(each)).convert("RGB") for each in pictures)
    plain = (each.quantize(256, dither=Image.Dither.NONE) for each in opened)
    duration = 1000 / rate  # ms
    next(plain).save(path, save_all=True, append_images=plain, duration=duration, loop=0)


def _write_mp4(pictures: Iterable[bytes], path: Path, rate: float) -> None:
    program = str(shutil.which("ffmpeg"))
    words = [program, "-framerate", repr(rate), *ENCODER, str(path)]
    with tempfile.TemporaryFile() as said:
        encoder = subprocess.Popen(words, stdin=subprocess.PIPE, stderr=said)
        try:
            with contextlib.suppress(BrokenPipeError), encoder.stdin as stream:
                for each in pictures:
                    stream.write(each)
        except BaseException:
            encoder.kill()
            raise
        finally:
            status = encoder.wait()
        if status:
            said.seek(0)
            last = b"".join(collections.deque(said, maxlen=1)).decode(errors="replace").strip()
            problem = f"{program} failed: {last or status}"
            raise NotWrittenError(f"film {path}", "", "an ffmpeg that works", problem)
