"""Common parts of all figures: no display needed, space for a legend, reproducible files."""

import contextlib
from collections.abc import Iterator, Sequence
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from vehicle_roll_sim.analysis.figure_size import Size
from vehicle_roll_sim.files.output_file import replaced_file

UNDATED = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
"""Date fields to suppress, so that the same figure gives the same file."""
LEGEND_GAP = 0.01
"""Space around a legend, as a fraction of the figure's height."""
CHARACTERS_PER_INCH, CHARACTERS_OF_AN_EXAMPLE = 13, 8
"""Text density in a legend, and the width of its line sample, in characters."""
MOST_COLUMNS = 4
FONT = 10.0
"""Points, in figures of the default size."""
POINTS_PER_INCH = 72.0
SMALLEST_FONT = 6.0
"""Points: lower limit for small figures."""
SCREEN_DPI, PRINT_DPI = 110, 300
SCALED = (
    *("lines.linewidth", "lines.markersize", "axes.linewidth", "axes.labelpad", "grid.linewidth"),
    *(f"{axis}tick.major.{part}" for axis in "xy" for part in ("size", "width", "pad")),
)
"""Style parameters that are scaled with the figure."""
DIGITS_OF_A_POSITION = 9
"""Digits of positions relative to the figure: far finer than a pixel, far coarser than rounding."""


class SteadyLayout(ConstrainedLayoutEngine):
    """The constrained layout with rounded positions, whose last bits differ from run to run.

    Its solver orders the constraints by memory address, and SVG element names depend on the exact
    positions.
    """

    def __init__(self):
        super().__init__()
        self._pads: dict[Axes, float] = {}

    def align(self, column: Sequence[Axes]) -> None:
        """Place the labels of the vertical axes of a column one below the other.

        As Figure.align_ylabels does; but that places the ticks of all axes for the label of each,
        in every pass of the layout, a seventh of the time that it takes to draw a figure.
        """
        self._pads |= {axes: axes.yaxis.labelpad for axes in column}

    def execute(self, fig: Figure) -> None:
        for axes, pad in self._pads.items():
            axes.yaxis.labelpad = pad
        self._place(fig)
        for axes in self._pads:
            axes.yaxis.get_tightbbox()  # which places the label beside the ticks
        places = {axes: axes.yaxis.label.get_position()[0] for axes in self._pads}
        for axes, place in places.items():
            beyond = (place - min(places.values())) / fig.dpi  # inches
            axes.yaxis.labelpad = self._pads[axes] + beyond * POINTS_PER_INCH

    def _place(self, fig: Figure) -> None:
        super().execute(fig)
        for axes in fig.axes:
            bounds = axes.get_position(original=True).bounds
            axes.set_position(np.round(bounds, DIGITS_OF_A_POSITION))
            axes.set_in_layout(True)  # otherwise this position would be kept


class DrawnFigure(Figure):
    """A figure drawn without a display; scale: factor on texts, lines and markers."""

    def __init__(self, width: float, height: float, scale: float = 1.0, dpi: int = SCREEN_DPI):
        super().__init__(figsize=(width, height), layout=SteadyLayout())
        FigureCanvasAgg(self)
        self.scale, self.dpi_of_file = scale, dpi

    def draw(self, renderer) -> None:
        """Draw the figure; while it has a layout to compute, only compute that when saving.

        matplotlib draws a figure twice to save it: first, without output, for the layout alone.
        """
        layout = self.get_layout_engine()
        if self.canvas.is_saving() and isinstance(layout, SteadyLayout):
            layout.execute(self)
        else:
            super().draw(renderer)


@contextlib.contextmanager
def drawn_at(scale: float) -> Iterator[None]:
    """Context in which lines and texts are scaled, texts to no less than SMALLEST_FONT."""
    sizes = {name: scale * matplotlib.rcParamsDefault[name] for name in SCALED}
    with matplotlib.rc_context({"font.size": max(scale * FONT, SMALLEST_FONT), **sizes}):
        yield


def new_figure(width: float, height: float, size: Size | None = None) -> DrawnFigure:
    """An empty figure of `width` by `height` (inches), or scaled to fit `size` if it is given."""
    if size is None:
        return DrawnFigure(width, height)
    scale = min(size.inches[0] / width, size.inches[1] / height)
    return DrawnFigure(*size.inches, min(scale, 1.0), PRINT_DPI)


def save_figure(figure: DrawnFigure, path: Path) -> None:
    """Write a figure in the format of the suffix; the same figure gives the same bytes."""
    salt = matplotlib.rc_context({"svg.hashsalt": "run"})
    with replaced_file(path) as partial, drawn_at(figure.scale), salt:
        metadata = UNDATED.get(path.suffix.lower())
        figure.savefig(partial, dpi=figure.dpi_of_file, metadata=metadata)


def add_title(figure: Figure, title: str) -> None:
    """Add a title above everything; the text is not interpreted as mathematics."""
    figure.suptitle(printable(title), parse_math=False)


def add_legend(figure: Figure, entries: Sequence[tuple]) -> None:
    """Add a legend of (artist, name) entries below everything else in the figure.

    matplotlib 3.6 does not support legends outside the axes, so the space is reserved here.
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
        text.set(text=printable(name), parse_math=False)  # names may begin with _ or contain $
    height = legend.get_window_extent(figure.canvas.get_renderer()).height / figure.bbox.height
    taken = height + LEGEND_GAP
    figure.get_layout_engine().set(rect=(0.0, taken, 1.0, 1.0 - taken))


def printable(text: str) -> str:
    """Replace non-printable characters, as in odd file names, so that any font can draw it."""
    return "".join(char if char.isprintable() else "\N{REPLACEMENT CHARACTER}" for char in text)
