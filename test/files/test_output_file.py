"""Results appear under their name when complete; before that and on failure, nothing does."""

import errno
import os
from pathlib import Path

import pytest
from written import NEW, OLD, contents, refused

from vehicle_roll_sim import InputError
from vehicle_roll_sim.files.output_file import (
    check_writable,
    filled_folder,
    new_folder,
    replaced_file,
)


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


def test_a_folder_is_no_place_for_a_result(path):
    path.mkdir()
    assert "folder" in refused(path)


@pytest.mark.parametrize("parent", ["none", "file"])
def test_neither_is_a_name_in_a_folder_that_is_none(path, parent):
    Path("file").write_text(OLD)
    assert f"{parent} does not" in refused(Path(parent) / path)


def test_nor_a_folder_that_may_not_be_written(path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda folder, how: how != os.W_OK)  # true for root, too
    assert "not writable" in refused(path)


def test_nor_what_is_no_file_such_as_a_pipe_or_a_device(path):
    os.mkfifo(path)
    refused(path)


@pytest.mark.parametrize("existing", [False, True])
def test_checking_makes_and_changes_nothing(path, existing):
    if existing:
        path.write_text(OLD)
    check_writable(path, "--csv")
    assert contents(path.parent) == ({"result.csv": OLD} if existing else {})


def test_a_link_that_leads_in_a_circle_is_refused(path):
    path.symlink_to(path.name)
    assert "symbolic links" in refused(path)


@pytest.mark.parametrize(
    ("method", "writing"),
    [
        ("touch", replaced_file),
        ("mkdir", filled_folder),
        ("mkdir", lambda path: new_folder(path, "--bag")),
    ],
    ids=["file", "folder", "new folder"],
)
def test_an_interruption_as_soon_as_something_is_there_leaves_nothing(
    path, monkeypatch, method, writing
):
    make = getattr(Path, method)

    def make_and_be_interrupted(self, *words, **options):
        make(self, *words, **options)
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, method, make_and_be_interrupted)
    with pytest.raises(KeyboardInterrupt), writing(path):
        pass
    assert list(Path.cwd().iterdir()) == []
