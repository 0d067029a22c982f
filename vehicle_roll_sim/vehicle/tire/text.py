"""Splits the text of a tire file into entries, skipping comments, sub-blocks and tables."""

import re
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from vehicle_roll_sim.files.text_file import read_text
from vehicle_roll_sim.input_errors import InputError, number_in

ENCODINGS = ("utf-8-sig", "cp1252")
COMMENT = r"(?:[$!#%]|//)"
HEADER = re.compile(rf"\s*\[\s*(?P<name>[^\]]+?)\s*\]\s*({COMMENT}.*)?$")
KEY = re.compile(r"\s*(?P<key>[A-Za-z_]\w*)\s*=\s*(?P<rest>.*)$")
QUOTED = re.compile(rf"(?P<quote>['\"])(?P<text>.*?)(?P=quote)\s*(?P<after>{COMMENT}.*)?$")
ROW = r"[-+.\d][-+.\deEdD\s]*"
IGNORED = re.compile(rf"[\s\x1a]*({COMMENT}.*|\{{.*|'.*|\".*|{ROW}({COMMENT}.*)?)?$")
"""Empty lines, comments, quoted lines, and headers and rows of tables such as [SHAPE]."""
BLOCK = re.compile(rf"\s*\(\s*(?P<name>\w+)\s*\)\s*({COMMENT}.*)?$")
"""The header of a sub-block of the TeimOrbit format, such as (COMMENTS)."""
FORTRAN_EXPONENT = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d)")
UNITS = "UNITS"
LARGEST = 1e15
"""Numbers must be below this in magnitude, whatever their unit."""


class Entry(NamedTuple):
    """KEY = VALUE in a section: key in upper case, text without quotes, line and file."""

    section: str
    key: str
    text: str
    line: int
    file: str

    @property
    def where(self) -> str:
        """File, line and key, for error messages."""
        return f"{self.file}: line {self.line}: {self.key}"

    @property
    def said(self) -> str:
        """Key, value and line, for notes."""
        return f"{self.key} = {self.text} (line {self.line})"

    def number(self, unit: float = 1.0) -> float:
        """The value in SI units as a finite number; raises InputError."""
        try:
            number = _number_in(self.text) * unit
        except ValueError:
            number = float("nan")
        if not abs(number) < LARGEST:
            allowed = f"a finite number below {LARGEST:g}; $ or ! begins a comment"
            raise InputError(self.where, self.text, allowed)
        return number


class Text(NamedTuple):
    """All entries of a file in order, its comments, and the names of its sections."""

    entries: list[Entry]
    comments: list[str]
    sections: list[str]


def read(path: Path) -> Text:
    """Split a tire file into entries and comments; raises InputError naming file and line."""
    text, section, in_block = Text([], [], []), None, False
    for number, line in enumerate(read_text(path, encodings=ENCODINGS).split("\n"), 1):
        where = f"{path}: line {number}"
        if header := HEADER.match(line):
            section, in_block = header["name"].upper(), False
            text.sections.append(section)
        elif entry := KEY.match(line):
            if section is None:
                raise InputError(where, "", "a [SECTION] must come first", "entry before a section")
            key = entry["key"].upper()
            value = _value(entry["rest"], f"{where}: {key}")
            text.entries.append(Entry(section, key, value, number, str(path)))
        elif BLOCK.match(line):
            in_block = True
        elif not in_block and not IGNORED.match(line):
            raise InputError(where, line.strip()[:40], "[SECTION] or KEY = VALUE")
        else:
            text.comments.append(line)
    return text


def _value(rest: str, where: str) -> str:
    """The text of a value, without quotes and without a trailing comment."""
    if rest[:1] in ("'", '"'):
        if quoted := QUOTED.match(rest):
            return quoted["text"].strip()
        allowed = "a value in quotes; $ or ! begins a comment after it"
        raise InputError(where, rest[:40], allowed)
    return re.split(COMMENT, rest, maxsplit=1)[0].strip().strip("'\"")


def first_of_each(entries: Iterable[Entry]) -> dict[str, Entry]:
    """The entries by key; a repeated key must have the same value.

    Raises InputError naming both lines if it has not.
    """
    found: dict[str, Entry] = {}
    for entry in entries:
        first = found.setdefault(entry.key, entry)
        if not _same(first.text, entry.text):
            again = f"given twice, on line {first.line} in [{first.section}] as {first.text!r}"
            again += f" and on line {entry.line} in [{entry.section}] as {entry.text!r}"
            raise InputError(entry.where, entry.text, "one value for each key", again)
    return found


def _same(one: str, other: str) -> bool:
    """Whether two texts are the same word or number."""
    if one.casefold() == other.casefold():
        return True
    try:
        return _number_in(one) == _number_in(other)
    except ValueError:
        return False


def _number_in(text: str) -> float:
    """A decimal number, also with a Fortran exponent (D); raises ValueError."""
    return number_in(FORTRAN_EXPONENT.sub("e", text))
