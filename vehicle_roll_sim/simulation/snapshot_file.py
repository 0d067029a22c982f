"""Files of snapshots: two lines of JSON, the first of which says what the second is."""

import hashlib
import json
from pathlib import Path

from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.files.text_file import read_text
from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.version import __version__

PACKAGE = "vehicle_roll_sim"
LARGEST_FILE = 500_000_000
"""Bytes: a snapshot takes about 16 kB, and more with long dead times of actuators."""


def text_of(content) -> str:
    """Numbers, texts, lists and dicts as one line of text, equal for equal content.

    Floats keep every bit: their shortest decimal form is unique.
    """
    return json.dumps(content, sort_keys=True, separators=(",", ":"))


def digest_of(text: str) -> str:
    """A digest of a text, 64 hexadecimal digits."""
    return hashlib.sha256(text.encode()).hexdigest()


def write_snapshot(path: str | Path, kind: str, text: str) -> None:
    """Write the text of a snapshot to a file, whole or not at all.

    kind: what it is a snapshot of. Raises NotWrittenError if the operating system refuses.
    """
    head = {"package": PACKAGE, "snapshot_of": kind, "version": __version__}
    head["sha256"] = digest_of(text)
    with replaced_file(path) as partial:
        partial.write_text(f"{text_of(head)}\n{text}\n", encoding="utf-8")


def read_snapshot(path: str | Path, kind: str) -> str:
    """The text of a snapshot of this kind in a file.

    Raises InputError naming the file if it has none, is damaged, or is of another version.
    """
    field = f"file {path}"
    first, *others = read_text(Path(path), LARGEST_FILE).split("\n")
    head = _head(first)
    if head.get("snapshot_of") != kind:
        raise InputError(field, "", f"a snapshot of a {kind}", "it is none")
    if head.get("version") != __version__:
        problem = f"saved by version {head.get('version')}"
        raise InputError(field, "", f"a snapshot of version {__version__}", problem)
    if len(others) != 2 or others[1] or digest_of(others[0]) != head.get("sha256"):
        raise InputError(field, "", "a snapshot as it was saved", "damaged")
    return others[0]


def _head(line: str) -> dict:
    """The first line of a snapshot, or {} if it is none."""
    try:
        head = json.loads(line)
    except (ValueError, RecursionError):
        return {}
    is_ours = isinstance(head, dict) and head.get("package") == PACKAGE
    return head if is_ours else {}
