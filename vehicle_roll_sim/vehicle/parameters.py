"""The vehicle's parameters: the one declaration of names, units, ranges and meaning."""

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
from vehicle_roll_sim.vehicle.tire_file import Tire

GRAVITY = 9.81
"""m/s^2, the value of the source."""
AXLES = {"front": LF, "rear": LR}
"""One of the two like wheels of each axle."""

_LENGTH = {"unit": "m", "minimum": 0.01, "maximum": 50.0}
_INERTIA = {"unit": "kg m^2", "minimum": 1e-3, "maximum": 1e7}
_WHEEL_INERTIA = _INERTIA | {"minimum": 1e-6}
_STIFFNESS = {"unit": "N/m", "minimum": 1.0, "maximum": 1e8}
_DAMPING = {"unit": "N s/m", "minimum": 0.0, "maximum": 1e7}
_MASS = {"unit": "kg", "minimum": 0.01, "maximum": 1e6}
_CENTRE = {"unit": "m", "minimum": -5.0, "maximum": 50.0}
_DEPTH = "roll centre below the sprung c.g."
_HEIGHT = "in place of the depth: roll centre above ground at rest"


@dataclasses.dataclass(frozen=True)
class Vehicle:
    """A vehicle: the values of a vehicle file and its tire.

    The roll centre of an axle is given as a depth or as a height, and keeps that when the height of
    the c.g. is replaced; the other of the two is None. `roll_centre_depth` and `roll_centre_height`
    have both, whichever was given.
    """

    sprung_mass: float = parameter("mass carried by the springs", **_MASS, symbol="m")
    roll_inertia: float = parameter("of the sprung mass about x", **_INERTIA, symbol="Jx")
    pitch_inertia: float = parameter("of the sprung mass about y", **_INERTIA, symbol="Jy")
    yaw_inertia: float = parameter("of the sprung mass about z", **_INERTIA, symbol="Jz")
    cg_to_front_axle: float = parameter("sprung c.g. to front axle", **_LENGTH, symbol="a")
    cg_to_rear_axle: float = parameter("sprung c.g. to rear axle", **_LENGTH, symbol="b")
    cg_height: float = parameter("sprung c.g. above ground at rest", **_LENGTH, symbol="h")
    front_track: float = parameter("between the front wheels", **_LENGTH, symbol="cf")
    rear_track: float = parameter("between the rear wheels", **_LENGTH, symbol="cr")
    front_spring_stiffness: float = parameter("of one spring", **_STIFFNESS, symbol="ksf")
    rear_spring_stiffness: float = parameter("of one spring", **_STIFFNESS, symbol="ksr")
    front_damping: float = parameter("of one damper", **_DAMPING, symbol="bsf")
    rear_damping: float = parameter("of one damper", **_DAMPING, symbol="bsr")
    front_unsprung_mass: float = parameter("per wheel", **_MASS, symbol="muf")
    rear_unsprung_mass: float = parameter("per wheel", **_MASS, symbol="mur")
    front_tire_stiffness: float = parameter("vertical, of one tire", **_STIFFNESS, symbol="ktf")
    rear_tire_stiffness: float = parameter("vertical, of one tire", **_STIFFNESS, symbol="ktr")
    tire_radius: float = parameter("unloaded", **_LENGTH, symbol="r0")
    wheel_inertia: float = parameter("of one wheel about its axle", **_WHEEL_INERTIA, symbol="Jw")
    front_roll_centre_depth: float | None = parameter(
        _DEPTH, **_CENTRE, symbol="hrcf", alternative="front_roll_centre_height"
    )
    front_roll_centre_height: float | None = parameter(
        _HEIGHT, **_CENTRE, alternative="front_roll_centre_depth"
    )
    rear_roll_centre_depth: float | None = parameter(
        _DEPTH, **_CENTRE, symbol="hrcr", alternative="rear_roll_centre_height"
    )
    rear_roll_centre_height: float | None = parameter(
        _HEIGHT, **_CENTRE, alternative="rear_roll_centre_depth"
    )
    steering_ratio: float = parameter(
        "handwheel angle over road-wheel angle", minimum=0.1, maximum=100.0
    )
    minimum_relaxation_length: float = parameter(
        "least distance over which a tire answers", "m", 0.01, 5.0, default=0.1
    )
    rolling_resistance_coefficient: float = parameter(
        "resisting force of a wheel over its load", "", 0.0, 1.0, default=0.0
    )
    drag_area: float = parameter(
        "drag coefficient times frontal area", "m^2", 0.0, 100.0, default=0.0
    )
    tire: Tire = dataclasses.field(kw_only=True)

    def __post_init__(self):
        keep_validated(self, self.given)
        if not isinstance(self.tire, Tire):
            raise InputError("tire", self.tire, "a Tire, as load_tire gives")
        check_alternatives(Vehicle, self.given)
        _check_roll_centres(self)
        _check_inertias(self)
        _check_fits_on_its_wheels(self)
        _check_springs_carry_it(self)

    @classmethod
    def checked(cls, values: dict, tire: Tire, prefix: str = "") -> "Vehicle":
        """A vehicle of these values; raises InputError naming one, with `prefix` before it."""
        numbers = validated(cls, values, prefix)
        try:
            return cls(**numbers, tire=tire)
        except InputError as error:  # values that do not go together
            field = prefix + error.field
            raise InputError(field, error.value, error.allowed, error.problem) from None

    def with_values(self, values: dict, prefix: str = "") -> "Vehicle":
        """A copy with some values replaced; raises InputError as `checked` does.

        A value also replaces its alternative: a roll centre's height the depth, for instance.
        """
        known, given = parameters_of(Vehicle), self.given
        kept = {n: value for n, value in given.items() if known[n].alternative not in values}
        return self.checked(kept | values, self.tire, prefix)

    @property
    def given(self) -> dict[str, float]:
        """Every value by name, of two alternatives the one that was given."""
        known = parameters_of(Vehicle)
        values = {name: getattr(self, name) for name in known}
        return {n: v for n, v in values.items() if v is not None or not known[n].alternative}

    def with_depths(self) -> "Vehicle":
        """The same vehicle, to the bit, with its roll centres given as depths."""
        depths = {axle: float(self.roll_centre_depth[wheel]) for axle, wheel in AXLES.items()}
        return self.with_values({f"{axle}_roll_centre_depth": d for axle, d in depths.items()})

    @functools.cached_property
    def roll_centre_depth(self) -> np.ndarray:
        """Of each wheel's axle, below the sprung c.g. (m)."""
        return self._roll_centre("depth", "height")

    @functools.cached_property
    def roll_centre_height(self) -> np.ndarray:
        """Of each wheel's axle, above the ground at rest (m)."""
        return self._roll_centre("height", "depth")

    def _roll_centre(self, wanted: str, other: str) -> np.ndarray:
        """The wanted measure at each wheel (m), where it was not given from the other one."""
        values = []
        for axle in AXLES:
            value = getattr(self, f"{axle}_roll_centre_{wanted}")
            if value is None:
                value = self.cg_height - getattr(self, f"{axle}_roll_centre_{other}")
            values += [value, value]
        return np.array(values)

    @functools.cached_property
    def axle_load_share(self) -> np.ndarray:
        return axle_load_share(self.cg_to_front_axle, self.cg_to_rear_axle)

    @functools.cached_property
    def static_tire_compression(self) -> np.ndarray:
        """xti of each wheel (m, eq. 20)."""
        return static_tire_compression(
            self.sprung_mass,
            self.axle_load_share,
            self.per_wheel("unsprung_mass"),
            self.per_wheel("tire_stiffness"),
            GRAVITY,
        )

    @functools.cached_property
    def static_suspension_compression(self) -> np.ndarray:
        """xsi of each corner (m, eq. 19)."""
        return static_suspension_compression(
            self.sprung_mass, self.axle_load_share, self.per_wheel("spring_stiffness"), GRAVITY
        )

    @functools.cached_property
    def static_strut_length(self) -> np.ndarray:
        """lsi of each corner (m, eq. 18)."""
        return static_strut_length(self.cg_height, self.tire_radius, self.static_tire_compression)

    def per_wheel(self, name: str) -> np.ndarray:
        """front_NAME and rear_NAME laid out for lf, rf, lr, rr."""
        front, rear = getattr(self, f"front_{name}"), getattr(self, f"rear_{name}")
        return np.array([front, front, rear, rear])

    def record(self) -> np.ndarray:
        """The vehicle on a level road as the equations take it: one VEHICLE record in an array.

        A field is an attribute of its name, or has its values front_NAME and rear_NAME, or is one
        of `_placement`; raises AttributeError for any other.
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
    """A height comes to a depth that could have been given."""
    for axle, wheel in AXLES.items():
        name = f"{axle}_roll_centre_height"
        depth = vehicle.roll_centre_depth[wheel]
        if name in vehicle.given and not _CENTRE["minimum"] <= depth <= _CENTRE["maximum"]:
            least, most = (vehicle.cg_height - _CENTRE[each] for each in ("maximum", "minimum"))
            limit = f"from {least:g} to {most:g} m with the c.g. at {vehicle.cg_height:g} m"
            raise InputError(name, vehicle.given[name], limit)


def _check_inertias(vehicle: Vehicle) -> None:
    """Moments of inertia of a body: none is larger than the sum of the other two."""
    names = ("roll_inertia", "pitch_inertia", "yaw_inertia")
    total = math.fsum(getattr(vehicle, name) for name in names)
    for name in names:
        value = getattr(vehicle, name)
        if value > total - value:
            most = total - value
            limit = f"at most the sum of the other two moments, {most:g} kg m^2"
            beyond = f"{value - most:g} kg m^2 ({100 * (value - most) / most:.2g} %) more"
            wanted = "wanted is that of the sprung mass alone, not of the whole vehicle"
            raise InputError(name, value, f"{limit}; it is {beyond}: {wanted}")


def _check_fits_on_its_wheels(vehicle: Vehicle) -> None:
    """At rest the tires are not squashed flat."""
    squashed = float(np.max(vehicle.static_tire_compression))
    if vehicle.tire_radius <= squashed:
        limit = f"more than the compression of the tires at rest, {squashed:g} m"
        raise InputError("tire_radius", vehicle.tire_radius, limit)


def _check_springs_carry_it(vehicle: Vehicle) -> None:
    """At rest no spring is compressed by what a run takes for divergence."""
    most = float(np.min(plausible_magnitudes()["suspension_compression"]))
    for axle, wheel in AXLES.items():
        name = f"{axle}_spring_stiffness"
        compression = float(vehicle.static_suspension_compression[wheel])
        if compression > most:
            stiffness = getattr(vehicle, name)
            limit = f"at least {stiffness * compression / most:g} N/m to carry the sprung mass"
            raise InputError(name, stiffness, limit)
