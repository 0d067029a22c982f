"""Invalid arguments of `paper`: refused in one line before any run; the help lists valid ones."""

import os

import pytest

from vehicle_roll_sim.command_line import paper as paper_module


@pytest.fixture
def no_runs(monkeypatch):
    """No run is made."""

    def refuse(*_):
        raise AssertionError("a run before the command was checked")

    monkeypatch.setattr(paper_module, "Study", refuse)


@pytest.mark.parametrize("name", ["", "file", "file/results", "/proc/results"])
def test_where_no_folder_can_be_the_command_is_refused_before_any_run(
    refused, folder, no_runs, name
):
    (folder / "file").write_text("no folder")
    refused(("paper", "--out", name), "--out", name)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_may_not_be_written_is_refused_before_any_run(refused, folder, no_runs):
    (folder / "locked").mkdir(mode=0o555)
    for name in ("locked", "locked/results"):
        refused(("paper", "--out", name), "--out", "Permission denied")


@pytest.mark.parametrize(
    "words",
    [("--outt", "x"), ("--stric",), ("--ou", "x"), ("--strict=1",), ("--out",), ("results",)],
)
def test_unknown_options_and_words_are_refused(refused, no_runs, words):
    refused(("paper", *words), words[0].partition("=")[0])


@pytest.mark.parametrize(
    ("words", "nearest"),
    [(("papr",), "paper"), (("paper", "--outt"), "--out"), (("paper", "--stirct"), "--strict")],
)
def test_what_is_misspelt_gives_the_nearest(refused, no_runs, words, nearest):
    refused(words, words[-1], f"did you mean {nearest}?")


@pytest.mark.parametrize("words", [("--help",), ("paper", "--help")])
def test_help_names_the_command_and_its_options(command, no_runs, capsys, words):
    with pytest.raises(SystemExit) as end:
        command(*words)
    assert end.value.code == 0
    text = capsys.readouterr().out
    shown = ("  paper ",) if words == ("--help",) else ("--out DIR", "--strict", "(default: paper)")
    for word in shown:
        assert word in text
