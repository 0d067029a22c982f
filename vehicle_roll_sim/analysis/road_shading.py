"""A road under a path: its friction as shades of grey, its heights as contour lines."""

import matplotlib
import numpy as np
from matplotlib.ticker import MaxNLocator

from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.road_mesh import has_mesh, sampled

POINTS = 160
"""Number of samples in either direction of a panel."""
BESIDE = 3.0
"""m: smallest distance shown on each side of the path."""
DARKEST = 0.5
"""Grey of a road without friction: 0 is white, 1 black."""
LINES = 6
"""Most contour lines, at round heights."""
LEAST_RANGE = 0.005
"""m: a road with smaller differences of height has no lines."""
COLOUR, WIDTH = "#8c510a", 0.5
"""Of contour lines; the width over that of other lines."""


def shade_road(axis, road: Road | None, x: np.ndarray, y: np.ndarray) -> None:
    """Draw the friction and the heights of the road around a path (m), behind everything else.

    Nothing is drawn for a plane.
    """
    known = np.isfinite(x) & np.isfinite(y)
    if not has_mesh(road) or not known.any():
        return
    edges = [
        np.linspace(along[known].min() - BESIDE, along[known].max() + BESIDE, POINTS + 1)
        for along in (x, y)
    ]
    middles = np.meshgrid(*((each[1:] + each[:-1]) / 2 for each in edges))
    found = sampled(road, np.column_stack([each.ravel() for each in middles]))
    height, friction, _ = (each.reshape(POINTS, POINTS) for each in found.T)
    _shade_friction(axis, edges, friction)
    _draw_contours(axis, middles, height)


def _shade_friction(axis, edges: list[np.ndarray], friction: np.ndarray) -> None:
    lost = np.clip(1.0 - friction, 0.0, 1.0)
    if lost.any():
        shown = np.ma.masked_equal(lost, 0.0)
        axis.pcolormesh(
            *edges, shown, cmap="Greys", vmin=0.0, vmax=1.0 / DARKEST, zorder=0, rasterized=True
        )
        axis.fill([], [], color=str(1.0 - DARKEST), label="less friction (path)")


def _draw_contours(axis, places: list[np.ndarray], height: np.ndarray) -> None:
    if np.ptp(height) < LEAST_RANGE:
        return
    levels = MaxNLocator(LINES, steps=(1, 2, 5, 10)).tick_values(height.min(), height.max())
    middles = (levels[1:] + levels[:-1]) / 2  # a level road is on no line
    width = WIDTH * matplotlib.rcParams["lines.linewidth"]
    look = {"colors": COLOUR, "linewidths": width, "linestyles": "solid", "zorder": 0.5}
    axis.contour(*places, height, levels=middles, **look)
    label = f"height of the road, a line every {levels[1] - levels[0]:g} m (path)"
    axis.plot([], [], color=COLOUR, linewidth=width, label=label)
