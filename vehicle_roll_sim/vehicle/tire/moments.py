"""Which of the moments of a tire a file has coefficients for."""

from collections.abc import Mapping

OVERTURNING, ROLLING_RESISTANCE, ALIGNING = "overturning", "rolling resistance", "aligning"
COEFFICIENTS = {
    OVERTURNING: tuple(f"QSX{number}" for number in range(1, 15)),
    ROLLING_RESISTANCE: tuple(f"QSY{number}" for number in range(1, 7)),
    ALIGNING: (
        *("QDZ1", "QDZ2", *(f"QDZ{number}" for number in range(6, 12))),
        *(f"SSZ{number}" for number in range(1, 5)),
    ),
}
"""Those without which a moment vanishes."""
FACTORS = {OVERTURNING: "LMX", ROLLING_RESISTANCE: "LMY"}
"""Scaling factors of a whole moment."""


def has_moment(moment: str, coefficients: Mapping[str, float]) -> bool:
    """Whether a tire with these coefficients has a moment: a key of COEFFICIENTS."""
    if moment in FACTORS and coefficients[FACTORS[moment]] == 0.0:
        return False
    return any(coefficients.get(name, 0.0) for name in COEFFICIENTS[moment])


def moments_of(coefficients: Mapping[str, float]) -> list[str]:
    """The moments that a tire with these coefficients has."""
    return [moment for moment in COEFFICIENTS if has_moment(moment, coefficients)]
