"""Parameters of drive, brakes and air forces."""

import dataclasses

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.vehicle.air_parameters import of_air


def _differential_of(axle: str):
    """The declaration of the viscous coupling in an axle's differential; it may be absent."""
    return parameter(
        f"viscous coupling of the {axle} wheels: torque from the faster to the slower one per "
        "difference of their speeds; 0, the default, is an open differential, a large value a "
        "locked one",
        "N m s/rad",
        0.0,
        1e5,
        default=None,
    )


@dataclasses.dataclass(frozen=True)
class DriveAndAir:
    """The drag of the engine, forces of the air, and how torques are shared between wheels."""

    engine_drag: float | None = parameter(
        "braking torque of the engine at each driven wheel per its speed; by default 0",
        "N m s/rad",
        0.0,
        1e4,
        default=None,
    )
    air_density: float | None = of_air("air_density")
    side_force_area: float | None = of_air("side_force_area")
    pressure_centre_ahead: float | None = of_air("pressure_centre_ahead")
    pressure_centre_height: float | None = of_air("pressure_centre_height")
    front_lift_area: float | None = of_air("front_lift_area")
    rear_lift_area: float | None = of_air("rear_lift_area")
    front_drive_share: float | None = parameter(
        "share of a total drive torque that the front wheels get: 0 is rear-wheel drive, 1 front-"
        "wheel drive; by default 0, and speed_cmd drives all wheels alike",
        "",
        0.0,
        1.0,
        default=None,
    )
    front_brake_share: float | None = parameter(
        "share of a total brake torque that the front wheels get; by default 0.6",
        "",
        0.0,
        1.0,
        default=None,
    )
    front_differential_damping: float | None = _differential_of("front")
    rear_differential_damping: float | None = _differential_of("rear")
