"""Films: their times, their pictures in a real browser, and the programs that put them together."""

import io
import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image, ImageSequence
from viewed_runs import fishhook, viewed

from vehicle_roll_sim.input_errors import NotWrittenError
from vehicle_roll_sim.viewer import browser, film
from vehicle_roll_sim.viewer.browser import SIZE, write_picture
from vehicle_roll_sim.viewer.film import frame_times, write_film
from vehicle_roll_sim.viewer.page import write_page

COLOURS = ("red", "lime", "blue", "white")
TIMES = (1.2, 1.6, 2.0)
"""s: the vehicle upright, lifted and on its side."""


@pytest.fixture
def page(tmp_path):
    path = tmp_path / "page.html"
    write_page(path, [viewed(fishhook())], "film")
    return path


@pytest.fixture
def plain_pictures(monkeypatch):
    """Pictures of one colour each, in place of those of a browser; returned as PNG."""

    def made(name: str) -> bytes:
        content = io.BytesIO()
        Image.new("RGB", (64, 48), name).save(content, "png")
        return content.getvalue()

    pictures = [made(name) for name in COLOURS]
    monkeypatch.setattr(film, "_pictures", lambda *arguments: (each for each in pictures))
    return pictures


@pytest.fixture
def encoder(tmp_path, monkeypatch):
    """encoder(script): a program that is found as ffmpeg."""

    def call(script: str) -> None:
        path = tmp_path / "bin" / "ffmpeg"
        path.parent.mkdir()
        path.write_text(f"#!/bin/sh\n{script}\n")
        path.chmod(0o755)
        monkeypatch.setenv("PATH", str(path.parent), prepend=":")

    return call


def levels(picture: Image.Image) -> np.ndarray:
    return np.asarray(picture.convert("RGB"), float)


def test_pictures_are_at_equal_distances_from_begin_to_end():
    np.testing.assert_allclose(frame_times(0.5, 0.8, 10), [0.5, 0.6, 0.7, 0.8], rtol=0, atol=1e-15)
    np.testing.assert_allclose(frame_times(0.0, 0.29, 12.5), [0.0, 0.08, 0.16, 0.24], rtol=1e-15)
    assert frame_times(3.0, 3.0, 20).tolist() == [3.0]


@pytest.mark.unmeasured
def test_the_pictures_of_a_film_are_those_of_the_page_at_their_times(driver, page, tmp_path):
    """A palette of 256 colours changes a level by less than 3 of 255 on average."""
    write_film(page, tmp_path / "film.gif", TIMES, 2.5, "rear", "dark")
    with Image.open(tmp_path / "film.gif") as found:
        assert (found.size, found.n_frames, found.info["loop"]) == (SIZE, len(TIMES), 0)
        frames = [(levels(each), each.info["duration"]) for each in ImageSequence.Iterator(found)]
    assert [duration for _, duration in frames] == [400] * len(TIMES)
    write_picture(page, tmp_path / "one.png", TIMES[1], "rear", "dark")
    with Image.open(tmp_path / "one.png") as single:
        expected = levels(single)
    before, there, after = (np.abs(frame - expected).mean() for frame, _ in frames)
    assert there < 3.0
    assert min(before, after) > 2.0 * there


def test_ffmpeg_gets_the_pictures_one_after_the_other(page, tmp_path, plain_pictures, encoder):
    encoder('for last; do :; done; echo "$@" > "$0.words"; cat > "$last"')
    write_film(page, tmp_path / "film.mp4", [0.0] * 4, 12.5, "rear", "dark")
    assert (tmp_path / "film.mp4").read_bytes() == b"".join(plain_pictures)
    assert (tmp_path / "bin/ffmpeg.words").read_text().startswith("-framerate 12.5 ")


def test_an_ffmpeg_that_fails_leaves_no_film_and_says_why(page, tmp_path, plain_pictures, encoder):
    encoder("echo first >&2; echo no such encoder >&2; exit 1")
    with pytest.raises(NotWrittenError, match="ffmpeg failed: no such encoder: an ffmpeg that"):
        write_film(page, tmp_path / "film.mp4", [0.0] * 4, 20, "rear", "dark")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bin", "page.html"]


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")
def test_a_film_of_ffmpeg_has_the_pictures_that_it_was_given(page, tmp_path, plain_pictures):
    """Within 8 of 255 levels: brightness and colours are rounded, and compressed."""
    write_film(page, tmp_path / "film.mp4", [0.0] * 4, 20.0, "rear", "dark")
    words = ("-i", tmp_path / "film.mp4", "-f", "rawvideo", "-pix_fmt", "rgb24", "-")
    read = subprocess.run(["ffmpeg", "-v", "error", *words], capture_output=True, check=True)
    found = np.frombuffer(read.stdout, np.uint8).reshape(-1, 48, 64, 3).astype(float)
    expected = [levels(Image.open(io.BytesIO(each))) for each in plain_pictures]
    np.testing.assert_allclose(found, expected, rtol=0, atol=8.0)


@pytest.mark.usefixtures("driver")
def test_a_browser_that_fails_leaves_no_film(page, tmp_path, monkeypatch):
    monkeypatch.setattr(browser, "BROWSERS", ("false",))
    with pytest.raises(NotWrittenError, match="false failed"):
        write_film(page, tmp_path / "film.gif", TIMES, 20, "rear", "dark")
    assert [path.name for path in tmp_path.iterdir()] == ["page.html"]
