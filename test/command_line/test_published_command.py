"""`paper --published`: numbers of other sources instead of the paper, in two files."""

import dataclasses
from pathlib import Path

import pytest

from vehicle_roll_sim.command_line import paper as paper_module
from vehicle_roll_sim.paper.published import source
from vehicle_roll_sim.paper.published.comparison import compare
from vehicle_roll_sim.paper.published.report import as_markdown, as_text

FILES = {"published.md", "published.txt"}


@pytest.fixture
def few(monkeypatch):
    """few(published): the command has three numbers that take no time; the first may be another."""
    monkeypatch.setattr(paper_module, "Study", None)  # no run of the paper is made
    chosen = [one for one in source.numbers() if one.rerun == "total_cg_height"]
    chosen.append(source.numbers()[0])

    def give(published: float | None = None):
        first = chosen[0]
        if published is not None:
            first = dataclasses.replace(first, published=published)
        numbers = (first, *chosen[1:])
        monkeypatch.setattr(source, "numbers", lambda: numbers)
        return compare(numbers)

    return give


def names(folder: Path) -> set[str]:
    return {entry.name for entry in folder.iterdir()}


def test_it_prints_what_it_writes_and_reruns_nothing_else(command, folder, few):
    found = few()
    result = command("paper", "--published", "--strict")
    assert (result.status, result.err) == (0, "")
    assert names(folder / "paper") == FILES
    text = (folder / "paper/published.txt").read_text(encoding="utf-8")
    assert text == f"{as_text(found)}\n"
    assert result.out == f"{text}\nresults: paper\n"
    table = (folder / "paper/published.md").read_text(encoding="utf-8")
    assert table == f"{as_markdown(found)}\n"


def test_only_with_strict_the_status_tells_a_number_that_differs(command, folder, few):
    few(published=1.0)
    for words, status in (((), 0), (("--strict",), 1)):
        result = command("paper", "--published", "--out", "results", *words)
        assert result.status == status
        assert "3 numbers: 2 agree, 1 differ, 0 not judged" in result.out
        assert names(folder / "results") == FILES


def test_what_lies_in_the_folder_stays(command, folder, few):
    few()
    (folder / "paper").mkdir()
    for name in ("claims.txt", "published.txt"):
        (folder / "paper" / name).write_text("old")
    assert command("paper", "--published").status == 0
    assert names(folder / "paper") == FILES | {"claims.txt"}
    assert (folder / "paper/claims.txt").read_text() == "old"
    assert (folder / "paper/published.txt").read_text(encoding="utf-8") != "old"


def test_what_is_wrong_is_refused_in_one_line(refused, few, folder):
    few()
    (folder / "file").write_text("no folder")
    refused(("paper", "--published", "--beyond"), "--beyond: not allowed with argument --published")
    refused(("paper", "--publised"), "--publised", "did you mean --published?")
    refused(("paper", "--published", "--out", "file"), "--out", "file")
