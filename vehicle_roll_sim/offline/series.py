"""A test series, or a search over entry speeds, as a table with its verdict."""

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, given, parameters_of, unknown_name
from vehicle_roll_sim.manoeuvres.series.base import Series
from vehicle_roll_sim.manoeuvres.series.catalogue import series_named
from vehicle_roll_sim.manoeuvres.series.speed_search import SpeedSearch
from vehicle_roll_sim.offline.tables import data_frame, known, path_of, structured, write_rows
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.vehicle_file import preset


@dataclasses.dataclass(frozen=True)
class SeriesResult:
    """Rows of a series that is over; result["end"] is a column, a list of its values.

    columns: their names, SI units unless the name ends in another. remarks: what else there is to
    say, label and text. verdict: what the rows mean.
    """

    columns: tuple[str, ...]
    rows: list[tuple]
    remarks: dict[str, str]
    verdict: str

    def __getitem__(self, name: str) -> list:
        place = known(name, self.columns)
        return [row[place] for row in self.rows]

    def __len__(self) -> int:
        return len(self.rows)

    @property
    def table(self) -> str:
        """Columns side by side, numbers with three decimals, whole ones with none."""
        cells = [self.columns, *([_cell(value) for value in row] for row in self.rows)]
        widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
        lines = (
            "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
            for row in cells
        )
        return "\n".join(lines)

    def to_numpy(self) -> np.ndarray:
        """The rows as a structured array, shape (rows,): numbers and texts as they are."""
        return structured(self.columns, [np.array(self[name]) for name in self.columns])

    def to_pandas(self):
        """The rows as a pandas DataFrame; needs the package pandas."""
        return data_frame(self.to_numpy(), {})

    def write_csv(self, path: str | Path) -> None:
        """Write the table, numbers in full precision, as the command's --csv does."""
        write_rows(path_of(path, "path"), self.columns, self.rows)


def series(
    name: str,
    vehicle: Vehicle | None = None,
    *,
    options: Options | None = None,
    progress: Callable[[], object] = lambda: None,
    **values: float | str,
) -> SeriesResult:
    """Drive the test series of a manoeuvre, as `vehicle_roll_sim series` does, on a level road.

    name: that of the manoeuvre. values: those that the command has options for, by the same names
    and in their units; with one of the range of entry speeds it is the search. vehicle: the
    reference if there is none. progress: called after every run. Raises InputError.
    """
    if not isinstance(name, str):
        raise InputError("name", name, "the name of a manoeuvre")
    is_search = any(each in values for each in parameters_of(SpeedSearch))
    chosen = series_named(name, is_search)
    known_values = {}
    for _, declaring in chosen.settings:
        known_values |= parameters_of(declaring)
    for each in values:
        if each not in known_values:
            if not known_values:
                raise InputError(each, values[each], f"no value: the series {name} has none to set")
            raise unknown_name(each, known_values, "name")
    chosen = chosen.with_values({n: known_values[n].validate(v) for n, v in values.items()})
    vehicle = given("vehicle", preset() if vehicle is None else vehicle, Vehicle)
    return drive_series(chosen, vehicle, given("options", options or Options(), Options), progress)


def drive_series(
    chosen: Series,
    vehicle: Vehicle,
    options: Options,
    progress: Callable[[], object] = lambda: None,
) -> SeriesResult:
    """Drive a series whose values are set."""
    rows = []
    for row in chosen.rows(vehicle, options):
        rows.append(row)
        progress()
    remarks = chosen.remarks(vehicle, rows)
    return SeriesResult(chosen.columns, rows, remarks, chosen.verdict(rows))


def _cell(value: float | str) -> str:
    if isinstance(value, str | int):
        return str(value)
    return "-" if math.isnan(value) else f"{value:.3f}"
