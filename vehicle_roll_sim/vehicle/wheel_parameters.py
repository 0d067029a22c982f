"""Parameters at each wheel: springs, dampers, unsprung masses and tires."""

import dataclasses

from vehicle_roll_sim.declaration import Table, parameter
from vehicle_roll_sim.vehicle.suspension_parameters import of_axle

_LENGTH = {"unit": "m", "minimum": 0.01, "maximum": 50.0}
_STIFFNESS = {"unit": "N/m", "minimum": 1.0, "maximum": 1e8}
_PROGRESSION = {"unit": "1/m", "minimum": 0.0, "maximum": 1e4}
_DAMPING = {"unit": "N s/m", "minimum": 0.0, "maximum": 1e7}
_MASS = {"unit": "kg", "minimum": 0.01, "maximum": 1e6}
_PRESSURE = {"unit": "Pa", "minimum": 1e4, "maximum": 2e6}
_LATERAL = _STIFFNESS | {"minimum": 1e3}
_WHEEL_INERTIA = {"unit": "kg m^2", "minimum": 1e-6, "maximum": 1e7}


@dataclasses.dataclass(frozen=True)
class Struts:
    """Where the wheels are, and what carries the sprung mass."""

    front_track: float = parameter("track width of the front axle", **_LENGTH, symbol="cf")
    rear_track: float = parameter("track width of the rear axle", **_LENGTH, symbol="cr")
    front_spring_stiffness: float | None = parameter(
        "spring stiffness at one front wheel, not per axle",
        **_STIFFNESS,
        symbol="ksf",
        alternative="front_spring_force",
    )
    front_spring_force: Table | None = of_axle("front", "spring_force")
    rear_spring_stiffness: float | None = parameter(
        "spring stiffness at one rear wheel, not per axle",
        **_STIFFNESS,
        symbol="ksr",
        alternative="rear_spring_force",
    )
    rear_spring_force: Table | None = of_axle("rear", "spring_force")
    front_damping: float | None = parameter(
        "damping coefficient at one front wheel, not per axle",
        **_DAMPING,
        symbol="bsf",
        alternative="front_damper_force",
    )
    front_damper_force: Table | None = of_axle("front", "damper_force")
    rear_damping: float | None = parameter(
        "damping coefficient at one rear wheel, not per axle",
        **_DAMPING,
        symbol="bsr",
        alternative="rear_damper_force",
    )
    rear_damper_force: Table | None = of_axle("rear", "damper_force")
    front_unsprung_mass: float = parameter(
        "unsprung mass at one front wheel, not per axle", **_MASS, symbol="muf"
    )
    rear_unsprung_mass: float = parameter(
        "unsprung mass at one rear wheel, not per axle", **_MASS, symbol="mur"
    )


@dataclasses.dataclass(frozen=True)
class Tires:
    """What a tire file may leave open, and the wheels."""

    front_tire_stiffness: float | None = parameter(
        "vertical stiffness of one front tire; by default that of the tire file",
        **_STIFFNESS,
        symbol="ktf",
        default=None,
    )
    rear_tire_stiffness: float | None = parameter(
        "vertical stiffness of one rear tire; by default that of the tire file",
        **_STIFFNESS,
        symbol="ktr",
        default=None,
    )
    front_tire_progression: float | None = parameter(
        "progression p of the vertical force k x (1 + p x) of a front tire; by default that of the "
        "tire file if the stiffness is from there too, else 0",
        **_PROGRESSION,
        default=None,
    )
    rear_tire_progression: float | None = parameter(
        "progression p of the vertical force k x (1 + p x) of a rear tire; by default that of the "
        "tire file if the stiffness is from there too, else 0",
        **_PROGRESSION,
        default=None,
    )
    tire_radius: float | None = parameter(
        "unloaded radius of all tires; by default UNLOADED_RADIUS of the tire file",
        **_LENGTH,
        symbol="r0",
        default=None,
    )
    front_tire_radius: float | None = parameter(
        "unloaded radius of the front tires, instead of one radius for all", **_LENGTH, default=None
    )
    rear_tire_radius: float | None = parameter(
        "unloaded radius of the rear tires, instead of one radius for all", **_LENGTH, default=None
    )
    tire_pressure: float | None = parameter(
        "inflation pressure of all tires (version 6 only); by default that of the tire file",
        **_PRESSURE,
        default=None,
    )
    front_tire_pressure: float | None = parameter(
        "inflation pressure of the front tires, instead of one for all", **_PRESSURE, default=None
    )
    rear_tire_pressure: float | None = parameter(
        "inflation pressure of the rear tires, instead of one for all", **_PRESSURE, default=None
    )
    front_tire_lateral_stiffness: float | None = parameter(
        "lateral stiffness of one front tire, for the shift of its contact patch; by default "
        "LATERAL_STIFFNESS of the tire file, else cornering stiffness over relaxation length",
        **_LATERAL,
        default=None,
    )
    rear_tire_lateral_stiffness: float | None = parameter(
        "lateral stiffness of one rear tire, for the shift of its contact patch; by default "
        "LATERAL_STIFFNESS of the tire file, else cornering stiffness over relaxation length",
        **_LATERAL,
        default=None,
    )
    wheel_inertia: float = parameter(
        "moment of inertia of one wheel about its spin axis", **_WHEEL_INERTIA, symbol="Jw"
    )
