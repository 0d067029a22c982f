"""How runs are distinguished in a figure: colour, line style and shaded band."""

import dataclasses
import itertools

import numpy as np
from matplotlib.lines import Line2D

COLOURS = ("black", "#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00")
"""Colours of the runs: the palette of Okabe and Ito, suitable for colour-blind readers."""
STYLES = ("-", "--", "-.")
LINE = 1.3
"""Points."""
MARKER = 5
"""Points."""


@dataclasses.dataclass(frozen=True)
class Pen:
    """How a run is drawn.

    band: range of a panel's height that it may shade (0 to 1). scale: scale of the figure.
    """

    colour: str
    style: str
    band: tuple[float, float]
    scale: float = 1.0

    @property
    def width(self) -> float:
        """Line width (points)."""
        return self.scale * LINE

    def example(self) -> Line2D:
        """A sample line for a legend."""
        return Line2D([], [], linestyle=self.style, color=self.colour)

    def draw(self, axis, x: np.ndarray, y: np.ndarray, style: str = "") -> None:
        """Draw a line, or the text "no data"; style: overrides the line style of the run."""
        axis.plot(x, y, style or self.style, color=self.colour, linewidth=self.width)
        if np.isnan(y).all():
            about = {"color": self.colour, "ha": "center", "va": "center"}
            axis.text(0.5, sum(self.band) / 2, "no data", transform=axis.transAxes, **about)

    def shade(self, axis, x: np.ndarray, where: np.ndarray, label: str) -> None:
        height = axis.get_xaxis_transform()
        shade = axis.fill_between(x, *self.band, where=where, transform=height, label=label)
        shade.set(color=self.colour, alpha=0.13)

    def mark(self, axis, x: float, y: float, marker: str, label: str) -> None:
        axis.plot(x, y, marker, color=self.colour, markersize=self.scale * MARKER, label=label)


def pens(count: int, scale: float = 1.0) -> list[Pen]:
    """One pen per run; their bands are stacked, that of the first run at the top."""
    looks = zip(COLOURS, itertools.cycle(STYLES), strict=False)
    return [
        Pen(*look, (1 - (place + 1) / count, 1 - place / count), scale)
        for place, look in zip(range(count), looks, strict=False)
    ]
