"""The size of a printed figure, parsed without importing matplotlib."""

import dataclasses
import re

from vehicle_roll_sim.declaration import InputError

MM_PER_INCH = 25.4
NARROWEST, LOWEST, LARGEST = 80.0, 120.0, 1000.0
"""mm: limits of the size; in smaller figures texts would overlap."""
SIZE = re.compile(r"(\d+(?:\.\d+)?)x(\d+(?:\.\d+)?)")
HELP = "size of the figure in mm, e.g. 170x200 for print; texts and lines scale (default: screen)"


@dataclasses.dataclass(frozen=True)
class Size:
    """Width and height of a figure (mm)."""

    width: float
    height: float

    @property
    def inches(self) -> tuple[float, float]:
        """Width and height (inches)."""
        return self.width / MM_PER_INCH, self.height / MM_PER_INCH


def named_size(text: str | None, field: str, has_figure: object = True) -> Size | None:
    """Parse a size given as WIDTHxHEIGHT (mm); None if it was not given.

    Raises InputError naming `field` for an invalid size, and if there is no figure.
    """
    if text is None:
        return None
    if not has_figure:
        raise InputError(field, text, "together with --plot")
    found = SIZE.fullmatch(text) if isinstance(text, str) else None
    width, height = map(float, found.groups()) if found else (0.0, 0.0)
    if not (NARROWEST <= width <= LARGEST and LOWEST <= height <= LARGEST):
        limits = f"from {NARROWEST:g}x{LOWEST:g} to {LARGEST:g}x{LARGEST:g}"
        raise InputError(field, text, f"WIDTHxHEIGHT in mm, {limits}, such as 170x200")
    return Size(width, height)
