"""Invalid input, refused in one line that names field, value and what is allowed."""

import difflib
import numbers
import reprlib
from collections.abc import Iterable

LONGEST_SHOWN = 60
"""Maximum number of characters of an invalid value shown in an error message."""


class InputError(ValueError):
    """Invalid user input; the message is a single line naming field, value and what is allowed."""

    def __init__(self, field: str, value, allowed: str, problem: str = ""):
        fault = problem or ("missing" if value is None else f"{shown(value)} is not allowed")
        super().__init__(_in_one_line(f"{field}: {fault}: {allowed}"))
        self.field, self.value, self.allowed, self.problem = field, value, allowed, problem


class NotWrittenError(InputError):
    """The operating system refused to write a result to the requested location."""


def _in_one_line(text: str) -> str:
    """Escape non-printable characters, such as a line break in a file name."""
    return "".join(char if char.isprintable() else ascii(char)[1:-1] for char in text)


class _Outline(reprlib.Repr):
    """Representations of values, abbreviated to what fits in an error message."""

    def __init__(self):
        super().__init__()
        self.maxlevel = 3
        self.maxlist = self.maxtuple = self.maxset = self.maxfrozenset = LONGEST_SHOWN // 3
        self.maxdict = self.maxarray = self.maxdeque = LONGEST_SHOWN // 3
        self.maxstring = self.maxother = self.maxlong = 3 * LONGEST_SHOWN  # cut in the middle

    def repr_int(self, x, level):
        return super().repr_int(x, level) if x.bit_length() < 1000 else hex(x)


def shown(value) -> str:
    """The value as shown in an error message, truncated to LONGEST_SHOWN characters."""
    text = _Outline().repr(plain(value))
    return text if len(text) <= LONGEST_SHOWN else text[:LONGEST_SHOWN] + "..."


def plain(value):
    """Convert a numpy scalar or 0-d array to a Python scalar; return anything else unchanged."""
    return value.item() if getattr(value, "ndim", None) == 0 else value


def number_of(value, field: str, allowed: str) -> float:
    """Convert a real number (Python or numpy) to float; raises InputError naming `field`."""
    if type(value) is float:  # as almost always, and hundreds of times per simulated second
        return value
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise InputError(field, value, allowed)
    try:
        return float(value)
    except OverflowError:  # an integer beyond the largest float
        raise InputError(field, value, allowed) from None


def given(field: str, value, kind: type):
    """Return `value` if it is an instance of `kind`; otherwise raise InputError naming `field`."""
    if not isinstance(value, kind):
        raise InputError(field, value, f"an instance of {kind.__name__}")
    return value


def number_in(text: str) -> float:
    """Parse a decimal number; raises ValueError.

    Unlike float(), it rejects underscores (1_0) and non-ASCII digits.
    """
    if "_" in text or not text.isascii():
        raise ValueError(text)
    return float(text)


def number_within(text: str, field: str, least: float, most: float, unit: str) -> float:
    """Parse a decimal number from `least` to `most`; raises InputError naming `field`."""
    allowed = f"a number from {least:g} to {most:g} {unit}"
    try:
        number = number_in(text)
    except ValueError:
        raise InputError(field, text, allowed) from None
    if not least <= number <= most:
        raise InputError(field, number, allowed)
    return number


def unknown_name(name, known: Iterable[str], field: str) -> InputError:
    """The error for a name not among the `known` ones; it suggests the closest match."""
    known = {each.casefold(): each for each in known}
    nearest = difflib.get_close_matches(str(name).casefold(), known, n=1)
    every = "one of " + ", ".join(known.values()) if known else "there are none"
    allowed = f"did you mean {known[nearest[0]]}?" if nearest else every
    return InputError(field, name, allowed, f"{shown(name)} is unknown")
