"""Search for the highest entry speed at which a vehicle passes a double lane change."""

import dataclasses
import math
from collections.abc import Iterator

from vehicle_roll_sim.manoeuvres.base import SIDES
from vehicle_roll_sim.manoeuvres.body_outline import BodySettings
from vehicle_roll_sim.manoeuvres.criteria import two_wheel_lift
from vehicle_roll_sim.manoeuvres.double_lane_change import KMH, DoubleLaneChange
from vehicle_roll_sim.manoeuvres.driver.path_following import DriverSettings
from vehicle_roll_sim.manoeuvres.series.base import COMPLETE, Series, driven, ending_of
from vehicle_roll_sim.model.integration.events import VALUE
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

COARSE, FINE = 5, 1
"""km/h: steps of the entry speed up to the first failed run, and within the step before it."""
SLOWER = 1.5
"""Factor on the time that the track takes at entry speed, to allow for deceleration."""
BEYOND = 2.0
"""s: additional duration of a run, so that a rollover that has begun is completed."""
SPEED, CONES, END = 1, 2, -1
"""Indices in a row."""


@dataclasses.dataclass(frozen=True)
class EntrySpeedSearch(Series):
    """Runs at rising entry speeds: in coarse steps to the first failure, then in fine steps.

    The fine steps cover the last coarse step, again up to the first failure. slowest, fastest:
    range of the entry speed (km/h). A run fails if it strikes a cone, misses a lane, does not reach
    the end of the track, or rolls over. The result is the highest speed driven below all failures.
    """

    slowest: int
    fastest: int

    columns = (
        *("direction", "speed_kmh", "cones_struck", "deviation", "peak_roll_deg"),
        *("two_wheel_lift", "final_speed_kmh", "end"),
    )
    settings = (("body", BodySettings), ("driver", DriverSettings))

    def rows_to_a_side(
        self, ready: DoubleLaneChange, direction: str, vehicle: Vehicle, options: Options
    ) -> Iterator[tuple]:
        ready = dataclasses.replace(ready, side=direction).for_vehicle(vehicle, options)
        coarse = range(self.slowest, self.fastest + 1, COARSE)
        for row in self._climb(ready, coarse, vehicle, options):
            yield row
        speed = row[SPEED - 1]
        if not _is_passed(row) and speed > self.slowest:
            between = range(speed - COARSE + FINE, speed, FINE)
            yield from self._climb(ready, between, vehicle, options)

    def _climb(
        self, ready: DoubleLaneChange, speeds: range, vehicle: Vehicle, options: Options
    ) -> Iterator[tuple]:
        """Drive runs at these speeds (km/h) up to the first failure."""
        for speed in speeds:
            row = self._row(ready, speed, vehicle, options)
            yield row
            if not _is_passed(row):
                return

    def _row(
        self, ready: DoubleLaneChange, speed: int, vehicle: Vehicle, options: Options
    ) -> tuple:
        """Drive one run; returns its row without the direction."""
        manoeuvre = at_entry_speed(ready, speed)
        simulation, history = driven(manoeuvre, vehicle, options)
        result = manoeuvre.result(history)
        ending = ending_of(simulation)
        if ending == COMPLETE and math.isnan(result.finished):
            ending = "unfinished"
        if ending == COMPLETE and result.missed:
            ending = "missed_lane"
        peak = math.degrees(simulation.events.peak_roll[VALUE])
        lift, final_speed = two_wheel_lift(history), result.final_speed * KMH
        return speed, result.struck, result.deviation, peak, lift, final_speed, ending

    def verdict(self, rows: list[tuple]) -> str:
        parts = [self._to_a_side([row for row in rows if row[0] == side]) for side in SIDES]
        return ", ".join(f"{part} to the {side}" for part, side in zip(parts, SIDES, strict=True))

    def _to_a_side(self, rows: list[tuple]) -> str:
        failed = [row[SPEED] for row in rows if not _is_passed(row[1:])]
        if not failed:
            return f"no failure up to {max(row[SPEED] for row in rows):g} km/h"
        passed = [row[SPEED] for row in rows if row[SPEED] < min(failed)]
        return f"{max(passed):g} km/h" if passed else f"failed already at {min(failed):g} km/h"


def at_entry_speed(ready: DoubleLaneChange, speed: float) -> DoubleLaneChange:
    """A manoeuvre completed by `for_vehicle`, at an entry speed (km/h), as long as it takes."""
    metres_per_second = speed / KMH
    length = ready.approach + ready.track.end + ready.outline.ahead + ready.outline.behind
    duration = round(SLOWER * length / metres_per_second + BEYOND, 1)
    return dataclasses.replace(ready, speed=metres_per_second, duration=duration)


def _is_passed(row: tuple) -> bool:
    """Whether the run of a row (without the direction) passed."""
    return row[CONES - 1] == 0 and row[END] == COMPLETE
