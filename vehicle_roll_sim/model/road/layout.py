"""The ground as one array of numbers, of any length: a header, features, and their tables.

A feature is a row of numbers: its kind, its origin in the ground frame (m), cosine and sine of its
heading, and its own numbers, counted from OWN on. Tables follow the rows; a feature or the header
has the index at which its table begins.
"""

import numpy as np

HEADER = 5
USED, COUNT, TILT, TILT_COUNT, SIDES = range(HEADER)
"""Elements of the header: whether the ground is more than a plane, number of features, index of the
table of the tilt angle over time, its number of points (0 if the ground does not tilt), and whether
there are features that push wheels from the side."""
FEATURE_SIZE = 16
KIND, ORIGIN_X, ORIGIN_Y, COSINE, SINE, OWN = range(6)
OWN_COUNT = FEATURE_SIZE - OWN
PATCH, CHESSBOARD, RAMP, WAVE, PROFILE, BANKED_CURVE, GRID, WALL, SOIL = range(9)
"""Kinds of features."""
PLANE = np.zeros(HEADER)
"""The ground that is a plane and nothing else; do not modify."""


def ground_of(
    rows: list[tuple[int, list[float], np.ndarray | None]],
    tilt: np.ndarray | None = None,
    is_commanded: bool = False,
) -> np.ndarray:
    """The array of a ground.

    rows: of each feature its kind, the numbers from ORIGIN_X on, and its table, a flat array, or
    None. The first of its own numbers of a feature with a table is the index of the table, which is
    inserted here. tilt: times (s) and angles (rad), shape (n, 2), or None. is_commanded: heights
    and frictions also come with the commands.
    """
    ground = np.zeros(HEADER + FEATURE_SIZE * len(rows))
    tables, end = [], len(ground)
    for k, (kind, numbers, table) in enumerate(rows):
        first = HEADER + FEATURE_SIZE * k
        ground[first] = kind
        if table is not None:
            numbers = [*numbers[: OWN - 1], end, *numbers[OWN - 1 :]]
            tables.append(table)
            end += len(table)
        ground[first + 1 : first + 1 + len(numbers)] = numbers
    ground[COUNT] = len(rows)
    ground[SIDES] = any(kind in (WALL, SOIL) for kind, _, _ in rows)
    if tilt is not None:
        ground[TILT], ground[TILT_COUNT] = end, len(tilt)
        tables.append(tilt.ravel())
    ground[USED] = len(rows) > 0 or tilt is not None or is_commanded
    return np.concatenate((ground, *tables))
