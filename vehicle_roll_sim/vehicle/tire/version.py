"""The Magic Formula version of a tire file, and how it was found."""

import re
from typing import NamedTuple

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire.key import ALL, NEW, NEWEST, OLD
from vehicle_roll_sim.vehicle.tire.keys import KEYS, is_neutral
from vehicle_roll_sim.vehicle.tire.text import Entry

FORMAT, FITTYP = "PROPERTY_FILE_FORMAT", "FITTYP"
FITTED = {
    **dict.fromkeys((5, 6, 50, 51, 52, 5.1, 5.2), "5.2"),
    **dict.fromkeys((60, 61, 6.1), "6.1"),
    **dict.fromkeys((62, 6.2), "6.2"),
}
"""Values of FITTYP; 6 stands for 5.2."""
FORMATS = {
    "PAC2002": "5.2",
    "MF05": "5.2",
    "MF50": "5.2",
    "MF51": "5.2",
    "MF52": "5.2",
    "MF60": "6.1",
    "MF61": "6.1",
    "MF62": "6.2",
    "MF": "",
    "USER": "",
}
"""The version that a PROPERTY_FILE_FORMAT implies, by its plain name; empty if none."""
MF_TYRE = "MF"
SHOWN = "PAC2002, MF_05, MF52, MF61, MF62, MF-TYRE, MF_SWIFT, USER"
GIVE = "give FITTYP = 52 (Magic Formula 5.0 to 5.2), 61 (6.0, 6.1) or 62 (6.2) in [MODEL]"
OTHERS = "a Magic Formula for cars: FITTYP 5, 6, 51, 52 (5.0 to 5.2), 60, 61 (6.1) or 62 (6.2)"
SWIFT_1 = 21
SWIFT = "; 21 is MF-Swift 1 with Magic Formula 5.2: write FITTYP = 52 to use its slip forces"


class Version(NamedTuple):
    """A version of the Magic Formula, and the reason for the decision in one line."""

    name: str
    reason: str


def version_of(entries: dict[str, Entry], numbers: dict[str, float]) -> Version | None:
    """The version of a file; None if nothing in it reveals the version.

    numbers: its coefficients in SI units. Raises InputError if the file contradicts itself.
    """
    stated = [s for s in (_fitted(entries), _formatted(entries)) if s]
    if len({name for name, _ in stated}) > 1:
        (name, by), (other, entry) = stated
        problem = f"{by.text!r} means version {name}, but {entry.said} means {other}"
        raise InputError(by.where, by.text, "one version; correct the wrong one", problem)
    if not stated:
        return _by_coefficients(entries, numbers)
    name, entry = stated[0]
    if foreign := foreign_to(name, numbers):
        raise _foreign(name, entry, [entries[each] for each in foreign])
    return Version(name, f"Magic Formula {name}: {entry.said}")


def _fitted(entries: dict[str, Entry]) -> tuple[str, Entry] | None:
    """The version given by FITTYP."""
    if FITTYP not in entries:
        return None
    entry = entries[FITTYP]
    try:
        number = entry.number()
    except InputError:
        number = 0.0
    if number not in FITTED:
        allowed = OTHERS + (SWIFT if number == SWIFT_1 else "")
        raise InputError(entry.where, entry.text, allowed)
    return FITTED[number], entry


def _formatted(entries: dict[str, Entry]) -> tuple[str, Entry] | None:
    """The version implied by PROPERTY_FILE_FORMAT."""
    if FORMAT not in entries:
        return None
    entry = entries[FORMAT]
    name = _plain(entry.text)
    if name not in FORMATS:
        allowed = f"one of {SHOWN}; other tire models are not simulated"
        raise InputError(entry.where, entry.text, allowed)
    return (FORMATS[name], entry) if FORMATS[name] else None


def _plain(text: str) -> str:
    """Letters and digits of a format: MF_6.1, MF-Tyre 6.1, MF-Swift 6.1 and mf61 are the same."""
    name = "".join(char for char in text.upper() if char.isalnum())
    return re.sub("^MF(TYRE|TIRE|SWIFT)", MF_TYRE, name)


def foreign_to(version: str, numbers: dict[str, float]) -> list[str]:
    """Coefficients that would act in another version but do not exist in this one."""
    return [name for name, value in numbers.items() if not _fits(name, value, version)]


def _fits(name: str, value: float, version: str) -> bool:
    return version in (*KEYS[name].acts, *KEYS[name].idle) or is_neutral(name, value)


def _foreign(version: str, by: Entry, foreign: list[Entry]) -> InputError:
    """The error for a coefficient that does not exist in the version that a file states."""
    entry, key = foreign[0], KEYS[foreign[0].key]
    others = f" and {len(foreign) - 1} more" if len(foreign) > 1 else ""
    home = f"for Magic Formula {' and '.join(key.acts)}" if key.acts else "not simulated"
    problem = f"{entry.text}{others} is {home}, but {by.said} means {version}"
    allowed = f"{key.default:g}, with which it has no effect; or correct the version"
    return InputError(entry.where, entry.text, allowed, problem)


def _by_coefficients(entries: dict[str, Entry], numbers: dict[str, float]) -> Version | None:
    """The one version that has all coefficients of a file."""
    possible = [version for version in ALL if not foreign_to(version, numbers)]
    if not possible:
        raise _contradicting(entries, numbers)
    old = [entries[name] for name in numbers if KEYS[name].acts == OLD]
    new = [entries[name] for name in numbers if _only_new(name)]
    newest = [entry for entry in new if KEYS[entry.key].acts == NEWEST]
    if "5.2" in possible and not new:
        given = _plain(entries[FORMAT].text) if FORMAT in entries else ""
        if old:
            return _without_fittyp("5.2", old)
        reason = "Magic Formula 5.2: FITTYP is not given, and no coefficient belongs to version 6"
        return Version("5.2", reason) if given == MF_TYRE else None
    if "6.1" in possible and (not old or "5.2" not in possible):
        return _without_fittyp("6.2" if newest else "6.1", newest or new)
    if "5.2" in possible and "6.1" in possible:
        return None
    return _without_fittyp("5.2", old) if "5.2" in possible else _without_fittyp("6.2", newest)


def _only_new(name: str) -> bool:
    """Whether a coefficient belongs to version 6 only."""
    key = KEYS[name]
    return bool(key.acts) and "5.2" not in (*key.acts, *key.idle) and {*key.acts} <= {*NEW}


def _without_fittyp(version: str, entries: list[Entry]) -> Version:
    """The version found from coefficients that only it has; the first non-neutral one is shown."""
    acting = [e for e in entries if not is_neutral(e.key, e.number())]
    shown = (acting or entries)[0].said
    reason = f"Magic Formula {version}: FITTYP is not given, but {shown} belongs to {version}"
    return Version(version, reason)


def _contradicting(entries: dict[str, Entry], numbers: dict[str, float]) -> InputError:
    """The error for coefficients that belong to no single version."""
    one = entries[foreign_to("5.2", numbers)[0]]
    other = entries[foreign_to("6.2", numbers)[0]]
    if one == other:
        return InputError(one.where, one.text, "0; it is not simulated in any version")
    problem = f"{one.text} belongs to version 6, but {other.said} to 5.2"
    return InputError(one.where, one.text, f"coefficients of one version; {GIVE}", problem)
