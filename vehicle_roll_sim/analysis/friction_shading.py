"""The friction of a road as shades of grey under a path."""

import numpy as np

from vehicle_roll_sim.simulation.road import Road

POINTS = 160
"""In either direction of a panel."""
BESIDE = 3.0
"""m on each side of the path that are shaded at least."""
DARKEST = 0.5
"""Grey of a road without friction: 0 is white, 1 black."""


def shade_friction(axis, road: Road | None, x: np.ndarray, y: np.ndarray) -> None:
    """Shade the panel around a path (m) where the road is slippery, behind everything else."""
    known = np.isfinite(x) & np.isfinite(y)
    if road is None or not road.features or not known.any():
        return
    edges = [
        np.linspace(along[known].min() - BESIDE, along[known].max() + BESIDE, POINTS + 1)
        for along in (x, y)
    ]
    ahead, aside = ((each[1:] + each[:-1]) / 2 for each in edges)
    friction = np.array([[road.surface(a, b)[3] for a in ahead] for b in aside])
    lost = np.clip(1.0 - friction, 0.0, 1.0)
    if lost.any():
        shown = np.ma.masked_equal(lost, 0.0)
        axis.pcolormesh(
            *edges, shown, cmap="Greys", vmin=0.0, vmax=1.0 / DARKEST, zorder=0, rasterized=True
        )
        axis.fill([], [], color=str(1.0 - DARKEST), label="less friction (path)")
