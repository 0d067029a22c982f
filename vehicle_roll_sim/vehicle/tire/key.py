"""The declaration of one key of a tire file, and tables of keys that share their properties."""

from typing import NamedTuple

OLD, NEW, NEWEST = ("5.2",), ("6.1", "6.2"), ("6.2",)
ALL = (*OLD, *NEW)
"""Versions of the Magic Formula: 5.2 stands for 5.0 to 5.2, and 6.1 for 6.0 and 6.1."""


class Key(NamedTuple):
    """A key of tire files.

    acts: versions in which it is a simulated coefficient. idle: versions in which a file may have
    it but it does not affect the simulation. In all other versions it may only have its default,
    with which its term vanishes. dimension: see units.py.
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
    """Keys by name, which differ only in their meaning."""
    shared = (acts, idle, default, dimension)
    return {name: Key(meaning, *shared) for name, meaning in meanings.items()}
