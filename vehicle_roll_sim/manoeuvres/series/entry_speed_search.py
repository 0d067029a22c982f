"""The highest speed at which a vehicle gets through a double lane change."""

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
"""km/h: steps of the entry speed, first up to a run that fails, then from the last that did not."""
SLOWER = 1.5
"""A run lasts as long as the track at the entry speed divided by this,"""
BEYOND = 2.0
"""and so much longer (s): a rollover that has begun comes to its end."""
SPEED, CONES, END = 1, 2, -1
"""Places in a row."""


@dataclasses.dataclass(frozen=True)
class EntrySpeedSearch(Series):
    """Entry speeds in coarse steps up to the first that fails; then in fine steps up to the first
    that fails of those between it and the one before.

    slowest, fastest: the first and the last entry speed (km/h). A run fails that strikes a cone,
    misses a lane, does not come to the end of the track, or rolls over. The result is the highest
    speed below every failure; speeds that were not driven are not spoken of.
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
        """Runs at these speeds (km/h) up to the first that fails."""
        for speed in speeds:
            row = self._row(ready, speed, vehicle, options)
            yield row
            if not _is_passed(row):
                return

    def _row(
        self, ready: DoubleLaneChange, speed: int, vehicle: Vehicle, options: Options
    ) -> tuple:
        """One run, without the direction in front."""
        metres_per_second = speed / KMH
        length = ready.approach + ready.track.end + ready.outline.ahead + ready.outline.behind
        duration = round(SLOWER * length / metres_per_second + BEYOND, 1)
        manoeuvre = dataclasses.replace(ready, speed=metres_per_second, duration=duration)
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
        return f"{max(passed):g} km/h" if passed else f"failed from {min(failed):g} km/h on"


def _is_passed(row: tuple) -> bool:
    """Whether a row, without the direction in front, is one of a run that did not fail."""
    return row[CONES - 1] == 0 and row[END] == COMPLETE
