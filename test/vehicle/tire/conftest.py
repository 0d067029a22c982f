"""For tests of tire files: readers of what becomes of a text."""

import pytest
from tire_texts import BASE
from vehicle_files import write

from vehicle_roll_sim import load_tire


@pytest.fixture
def read(tmp_path):
    """read(text or bytes, ...): the tire in a file with that content."""
    path = tmp_path / "some.tir"
    return lambda content, **options: load_tire(write(tmp_path, path.name, content), **options)


@pytest.fixture
def base(read):
    return read(BASE)
