"""The vehicle: its parameters, put together from their groups, and what else a vehicle file has.

Each group declares names, units, ranges and descriptions of its parameters, once.
"""

import dataclasses
import functools
from collections.abc import Mapping

from vehicle_roll_sim.declaration import (
    InputError,
    Table,
    check_alternatives,
    parameters_of,
    validated,
)
from vehicle_roll_sim.model.variants import PAPER
from vehicle_roll_sim.vehicle.actuator_parameters import Actuators
from vehicle_roll_sim.vehicle.body_parameters import BodyBox
from vehicle_roll_sim.vehicle.chassis_parameters import Chassis
from vehicle_roll_sim.vehicle.consistency import check_consistency, check_given
from vehicle_roll_sim.vehicle.derived_values import AXLES, BAR_SPELLINGS, DerivedValues
from vehicle_roll_sim.vehicle.drive_parameters import DriveAndAir
from vehicle_roll_sim.vehicle.mass_parameters import Masses
from vehicle_roll_sim.vehicle.masses import Load
from vehicle_roll_sim.vehicle.sensor_parameters import Sensors
from vehicle_roll_sim.vehicle.sprung_mass import (
    MASS_SPELLINGS,
    WHOLE,
    Origin,
    as_given,
    sprung_values,
)
from vehicle_roll_sim.vehicle.suspension_parameters import SuspensionDetails
from vehicle_roll_sim.vehicle.tire_file import Tire
from vehicle_roll_sim.vehicle.travel_parameters import WheelTravel
from vehicle_roll_sim.vehicle.wheel_parameters import Struts, Tires

PER_AXLE = {
    name: tuple(f"{axle}_{name}" for axle in AXLES) for name in ("tire_radius", "tire_pressure")
}
"""Parameters of both axles, and those of one axle that are given instead."""


@dataclasses.dataclass(frozen=True)
class Vehicle(
    Sensors,
    Actuators,
    BodyBox,
    DriveAndAir,
    SuspensionDetails,
    WheelTravel,
    Chassis,
    Tires,
    Struts,
    Masses,
    DerivedValues,
):
    """A vehicle: the values of a vehicle file, and its tires.

    Units are those of the declarations (SI; `vehicle_roll_sim parameters` lists them).

    The tires are given either as one `tire` for all wheels, or as `front_tire` and `rear_tire`; the
    other attributes are None. `axle_tires` has both, whichever was given. tire_moments,
    contact_patch_shift: the values for which `auto` stands in the options of these names.
    longitudinal: how tire files are read, `from_lateral` or ''. model: with which the vehicle is
    simulated unless another is asked for. stated_at: where values were given (file, line and name),
    for messages.

    payload: masses that the sprung mass carries besides. Of a vehicle with payload or with data of
    the whole vehicle (`total_mass` and so on), the attributes `sprung_mass`, `cg_height` ... are
    those of the sprung mass with its payload, as the equations take them; `given` has the values
    as they were given, and `origin` both. Change such a vehicle with `with_values`.

    The roll centre of an axle is specified either as a depth below the c.g. or as a height above
    the ground; the other attribute is None. The specified value is kept when `cg_height` is
    replaced. `roll_centre_depth` and `roll_centre_height` give both, whichever was specified.

    The parameters are in the order of the base classes from the last to the first.

    Raises InputError for a value that is invalid or inconsistent with the others.
    """

    tire: Tire | None = dataclasses.field(kw_only=True, default=None)
    front_tire: Tire | None = dataclasses.field(kw_only=True, default=None)
    rear_tire: Tire | None = dataclasses.field(kw_only=True, default=None)
    tire_moments: bool = dataclasses.field(kw_only=True, default=True)
    contact_patch_shift: bool = dataclasses.field(kw_only=True, default=True)
    longitudinal: str = dataclasses.field(kw_only=True, default="")
    payload: tuple[Load, ...] = dataclasses.field(kw_only=True, default=())
    origin: Origin | None = dataclasses.field(kw_only=True, default=None, repr=False, compare=False)
    model: str = dataclasses.field(kw_only=True, default=PAPER)
    stated_at: dict = dataclasses.field(
        kw_only=True, default_factory=dict, compare=False, repr=False
    )

    def __post_init__(self):
        self._keep(as_given(self))
        self._keep(validated(Vehicle, self.given))
        check_alternatives(Vehicle, self.given)
        check_given(self, PER_AXLE)
        given = self.given
        if derived := sprung_values(self):
            self._keep(derived | {"origin": Origin(given, derived)})
        check_consistency(self)

    def _keep(self, values: dict) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)
        self.__dict__.pop("given", None)

    @classmethod
    def checked(
        cls, values: dict, tire: Tire | None = None, prefix: str = "", **others
    ) -> "Vehicle":
        """Build a vehicle from these values. others: fields that are not numbers.

        Raises InputError naming the invalid value, preceded by `prefix`.
        """
        numbers = validated(cls, values, prefix)
        try:
            return cls(**numbers, tire=tire, **others)
        except InputError as error:  # inconsistent values
            field = prefix + error.field
            raise InputError(field, error.value, error.allowed, error.problem) from None

    def with_values(self, values: dict, prefix: str = "") -> "Vehicle":
        """A copy with some values replaced; raises InputError like `checked`.

        A value also replaces its alternative: a roll centre height, for instance, the depth; the
        radius or pressure of one axle leaves the other axle the common one.
        """
        known, given = parameters_of(Vehicle), self.given
        kept = {n: value for n, value in given.items() if known[n].alternative not in values}
        spellings = (*BAR_SPELLINGS, *MASS_SPELLINGS)
        for name, other in (*spellings, *((b, a) for a, b in spellings)):
            if name in values:
                kept.pop(other, None)
        for both, single in PER_AXLE.items():
            if both in values:
                kept = {name: value for name, value in kept.items() if name not in single}
            elif both in kept and values.keys() & {*single}:
                kept |= dict.fromkeys(single, kept.pop(both))
        places = self.stated_at | {name: prefix + name for name in values}
        others = self.not_numbers | {"stated_at": places}
        return self.checked(kept | values, prefix=prefix, **others)

    @functools.cached_property
    def given(self) -> Mapping[str, float | Table]:
        """Every given value by name; of two alternatives, only the one that was specified.

        Not what `origin.derived` has.
        """
        if self.origin:
            return self.origin.given
        known = parameters_of(Vehicle)
        values = {name: getattr(self, name) for name in known}
        return {n: v for n, v in values.items() if v is not None or known[n].default is not None}

    @property
    def not_numbers(self) -> dict:
        """The fields that are not parameters: tires, payload, and what is on by default."""
        names = {field.name for field in dataclasses.fields(self)} - {*parameters_of(Vehicle)}
        names.remove("origin")
        return {name: getattr(self, name) for name in names}

    def with_depths(self) -> "Vehicle":
        """The same vehicle, bit for bit, as its sprung mass with depths of roll centres."""
        depths = {
            f"{axle}_roll_centre_depth": float(self.roll_centre_depth[wheel])
            for axle, wheel in AXLES.items()
        }
        if not self.origin:
            return self.with_values(depths)
        values = {n: v for n, v in self.given.items() if n not in WHOLE and "roll_centre" not in n}
        values |= {n: v for n, v in self.origin.derived.items() if v is not None}
        return self.checked(values | depths, **self.not_numbers | {"payload": ()})
