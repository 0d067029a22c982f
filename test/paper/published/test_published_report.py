"""Published numbers as text and as Markdown, and in docs/published_numbers.md."""

import dataclasses
import re
from pathlib import Path

import pytest

from vehicle_roll_sim.paper.published.comparison import AGREES, DIFFERS
from vehicle_roll_sim.paper.published.report import HEADER, MANY, WIDTH, as_markdown, as_text, tally

PAGE = Path(__file__).parents[3] / "docs" / "published_numbers.md"
NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e-?\d+)?")


def test_the_text_has_each_source_quantity_and_vehicle_with_its_numbers(compared):
    text = as_text(compared)
    lines = text.splitlines()
    assert max(map(len, lines)) <= WIDTH
    words = " ".join(text.split())
    for source in {str(one.number.source) for one in compared}:
        assert words.count(source) == 1
    shared = [one for one in compared if one.number.rerun == "static_stability_factor"]
    shared = [one for one in shared if one.verdict == AGREES]
    assert len(shared) >= MANY
    (line,) = (line for line in lines if line.startswith("  49 vehicles"))
    assert line.endswith(AGREES)
    for one in compared:
        if one not in shared:
            start = f"  {one.number.name} "
            numbers = f"{one.number.published:.4g}", f"{one.computed:.4g}"
            of_it = [line.split() for line in lines if line.startswith(start)]
            assert any({*numbers} <= {*words} for words in of_it)
    assert lines[-1] == tally(compared)


def test_the_markdown_has_the_same_rows_in_a_table_for_each_quantity(compared):
    parts = as_markdown(compared).split("\n\n")
    tables = [part.splitlines() for part in parts if part.startswith("|")]
    quantities = [(one.number.source, one.number.quantity) for one in compared]
    assert len(tables) == len(set(quantities))
    for header, rule, *rows in tables:
        assert header == "| " + " | ".join(HEADER).strip() + " |"
        assert rule == "| " + " | ".join(["---"] * len(HEADER)) + " |"
        assert {row.count("|") for row in rows} == {len(HEADER) + 1}
    agreeing = sum(one.number.rerun == "static_stability_factor" for one in compared) - 3
    assert sum(len(rows) - 2 for rows in tables) == len(compared) - agreeing + 1
    assert parts[-1] == tally(compared)
    words = " ".join(as_text(compared).split())
    for part in parts:
        if not part.startswith("|"):
            assert part.replace("**", "") in words


def test_a_number_that_differs_is_marked_and_counted(compared):
    wrong = dataclasses.replace(compared[0], computed=2.0)
    found = [wrong, *compared[1:]]
    assert tally(found) == "81 numbers: 71 agree, 1 differ, 9 not judged"
    (row,) = (line for line in as_markdown(found).splitlines() if f"**{DIFFERS}**" in line)
    assert wrong.number.name in row
    assert f"{wrong.difference:+.2g}" in row
    (line,) = (line for line in as_text(found).splitlines() if line.endswith(DIFFERS))
    assert line.startswith(f"  {wrong.number.name} ")


def test_the_page_has_these_tables(compared):
    """Numbers to 1 % of a number or 0.1: they are rounded, and the last digit may differ."""
    written = as_markdown(compared).splitlines()
    page = PAGE.read_text(encoding="utf-8").splitlines()
    first = page.index(written[0])
    for one, other in zip(page[first : first + len(written)], written, strict=True):
        assert NUMBER.sub("#", one) == NUMBER.sub("#", other)
        numbers = [[float(found[0]) for found in NUMBER.finditer(row)] for row in (one, other)]
        assert numbers[0] == pytest.approx(numbers[1], rel=0.01, abs=0.1)
