"""Parameters of masses, inertias and of where the c.g. is."""

import dataclasses

from vehicle_roll_sim.declaration import parameter

_MASS = {"unit": "kg", "minimum": 0.01, "maximum": 1e6}
_LENGTH = {"unit": "m", "minimum": 0.01, "maximum": 50.0}
_OFFSET = {"unit": "m", "minimum": -25.0, "maximum": 25.0}
_INERTIA = {"unit": "kg m^2", "minimum": 1e-3, "maximum": 1e7}
_PRODUCT = {"unit": "kg m^2", "minimum": -1e7, "maximum": 1e7}


@dataclasses.dataclass(frozen=True)
class Masses:
    """The sprung mass, or the whole vehicle in its place."""

    sprung_mass: float | None = parameter(
        "mass carried by the suspension springs", **_MASS, symbol="m", alternative="total_mass"
    )
    roll_inertia: float | None = parameter(
        "moment of inertia of the sprung mass about its x axis",
        **_INERTIA,
        symbol="Jx",
        alternative="total_roll_inertia",
    )
    pitch_inertia: float | None = parameter(
        "moment of inertia of the sprung mass about its y axis",
        **_INERTIA,
        symbol="Jy",
        alternative="total_pitch_inertia",
    )
    yaw_inertia: float | None = parameter(
        "moment of inertia of the sprung mass about its z axis",
        **_INERTIA,
        symbol="Jz",
        alternative="total_yaw_inertia",
    )
    cg_to_front_axle: float | None = parameter(
        "distance from the c.g. of the sprung mass to the front axle",
        **_LENGTH,
        symbol="a",
        alternative="total_cg_to_front_axle",
    )
    cg_to_rear_axle: float | None = parameter(
        "distance from the c.g. of the sprung mass to the rear axle",
        **_LENGTH,
        symbol="b",
        alternative="total_cg_to_rear_axle",
    )
    cg_height: float | None = parameter(
        "height of the c.g. of the sprung mass above ground at rest",
        **_LENGTH,
        symbol="h",
        alternative="total_cg_height",
    )
    total_mass: float | None = parameter(
        "mass of the whole vehicle, instead of its sprung mass", **_MASS, alternative="sprung_mass"
    )
    total_roll_inertia: float | None = parameter(
        "moment of inertia of the whole vehicle about its x axis, instead of that of the sprung "
        "mass",
        **_INERTIA,
        alternative="roll_inertia",
    )
    total_pitch_inertia: float | None = parameter(
        "moment of inertia of the whole vehicle about its y axis, instead of that of the sprung "
        "mass",
        **_INERTIA,
        alternative="pitch_inertia",
    )
    total_yaw_inertia: float | None = parameter(
        "moment of inertia of the whole vehicle about its z axis, instead of that of the sprung "
        "mass",
        **_INERTIA,
        alternative="yaw_inertia",
    )
    total_cg_to_front_axle: float | None = parameter(
        "distance from the c.g. of the whole vehicle to the front axle, instead of that of the "
        "sprung mass",
        **_LENGTH,
        alternative="cg_to_front_axle",
    )
    total_cg_to_rear_axle: float | None = parameter(
        "distance from the c.g. of the whole vehicle to the rear axle, instead of that of the "
        "sprung mass",
        **_LENGTH,
        alternative="cg_to_rear_axle",
    )
    total_cg_height: float | None = parameter(
        "height of the c.g. of the whole vehicle above ground at rest, instead of that of the "
        "sprung mass",
        **_LENGTH,
        alternative="cg_height",
    )
    cg_offset: float | None = parameter(
        "distance of the c.g. of the sprung mass to the left of the centreline (14 DOF models); "
        "by default 0",
        **_OFFSET,
        default=None,
    )
    total_cg_offset: float | None = parameter(
        "distance of the c.g. of the whole vehicle to the left of the centreline, instead of that "
        "of the sprung mass (14 DOF models)",
        **_OFFSET,
        default=None,
    )
    roll_yaw_product: float | None = parameter(
        "product of inertia of the sprung mass, the integral of x z dm (14 DOF models); by default "
        "0",
        **_PRODUCT,
        symbol="Jxz",
        default=None,
    )
    total_roll_yaw_product: float | None = parameter(
        "product of inertia of the whole vehicle, instead of that of the sprung mass",
        **_PRODUCT,
        default=None,
    )
    roll_pitch_product: float | None = parameter(
        "product of inertia of the sprung mass, the integral of x y dm (14 DOF models); by default "
        "0",
        **_PRODUCT,
        symbol="Jxy",
        default=None,
    )
    pitch_yaw_product: float | None = parameter(
        "product of inertia of the sprung mass, the integral of y z dm (14 DOF models); by default "
        "0",
        **_PRODUCT,
        symbol="Jyz",
        default=None,
    )
