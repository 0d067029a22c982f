"""Vehicle and tire files written by the tests, and the form of every refusal."""

import contextlib
from pathlib import Path

import pytest

from vehicle_roll_sim import InputError
from vehicle_roll_sim.vehicle.vehicle_file import PRESETS

REFERENCE_YAML = (PRESETS / "reference.yaml").read_text()
REFERENCE_TIR = (PRESETS / "reference.tir").read_text()


def edited(text: str, name: str, line: str) -> str:
    """The file with the only line that starts with `name` replaced by `line`."""
    lines = text.splitlines()
    matches = [n for n, old in enumerate(lines) if old.replace(":", " ").split()[:1] == [name]]
    assert len(matches) == 1, f"{name} stands {len(matches)} times"
    lines[matches[0]] = line
    return "\n".join(lines) + "\n"


def line_of(text: str, name: str) -> str:
    """How a refusal says in which line `name` begins, the last one of them."""
    numbers = [n for n, line in enumerate(text.splitlines(), 1) if line.startswith(name)]
    return f" line {numbers[-1]}:"


def write(folder: Path, name: str, content: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@contextlib.contextmanager
def refused(*names: str):
    """The block raises InputError, in one line that says all of `names`."""
    with pytest.raises(InputError) as refusal:
        yield refusal
    message = str(refusal.value)
    assert len(message.splitlines()) == 1, message
    assert message.isprintable(), message
    for name in names:
        assert str(name) in message, f"{name!r} is not in {message!r}"
