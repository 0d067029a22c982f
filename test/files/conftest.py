"""The folder for the tests of files."""

import os
from pathlib import Path

import pytest


@pytest.fixture
def umask():
    """Sets the umask of the process until the end of the test."""
    before = os.umask(0o022)
    yield os.umask
    os.umask(before)


@pytest.fixture
def path(tmp_path, monkeypatch):
    """A name in an empty folder; short, so that messages show it whole."""
    monkeypatch.chdir(tmp_path)
    return Path("result.csv")
