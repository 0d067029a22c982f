"""Helpers: written results, the content of a folder, and the message that refuses a name."""

import pytest

from vehicle_roll_sim import InputError
from vehicle_roll_sim.files.output_file import check_writable

OLD, NEW = "old content", "new content"


def contents(folder) -> dict[str, str]:
    """Every file of a folder, hidden ones too."""
    return {entry.name: entry.read_text() for entry in folder.iterdir()}


def refused(path, check=check_writable) -> str:
    with pytest.raises(InputError) as refusal:
        check(path, "--csv")
    assert refusal.value.field == "--csv"
    message = str(refusal.value)
    assert str(path) in message
    assert len(message.splitlines()) == 1
    return message
