"""The road: a plane with a grade and a bank, and the features on it."""

import dataclasses
import functools
import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, keep_validated, parameter, unknown_name
from vehicle_roll_sim.files.yaml_file import read_mapping
from vehicle_roll_sim.input_errors import given
from vehicle_roll_sim.model.layout import WHEELS
from vehicle_roll_sim.model.road.layout import PLANE, ground_of
from vehicle_roll_sim.model.road.surface import surface
from vehicle_roll_sim.roads.commanded import Commanded
from vehicle_roll_sim.roads.kinds import NAMES, feature_of, values_of
from vehicle_roll_sim.roads.surfaces import Chessboard, Patch
from vehicle_roll_sim.roads.tilt import TiltTable
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road_tables import with_table

STEEPEST = 1.0
"""m/m: a slope of 45 degrees."""
LARGEST_FILE = 20_000_000
"""Bytes of a road file."""
FEATURES = "features"
OF_A_PLANE = (Patch, Chessboard, TiltTable)
"""Features that leave the road a plane."""
A_ROAD = "expected a YAML mapping with grade, bank and features"


@dataclasses.dataclass(frozen=True)
class Road:
    """An inclined plane that contains the x axis (initial heading) and y axis (left) of the ground.

    The slope is modelled by rotating gravity, so all positions, heights and attitudes are relative
    to the road. features: what is on the plane, instances of the classes in
    `vehicle_roll_sim.roads`; heights are normal to the plane. Raises InputError for a slope outside
    the allowed range, and for features that are not compatible.
    """

    grade: float = parameter(
        "slope of the road in the initial heading, positive uphill",
        "m/m",
        -STEEPEST,
        STEEPEST,
        default=0.0,
    )
    bank: float = parameter(
        "slope of the road across the initial heading, positive if it rises to the left",
        "m/m",
        -STEEPEST,
        STEEPEST,
        default=0.0,
    )
    features: tuple = ()

    def __post_init__(self):
        keep_validated(self)
        object.__setattr__(self, FEATURES, tuple(_listed(self.features, FEATURES)))
        for number, feature in enumerate(self.features, 1):
            if type(feature) not in NAMES:
                allowed = "a feature, such as Patch or Curb of vehicle_roll_sim.roads"
                raise InputError(f"{FEATURES}: {number}", feature, allowed)
        tables = [each for each in self.features if isinstance(each, TiltTable)]
        if len(tables) > 1:
            raise InputError(FEATURES, "", "at most one", "two tilt tables")
        if tables and (self.grade or self.bank):
            name = "grade" if self.grade else "bank"
            raise InputError(name, getattr(self, name), "0 on a tilt table")

    @classmethod
    def from_file(cls, path: str | Path) -> "Road":
        """Read a road file (YAML) and the tables that it names; raises InputError naming file, line
        and key."""
        path = Path(path)
        values, lines = read_mapping(path, "road file", A_ROAD, LARGEST_FILE)
        for name in values:
            if name not in ROAD_KEYS:
                raise unknown_name(name, ROAD_KEYS, f"{path}: line {lines[name,]}: name")
        whole = f"{path}: line {lines.get((FEATURES,))}: {FEATURES}"
        read = []
        for index, each in enumerate(_listed(values.get(FEATURES), whole)):
            where = f"{path}: line {lines[FEATURES, index]}: feature {index + 1}"
            read.append(feature_of(with_table(each, path.parent, where), where))
        try:
            return cls(**{**values, FEATURES: tuple(read)})
        except InputError as error:
            line = lines.get((error.field,))
            where = f"{path}: line {line}: {error.field}" if line else f"{path}: {error.field}"
            raise InputError(where, error.value, error.allowed, error.problem) from None

    @classmethod
    def from_values(cls, values: Mapping) -> "Road":
        """The road with the values of `values`; raises InputError."""
        for name in given("road", values, Mapping):
            if name not in ROAD_KEYS:
                raise unknown_name(name, ROAD_KEYS, "road")
        features = enumerate(_listed(values.get(FEATURES), FEATURES), 1)
        read = tuple(feature_of(each, f"{FEATURES}: {number}") for number, each in features)
        return cls(**{**values, FEATURES: read})

    def values(self) -> dict:
        """Grade and bank, and the features if there are any, as plain values."""
        values = {"grade": self.grade, "bank": self.bank}
        if self.features:
            values[FEATURES] = [values_of(each) for each in self.features]
        return values

    @property
    def tilt(self) -> TiltTable | None:
        """The table that tilts the road, if there is one."""
        return next((each for each in self.features if isinstance(each, TiltTable)), None)

    @property
    def is_commanded(self) -> bool:
        """Whether commands give heights and frictions of the road under the wheels."""
        return any(isinstance(each, Commanded) for each in self.features)

    @property
    def has_heights(self) -> bool:
        """Whether the road is not plane, so that heights over z = 0 are not those over the road."""
        return not all(isinstance(each, OF_A_PLANE) for each in self.features)

    def gravity(self, gravity: float, time: float = 0.0) -> tuple[float, float, float]:
        """Components of gravity into the road, along its x axis and along its y axis (m/s^2).

        gravity: magnitude of the acceleration of gravity (m/s^2). time: simulated time (s), on
        which they depend if the road tilts.
        """
        if self.tilt:
            angle = self.tilt.angle(time)
            return gravity * math.cos(angle), 0.0, -gravity * math.sin(angle)
        return self.resting_gravity(gravity)

    def resting_gravity(self, gravity: float) -> tuple[float, float, float]:
        """The same before the road tilts."""
        down = gravity / math.sqrt(1.0 + self.grade**2 + self.bank**2)
        return down, -self.grade * down, -self.bank * down

    def ground(self) -> np.ndarray:
        """The features as the equations take them (see `model.road.layout`)."""
        return self._ground if self.features else PLANE

    @functools.cached_property
    def _ground(self) -> np.ndarray:
        tilt, rows = self.tilt, []
        for feature in self.features:
            rows += [] if isinstance(feature, TiltTable | Commanded) else feature.rows()
        return ground_of(rows, tilt.table() if tilt else None, self.is_commanded)

    def surface(self, x: float, y: float) -> tuple[float, float, float, float]:
        """Height above the plane (m), slopes along x and y (m/m), and factor of friction."""
        return surface(float(x), float(y), self.ground())

    def check_model(self, options: Options) -> None:
        """Raise InputError if a model cannot have this road."""
        if not self.features:
            return
        if options.has_eight_dof:
            allowed = "a plane: its wheels have no vertical motion; use model 1 or 2"
            raise InputError("road", "", allowed, f"features on the road of model {options.model}")
        if options.tire_normal_to_ground:
            allowed = "an option for planes, whose normal is the same at every wheel"
            problem = "not possible on a road with features"
            raise InputError("tire_normal_to_ground", True, allowed, problem)

    def check_start(self, vehicle: np.record) -> None:
        """Raise InputError if a vehicle would start with the centre of a wheel in the ground.

        vehicle: a VEHICLE record. Its wheels are where they are in the equilibrium of a level road.
        """
        if not self.has_heights:
            return
        centres = vehicle["tire_radius"] - vehicle["static_tire_compression"]
        for name, x, y, centre in zip(WHEELS, vehicle["x"], vehicle["y"], centres, strict=True):
            height = self.surface(x, y)[0]
            if height >= centre:
                problem = f"{height:.4g} m high under the wheel {name} at the start"
                allowed = f"less than the height of its centre on a level road, {centre:.3g} m"
                raise InputError("road", "", allowed, problem)


def _listed(features, field: str) -> Sequence:
    """The features of a road, none for None; raises InputError naming `field` if not a list."""
    if not isinstance(features, list | tuple | None):
        raise InputError(field, features, "a list of features")
    return features or ()


ROAD_KEYS = tuple(field.name for field in dataclasses.fields(Road))
"""Keys of a road file."""
