"""Tables of a road file in files of their own: profiles and grids."""

from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.table_file import read_table
from vehicle_roll_sim.input_errors import number_in
from vehicle_roll_sim.simulation.open_crg import SPACINGS, grid_values

FILE, FRICTION_FILE = "file", "friction_file"
"""Keys of a feature in a road file that name files, relative to the road file."""
OPEN_CRG = ".crg"
"""Suffix of an OpenCRG file; other files are CSV files."""
LARGEST_FILE = 50_000_000
"""Bytes."""
PROFILE = (("distance", "height"), ("distance", "left_height", "right_height"))
GRID = (("x", "y", "height"), ("x", "y", "height", "friction"))
COLUMNS = {"profile": PROFILE, "grid": GRID}
"""By kind of feature: the columns that its file may have."""
UNEVEN = 1e-6
"""Of the spacing: how much distances of neighbours may differ."""


def with_table(values, folder: Path, where: str):
    """The values of a feature with those of its file, if it names one, in its place.

    where: names the feature in messages. Raises InputError.
    """
    if not isinstance(values, dict) or FILE not in values or values.get("kind") not in COLUMNS:
        return values
    values, kind = dict(values), values["kind"]
    path = _path(values, FILE, folder, where)
    replaced = ()
    if kind == "grid" and path.suffix.lower() == OPEN_CRG:
        frictions = None
        if FRICTION_FILE in values:
            frictions = _path(values, FRICTION_FILE, folder, where)
        found, replaced = grid_values(values, path, frictions, where), SPACINGS
    elif kind == "grid":
        found = _grid(path)
    else:
        found = {"points": _read(path, kind)[1].tolist()}
    for key in found:
        if key in values and key not in replaced:
            raise InputError(f"{where}: {key}", values[key], f"either this or {FILE}, not both")
    return values | found


def _path(values: dict, key: str, folder: Path, where: str) -> Path:
    """The file that a key names, which is taken out of the values."""
    name = values.pop(key)
    if not isinstance(name, str) or not name:
        raise InputError(f"{where}: {key}", name, "the name of a file")
    return folder / name


def _read(path: Path, kind: str) -> tuple[tuple[str, ...], np.ndarray]:
    """The columns of a file and its rows; raises InputError naming the line."""
    header, lines = read_table(path, LARGEST_FILE)
    if tuple(header) not in COLUMNS[kind]:
        wanted = " or ".join(",".join(columns) for columns in COLUMNS[kind])
        raise InputError(f"{path}: line 1", ",".join(header), f"the columns {wanted}")
    rows = []
    for line, texts in lines:
        try:
            rows.append([number_in(text) for text in texts])
        except ValueError:
            raise InputError(f"{path}: line {line}", ",".join(texts), "numbers") from None
    if len(rows) < 2:
        raise InputError(f"file {path}", "", "at least two rows", f"{len(rows)} rows")
    return tuple(header), np.array(rows)


def _grid(path: Path) -> dict:
    """The keys of a grid from the rows of a file in any order, one for each point."""
    columns, table = _read(path, "grid")
    ahead, row = np.unique(table[:, 0], return_inverse=True)
    aside, column = np.unique(table[:, 1], return_inverse=True)
    shape = len(ahead), len(aside)
    filled = np.zeros(shape, int)
    np.add.at(filled, (row, column), 1)
    if min(shape) < 2 or (filled != 1).any():
        problem = f"{len(table)} rows with {shape[0]} values of x and {shape[1]} of y"
        raise InputError(f"file {path}", "", "one row for each x with each y", problem)
    spacings = []
    for name, places in (("x", ahead), ("y", aside)):
        steps = np.diff(places)
        if np.ptp(steps) > UNEVEN * steps[0]:
            problem = f"distances of {name} from {steps.min():g} to {steps.max():g} m"
            raise InputError(f"file {path}", "", f"{name} in equal distances", problem)
        spacings.append(float((places[-1] - places[0]) / (len(places) - 1)))
    if ahead[0] != 0.0:
        raise InputError(f"file {path}: x", float(ahead[0]), "from 0 on; `start` says where 0 is")
    found = {"spacing": spacings[0], "side_spacing": spacings[1], "right": float(aside[0])}
    for key, place in (("heights", 2), ("frictions", 3))[: len(columns) - 2]:
        values = np.zeros(shape)
        values[row, column] = table[:, place]
        found[key] = values.tolist()
    return found
