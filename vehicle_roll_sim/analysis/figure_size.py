"""The size of a figure that is to be printed, read without what draws it."""

import dataclasses
import re

from vehicle_roll_sim.declaration import InputError

MM_PER_INCH = 25.4
NARROWEST, LOWEST, LARGEST = 80.0, 120.0, 1000.0
"""mm; in less texts would lie over each other."""
SIZE = re.compile(r"(\d+(?:\.\d+)?)x(\d+(?:\.\d+)?)")
HELP = "of the figure in mm, such as 170x200 in a paper; texts and lines fit it (default: a screen)"


@dataclasses.dataclass(frozen=True)
class Size:
    """Width and height of a figure (mm)."""

    width: float
    height: float

    @property
    def inches(self) -> tuple[float, float]:
        return self.width / MM_PER_INCH, self.height / MM_PER_INCH


def named_size(text: str | None, field: str, has_figure: object = True) -> Size | None:
    """The size that an option gives as WIDTHxHEIGHT, None where it was not given.

    Raises InputError naming `field` for what is none, and where there is no figure.
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
