"""What is known about one key of a tire file, and the tables of keys that share it."""

from typing import NamedTuple

OLD, NEW, NEWEST = ("5.2",), ("6.1", "6.2"), ("6.2",)
ALL = (*OLD, *NEW)
"""Versions of the Magic Formula: 5.2 stands for 5.0 to 5.2, and 6.1 for 6.0 and 6.1."""


class Key(NamedTuple):
    """A key of tire files.

    acts: versions in which it is a coefficient of what is simulated. idle: versions in which it may
    stand in a file but has no effect on what is simulated; in all others it may only have its
    default, with which its term vanishes. dimension: see units.py.
    """

    meaning: str
    acts: tuple[str, ...] = ()
    idle: tuple[str, ...] = ()
    default: float = 0.0
    dimension: str = ""


def table(
    meanings: dict[str, str],
    acts: tuple[str, ...] = (),
    idle: tuple[str, ...] = (),
    default: float = 0.0,
    dimension: str = "",
) -> dict[str, Key]:
    """Keys that differ in their meaning only, by name."""
    shared = (acts, idle, default, dimension)
    return {name: Key(meaning, *shared) for name, meaning in meanings.items()}
