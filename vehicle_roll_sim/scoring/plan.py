"""The runs of a score: tests, variants of the vehicle, sides and levels."""

import dataclasses
import functools
from collections.abc import Iterable, Iterator

from vehicle_roll_sim.declaration import InputError, unknown_name
from vehicle_roll_sim.manoeuvres.base import SIDES, Manoeuvre
from vehicle_roll_sim.manoeuvres.double_lane_change import DoubleLaneChange
from vehicle_roll_sim.manoeuvres.on_roads.own_road import road_for
from vehicle_roll_sim.manoeuvres.on_roads.split_friction import SplitFrictionBraking
from vehicle_roll_sim.manoeuvres.series.speed_search import to_the
from vehicle_roll_sim.scoring.catalogue import TESTS, ScoredTest
from vehicle_roll_sim.scoring.spread import SPREAD
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle

KEPT = 1000
"""Completed manoeuvres, more than a score has."""


@dataclasses.dataclass(frozen=True, eq=False)
class Setup:
    """What all runs share: vehicle, model, step (s), rollover angle (rad), command period (s)."""

    vehicle: Vehicle
    options: Options
    step: float
    rollover_angle: float
    road: Road
    period: float

    @functools.cached_property
    def _variants(self) -> dict[str, Vehicle]:
        return {}

    def variant(self, name: str) -> Vehicle:
        """The vehicle of a variant; raises InputError if it is not possible."""
        if name not in self._variants:
            self._variants[name] = SPREAD[name].of(self.vehicle)
        return self._variants[name]


@dataclasses.dataclass(frozen=True)
class Ladder:
    """One test with one variant to one side: runs at rising levels."""

    test: str
    variant: str
    side: str
    levels: tuple[float, ...]

    @property
    def of_test(self) -> ScoredTest:
        return TESTS[self.test]

    def name(self, level: float) -> str:
        """The name of the run at a level, also as part of a file name."""
        return f"{self.test}-{self.variant}-{self.side}-{level:g}"

    def manoeuvre(self, setup: Setup, level: float) -> Manoeuvre:
        """The manoeuvre at a level; raises InputError if the vehicle cannot be driven so."""
        return self.of_test.at(_ready(self, setup), level)

    def road(self, setup: Setup) -> Road:
        """The road of the test, else that of the setup.

        Raises InputError if the test has one and the setup another than the level plane.
        """
        own = road_for(_ready(self, setup), None) or self.of_test.road
        if own is None:
            return setup.road
        if setup.road not in (Road(), own):
            allowed = "a level road, or --only with tests that have no road of their own"
            raise InputError("road", "", allowed, f"{self.test} brings its own")
        return own

    def simulation(self, setup: Setup) -> Simulation:
        """A new simulation of the vehicle of the variant, on the road of the test."""
        return Simulation(
            setup.variant(self.variant),
            setup.options,
            step=setup.step,
            rollover_angle=setup.rollover_angle,
            road=self.road(setup),
        )


@functools.lru_cache(maxsize=KEPT)
def _ready(ladder: Ladder, setup: Setup) -> Manoeuvre:
    """The manoeuvre of a ladder, completed for its vehicle."""
    manoeuvre = ladder.of_test.manoeuvre
    if isinstance(manoeuvre, DoubleLaneChange | SplitFrictionBraking):
        manoeuvre = dataclasses.replace(manoeuvre, side=ladder.side)
    else:
        manoeuvre = to_the(ladder.side, manoeuvre)
    return manoeuvre.for_vehicle(setup.variant(ladder.variant), setup.options)


def ladders(only: Iterable[str], is_quick: bool) -> list[Ladder]:
    """The ladders of a score, in order. only: names of tests, none for all; raises InputError."""
    chosen = list(only)
    for name in chosen:
        if name not in TESTS:
            raise unknown_name(name, TESTS, "--only")
    return list(_ladders(chosen or list(TESTS), is_quick))


def _ladders(tests: list[str], is_quick: bool) -> Iterator[Ladder]:
    sides = list(SIDES)[:1] if is_quick else list(SIDES)
    for variant, change in SPREAD.items():
        if is_quick and not change.is_quick:
            continue
        for name, test in TESTS.items():
            levels = test.quick if is_quick else test.levels
            if name not in tests or not levels:
                continue
            for side in sides:
                yield Ladder(name, variant, side, levels)
