"""The vehicle parameters: the single declaration of names, units, ranges and descriptions."""

import dataclasses
import functools
import math

import numpy as np

from vehicle_roll_sim.declaration import (
    InputError,
    check_alternatives,
    keep_validated,
    parameter,
    parameters_of,
    validated,
)
from vehicle_roll_sim.model.equilibrium import (
    axle_load_share,
    static_strut_length,
    static_suspension_compression,
    static_tire_compression,
)
from vehicle_roll_sim.model.integration.events import plausible_magnitudes
from vehicle_roll_sim.model.records import LF, LR, VEHICLE
from vehicle_roll_sim.model.tire.coefficients import on_axles
from vehicle_roll_sim.vehicle.tire_file import Tire

GRAVITY = 9.81
"""m/s^2, the value used in the paper."""
AXLES = {"front": LF, "rear": LR}
"""The left wheel of each axle; both wheels of an axle have the same parameters."""

_LENGTH = {"unit": "m", "minimum": 0.01, "maximum": 50.0}
_INERTIA = {"unit": "kg m^2", "minimum": 1e-3, "maximum": 1e7}
_WHEEL_INERTIA = _INERTIA | {"minimum": 1e-6}
_STIFFNESS = {"unit": "N/m", "minimum": 1.0, "maximum": 1e8}
_DAMPING = {"unit": "N s/m", "minimum": 0.0, "maximum": 1e7}
_MASS = {"unit": "kg", "minimum": 0.01, "maximum": 1e6}
_CENTRE = {"unit": "m", "minimum": -5.0, "maximum": 50.0}


@dataclasses.dataclass(frozen=True)
class Vehicle:
    """A vehicle: the values of a vehicle file, and its tire.

    Units are those of the declarations (SI; `vehicle_roll_sim parameters` lists them).

    The roll centre of an axle is specified either as a depth below the c.g. or as a height above
    the ground; the other attribute is None. The specified value is kept when `cg_height` is
    replaced. `roll_centre_depth` and `roll_centre_height` give both, whichever was specified.

    Raises InputError for a value that is invalid or inconsistent with the others.
    """

    sprung_mass: float = parameter("mass carried by the suspension springs", **_MASS, symbol="m")
    roll_inertia: float = parameter(
        "moment of inertia of the sprung mass about its x axis", **_INERTIA, symbol="Jx"
    )
    pitch_inertia: float = parameter(
        "moment of inertia of the sprung mass about its y axis", **_INERTIA, symbol="Jy"
    )
    yaw_inertia: float = parameter(
        "moment of inertia of the sprung mass about its z axis", **_INERTIA, symbol="Jz"
    )
    cg_to_front_axle: float = parameter(
        "distance from the c.g. of the sprung mass to the front axle", **_LENGTH, symbol="a"
    )
    cg_to_rear_axle: float = parameter(
        "distance from the c.g. of the sprung mass to the rear axle", **_LENGTH, symbol="b"
    )
    cg_height: float = parameter(
        "height of the c.g. of the sprung mass above ground at rest", **_LENGTH, symbol="h"
    )
    front_track: float = parameter("track width of the front axle", **_LENGTH, symbol="cf")
    rear_track: float = parameter("track width of the rear axle", **_LENGTH, symbol="cr")
    front_spring_stiffness: float = parameter(
        "spring stiffness at one front wheel, not per axle", **_STIFFNESS, symbol="ksf"
    )
    rear_spring_stiffness: float = parameter(
        "spring stiffness at one rear wheel, not per axle", **_STIFFNESS, symbol="ksr"
    )
    front_damping: float = parameter(
        "damping coefficient at one front wheel, not per axle", **_DAMPING, symbol="bsf"
    )
    rear_damping: float = parameter(
        "damping coefficient at one rear wheel, not per axle", **_DAMPING, symbol="bsr"
    )
    front_unsprung_mass: float = parameter(
        "unsprung mass at one front wheel, not per axle", **_MASS, symbol="muf"
    )
    rear_unsprung_mass: float = parameter(
        "unsprung mass at one rear wheel, not per axle", **_MASS, symbol="mur"
    )
    front_tire_stiffness: float = parameter(
        "vertical stiffness of one front tire", **_STIFFNESS, symbol="ktf"
    )
    rear_tire_stiffness: float = parameter(
        "vertical stiffness of one rear tire", **_STIFFNESS, symbol="ktr"
    )
    tire_radius: float = parameter("unloaded radius of the tires", **_LENGTH, symbol="r0")
    wheel_inertia: float = parameter(
        "moment of inertia of one wheel about its spin axis", **_WHEEL_INERTIA, symbol="Jw"
    )
    front_roll_centre_depth: float | None = parameter(
        "depth of the front roll centre below the c.g. of the sprung mass",
        **_CENTRE,
        symbol="hrcf",
        alternative="front_roll_centre_height",
    )
    front_roll_centre_height: float | None = parameter(
        "height of the front roll centre above ground at rest, instead of its depth",
        **_CENTRE,
        alternative="front_roll_centre_depth",
    )
    rear_roll_centre_depth: float | None = parameter(
        "depth of the rear roll centre below the c.g. of the sprung mass",
        **_CENTRE,
        symbol="hrcr",
        alternative="rear_roll_centre_height",
    )
    rear_roll_centre_height: float | None = parameter(
        "height of the rear roll centre above ground at rest, instead of its depth",
        **_CENTRE,
        alternative="rear_roll_centre_depth",
    )
    steering_ratio: float = parameter(
        "ratio of handwheel angle to road-wheel angle", minimum=0.1, maximum=100.0
    )
    minimum_relaxation_length: float = parameter(
        "lower limit of the tires' relaxation lengths", "m", 0.01, 5.0, default=0.1
    )
    rolling_resistance_coefficient: float = parameter(
        "ratio of a wheel's rolling resistance to its normal load", "", 0.0, 1.0, default=0.0
    )
    drag_area: float = parameter(
        "drag coefficient times frontal area", "m^2", 0.0, 100.0, default=0.0
    )
    tire: Tire = dataclasses.field(kw_only=True)

    def __post_init__(self):
        keep_validated(self, self.given)
        if not isinstance(self.tire, Tire):
            raise InputError("tire", self.tire, "a Tire, as returned by load_tire")
        check_alternatives(Vehicle, self.given)
        _check_roll_centres(self)
        _check_inertias(self)
        _check_fits_on_its_wheels(self)
        _check_springs_carry_it(self)

    @classmethod
    def checked(cls, values: dict, tire: Tire, prefix: str = "") -> "Vehicle":
        """Build a vehicle from these values.

        Raises InputError naming the invalid value, preceded by `prefix`.
        """
        numbers = validated(cls, values, prefix)
        try:
            return cls(**numbers, tire=tire)
        except InputError as error:  # inconsistent values
            field = prefix + error.field
            raise InputError(field, error.value, error.allowed, error.problem) from None

    def with_values(self, values: dict, prefix: str = "") -> "Vehicle":
        """A copy with some values replaced; raises InputError like `checked`.

        A value also replaces its alternative: a roll centre height, for instance, the depth.
        """
        known, given = parameters_of(Vehicle), self.given
        kept = {n: value for n, value in given.items() if known[n].alternative not in values}
        return self.checked(kept | values, self.tire, prefix)

    @property
    def given(self) -> dict[str, float]:
        """Every value by name; of two alternatives, only the one that was specified."""
        known = parameters_of(Vehicle)
        values = {name: getattr(self, name) for name in known}
        return {n: v for n, v in values.items() if v is not None or not known[n].alternative}

    def with_depths(self) -> "Vehicle":
        """The same vehicle, bit for bit, with its roll centres specified as depths."""
        depths = {axle: float(self.roll_centre_depth[wheel]) for axle, wheel in AXLES.items()}
        return self.with_values({f"{axle}_roll_centre_depth": d for axle, d in depths.items()})

    @functools.cached_property
    def roll_centre_depth(self) -> np.ndarray:
        """Depth of the roll centre below the sprung c.g., at each wheel's axle; shape (4,) (m)."""
        return self._roll_centre("depth", "height")

    @functools.cached_property
    def roll_centre_height(self) -> np.ndarray:
        """Height of the roll centre above ground at rest, at each wheel's axle; shape (4,) (m)."""
        return self._roll_centre("height", "depth")

    def _roll_centre(self, wanted: str, other: str) -> np.ndarray:
        """The requested measure at each wheel (m), derived from the other if not specified."""
        values = []
        for axle in AXLES:
            value = getattr(self, f"{axle}_roll_centre_{wanted}")
            if value is None:
                value = self.cg_height - getattr(self, f"{axle}_roll_centre_{other}")
            values += [value, value]
        return np.array(values)

    @functools.cached_property
    def axle_load_share(self) -> np.ndarray:
        """Share of the sprung weight that each wheel carries at rest; shape (4,)."""
        return axle_load_share(self.cg_to_front_axle, self.cg_to_rear_axle)

    @functools.cached_property
    def static_tire_compression(self) -> np.ndarray:
        """xti of each tire, eq. 20; shape (4,) (m)."""
        return static_tire_compression(
            self.sprung_mass,
            self.axle_load_share,
            self.per_wheel("unsprung_mass"),
            self.per_wheel("tire_stiffness"),
            GRAVITY,
        )

    @functools.cached_property
    def static_suspension_compression(self) -> np.ndarray:
        """xsi of each corner, eq. 19; shape (4,) (m)."""
        return static_suspension_compression(
            self.sprung_mass, self.axle_load_share, self.per_wheel("spring_stiffness"), GRAVITY
        )

    @functools.cached_property
    def static_strut_length(self) -> np.ndarray:
        """lsi of each corner, eq. 18; shape (4,) (m)."""
        return static_strut_length(self.cg_height, self.tire_radius, self.static_tire_compression)

    def per_wheel(self, name: str) -> np.ndarray:
        """The values of front_NAME and rear_NAME at lf, rf, lr, rr; shape (4,)."""
        front, rear = getattr(self, f"front_{name}"), getattr(self, f"rear_{name}")
        return np.array([front, front, rear, rear])

    def record(self) -> np.ndarray:
        """The vehicle on a level road as input to the equations: one VEHICLE record, shape (1,).

        Each field takes the attribute of its name, or the values front_NAME and rear_NAME, or comes
        from `_placement`. Raises AttributeError for a field that has none of these.
        """
        placement, vehicle = self._placement(), np.zeros(1, VEHICLE)
        for name in VEHICLE.names:
            if name in placement:
                vehicle[name] = placement[name]
            elif hasattr(self, name):
                vehicle[name] = getattr(self, name)
            else:
                vehicle[name] = self.per_wheel(name)
        return vehicle

    def tires(self) -> np.ndarray:
        """The tires of front and rear axle as input to the equations: TIRE records, shape (2,)."""
        return on_axles(self.tire.record(), self.tire.record())

    def _placement(self) -> dict:
        """Where the wheels are in the plane of the c.g. (m), and gravity (m/s^2)."""
        front, rear = self.cg_to_front_axle, -self.cg_to_rear_axle
        return {
            "x": (front, front, rear, rear),
            "y": self.per_wheel("track") / 2 * (1, -1, 1, -1),
            "gravity": GRAVITY,
            "gravity_along": 0.0,
            "gravity_across": 0.0,
        }


def _check_roll_centres(vehicle: Vehicle) -> None:
    """The depth that follows from a given height must be within the allowed range of depths."""
    for axle, wheel in AXLES.items():
        name = f"{axle}_roll_centre_height"
        depth = vehicle.roll_centre_depth[wheel]
        if name in vehicle.given and not _CENTRE["minimum"] <= depth <= _CENTRE["maximum"]:
            least, most = (vehicle.cg_height - _CENTRE[each] for each in ("maximum", "minimum"))
            limit = f"from {least:g} to {most:g} m with the c.g. at {vehicle.cg_height:g} m"
            raise InputError(name, vehicle.given[name], limit)


def _check_inertias(vehicle: Vehicle) -> None:
    """No principal moment of inertia of a rigid body exceeds the sum of the other two."""
    names = ("roll_inertia", "pitch_inertia", "yaw_inertia")
    total = math.fsum(getattr(vehicle, name) for name in names)
    for name in names:
        value = getattr(vehicle, name)
        if value > total - value:
            most = total - value
            limit = f"at most the sum of the other two moments of inertia, {most:g} kg m^2"
            excess = f"{value - most:g} kg m^2 ({100 * (value - most) / most:.2g} %) more"
            scope = "give the inertia of the sprung mass alone, not of the whole vehicle"
            raise InputError(name, value, f"{limit}; it is {excess}: {scope}")


def _check_fits_on_its_wheels(vehicle: Vehicle) -> None:
    """The static tire compression must be less than the tire radius."""
    compression = float(np.max(vehicle.static_tire_compression))
    if vehicle.tire_radius <= compression:
        limit = f"more than the static compression of the tires, {compression:g} m"
        raise InputError("tire_radius", vehicle.tire_radius, limit)


def _check_springs_carry_it(vehicle: Vehicle) -> None:
    """The static spring compression must be below the limit at which a run counts as diverged."""
    most = float(np.min(plausible_magnitudes()["suspension_compression"]))
    for axle, wheel in AXLES.items():
        name = f"{axle}_spring_stiffness"
        compression = float(vehicle.static_suspension_compression[wheel])
        if compression > most:
            stiffness = getattr(vehicle, name)
            limit = f"at least {stiffness * compression / most:g} N/m to carry the sprung mass"
            raise InputError(name, stiffness, limit)
