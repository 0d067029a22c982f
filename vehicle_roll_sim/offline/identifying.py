"""Identification of a vehicle from measured logs."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.figure_size import Size, named_size
from vehicle_roll_sim.comparison import comparison
from vehicle_roll_sim.comparison.corridor import Tolerances
from vehicle_roll_sim.comparison.driving import Driving
from vehicle_roll_sim.declaration import parameters_of, unknown_name
from vehicle_roll_sim.files.output_file import check_figure_format
from vehicle_roll_sim.identification import report, vehicle_text
from vehicle_roll_sim.identification.estimate import Estimate, estimated
from vehicle_roll_sim.identification.free import applied, free_of
from vehicle_roll_sim.identification.problem import Problem
from vehicle_roll_sim.identification.profile import Profile, profile
from vehicle_roll_sim.identification.settings import priors_of, with_sensors
from vehicle_roll_sim.input_errors import InputError, given
from vehicle_roll_sim.logs.log import Log
from vehicle_roll_sim.logs.settings import Conditioning
from vehicle_roll_sim.offline.comparing import SETTINGS, ComparisonResult, load_log
from vehicle_roll_sim.offline.tables import path_of
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.plausibility import warn
from vehicle_roll_sim.vehicle.vehicle_file import preset

NOTHING = "the logs do not say"


@dataclasses.dataclass(frozen=True)
class Identification:
    """The result of an identification.

    estimate: values, covariance and combinations. logs, held_out: by name, the comparison of the
    identified vehicle with each log, its sensors corrected.
    """

    estimate: Estimate
    logs: dict[str, ComparisonResult]
    held_out: dict[str, ComparisonResult]

    @property
    def names(self) -> list[str]:
        """What was identified, in the order of `covariance`."""
        return [each.name for each in self.estimate.free]

    @property
    def values(self) -> dict[str, float]:
        """Identified values by name, in their units."""
        return self.estimate.values

    @property
    def errors(self) -> dict[str, float]:
        """Standard errors by name."""
        return self.estimate.errors

    @property
    def intervals(self) -> dict[str, tuple[float, float]]:
        """Intervals of 95 % by name."""
        return self.estimate.intervals

    @property
    def covariance(self) -> np.ndarray:
        """Covariance of the values, shape (p, p), in their units."""
        scales = self.estimate.problem.scales
        return self.estimate.uncertainty.covariance * np.outer(scales, scales)

    @property
    def correlations(self) -> np.ndarray:
        """Correlation matrix, shape (p, p)."""
        return self.estimate.uncertainty.correlations

    @property
    def not_identifiable(self) -> list[str]:
        """Combinations of which the logs say nothing, in words."""
        found = self.estimate.uncertainty.combinations
        return [report.in_words(each, self.names) for each in found if not each.is_identifiable]

    @property
    def vehicle(self) -> Vehicle:
        """The identified vehicle. Raises InputError if something is not identifiable."""
        self._check()
        return applied(self.estimate.problem.simulation.vehicle, self.values)[0]

    def _check(self) -> None:
        if self.not_identifiable:
            allowed = "fewer names, a prior for one of them, or logs in which they differ"
            problem = f"{NOTHING} {'; '.join(self.not_identifiable)}"
            raise InputError("free", "", allowed, problem)

    @property
    def summary(self) -> str:
        """What the command prints, without the lines on output files."""
        lines = [report.summary(self.estimate, list(self.logs))]
        if not self.not_identifiable:
            lines += [report.verdict_line(f"on {n}", r.compared) for n, r in self.logs.items()]
            held = self.held_out.items()
            lines += [report.verdict_line(f"held out, {n}", r.compared) for n, r in held]
        return "\n".join(lines)

    def write_vehicle(self, path: str | Path) -> list[Path]:
        """Write the vehicle file, like --out; returns the paths of all files written.

        Raises InputError if something is not identifiable.
        """
        self._check()
        return vehicle_text.write_vehicle(self.estimate, path_of(path, "path"), list(self.logs))

    def profile(self, name: str) -> Profile:
        """The profile likelihood of a value, like --profile; raises InputError."""
        return profile(self.estimate, name)


def draw_profile(
    found: Profile, path: str | Path, title: str = "", size: Size | str | None = None
) -> None:
    """Write the figure of a profile (PNG, SVG or PDF, by the suffix of `path`)."""
    size = size if isinstance(size, Size) else named_size(size, "size")
    path = path_of(path, "path")
    check_figure_format(path, "path")
    from vehicle_roll_sim.identification import figures  # matplotlib: half a second

    figures.draw(found, path, title, size)


def identify(
    logs: str | Path | Sequence[str | Path],
    map: str | Path | Mapping,
    free: Sequence[str],
    vehicle: Vehicle | None = None,
    *,
    simulation: Simulation | None = None,
    hold_out: Sequence[str | Path] = (),
    sensors: Sequence[str] = (),
    priors: Mapping[str, tuple[float, float]] | None = None,
    workers: int | None = None,
    **settings: float | str,
) -> Identification:
    """Identify a vehicle from measured logs, like `vehicle_roll_sim identify`.

    logs, hold_out: files, or folders for bags, all with one map. map: a map file, or a mapping of
    its keys. free: names of what is identified. vehicle: to start from, by default the reference
    vehicle; simulation: for a model, a road or a step other than the default, instead of a vehicle.
    sensors: `bias`, `delay`, `scale` of all compared quantities. priors: mean and standard
    deviation by name. workers: number of threads. settings: as for `compare`. Issues a
    PlausibilityWarning for contradictions within a log. Raises InputError.
    """
    every = [name for kind in SETTINGS for name in parameters_of(kind)]
    for name in settings:
        if name not in every:
            raise unknown_name(name, every, "name")
    chosen = [
        kind(**{name: settings[name] for name in parameters_of(kind) if name in settings})
        for kind in SETTINGS
    ]
    used, held = (load_logs(each, map, chosen[0]) for each in (_listed(logs), _listed(hold_out)))
    for log in (*used.values(), *held.values()):
        warn(log.doubts)
    if simulation is None:
        simulation = Simulation(preset() if vehicle is None else vehicle)
    given("simulation", simulation, Simulation)
    names = [free] if isinstance(free, str) else list(free)
    return identified(
        used, held, simulation, names, list(sensors), priors or {}, chosen[1:], workers
    )


def _listed(paths) -> list[Path]:
    paths = [paths] if isinstance(paths, str | Path) else list(paths)
    return [path_of(each, "log") for each in paths]


def load_logs(
    paths: Sequence[Path], map_given: str | Path | Mapping, conditions: Conditioning
) -> dict[str, Log]:
    """Logs by the names of their files; raises InputError."""
    names = [
        path.name if [p.name for p in paths].count(path.name) == 1 else str(path) for path in paths
    ]
    for path, name in zip(paths, names, strict=True):
        if names.count(name) > 1:
            raise InputError("LOG", str(path), "each log once")
    return {
        name: load_log(path, map_given, conditions) for path, name in zip(paths, names, strict=True)
    }


def _compared(used: Mapping[str, Log]) -> list[str]:
    """The quantities that any of the logs has."""
    return list(dict.fromkeys(name for log in used.values() for name in log.compared))


def all_names(used: Mapping[str, Log], names: Sequence[str], kinds: Sequence[str]) -> list[str]:
    """What is to be identified: the names, and values of these kinds of all sensors."""
    return with_sensors(names, kinds, _compared(used))


def identified(
    used: Mapping[str, Log],
    held: Mapping[str, Log],
    simulation: Simulation,
    names: Sequence[str],
    kinds: Sequence[str],
    priors: Mapping[str, tuple[float, float]],
    chosen: tuple[Driving, Tolerances],
    workers: int | None = None,
    progress: Callable[[int], None] = lambda runs: None,
) -> Identification:
    """Identify a vehicle from logs that were read, and judge it on them and on those held out."""
    driving, tolerances = chosen
    every = all_names(used, names, kinds)
    free = free_of(every, simulation.vehicle, _compared(used))
    logs = list(used.values())
    problem = Problem(logs, simulation, free, driving, priors_of(priors, every), workers)
    estimate = estimated(problem, progress)
    vehicle, sensors = applied(simulation.vehicle, estimate.values)

    def judged(log: Log) -> ComparisonResult:
        corrected = sensors.corrected(log)
        return ComparisonResult(
            comparison.compare(corrected, problem.like(vehicle), driving, tolerances)
        )

    results = [{name: judged(log) for name, log in of.items()} for of in (used, held)]
    return Identification(estimate, *results)
