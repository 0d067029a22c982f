"""Results appear under their name when they are whole; before that and on failure, nothing does."""

import errno
import os
from pathlib import Path

import pytest

from vehicle_roll_sim import InputError
from vehicle_roll_sim.simulation.output_file import check_writable, replaced_file

OLD, NEW = "old content", "new content"


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


def contents(folder) -> dict[str, str]:
    """Every file of a folder, hidden ones too."""
    return {entry.name: entry.read_text() for entry in folder.iterdir()}


def test_what_was_written_stands_under_the_name_and_nothing_beside_it(path):
    with replaced_file(path) as partial:
        partial.write_text(NEW)
    assert contents(path.parent) == {"result.csv": NEW}


def test_until_it_is_whole_the_name_shows_what_was_there_before(path):
    with replaced_file(path) as partial:
        partial.write_text(NEW)
        assert not path.exists()
    path.write_text(OLD)
    with replaced_file(path) as partial:
        partial.write_text(NEW)
        assert path.read_text() == OLD
    assert path.read_text() == NEW


def test_the_partial_file_is_in_the_same_folder_and_has_the_same_suffix(path):
    with replaced_file(path) as partial:
        assert partial != path
        assert (partial.parent.resolve(), partial.suffix) == (Path.cwd(), ".csv")


def write_and_fail(path, failure) -> None:
    with replaced_file(path) as partial:
        partial.write_text(NEW)
        raise failure


@pytest.mark.parametrize(
    ("failure", "raised"),
    [(OSError(errno.ENOSPC, "full"), InputError), (KeyboardInterrupt(), KeyboardInterrupt)],
)
@pytest.mark.parametrize("before", [{}, {"result.csv": OLD}], ids=["new", "existing"])
def test_after_a_failure_everything_is_as_it_was(path, failure, raised, before):
    for name, text in before.items():
        (path.parent / name).write_text(text)
    with pytest.raises(raised):
        write_and_fail(path, failure)
    assert contents(path.parent) == before


@pytest.mark.parametrize(("mask", "mode"), [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_its_permissions_are_those_of_any_new_file(path, umask, mask, mode):
    umask(mask)
    with replaced_file(path) as partial:
        partial.write_text(NEW)
    assert path.stat().st_mode & 0o777 == mode
    assert umask(mask) == mask  # as it was


def refused(path) -> str:
    with pytest.raises(InputError) as refusal:
        check_writable(path, "--csv")
    assert refusal.value.field == "--csv"
    message = str(refusal.value)
    assert str(path) in message
    assert len(message.splitlines()) == 1
    return message


def test_a_folder_is_no_place_for_a_result(path):
    path.mkdir()
    assert "folder" in refused(path)


@pytest.mark.parametrize("parent", ["none", "file"])
def test_neither_is_a_name_in_a_folder_that_is_none(path, parent):
    Path("file").write_text(OLD)
    assert f"{parent} does not" in refused(Path(parent) / path)


def test_nor_a_folder_that_may_not_be_written(path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda folder, how: how != os.W_OK)  # true for root, too
    assert "can be written" in refused(path)


def test_nor_what_is_no_file_such_as_a_pipe_or_a_device(path):
    os.mkfifo(path)
    refused(path)


@pytest.mark.parametrize("existing", [False, True])
def test_checking_makes_and_changes_nothing(path, existing):
    if existing:
        path.write_text(OLD)
    check_writable(path, "--csv")
    assert contents(path.parent) == ({"result.csv": OLD} if existing else {})
