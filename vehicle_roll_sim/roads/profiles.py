"""Features with heights along two tracks: profiles from points, and random ones."""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError, number_of, parameter
from vehicle_roll_sim.model.road.layout import PROFILE
from vehicle_roll_sim.roads.feature import FURTHEST, HIGHEST, MOST_POINTS, Feature, Row, size
from vehicle_roll_sim.roads.iso8608 import COARSEST, PRECISION, ROUGHNESS, random_tracks


@dataclasses.dataclass(frozen=True, kw_only=True)
class Tracks(Feature):
    """Heights along two tracks, one for the wheels of each side.

    Between the tracks the height changes smoothly; beyond them, and before and after the table, it
    stays the same. It is averaged over the length of the contact patch.
    """

    track: float = size("distance between the two tracks, half of it to each side", default=1.5)
    contact_length: float = parameter(
        "length of the contact patch, over which heights are averaged; 0: no averaging",
        "m",
        0.0,
        2.0,
        default=0.1,
    )
    spacing: float = size("spacing of the resampled heights", least=0.005, default=0.05)

    def tracks(self) -> np.ndarray:
        """Heights of the left and the right track at their points, shape (2, n) (m)."""
        raise NotImplementedError

    def places(self, count: int) -> np.ndarray:
        """Distances of these points from the first one, in spacings of the table, shape (n,)."""
        return np.arange(count, dtype=float)

    def rows(self) -> list[Row]:
        tracks, width = self.tracks(), self.contact_length / self.spacing
        places, margin = self.places(tracks.shape[1]), math.ceil(width / 2)
        heights = np.array([averaged(places, each, width, margin) for each in tracks])
        sides = (self.track / 2, -self.track / 2)
        own = (heights.shape[1], self.spacing, *sides)
        table = np.pad(heights, ((0, 0), (1, 1)), mode="edge")
        kind, (x, y, c, s, *own), table = self.row(PROFILE, *own, table=table.T.ravel())
        back = margin * self.spacing
        return [(kind, [x - c * back, y - s * back, c, s, *own], table)]

    def ends(self) -> tuple[float, float]:
        """Where it begins and ends along its heading, from its start (m)."""
        raise NotImplementedError

    def edges(self) -> tuple[Sequence[float], Sequence[float]]:
        return self.ends(), (-self.track / 2, self.track / 2)


def averaged(places: np.ndarray, heights: np.ndarray, width: float, margin: int) -> np.ndarray:
    """Moving averages over a width of straight lines between points, at whole places.

    places: of the points, increasing from 0 on. margin: places before the first point and after the
    last one, at least half the width. Beyond the ends the heights stay the same.
    """
    middle = np.arange(-margin, math.ceil(places[-1]) + 1 + margin, dtype=float)
    if width == 0.0:
        return np.interp(middle, places, heights)
    further = np.arange(1.0, math.ceil(width / 2) + 2)
    at = np.concatenate((-further[::-1], places, places[-1] + further))
    padded = np.pad(heights, len(further), mode="edge")
    length, rise = np.diff(at), np.diff(padded)
    area = np.concatenate(([0.0], np.cumsum((padded[1:] + padded[:-1]) / 2 * length)))

    def integral(place: np.ndarray) -> np.ndarray:
        below = np.clip(np.searchsorted(at, place, side="right") - 1, 0, len(length) - 1)
        part = place - at[below]
        return area[below] + padded[below] * part + rise[below] / length[below] * part**2 / 2

    return (integral(middle + width / 2) - integral(middle - width / 2)) / width


@dataclasses.dataclass(frozen=True, kw_only=True)
class Profile(Tracks):
    """A profile through points, straight between them.

    points: of each the distance from the start (m, increasing) and the height (m), or the heights
    of the left and of the right track.
    """

    points: tuple[tuple[float, ...], ...] = ()

    def __post_init__(self):
        super().__post_init__()
        object.__setattr__(self, "points", self._checked())

    def _checked(self) -> tuple[tuple[float, ...], ...]:
        allowed = f"2 to {MOST_POINTS} lists, each of distance and one or two heights (m)"
        if not isinstance(self.points, list | tuple) or not 2 <= len(self.points) <= MOST_POINTS:
            raise InputError("points", self.points or None, allowed)
        kept = []
        for number, point in enumerate(self.points, 1):
            field = f"points: {number}"
            if not isinstance(point, list | tuple) or len(point) not in (2, 3):
                raise InputError(field, point, "distance and one or two heights (m)")
            values = tuple(number_of(each, field, "a number") for each in point)
            if not all(
                abs(each) <= limit
                for each, limit in zip(values, (FURTHEST, HIGHEST, HIGHEST), strict=False)
            ):
                raise InputError(field, point, f"finite, heights up to {HIGHEST:g} m")
            if kept and not values[0] > kept[-1][0]:
                raise InputError(field, values[0], f"a distance beyond {kept[-1][0]:g} m")
            kept.append(values)
        length = kept[-1][0] - kept[0][0]
        if length / self.spacing > MOST_POINTS or length < self.spacing:
            allowed = f"1 to {MOST_POINTS} times the spacing, {self.spacing:g} m"
            raise InputError("points", f"{length:g} m", allowed)
        return tuple(kept)

    def row(self, kind: int, *numbers: float, table: np.ndarray | None = None) -> Row:
        kind, (x, y, c, s, *own), table = super().row(kind, *numbers, table=table)
        first = self.points[0][0]
        return kind, [x + c * first, y + s * first, c, s, *own], table

    def ends(self) -> tuple[float, float]:
        return self.points[0][0], self.points[-1][0]

    def tracks(self) -> np.ndarray:
        return np.array([[point[side] for point in self.points] for side in (1, -1)])

    def places(self, count: int) -> np.ndarray:
        distances = np.array([point[0] for point in self.points])
        return (distances - distances[0]) / self.spacing


@dataclasses.dataclass(frozen=True, kw_only=True)
class Roughness:
    """Properties of a random road."""

    roughness: str = parameter("class of roughness", choices=tuple(ROUGHNESS), default="B")
    seed: float = parameter("seed of the random numbers", "", 0.0, 2.0**53, default=1.0)
    length: float = size("its length; after it, the road is level", least=1.0, default=1000.0)
    incoherence: float = parameter(
        "length L in the coherence exp(-n L) of the tracks at the spatial frequency n; 0: both "
        "tracks are the same",
        "m",
        0.0,
        1e3,
        default=1.5,
    )
    run_in: float = size(
        "length over which the roughness grows at the start and fades at the end", default=10.0
    )

    def roughness_values(self) -> dict[str, float | str]:
        """Its values by name."""
        return {field.name: getattr(self, field.name) for field in dataclasses.fields(Roughness)}


@dataclasses.dataclass(frozen=True, kw_only=True)
class RandomProfile(Roughness, Tracks):
    """A random road after ISO 8608, the same for the same seed; see `roads.iso8608`."""

    def __post_init__(self):
        super().__post_init__()
        if self.seed != round(self.seed):
            raise InputError("seed", self.seed, "a whole number")
        if self.length / self.spacing > MOST_POINTS:
            allowed = f"at most {MOST_POINTS} times the spacing, {self.spacing:g} m"
            raise InputError("length", self.length, allowed)
        if self.spacing > COARSEST:
            raise InputError("spacing", self.spacing, f"at most {COARSEST} m, half a shortest wave")

    def ends(self) -> tuple[float, float]:
        return 0.0, self.length

    def tracks(self) -> np.ndarray:
        count = round(self.length / self.spacing) + 1
        found = random_tracks(self.roughness, int(self.seed), count, self.spacing, self.incoherence)
        distance = self.spacing * np.arange(count)
        near = np.minimum(distance, distance[::-1])
        share = np.clip(near / min(self.run_in, self.length / 2), 0.0, 1.0)
        return np.round(found * share**2 * (3.0 - 2.0 * share), PRECISION)
