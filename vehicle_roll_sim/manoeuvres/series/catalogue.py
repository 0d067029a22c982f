"""Test series: runs of a manoeuvre with rising entry speed or steering amplitude, and a verdict."""

import dataclasses
import math
from collections.abc import Iterator

import numpy as np

from vehicle_roll_sim.declaration import InputError, unknown_name
from vehicle_roll_sim.manoeuvres.base import SIDES
from vehicle_roll_sim.manoeuvres.catalogue import ON_ANY_ROAD
from vehicle_roll_sim.manoeuvres.criteria import has_wheel_heights, two_wheel_lift
from vehicle_roll_sim.manoeuvres.double_lane_change import (
    ISO_DOUBLE_LANE_CHANGE,
    ISO_SEVERE_DOUBLE_LANE_CHANGE,
)
from vehicle_roll_sim.manoeuvres.driver.path_following import PathFollowing
from vehicle_roll_sim.manoeuvres.handwheel import (
    METRES_PER_SECOND_OF_A_MPH,
    ROUNDING,
    at_the_road_wheels,
    largest_handwheel,
)
from vehicle_roll_sim.manoeuvres.nhtsa import NHTSA_FISHHOOK, NHTSA_J_TURN
from vehicle_roll_sim.manoeuvres.scaled import ScaledManoeuvre
from vehicle_roll_sim.manoeuvres.series.base import COMPLETE, Series, driven, ending_of
from vehicle_roll_sim.manoeuvres.series.entry_speed_search import EntrySpeedSearch
from vehicle_roll_sim.manoeuvres.series.speed_search import SpeedSearch
from vehicle_roll_sim.manoeuvres.sine_with_dwell import (
    LADDER_TO,
    SINE_WITH_DWELL,
    SineWithDwellResult,
)
from vehicle_roll_sim.manoeuvres.steady_turn import RisingSpeed
from vehicle_roll_sim.model.integration.events import VALUE
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle

LADDER_FROM, LADDER_STEP = 1.5, 0.5
"""Scalars of the sine with dwell: handwheel amplitude over the handwheel angle at 0.3 g."""
LEAST_FINAL, LARGEST_FINAL = 270.0, 300.0
"""deg: limits of the final amplitude, which is otherwise 6.5 times the angle at 0.3 g."""


@dataclasses.dataclass(frozen=True)
class SpeedSeries(Series):
    """Runs at rising entry speeds (mph) until two-wheel lift."""

    speeds: tuple[float, ...]

    columns = ("direction", "speed_mph", "amplitude_deg", "peak_roll_deg", "two_wheel_lift", "end")

    def rows_to_a_side(
        self, ready: ScaledManoeuvre, direction: str, vehicle: Vehicle, options: Options
    ) -> Iterator[tuple]:
        side = SIDES[direction]
        for speed in self.speeds:
            manoeuvre = dataclasses.replace(
                ready, speed=speed * METRES_PER_SECOND_OF_A_MPH, scalar=side * ready.scalar
            )
            simulation, history = driven(manoeuvre, vehicle, options)
            if not has_wheel_heights(history):
                raise InputError("model", options.model, "a model that computes wheel heights")
            lift = two_wheel_lift(history)
            peak = math.degrees(simulation.events.peak_roll[VALUE])
            ending = ending_of(simulation)
            yield speed, manoeuvre.amplitude, peak, lift, ending
            if not (math.isnan(lift) and ending == COMPLETE):
                return

    def remarks(self, vehicle: Vehicle, rows: list[tuple]) -> dict[str, str]:
        """A line if the amplitudes end where the road wheels turn no further."""
        largest = largest_handwheel(vehicle.gear)
        if abs(rows[0][2]) < largest * (1.0 - ROUNDING):
            return {}
        return {"amplitudes end at": at_the_road_wheels(largest, vehicle.gear)}

    def verdict(self, rows: list[tuple]) -> str:
        ended = [row for row in rows if not math.isnan(row[4]) or row[-1] != COMPLETE]
        if not ended:
            return f"no two-wheel lift up to {max(row[1] for row in rows):g} mph"
        events = [row[-1] if math.isnan(row[4]) else "two-wheel lift" for row in ended]
        where = [f"at {row[1]:g} mph to the {row[0]}" for row in ended]
        return ", ".join(f"{event} {place}" for event, place in zip(events, where, strict=True))


@dataclasses.dataclass(frozen=True)
class AmplitudeLadder(Series):
    """Runs of the sine with dwell at rising amplitudes, each with a verdict."""

    columns = (
        *("direction", "scalar", "amplitude_deg", "yaw_rate_ratio_1_00", "yaw_rate_ratio_1_75"),
        *("displacement", "verdict"),
    )

    def rows_to_a_side(
        self, ready: ScaledManoeuvre, direction: str, vehicle: Vehicle, options: Options
    ) -> Iterator[tuple]:
        side = SIDES[direction]
        for scalar in ladder(ready.steering_at_03g, largest_handwheel(ready.gear)):
            manoeuvre = dataclasses.replace(ready, scalar=side * scalar).checked()
            _, history = driven(manoeuvre, vehicle, options)
            result: SineWithDwellResult = manoeuvre.result(history)
            verdict = "passed" if result.is_passed else "failed"
            ratios = result.yaw_rate_ratios
            yield scalar, manoeuvre.amplitude, *ratios, result.displacement, verdict

    def remarks(self, vehicle: Vehicle, rows: list[tuple]) -> dict[str, str]:
        """A line if the vehicle cannot reach the standard's final amplitude."""
        largest = largest_handwheel(vehicle.gear)
        _, scalar, amplitude, *_ = rows[-1]
        wanted = final_amplitude(abs(amplitude) / scalar)
        if wanted <= largest:
            return {}
        end = at_the_road_wheels(largest, vehicle.gear)
        return {"amplitudes end at": f"{end}; the standard requires {wanted:.4g} deg"}

    def verdict(self, rows: list[tuple]) -> str:
        failed = [row for row in rows if row[-1] != "passed"]
        if not failed:
            return "passed"
        first = [next((r for r in failed if r[0] == side), None) for side in SIDES]
        where = [f"from {abs(row[2]):.1f} deg to the {row[0]}" for row in first if row]
        return f"failed {', '.join(where)}: {len(failed)} of {len(rows)} runs"


SERIES = {
    "nhtsa_j_turn": SpeedSeries(NHTSA_J_TURN, (35.0, 40.0, 45.0, 50.0, 55.0, 60.0)),
    "nhtsa_fishhook": SpeedSeries(NHTSA_FISHHOOK, (35.0, 40.0, 45.0, 47.5, 50.0)),
    "sine_with_dwell": AmplitudeLadder(SINE_WITH_DWELL),
    "iso_double_lane_change": EntrySpeedSearch(ISO_DOUBLE_LANE_CHANGE, 40, 200),
    "iso_severe_double_lane_change": EntrySpeedSearch(ISO_SEVERE_DOUBLE_LANE_CHANGE, 20, 150),
}
"""The manoeuvres whose standard defines a series."""


SEARCHES = {
    name: SpeedSearch(manoeuvre)
    for name, manoeuvre in ON_ANY_ROAD.items()
    if not isinstance(manoeuvre, PathFollowing | RisingSpeed)
}
"""Entry-speed searches, for all manoeuvres whose entry speed can be varied by itself."""


def series_named(name: str, is_search: bool = False) -> Series:
    """The series that the standard defines for a manoeuvre, or else an entry-speed search.

    is_search: return the entry-speed search in any case. Raises InputError listing the available
    names.
    """
    known = SEARCHES if is_search else SEARCHES | SERIES
    if name not in known:
        raise unknown_name(name, known, "MANOEUVRE")
    return known[name]


def final_amplitude(steering_at_03g: float) -> float:
    """Final amplitude (deg): 6.5 times the angle at 0.3 g (deg), at least 270, at most 300 deg."""
    return min(max(LADDER_TO * steering_at_03g, LEAST_FINAL), LARGEST_FINAL)


def ladder(steering_at_03g: float, largest: float = math.inf) -> list[float]:
    """Scalars of the series (FMVSS 126): 1.5 in steps of 0.5, then that of the final amplitude.

    A scalar is the amplitude over `steering_at_03g` (deg). No amplitude exceeds `largest`, the
    largest handwheel angle of the vehicle (deg).
    """
    final = min(final_amplitude(steering_at_03g), largest) / steering_at_03g
    return [*np.arange(LADDER_FROM, final - 1e-9, LADDER_STEP).tolist(), final]
