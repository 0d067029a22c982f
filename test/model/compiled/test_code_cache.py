"""Compiled code on disk: with any defect, the program still runs correctly and reports it."""

import os
import resource
import shutil
import subprocess
import sys

import pytest
from patience import PATIENCE

from vehicle_roll_sim.model.compiled import jit

pytestmark = pytest.mark.skipif(not jit.COMPILED, reason="only compiled code is cached")
SHOW_CACHE = "from vehicle_roll_sim.model.compiled import jit; print(jit.CACHE)"


def doubled(x):
    return 2.0 * x


def tripled(x):
    return 3.0 * x


@pytest.fixture
def folder(monkeypatch, tmp_path):
    """A cache of its own, as in a process that has said nothing yet."""
    monkeypatch.setattr(jit, "CACHE", tmp_path)
    monkeypatch.setattr(jit.code_cache, "_said", set())
    return tmp_path


def compiled_kernel():
    """The function compiled, or read from the cache: as a new process would have it."""
    kernel = jit.kernel(doubled)
    assert kernel(21.0) == 42.0
    return kernel


def is_from_cache(kernel) -> bool:
    return sum(kernel.stats.cache_hits.values()) == 1


def test_what_was_compiled_is_read_again(folder, capsys):
    assert not is_from_cache(compiled_kernel())
    assert is_from_cache(compiled_kernel())
    assert capsys.readouterr().err == ""


def flip(data: bytes, place: int) -> bytes:
    return data[:place] + bytes([data[place] ^ 1]) + data[place + 1 :]


DAMAGE = {
    "empty": lambda data: b"",
    "cut": lambda data: data[: len(data) // 2],
    "garbage": lambda data: b"\x80\x04garbage." * 100,
    "a bit in front": lambda data: flip(data, 3),
    "a bit in the middle": lambda data: flip(data, len(data) // 2),
    "a bit at the end": lambda data: flip(data, len(data) - 1),
    "more": lambda data: data + b"x",
}


@pytest.mark.parametrize("kind", ["nbi", "nbc"])
@pytest.mark.parametrize("damage", DAMAGE.values(), ids=DAMAGE)
def test_damaged_code_is_made_anew_with_one_line(folder, capsys, kind, damage):
    compiled_kernel()
    (file,) = folder.rglob(f"*.{kind}")
    file.write_bytes(damage(file.read_bytes()))
    assert not is_from_cache(compiled_kernel())
    (line,) = capsys.readouterr().err.splitlines()
    assert "is damaged and is recompiled" in line
    assert is_from_cache(compiled_kernel())
    assert capsys.readouterr().err == ""


def test_files_that_changed_places_are_damaged(folder, capsys):
    compiled_kernel()
    jit.kernel(tripled)(1.0)
    first, second = folder.rglob("*.nbc")
    content = first.read_bytes()
    first.write_bytes(second.read_bytes())
    second.write_bytes(content)
    assert not is_from_cache(compiled_kernel())
    assert "is damaged" in capsys.readouterr().err


def test_code_that_is_gone_is_made_anew(folder):
    compiled_kernel()
    (file,) = folder.rglob("*.nbc")
    file.unlink()
    assert not is_from_cache(compiled_kernel())
    assert is_from_cache(compiled_kernel())


def test_a_folder_in_place_of_a_file_costs_a_line_each_for_reading_and_writing(folder, capsys):
    compiled_kernel()
    (file,) = folder.rglob("*.nbc")
    file.unlink()
    file.mkdir()
    compiled_kernel()
    assert len(capsys.readouterr().err.splitlines()) == 2


def test_a_disk_that_fills_up_costs_a_line_and_no_run(folder, capsys, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(jit.code_cache.IndexDataCacheFile, "_open_for_write", full)
    compiled_kernel()
    compiled_kernel()
    (line,) = capsys.readouterr().err.splitlines()
    assert "No space left on device" in line
    assert jit.code_cache.troubled()


def test_a_folder_that_vanishes_is_made_again(folder):
    kernel = jit.kernel(doubled)
    shutil.rmtree(folder)
    assert kernel(21.0) == 42.0
    assert is_from_cache(compiled_kernel())


def test_without_room_for_all_of_it_nothing_is_begun_and_one_line_says_so(tmp_path):
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000_000, 20_000_000))

    shown = subprocess.run(
        [sys.executable, "-c", SHOW_CACHE],
        env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        preexec_fn=limit,
    )
    assert shown.stdout == "None\n"
    (line,) = shown.stderr.splitlines()
    assert "File too large" in line
    assert "compiled at every start" in line
