"""Parameters of the air forces beyond drag, and how the equations take them."""

from vehicle_roll_sim.declaration import InputError, parameter

STANDARD_DENSITY = 1.225
"""kg/m^3: standard atmosphere at sea level."""
_AREA = {"unit": "m^2", "minimum": -100.0, "maximum": 100.0}
_PLACE = {"unit": "m", "minimum": -20.0, "maximum": 20.0}
_DECLARED = {
    "air_density": (
        "density of the air, by default 1.225",
        {"unit": "kg/m^3", "minimum": 0.0, "maximum": 10.0},
    ),
    "side_force_area": (
        "side-force coefficient times frontal area; the coefficient is that of air from the side, "
        "and for small angles its slope per radian of the air's sideslip; by default 0",
        _AREA | {"minimum": 0.0},
    ),
    "pressure_centre_ahead": (
        "distance from the sprung c.g. forward to the point that the side force acts at; by "
        "default 0",
        _PLACE,
    ),
    "pressure_centre_height": ("height of this point above the sprung c.g.; by default 0", _PLACE),
    "front_lift_area": (
        "lift coefficient of the front axle times frontal area; negative is downforce; by default "
        "0",
        _AREA,
    ),
    "rear_lift_area": ("the same of the rear axle", _AREA),
}
OF_SIDE_AND_LIFT = tuple(name for name in _DECLARED if name != "air_density")
"""What only models with all motions of the body use."""
NO_WIND = "no wind, since the vehicle has no air forces, such as a side_force_area"
"""What is allowed to a vehicle on which the wind does not act."""


def of_air(name: str):
    """The declaration of a parameter of the air forces; it may be absent."""
    meaning, limits = _DECLARED[name]
    return parameter(meaning, **limits, default=None)


def has_air_forces(vehicle) -> bool:
    """Whether the vehicle is given any of OF_SIDE_AND_LIFT, even as 0; a wind then acts on it."""
    return any(name in vehicle.given for name in OF_SIDE_AND_LIFT)


def check_air(vehicle) -> None:
    """Raise InputError for a place of the side force without the force."""
    for name in ("pressure_centre_ahead", "pressure_centre_height"):
        if name in vehicle.given and not vehicle.side_force_area:
            raise InputError(name, vehicle.given[name], "no value without a side_force_area")


def air_of(vehicle) -> dict[str, float]:
    """Fields of a VEHICLE record: the parameters, and whether any force beside drag is computed."""
    density = vehicle.air_density
    values = {name: getattr(vehicle, name) or 0.0 for name in OF_SIDE_AND_LIFT}
    return {
        "air_density": STANDARD_DENSITY if density is None else density,
        "side_and_lift": float(any(values.values())),
        **values,
    }
