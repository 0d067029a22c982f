"""OpenCRG files in text, written by hand: what stands where is that of the format's description."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

WIDTH, PER_LINE = 20, 4
"""Characters of a number and numbers of a line in the format LDFI."""


def write_crg(
    path: Path,
    heights: np.ndarray,
    spacing: float,
    across: Sequence[float],
    *,
    phi: Sequence[float] | None = None,
    slope: Sequence[float] | None = None,
    bank: Sequence[float] | None = None,
    header: Sequence[str] = (),
    modifiers: Sequence[str] | None = None,
) -> Path:
    """Write a file and return its path.

    heights: (rows, columns) (m); nan is written as stars. spacing: of the rows (m). across: v of
    the columns (m). phi, slope: of the parts of the reference line between the rows. bank: of each
    row.
    """
    end = spacing * (len(heights) - 1)
    lines = ["$CT", "written by hand", "$", "$ROAD_CRG", "REFERENCE_LINE_START_U = 0"]
    lines += [f"REFERENCE_LINE_END_U = {end:.6f}", f"REFERENCE_LINE_INCREMENT = {spacing}"]
    lines += [*header, "$"]
    if modifiers is not None:
        lines += ["$ROAD_CRG_MODS", *modifiers, "$"]
    lines += ["$KD_DEFINITION", "#:LDFI"]
    columns = []
    for name, values in (("phi,rad", phi), ("slope,m/m", slope)):
        if values is not None:  # the first row ends no part
            lines.append(f"D:reference line {name}")
            columns.append([np.nan, *values])
    if bank is not None:
        lines.append("D:reference line banking,m/m")
        columns.append(bank)
    lines += [f"D:long section at v = {v:.3f},m" for v in across] + ["$", "$" * 72]
    for row in np.column_stack([*columns, heights]):
        texts = ["*" * WIDTH if np.isnan(x) else f"{x:{WIDTH}.12e}" for x in row]
        starts = range(0, len(texts), PER_LINE)
        lines += ["".join(texts[k : k + PER_LINE]) for k in starts]
    path.write_text("\n".join(lines) + "\n")
    return path
