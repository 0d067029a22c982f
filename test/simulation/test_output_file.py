"""Results appear under their name when they are whole; before that and on failure, nothing does."""

import errno
import os
from pathlib import Path

import pytest

from vehicle_roll_sim import InputError
from vehicle_roll_sim.simulation.output_file import (
    check_folder,
    check_writable,
    filled_folder,
    new_folder,
    replaced_file,
)

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


def refused(path, check=check_writable) -> str:
    with pytest.raises(InputError) as refusal:
        check(path, "--csv")
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
    assert "a folder that can be written to, or made" in refused(Path(name), check_folder)


def test_a_link_that_leads_in_a_circle_is_refused(path):
    path.symlink_to(path.name)
    assert "symbolic links" in refused(path)


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="no /proc on this system")
def test_neither_is_what_the_system_does_not_let_be_made(path):
    refused(Path("/proc/results"), check_folder)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
@pytest.mark.parametrize("name", ["locked", "locked/results"])
def test_neither_is_one_that_may_not_be_written(path, name):
    Path("locked").mkdir(mode=0o555)
    assert "Permission denied" in refused(Path(name), check_folder)


def test_neither_is_a_name_that_is_too_long(path):
    refused(Path("long" * 100), check_folder)


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
