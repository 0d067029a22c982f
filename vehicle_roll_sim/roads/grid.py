"""A feature with heights, and factors of friction, at the points of a grid."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError, number_of
from vehicle_roll_sim.model.road.layout import GRID
from vehicle_roll_sim.roads.feature import HIGHEST, MOST_POINTS, Feature, Row, place, size


@dataclasses.dataclass(frozen=True, kw_only=True)
class Grid(Feature):
    """Heights, and factors of friction, at the points of a grid.

    heights: rows along the heading, from `ahead` on; each row has the heights across, from right
    to left (m). frictions: likewise, or empty. Between the points heights follow cubic curves,
    friction changes linearly; beyond the grid both stay as at its edge.
    """

    spacing: float = size("spacing of the rows along the heading", least=0.01)
    side_spacing: float = size("spacing of the points of a row", least=0.01)
    right: float = place("lateral position n of the right end of the rows")
    ahead: float = place("position s of the first row", default=0.0)
    heights: tuple[tuple[float, ...], ...] = ()
    frictions: tuple[tuple[float, ...], ...] = ()

    def __post_init__(self):
        super().__post_init__()
        shape = None
        for name, least in (("heights", -HIGHEST), ("frictions", 0.0)):
            values = getattr(self, name)
            if name == "frictions" and not values:
                continue
            kept = _matrix(name, values, least)
            object.__setattr__(self, name, kept)
            if shape and shape != (len(kept), len(kept[0])):
                allowed = f"as many as heights, {shape[0]} rows of {shape[1]}"
                raise InputError(name, f"{len(kept)} rows of {len(kept[0])}", allowed)
            shape = len(kept), len(kept[0])

    def rows(self) -> list[Row]:
        heights = np.array(self.heights)
        parts = [heights.ravel(), np.array(self.frictions).ravel()]
        own = (*heights.shape, self.spacing, self.side_spacing, float(bool(self.frictions)))
        return [self.row(GRID, *own, table=np.concatenate(parts))]

    def edges(self) -> tuple[Sequence[float], Sequence[float]]:
        width = self.side_spacing * (len(self.heights[0]) - 1)
        return (0.0, self.spacing * (len(self.heights) - 1)), (self.right, self.right + width)

    def row(self, kind: int, *numbers: float, table: np.ndarray | None = None) -> Row:
        kind, (x, y, c, s, *own), table = super().row(kind, *numbers, table=table)
        x, y = x - s * self.right + c * self.ahead, y + c * self.right + s * self.ahead
        return kind, [x, y, c, s, *own], table


def _matrix(field: str, values, least: float) -> tuple[tuple[float, ...], ...]:
    """Rows of numbers, all of the same length; raises InputError."""
    allowed = f"2 or more rows of 2 or more numbers from {least:g} to {HIGHEST:g}, all of a length"
    try:
        rows = [[number_of(each, field, "a number") for each in row] for row in values]
    except TypeError:
        rows = None
    if rows is None or len({len(row) for row in rows}) > 1:
        raise InputError(field, "", allowed, "not a table of numbers")
    matrix = np.array(rows)
    if matrix.ndim != 2 or min(matrix.shape) < 2 or matrix.size > MOST_POINTS:
        problem = f"a table of {' x '.join(map(str, matrix.shape)) or 'no'} numbers"
        raise InputError(field, "", f"{allowed}, at most {MOST_POINTS} in all", problem)
    if not ((matrix >= least) & (matrix <= HIGHEST)).all():
        wrong = matrix[~((matrix >= least) & (matrix <= HIGHEST))].flat[0]
        raise InputError(field, float(wrong), allowed)
    return tuple(map(tuple, matrix.tolist()))
