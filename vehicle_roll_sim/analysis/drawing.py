"""What all figures share: they need no screen, have room for a legend, are the same every time."""

import contextlib
from collections.abc import Iterator, Sequence
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from vehicle_roll_sim.analysis.figure_size import Size
from vehicle_roll_sim.files.output_file import replaced_file

UNDATED = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
"""Metadata without which the same figure would differ from one run to the next."""
LEGEND_GAP = 0.01
"""Room around a legend, as a share of the figure's height."""
CHARACTERS_PER_INCH, CHARACTERS_OF_AN_EXAMPLE = 13, 8
"""Of the text in a legend, and what stands beside it."""
MOST_COLUMNS = 4
FONT = 10.0
"""Points, in the figures of the default size."""
SMALLEST_FONT = 6.0
"""Points, however small a figure is."""
SCREEN_DPI, PRINT_DPI = 110, 300
SCALED = (
    *("lines.linewidth", "lines.markersize", "axes.linewidth", "axes.labelpad", "grid.linewidth"),
    *(f"{axis}tick.major.{what}" for axis in "xy" for what in ("size", "width", "pad")),
)
"""What of the style becomes smaller with a figure."""
DIGITS_OF_A_POSITION = 9
"""As a share of the figure: far less than a pixel, far more than rounding."""


class SteadyLayout(ConstrainedLayoutEngine):
    """The constrained layout but for its last bits, which differ from run to run.

    Its solver takes the constraints in an order that goes by addresses in memory, and an SVG makes
    names from exact positions.
    """

    def execute(self, fig: Figure) -> None:
        super().execute(fig)
        for axes in fig.axes:
            bounds = axes.get_position(original=True).bounds
            axes.set_position(np.round(bounds, DIGITS_OF_A_POSITION))
            axes.set_in_layout(True)  # else it would keep this place


class DrawnFigure(Figure):
    """A figure that is drawn without a screen; scale: of its texts, lines and marks."""

    def __init__(self, width: float, height: float, scale: float = 1.0, dpi: int = SCREEN_DPI):
        super().__init__(figsize=(width, height), layout=SteadyLayout())
        FigureCanvasAgg(self)
        self.scale, self.dpi_of_file = scale, dpi


@contextlib.contextmanager
def drawn_at(scale: float) -> Iterator[None]:
    """Within, what is drawn is smaller by `scale`, but no text than `SMALLEST_FONT`."""
    sizes = {name: scale * matplotlib.rcParamsDefault[name] for name in SCALED}
    with matplotlib.rc_context({"font.size": max(scale * FONT, SMALLEST_FONT), **sizes}):
        yield


def new_figure(width: float, height: float, size: Size | None = None) -> DrawnFigure:
    """An empty figure (inches); with a size, of that size, and drawn smaller to fit."""
    if size is None:
        return DrawnFigure(width, height)
    scale = min(size.inches[0] / width, size.inches[1] / height)
    return DrawnFigure(*size.inches, min(scale, 1.0), PRINT_DPI)


def save_figure(figure: DrawnFigure, path: Path) -> None:
    """Write a figure in the format of its name, the same bytes for the same figure."""
    salt = matplotlib.rc_context({"svg.hashsalt": "run"})
    with replaced_file(path) as partial, drawn_at(figure.scale), salt:
        metadata = UNDATED.get(path.suffix.lower())
        figure.savefig(partial, dpi=figure.dpi_of_file, metadata=metadata)


def add_title(figure: Figure, title: str) -> None:
    """A title above everything, word for word."""
    figure.suptitle(printable(title), parse_math=False)


def add_legend(figure: Figure, entries: Sequence[tuple]) -> None:
    """Explain each (artist, name) in `entries` below everything else that is in the figure.

    matplotlib 3.6 does not know of legends outside the axes, so the room is made here.
    """
    if not entries:
        return
    artists = [artist for artist, _ in entries]
    widest = max(len(name) for _, name in entries) + CHARACTERS_OF_AN_EXAMPLE
    per_inch = CHARACTERS_PER_INCH * FONT / matplotlib.rcParams["font.size"]
    fitting = int(figure.get_figwidth() * per_inch) // widest
    columns = min(max(fitting, 1), MOST_COLUMNS)
    legend = figure.legend(artists, [""] * len(artists), loc="lower center", ncols=columns)
    for text, (_, name) in zip(legend.get_texts(), entries, strict=True):
        text.set(text=printable(name), parse_math=False)  # it may begin with _ and have a $
    height = legend.get_window_extent(figure.canvas.get_renderer()).height / figure.bbox.height
    taken = height + LEGEND_GAP
    figure.get_layout_engine().set(rect=(0.0, taken, 1.0, 1.0 - taken))


def printable(text: str) -> str:
    """A text that no font fails at, whatever name a file has."""
    return "".join(char if char.isprintable() else "\N{REPLACEMENT CHARACTER}" for char in text)
