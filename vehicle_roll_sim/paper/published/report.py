"""Published numbers beside the computed ones, as text and as Markdown."""

import itertools
import textwrap
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from vehicle_roll_sim.paper.layout import table
from vehicle_roll_sim.paper.published.comparison import AGREES, DIFFERS, NOT_JUDGED, Compared
from vehicle_roll_sim.paper.published.source import Number

WIDTH = 100
"""Line width of the text (characters)."""
MARGIN, INDENT = "  ", "      "
MANY = 10
"""From this number on, vehicles that agree share a row."""
HEADER = ("vehicle", "published", "computed", "difference", "")


class Row(NamedTuple):
    """What is shown of one number, or of many that agree."""

    vehicle: str
    published: str
    computed: str
    difference: str
    reason: str
    verdict: str


def as_text(found: list[Compared]) -> str:
    """Each source, its quantities with tolerance and reason, and a line per row."""
    lines = []
    for source, of_source in itertools.groupby(found, lambda one: one.number.source):
        lines += [*_wrapped(str(source)), ""]
        for members in _by_quantity(of_source):
            rows = _rows(members)
            common = rows[0].reason
            lines += _wrapped(_about(members[0].number, common), subsequent_indent=MARGIN)
            for row in rows:
                line = _line(row, common)
                lines += _wrapped(line, initial_indent=MARGIN, subsequent_indent=INDENT)
            lines.append("")
    return "\n".join([*lines, tally(found)])


def as_markdown(found: list[Compared]) -> str:
    """The same as Markdown, with a table for each quantity."""
    parts = []
    for source, of_source in itertools.groupby(found, lambda one: one.number.source):
        parts.append(f"**{source.authors} ({source.year}): {source.title}.** {source.where}")
        for members in _by_quantity(of_source):
            rows = _rows(members)
            common = rows[0].reason
            cells = [(*row[:4], _verdict(row, common, _marked(row.verdict))) for row in rows]
            parts += [_about(members[0].number, common), table(HEADER, cells)]
    return "\n\n".join([*parts, tally(found)])


def tally(found: list[Compared]) -> str:
    """How many numbers agree, differ and are not judged, in one line."""
    verdicts = [one.verdict for one in found]
    agree, differ, unjudged = (verdicts.count(v) for v in (AGREES, DIFFERS, NOT_JUDGED))
    return f"{len(found)} numbers: {agree} agree, {differ} differ, {unjudged} not judged"


def _wrapped(text: str, **indents: str) -> list[str]:
    """Lines of the text, in which addresses stay whole."""
    return textwrap.wrap(text, WIDTH, break_on_hyphens=False, **indents)


def _by_quantity(found: Iterable[Compared]) -> Iterator[list[Compared]]:
    """The numbers of each quantity of each source, which follow each other."""
    groups = itertools.groupby(found, lambda one: (one.number.source, one.number.quantity))
    return (list(members) for _, members in groups)


def _rows(members: list[Compared]) -> list[Row]:
    """The rows of one quantity: one for all that agree if they are many, then one for each."""
    agreeing = [one for one in members if one.verdict == AGREES]
    if len(agreeing) < MANY:
        return [_row(one) for one in members]
    differences = [one.difference for one in agreeing]
    span = f"{min(differences):+.2g} to {max(differences):+.2g}"
    shared = Row(f"{len(agreeing)} vehicles", "", "", span, _reason(agreeing[0].number), AGREES)
    return [shared, *(_row(one) for one in members if one.verdict != AGREES)]


def _row(one: Compared) -> Row:
    percent = round(100 * one.difference / one.number.published, 1) + 0.0  # no -0.0
    return Row(
        one.number.name,
        f"{one.number.published:.4g}",
        f"{one.computed:.4g}",
        f"{one.difference:+.2g} ({percent:+.1f} %)",
        _reason(one.number),
        one.verdict,
    )


def _line(row: Row, common: str) -> str:
    numbers = f"{row.published:>9}{row.computed:>9}  {row.difference:<22}"
    return f"{row.vehicle:<34}{numbers}{_verdict(row, common, row.verdict)}"


def _verdict(row: Row, common: str, verdict: str) -> str:
    """The verdict, with the reason of the row unless it is the common one."""
    return verdict if row.reason == common else f"{verdict}: {row.reason}"


def _about(number: Number, common: str) -> str:
    return f"{number.quantity} ({number.unit}) [{number.place}]; {common}"


def _reason(number: Number) -> str:
    if number.tolerance is None:
        return number.because
    return f"within {number.tolerance:g}: {number.because}"


def _marked(verdict: str) -> str:
    return f"**{verdict}**" if verdict == DIFFERS else verdict
