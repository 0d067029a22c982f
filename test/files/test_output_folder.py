"""A folder of results appears or is filled when complete; on failure nothing changes."""

import errno
import os
import shutil
from pathlib import Path

import pytest
from written import NEW, OLD, contents, refused

from vehicle_roll_sim import InputError
from vehicle_roll_sim.files.output_file import (
    check_folder,
    check_new_folder,
    check_writable,
    filled_folder,
)


def everything() -> dict[str, str | None]:
    """All files of the working folder with what is in them, and all folders."""
    found = sorted(Path().rglob("*"))
    return {str(each): each.read_text() if each.is_file() else None for each in found}


def fill(folder, *names, failure=None) -> None:
    """Write new files of these names, and then fail if there is a failure."""
    with filled_folder(folder) as partial:
        for name in names:
            (partial / name).write_text(NEW)
        if failure is not None:
            raise failure


FOLDERS = ("results", "new/results", "new/and/newer/results")
"""Names of folders that may not be there yet."""


@pytest.mark.parametrize("name", FOLDERS)
def test_a_folder_appears_with_all_that_was_written_to_it(path, name):
    with filled_folder(Path(name)) as partial:
        (partial / "a.csv").write_text(NEW)
        (partial / "b.png").write_text(OLD)
        assert not Path(name).exists()
    assert contents(Path(name)) == {"a.csv": NEW, "b.png": OLD}
    assert [entry.name for entry in Path().iterdir()] == [Path(name).parts[0]]


def test_in_a_folder_that_is_there_files_of_the_same_names_are_replaced_and_others_stay(path):
    folder = Path("results")
    folder.mkdir()
    for name in ("a.csv", "mine.txt"):
        (folder / name).write_text(OLD)
    with filled_folder(folder) as partial:
        (partial / "a.csv").write_text(NEW)
        (partial / "b.csv").write_text(NEW)
        assert (folder / "a.csv").read_text() == OLD
        assert not (folder / "b.csv").exists()
    assert contents(folder) == {"a.csv": NEW, "b.csv": NEW, "mine.txt": OLD}


@pytest.mark.parametrize("name", [".", "results", "new/results"])
def test_it_is_filled_in_a_hidden_folder_beside_or_above_from_which_files_can_be_moved(path, name):
    Path("results").mkdir()
    with filled_folder(Path(name)) as partial:
        assert partial.name.startswith(".")
        assert partial.is_relative_to(Path.cwd())


def test_a_link_to_a_folder_stays_and_the_folder_is_filled(path):
    Path("results").mkdir()
    Path("link").symlink_to("results")
    fill(Path("link"), "a.csv")
    assert Path("link").is_symlink()
    assert contents(Path("results")) == {"a.csv": NEW}


@pytest.mark.parametrize(("mask", "mode"), [(0o022, 0o755), (0o077, 0o700)])
def test_the_permissions_of_a_folder_and_its_files_are_those_of_new_ones(path, umask, mask, mode):
    umask(mask)
    fill(Path("results"), "a.csv")
    assert Path("results").stat().st_mode & 0o777 == mode
    assert Path("results/a.csv").stat().st_mode & 0o777 == mode & 0o666


@pytest.mark.parametrize(
    "failure", [OSError(errno.ENOSPC, "full"), KeyboardInterrupt(), ValueError()], ids=repr
)
@pytest.mark.parametrize("name", FOLDERS)
@pytest.mark.parametrize("existing", [False, True])
def test_after_a_failure_a_folder_is_as_it_was_or_is_not(path, failure, name, existing):
    if existing:
        Path(name).mkdir(parents=True)
        (Path(name) / "a.csv").write_text(OLD)
    before = everything()
    with pytest.raises(InputError if isinstance(failure, OSError) else type(failure)):
        fill(Path(name), "a.csv", failure=failure)
    assert everything() == before


def test_where_one_file_cannot_take_its_place_no_other_does(path):
    """A folder of the user has its name."""
    Path("results/b.csv").mkdir(parents=True)
    Path("results/a.csv").write_text(OLD)
    before = everything()
    with pytest.raises(InputError, match=r"b\.csv"):
        fill(Path("results"), "a.csv", "b.csv", "c.csv")
    assert everything() == before


@pytest.mark.parametrize("name", ["file", "file/results", "file/new/results"])
def test_a_file_and_what_is_below_one_are_no_folders(path, name):
    Path("file").write_text(OLD)
    assert "a folder that is writable or can be created" in refused(Path(name), check_folder)


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="no /proc on this system")
def test_neither_is_what_the_system_does_not_let_be_made(path):
    refused(Path("/proc/results"), check_folder)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
@pytest.mark.parametrize("name", ["locked", "locked/results"])
def test_neither_is_one_that_may_not_be_written(path, name):
    Path("locked").mkdir(mode=0o555)
    assert "Permission denied" in refused(Path(name), check_folder)


@pytest.mark.parametrize("check", [check_folder, check_new_folder, check_writable])
def test_neither_is_a_name_that_is_too_long(path, check):
    refused(Path("long" * 100), check)


@pytest.mark.parametrize("target", ["nowhere", "link"], ids=["dangling", "loop"])
@pytest.mark.parametrize("name", ["link", "link/results"])
def test_a_link_that_leads_nowhere_is_refused_or_leads_to_a_new_folder(path, target, name):
    """Either way it is known before there are results."""
    Path("link").symlink_to(target)
    try:
        check_folder(Path(name), "--out")
    except InputError:
        return
    fill(Path(name), "a.csv")
    assert contents(Path(name)) == {"a.csv": NEW}


@pytest.mark.parametrize("name", [".", "results", *FOLDERS])
@pytest.mark.parametrize("existing", [False, True])
def test_checking_a_folder_makes_and_changes_nothing(path, name, existing):
    if existing:
        Path("results").mkdir()
        Path("results/a.csv").write_text(OLD)
    before = everything()
    check_folder(Path(name), "--out")
    assert everything() == before


@pytest.mark.parametrize("check", [check_folder, check_writable])
def test_a_signal_while_a_trial_is_being_removed_leaves_nothing(path, monkeypatch, check):
    """Where it raises once in the middle of the removal, as handlers of signals do."""
    for module, name in ((shutil, "rmtree"), (Path, "unlink")):
        monkeypatch.setattr(module, name, interrupted_once(getattr(module, name)))
    with pytest.raises(KeyboardInterrupt):
        check(path.resolve(), "--out")
    assert contents(Path()) == {}


def interrupted_once(function):
    """The function, but the first call is interrupted before it does anything."""
    signals = iter([KeyboardInterrupt])

    def call(*arguments, **options):
        if signal := next(signals, None):
            raise signal
        return function(*arguments, **options)

    return call
