"""Parameters of drive, brakes and air forces."""

import dataclasses

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.vehicle.air_parameters import of_air
from vehicle_roll_sim.vehicle.differential_parameters import of_differential


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
    front_differential_damping: float | None = of_differential("damping", "front")
    rear_differential_damping: float | None = of_differential("damping", "rear")
    front_differential_preload: float | None = of_differential("preload", "front")
    rear_differential_preload: float | None = of_differential("preload", "rear")
    front_differential_locking: float | None = of_differential("locking", "front")
    rear_differential_locking: float | None = of_differential("locking", "rear")
