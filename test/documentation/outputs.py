"""Compares the output shown on a page with that of the command."""

import re

NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
LEFT_OUT = "..."
"""In a line of its own: any number of lines."""


def same(shown: str, printed: str) -> bool:
    """Whether all lines agree; a line `...` stands for any others.

    Numbers may differ by one in the last digit that is shown, as they do between processors.
    """
    return _same(_lines(shown), _lines(printed))


def _lines(text: str) -> list[str]:
    return [line.rstrip() for line in text.strip("\n").splitlines()]


def _same(shown: list[str], printed: list[str]) -> bool:
    if not shown:
        return not printed
    if shown[0].strip() == LEFT_OUT:
        return any(_same(shown[1:], printed[begin:]) for begin in range(len(printed) + 1))
    return bool(printed) and _same_line(shown[0], printed[0]) and _same(shown[1:], printed[1:])


def _same_line(shown: str, printed: str) -> bool:
    if NUMBER.sub("#", shown).split() != NUMBER.sub("#", printed).split():
        return False
    numbers = zip(NUMBER.findall(shown), NUMBER.findall(printed), strict=True)
    return all(_same_number(one, other) for one, other in numbers)


def _same_number(shown: str, printed: str) -> bool:
    mantissa, _, exponent = shown.partition("e")
    last_digit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    is_whole = "." not in mantissa and not exponent
    return shown == printed if is_whole else abs(float(shown) - float(printed)) < 1.5 * last_digit
