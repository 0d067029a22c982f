"""Pictures and films of the page that `view` writes."""

import argparse
import dataclasses
from collections.abc import Sequence
from pathlib import Path

from tqdm import tqdm

from vehicle_roll_sim.arguments import add_declared, declared_values, named_file
from vehicle_roll_sim.command_line import signals
from vehicle_roll_sim.command_line.recorded_runs import check_output
from vehicle_roll_sim.declaration import InputError, parameter
from vehicle_roll_sim.files.output_file import check_distinct
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.viewer.browser import CAMERAS, THEMES, need_browser, write_picture
from vehicle_roll_sim.viewer.film import (
    MOST_FRAMES,
    check_rate,
    frame_count,
    frame_times,
    need_for_film,
    write_film,
)

TITLE = "pictures"
NEEDED = {"--mp4": ", chromedriver and ffmpeg", "--gif": " and chromedriver"}
"""Options of the films, and what they need."""
DEPENDENT = {"camera": ("png", "mp4", "gif"), "theme": ("png", "mp4", "gif"), "fps": ("mp4", "gif")}
"""Settings and the results of which they need one."""


@dataclasses.dataclass(frozen=True)
class PictureSettings:
    """The picture that is taken of the page, or the film."""

    png: float | None = parameter(
        "also write a picture of the page at this time, named like the page but with .png; needs "
        "Chromium or Chrome",
        "s",
        0.0,
        1e10,
        default=None,
    )
    camera: str = parameter("camera of picture and film", choices=CAMERAS, default=CAMERAS[0])
    theme: str = parameter("colours of picture and film", choices=THEMES, default=THEMES[0])
    fps: float = parameter("pictures per second of the film", "1/s", 1.0, 60.0, default=20.0)


@dataclasses.dataclass(frozen=True)
class Pictures:
    """What is made of a page besides itself. films: by the option that names the file."""

    page: Path
    settings: PictureSettings
    films: dict[str, Path]

    def check_times(self, begin: float, end: float) -> None:
        """Raise InputError for a time, or a number of pictures, that the runs (s) do not have."""
        png, fps = self.settings.png, self.settings.fps
        if png is not None and not begin <= png <= end:
            raise InputError("--png", png, f"a time of the runs, {begin:g} to {end:g} s")
        count = frame_count(begin, end, fps)
        if self.films and count > MOST_FRAMES:
            allowed = f"at most {MOST_FRAMES}: a lower --fps, or a part from --begin to --end"
            raise InputError(next(iter(self.films)), f"{count} pictures", allowed)

    def write(self, begin: float, end: float) -> None:
        """Write everything from the page, and say what was written. begin, end: of the runs (s)."""
        look = {"camera": self.settings.camera, "theme": self.settings.theme}
        if self.settings.png is not None:
            picture = self.page.with_suffix(".png")
            write_picture(self.page, picture, self.settings.png, **look)
            print(line("picture", picture))
        for film in self.films.values():
            times = frame_times(begin, end, self.settings.fps)
            with (
                signals.raise_on_signal(),
                tqdm(times, delay=1.0, disable=None, leave=False, unit=" pictures") as shown,
            ):
                write_film(self.page, film, shown, self.settings.fps, **look)
            print(line("film", film))


def add_pictures(parser: argparse.ArgumentParser) -> None:
    """Add the options that `pictures_of` reads."""
    group = parser.add_argument_group(TITLE)
    for option, needed in NEEDED.items():
        about = f"also write a film of the page; needs Chromium or Chrome, selenium{needed}"
        group.add_argument(option, metavar="FILE", help=about)
    add_declared(parser, PictureSettings, TITLE)


def pictures_of(arguments: argparse.Namespace, page: Path, files: Sequence[Path]) -> Pictures:
    """What is to be made of a page of these files, checked; raises InputError."""
    settings = declared_values(arguments, PictureSettings)
    named = {option: named_file(getattr(arguments, option[2:]), option) for option in NEEDED}
    films = {option: file for option, file in named.items() if file is not None}
    wanted = {*settings} | {option[2:] for option in films}
    for name, results in DEPENDENT.items():
        if name in settings and not wanted & {*results}:
            allowed = "together with " + " or ".join(f"--{each}" for each in results)
            raise InputError(f"--{name}", "", allowed, "no picture")
    found = Pictures(page, PictureSettings(**settings), films)
    for option, file in films.items():
        _check_film(option, file, found.settings.fps, files)
    if "png" in settings:
        check_output(page.with_suffix(".png"), "--png", files)
        need_browser("--png")
    check_distinct({"--out": page, **films})
    return found


def _check_film(option: str, file: Path, fps: float, files: Sequence[Path]) -> None:
    kind = f".{option[2:]}"
    if file.suffix.lower() != kind:
        raise InputError(option, str(file), f"a file name ending in {kind}")
    check_output(file, option, files)
    check_rate(fps, kind, "--fps")
    need_for_film(kind, option)
