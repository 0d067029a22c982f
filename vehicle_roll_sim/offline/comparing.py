"""Comparison of a measured log with the model that is driven by it."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.figure_size import Size, named_size
from vehicle_roll_sim.comparison import comparison, report
from vehicle_roll_sim.comparison.agreement import Agreement
from vehicle_roll_sim.comparison.corridor import Tolerances
from vehicle_roll_sim.comparison.driving import Driving
from vehicle_roll_sim.comparison.steady import Gradients
from vehicle_roll_sim.declaration import parameters_of, unknown_name
from vehicle_roll_sim.files.output_file import check_figure_format
from vehicle_roll_sim.input_errors import given
from vehicle_roll_sim.logs.log import Log, log_of
from vehicle_roll_sim.logs.map_file import map_of
from vehicle_roll_sim.logs.settings import Conditioning
from vehicle_roll_sim.offline.log_files import read_log
from vehicle_roll_sim.offline.tables import known, path_of
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.plausibility import warn
from vehicle_roll_sim.vehicle.vehicle_file import preset

SETTINGS = (Conditioning, Driving, Tolerances)
"""Classes that declare the settings of a comparison."""


@dataclasses.dataclass(frozen=True)
class ComparisonResult:
    """The result of a comparison; `result["roll_measured"]` is a column, shape (n,), in SI units.

    Columns are time and, of each compared quantity, NAME_measured, NAME_simulated, NAME_lower and
    NAME_upper, the boundaries of the corridor. accepted: the verdict, None if nothing is large
    enough to judge. doubts: contradictions within the log, one line each.
    """

    compared: comparison.Compared

    def __getitem__(self, name: str) -> np.ndarray:
        columns = report.columns_of(self.compared)
        known(name, list(columns))
        return columns[name]

    @property
    def quantities(self) -> list[str]:
        """The names of the compared quantities."""
        return list(self.compared.judged)

    @property
    def accepted(self) -> bool | None:
        """Whether the model passes."""
        return self.compared.accepted

    @property
    def doubts(self) -> list[str]:
        """Contradictions within the log, such as a swapped sign."""
        return self.compared.log.doubts

    @property
    def agreements(self) -> dict[str, Agreement]:
        """Errors, time shift, correlation and gain of each quantity, in SI units."""
        return {name: each.agreement for name, each in self.compared.judged.items()}

    @property
    def inside(self) -> dict[str, float]:
        """Share of the measured samples inside the corridor over time, 0 to 1, by quantity."""
        return {name: each.inside for name, each in self.compared.judged.items()}

    @property
    def gradients(self) -> dict[str, Gradients] | None:
        """Gradients of understeer and roll, `measured` and `simulated`; None without a
        quasi-steady part.
        """
        part = self.compared.steady
        return {"measured": part.measured, "simulated": part.simulated} if part else None

    @property
    def summary(self) -> str:
        """What the command prints, without the lines on output files."""
        return report.summary(self.compared)

    def write_csv(self, path: str | Path) -> None:
        """Write all columns in full precision, like the option --csv."""
        report.write_csv(self.compared, path_of(path, "path"))

    def plot(self, path: str | Path, title: str = "", size: Size | str | None = None) -> None:
        """Write the figure (PNG, SVG or PDF, by the suffix of `path`), like --plot and --size."""
        size = size if isinstance(size, Size) else named_size(size, "size")
        path = path_of(path, "path")
        check_figure_format(path, "path")
        from vehicle_roll_sim.comparison import figures  # matplotlib: half a second

        figures.draw(self.compared, path, title, size)


def compare(
    log: str | Path,
    map: str | Path | Mapping,
    vehicle: Vehicle | None = None,
    *,
    simulation: Simulation | None = None,
    align: bool = False,
    **settings: float | str,
) -> ComparisonResult:
    """Drive the model by a measured log and compare the two, like `vehicle_roll_sim compare`.

    log: a file, or a folder for a bag. map: a map file, or a mapping of its keys. vehicle: by
    default the reference vehicle; simulation: for a model, a road or a step other than the default,
    instead of a vehicle. align: remove the time shift of each quantity first. settings: with the
    names and units of the command's options (`cutoff`, `drive_by`, `time_tolerance`, ...). Returns
    a ComparisonResult. Issues a PlausibilityWarning for contradictions within the log. Raises
    InputError.
    """
    chosen = [_chosen(kind, settings) for kind in SETTINGS]
    every = [name for kind in SETTINGS for name in parameters_of(kind)]
    for name in settings:
        if name not in every:
            raise unknown_name(name, every, "name")
    ready = load_log(path_of(log, "log"), map, chosen[0])
    warn(ready.doubts)
    if simulation is None:
        simulation = Simulation(preset() if vehicle is None else vehicle)
    given("simulation", simulation, Simulation)
    return compared(ready, simulation, *chosen[1:], align)


def _chosen(kind: type, settings: Mapping):
    """An instance of a declaring class from those of the settings that it declares."""
    return kind(**{name: settings[name] for name in parameters_of(kind) if name in settings})


def load_log(path: Path, map_given: str | Path | Mapping, conditions: Conditioning) -> Log:
    """A log that is ready to be compared; raises InputError."""
    log_map = map_of(map_given if isinstance(map_given, Mapping) else path_of(map_given, "map"))
    return log_of(read_log(path, log_map), log_map, conditions)


def compared(
    log: Log, simulation: Simulation, driving: Driving, tolerances: Tolerances, align: bool
) -> ComparisonResult:
    """Compare a log with a simulation."""
    return ComparisonResult(comparison.compare(log, simulation, driving, tolerances, align))
