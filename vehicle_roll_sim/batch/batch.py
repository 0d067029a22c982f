"""Many runs together: each argument is one value, or one for each run."""

import collections
from collections.abc import Iterator, Sequence

import numpy as np

from vehicle_roll_sim.batch.case import Case, Outcome, no_state
from vehicle_roll_sim.batch.evaluate import outcomes
from vehicle_roll_sim.declaration import InputError, unknown_name
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.control_law import ControlLaw
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_ANGLE, DEFAULT_STEP
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.parameters import Vehicle

ARGUMENTS = {"vehicle": "vehicles"}
"""Arguments of Batch that are not named like the value of a Case."""


class Batch:
    """Runs of many vehicles, manoeuvres, options and speeds, driven on all processors.

    Every argument is one value for all runs, or a sequence with one for each run. vehicles: a
    Vehicle. options: Options, or None for those of the vehicle. manoeuvre: a name of the catalogue
    or a Manoeuvre. speed: entry speed (m/s), duration: simulated time (s), by default those of the
    manoeuvre. controller: a ControlLaw, by default none. model: in place of that of the options.
    road: by default level. step: integration step (s). rollover_angle: roll angle at which a run
    stops (rad).

    Raises InputError for sequences of different lengths, and for unknown manoeuvres. All else is
    checked run by run: a run that is refused does not stop the others. `len(batch)` is the number
    of runs, `batch[i]` a Case.
    """

    def __init__(
        self,
        vehicles: Vehicle | Sequence[Vehicle],
        options: Options | Sequence[Options | None] | None = None,
        *,
        manoeuvre: str | Manoeuvre | Sequence[str | Manoeuvre],
        speed: float | Sequence[float | None] | None = None,
        duration: float | Sequence[float | None] | None = None,
        controller: ControlLaw | Sequence[ControlLaw | None] | None = None,
        model: str | Sequence[str | None] | None = None,
        road: Road | Sequence[Road | None] | None = None,
        step: float | Sequence[float] = DEFAULT_STEP,
        rollover_angle: float | Sequence[float] = DEFAULT_ROLLOVER_ANGLE,
    ):
        self._values = {
            "vehicle": vehicles,
            "manoeuvre": _named(manoeuvre),
            "speed": speed,
            "duration": duration,
            "controller": controller,
            "options": options,
            "model": model,
            "road": road,
            "step": step,
            "rollover_angle": rollover_angle,
        }
        self._per_run = {name for name, value in self._values.items() if _is_sequence(value)}
        self._length = self._common_length()

    def _common_length(self) -> int:
        """The number of runs: the length that most sequences have; raises InputError for others."""
        lengths = {name: len(self._values[name]) for name in self._values if name in self._per_run}
        if not lengths:
            return 1
        usual = collections.Counter(lengths.values()).most_common(1)[0][0]  # the first, if tied
        whose = next(name for name, length in lengths.items() if length == usual)
        for name, length in lengths.items():
            if length != usual:
                problem = f"{length} values, but {usual} of {ARGUMENTS.get(whose, whose)}"
                field = ARGUMENTS.get(name, name)
                raise InputError(field, "", "one value, or one for each run", problem)
        return usual

    def __len__(self) -> int:
        return self._length

    def __getitem__(self, i: int) -> Case:
        if not -self._length <= i < self._length:
            raise IndexError(i)
        values = self._values.items()
        return Case(**{name: each[i] if name in self._per_run else each for name, each in values})

    def __iter__(self) -> Iterator[Case]:
        return (self[i] for i in range(self._length))

    def run(self, *, workers: int | None = None, histories: bool = False) -> "BatchResult":
        """Drive all runs; the results are bit for bit those of single runs.

        workers: number of threads, by default one for each processor that the process may use.
        histories: whether to keep the rows of all runs, about 0.5 MB each for 10 s; without them
        the result takes 0.5 kB for each run. Raises InputError for an invalid number of workers.
        """
        found = outcomes(self, workers=workers, histories=histories)
        return BatchResult(self, found, histories)


class BatchResult:
    """The results of a batch; `result["peak_roll"]` is a metric of all runs, shape (runs,).

    batch: the batch. columns, units: names of the metrics, and their units by name; the metrics are
    those of `RunResult.metrics`, nan for a run that failed. failures: for each run "", or one line
    that says why it failed. conditions: for each run RUNNING if it was completed, else why it
    stopped; None if it was refused or failed. final_states: STATE records, shape (runs,), such as
    `final_states["u"]`; nan for a run without a condition. histories: the History of each run, None
    without a condition; an empty list if they were not asked for.
    """

    columns = tuple(METRIC_UNITS)
    units = METRIC_UNITS

    def __init__(self, batch: Batch, found: Iterator[Outcome], histories: bool):
        self.batch = batch
        self._metrics = np.full((len(batch), len(self.columns)), np.nan)
        self.final_states = np.repeat(no_state(), len(batch))
        self.failures: list[str] = []
        self.conditions: list[Condition | None] = []
        self.histories: list[History | None] = []
        for i, outcome in enumerate(found):
            if outcome.metrics:
                self._metrics[i] = [outcome.metrics[name] for name in self.columns]
            self.final_states[i] = outcome.final_state
            self.failures.append(outcome.failure)
            self.conditions.append(outcome.condition)
            if histories:
                self.histories.append(outcome.history)

    def __len__(self) -> int:
        return len(self.batch)

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self.columns:
            raise KeyError(f"no metric {name!r}: one of {', '.join(self.columns)}")
        return self._metrics[:, self.columns.index(name)]

    def to_numpy(self) -> np.ndarray:
        """All metrics as a structured array, shape (runs,), with a float64 field for each."""
        return self._metrics.copy().view([(name, float) for name in self.columns])[:, 0]


def _is_sequence(value) -> bool:
    is_list = isinstance(value, Sequence) and not isinstance(value, str | bytes)
    return is_list or getattr(value, "ndim", None) == 1


def _named(manoeuvre):
    """The manoeuvre, or each of a sequence, in place of its name in the catalogue."""
    if _is_sequence(manoeuvre):
        return [_named(each) for each in manoeuvre]
    if not isinstance(manoeuvre, str):
        return manoeuvre
    if manoeuvre not in MANOEUVRES:
        raise unknown_name(manoeuvre, MANOEUVRES, "manoeuvre")
    return MANOEUVRES[manoeuvre]
