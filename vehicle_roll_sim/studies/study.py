"""A study: the runs, the varied quantities, the events and the search."""

import dataclasses
import hashlib
import json
import math
from collections.abc import Mapping

import numpy as np

from vehicle_roll_sim.declaration import InputError, keep_validated, parameter, parameters_of
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.runs.control_law import ControlLaw
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.simulation.integration import Integration
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.studies.factors import Distribution, Factor, Levels
from vehicle_roll_sim.studies.source import whole
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.version import __version__

GRID, LATIN_HYPERCUBE, SOBOL, RANDOM, SALTELLI = DESIGNS = (
    *("grid", "latin_hypercube", "sobol", "random", "saltelli"),
)
MOST_RUNS = 1_000_000
NEVER = tuple(name for name in METRIC_UNITS if name.endswith("_time") and name != "end_time")
"""Times of occurrences, nan for those that did not take place."""
A_WHOLE_NUMBER = "a whole number"


@dataclasses.dataclass(frozen=True)
class Settings(Integration):
    """Numbers of a study as a whole. Raises InputError."""

    runs: float | None = parameter(
        "number of draws from the distributions, at each point of the grid",
        "",
        1,
        MOST_RUNS,
        default=None,
    )
    seed: float | None = parameter("seed of the draws", "", 0, 2**32 - 1, default=None)
    chunk: float = parameter(
        "number of runs that are evaluated, and kept, together", "", 1, 10_000, default=64
    )

    def __post_init__(self):
        given = {name: getattr(self, name) for name in parameters_of(self)}
        given = {name: value for name, value in given.items() if value is not None}
        keep_validated(self, given)
        for name in given.keys() & {"runs", "seed", "chunk"}:
            object.__setattr__(self, name, whole(getattr(self, name), name, A_WHOLE_NUMBER))


@dataclasses.dataclass(frozen=True)
class Event:
    """What may happen in a run: a time is not nan, or a magnitude is beyond a bound."""

    metric: str = parameter("metric of the runs", choices=tuple(METRIC_UNITS))
    above: float | None = parameter(
        "the event happens if the magnitude is at least this", "", 0.0, default=None
    )
    below: float | None = parameter(
        "the event happens if the magnitude is at most this", "", 0.0, default=None
    )

    def __post_init__(self):
        bounds = {name: getattr(self, name) for name in ("above", "below")}
        given = {name: bound for name, bound in bounds.items() if bound is not None}
        keep_validated(self, {"metric": self.metric, **given})
        if len(given) == 2:
            raise InputError("below", self.below, "either above or below, not both")
        if not given and self.metric not in NEVER:
            raise InputError("above", None, f"{self.metric} needs a bound, above or below")

    @property
    def is_bounded(self) -> bool:
        return (self.above, self.below) != (None, None)

    def margin(self, row: Mapping) -> float:
        """How far the run is past the bound, negative if it is not; nan if that is unknown."""
        value = row[self.metric]
        if value is None:
            return math.nan
        if not self.is_bounded:
            return -math.inf if math.isnan(value) else math.inf
        return self.below - abs(value) if self.above is None else abs(value) - self.above

    def happened(self, row: Mapping) -> bool | None:
        """Whether it happened in a run; None for a run that failed."""
        if row[self.metric] is None:
            return None
        return self.margin(row) >= 0.0  # a time that is never is past no bound: nan

    def __str__(self) -> str:
        if not self.is_bounded:
            return f"there is a {self.metric}"
        sign, bound = (">=", self.above) if self.below is None else ("<=", self.below)
        unit = METRIC_UNITS[self.metric]
        return f"|{self.metric}| {sign} {bound:g}{f' {unit}' if unit else ''}"


EVENTS = {"rollover": Event("rollover_time"), "two_wheel_lift": Event("two_wheel_lift_time")}
"""The events of a study that names none."""


@dataclasses.dataclass(frozen=True)
class Search:
    """At each point of the design, the lowest value of a factor at which an event happens."""

    factor: str = parameter("name of the factor that is searched over")
    event: str = parameter("name of the event")
    lowest: float = parameter("lowest value of the factor")
    highest: float = parameter("highest value of the factor")
    resolution: float = parameter("width of the interval at which the search stops", "", 0.0)
    steps: float = parameter(
        "number of equal steps of the initial scan of the range", "", 1, 1000, default=8
    )

    def __post_init__(self):
        keep_validated(self)
        if not self.lowest < self.highest:
            raise InputError("highest", self.highest, f"more than lowest, {self.lowest:g}")
        finest = (self.highest - self.lowest) * 1e-9
        if not self.resolution >= finest:
            raise InputError("resolution", self.resolution, f"a number from {finest:.3g}")
        object.__setattr__(self, "steps", whole(self.steps, "steps", A_WHOLE_NUMBER))


@dataclasses.dataclass(frozen=True)
class Rare:
    """The probability of a rare event by subset simulation."""

    event: str = parameter("name of the event, one with a bound")
    level_runs: float = parameter("runs of a level", "", 20, 100_000, default=1000)
    most_levels: float = parameter(
        "number of levels after which the estimate is given up", "", 1, 30, default=10
    )

    def __post_init__(self):
        keep_validated(self)
        for name in ("level_runs", "most_levels"):
            object.__setattr__(self, name, whole(getattr(self, name), name, A_WHOLE_NUMBER))
        if self.level_runs % 10:
            raise InputError("level_runs", self.level_runs, "a multiple of 10")


@dataclasses.dataclass(frozen=True)
class Study:
    """A study that has been checked.

    vehicle, manoeuvre, controller: what the fixed values and the factors change, by their names; no
    controller is None. code: what Python code of the user's own the manoeuvre and the controller
    have, by section, see `own_code`. correlation:
    of the normal scores of the drawn factors, shape (drawn, drawn). outputs: metrics that are
    drawn and summarized. said: the values as they were given, for comparison, with
    those of the road in place of its file.
    """

    said: dict
    manoeuvre: Manoeuvre
    vehicle: Vehicle
    fixed: dict[str, float | str | bool]
    factors: dict[str, Factor]
    correlation: np.ndarray
    design: str
    settings: Settings
    outputs: tuple[str, ...]
    events: dict[str, Event]
    search: Search | None = None
    rare: Rare | None = None
    road: Road | None = None
    controller: ControlLaw | None = None
    code: dict[str, dict] = dataclasses.field(default_factory=dict)

    @property
    def driving(self) -> dict[str, Manoeuvre | ControlLaw | None]:
        """What drives the vehicle, by the section of its parameters."""
        return {"manoeuvre": self.manoeuvre, "controller": self.controller}

    @property
    def gridded(self) -> dict[str, tuple]:
        """The values of the factors whose values are all run, by name."""
        drawn = self.drawn
        return {name: each.values for name, each in self.factors.items() if name not in drawn}

    @property
    def drawn(self) -> dict[str, Distribution]:
        """The factors that are drawn from distributions, by name."""
        return {n: each for n, each in self.factors.items() if isinstance(each, Distribution)}

    @property
    def inputs(self) -> tuple[str, ...]:
        """The names of all that differs between runs."""
        return (*self.factors, *((self.search.factor,) if self.search else ()))

    @property
    def kinds(self) -> dict[str, type]:
        """Whether the values of an input are float, bool or str, by name."""
        lists = {n: each.values for n, each in self.factors.items() if isinstance(each, Levels)}
        return {name: type(lists[name][0]) if name in lists else float for name in self.inputs}

    @property
    def samples(self) -> int:
        """Number of draws at each point of the grid."""
        if not self.drawn or self.rare:
            return 1
        return self.settings.runs * (len(self.drawn) + 2 if self.design == SALTELLI else 1)

    @property
    def points(self) -> int:
        """Number of points of the design."""
        return math.prod(map(len, self.gridded.values())) * self.samples

    @property
    def identity(self) -> dict:
        """What results depend on: the study, its vehicle and the version of the program."""
        vehicle = {
            "given": self.vehicle.given,
            "tires": [
                [tire.coefficients, tire.side, tire.version, tire.combined]
                for tire in self.vehicle.axle_tires.values()
            ],
            "payload": [dataclasses.asdict(load) for load in self.vehicle.payload],
            "others": [
                getattr(self.vehicle, name)
                for name in ("tire_moments", "contact_patch_shift", "model")
            ],
        }
        digest = hashlib.sha256(json.dumps(vehicle).encode()).hexdigest()
        code = {"code": self.code} if self.code else {}
        return {"version": __version__, "vehicle": digest, **code, "study": self.said}
