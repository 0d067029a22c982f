"""Test series and entry-speed searches, as a table with a verdict."""

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameters_of, unknown_name
from vehicle_roll_sim.files.table_file import write_rows
from vehicle_roll_sim.input_errors import given
from vehicle_roll_sim.manoeuvres.series.base import Series, on_road
from vehicle_roll_sim.manoeuvres.series.catalogue import series_named
from vehicle_roll_sim.manoeuvres.series.speed_search import SpeedSearch
from vehicle_roll_sim.offline.tables import data_frame, known, path_of, structured
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.vehicle_file import preset


@dataclasses.dataclass(frozen=True)
class SeriesResult:
    """The result of a series; `result["end"]` is a column, a list of its values.

    columns: names of the columns; SI units unless the name ends in a unit. rows: one per run.
    remarks: further remarks, text by label. verdict: the conclusion, in one line.
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
        """The table as text: numbers with three decimals, integers without."""
        cells = [self.columns, *([_cell(value) for value in row] for row in self.rows)]
        widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
        lines = (
            "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
            for row in cells
        )
        return "\n".join(lines)

    def to_numpy(self) -> np.ndarray:
        """The rows as a structured array, shape (rows,), with numeric and text fields."""
        return structured(self.columns, [np.array(self[name]) for name in self.columns])

    def to_pandas(self):
        """The rows as a pandas DataFrame; requires pandas."""
        return data_frame(self.to_numpy(), {})

    def write_csv(self, path: str | Path) -> None:
        """Write the table with numbers in full precision, like the option --csv."""
        write_rows(path_of(path, "path"), self.columns, self.rows)


def series(
    name: str,
    vehicle: Vehicle | None = None,
    *,
    options: Options | None = None,
    road: Road | None = None,
    progress: Callable[[], object] = lambda: None,
    **values: float | str,
) -> SeriesResult:
    """Drive the test series of a manoeuvre, like `vehicle_roll_sim series`.

    name: name of the manoeuvre. values: parameters with the names and units of the command's
    options; any of those on the range of entry speeds selects the entry-speed search. vehicle: by
    default the reference vehicle. road: by default level. progress: called after every run. Returns
    a SeriesResult. Raises InputError. An exception in the middle of a series has an attribute
    `driven`, the SeriesResult of the runs before it.
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
                raise InputError(each, values[each], f"none: the series {name} has no parameters")
            raise unknown_name(each, known_values, "name")
    chosen = chosen.with_values({n: known_values[n].validate(v) for n, v in values.items()})
    vehicle = given("vehicle", preset() if vehicle is None else vehicle, Vehicle)
    options = given("options", options or options_for(vehicle), Options)
    road = given("road", road or Road(), Road)
    return drive_series(chosen, vehicle, options, progress, road)


def drive_series(
    chosen: Series,
    vehicle: Vehicle,
    options: Options,
    progress: Callable[[], object] = lambda: None,
    road: Road | None = None,
) -> SeriesResult:
    """Drive a series with its present values; arguments and result as for `series`."""
    rows = []
    try:
        with on_road(road):
            for row in chosen.rows(vehicle, options):
                rows.append(row)
                progress()
    except BaseException as end:  # a signal too
        end.driven = SeriesResult(chosen.columns, rows, {}, _unfinished(rows))
        raise
    remarks = chosen.remarks(vehicle, rows)
    return SeriesResult(chosen.columns, rows, remarks, chosen.verdict(rows))


def _unfinished(rows: list[tuple]) -> str:
    runs = "1 run" if len(rows) == 1 else f"{len(rows)} runs"
    return f"none: the series ended after {runs}"


def _cell(value: float | str) -> str:
    if isinstance(value, str | int):
        return str(value)
    return "-" if math.isnan(value) else f"{value:.3f}"
