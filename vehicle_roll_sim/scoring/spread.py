"""The spread: variants of the vehicle over which each test is driven, as data.

A variant changes parameters of the vehicle, or coefficients of its tires. To add one, add an entry
to SPREAD; every parameter of a vehicle can be named.
"""

import dataclasses
from collections.abc import Mapping

from vehicle_roll_sim.vehicle.derived_values import AXLES
from vehicle_roll_sim.vehicle.parameters import Vehicle

DELAYED = ("rear_steering", "wheel_torque", "brake_torque", "normal_force")
"""The actuators that a controller uses, rather than the driver."""


@dataclasses.dataclass(frozen=True)
class Variant:
    """A change of the vehicle.

    factors: by which parameters are multiplied. values: to which they are set. tires: factors on
    coefficients of all tires. is_quick: whether it belongs to the quick size.
    """

    title: str
    factors: Mapping[str, float] = dataclasses.field(default_factory=dict)
    values: Mapping[str, float] = dataclasses.field(default_factory=dict)
    tires: Mapping[str, float] = dataclasses.field(default_factory=dict)
    is_quick: bool = False

    def of(self, vehicle: Vehicle) -> Vehicle:
        """The changed vehicle; raises InputError if it is not possible."""
        values = {name: factor * getattr(vehicle, name) for name, factor in self.factors.items()}
        values |= self.values
        changed = vehicle.with_values(values) if values else vehicle
        return _on_scaled_tires(changed, self.tires) if self.tires else changed

    @property
    def changes(self) -> str:
        """The changes in words."""
        factors = [f"{name} × {factor:g}" for name, factor in self.factors.items()]
        values = [f"{name} {value:g}" for name, value in self.values.items()]
        tires = [f"tire coefficient {name} × {factor:g}" for name, factor in self.tires.items()]
        return ", ".join((*factors, *values, *tires)) or "none"


def _on_scaled_tires(vehicle: Vehicle, factors: Mapping[str, float]) -> Vehicle:
    tires = {}
    for axle in AXLES:
        tire = vehicle.axle_tires[axle]
        scaled = {name: tire.coefficients[name] * factor for name, factor in factors.items()}
        tires[f"{axle}_tire"] = tire.with_coefficients(**scaled)
    others = vehicle.not_numbers | {"tire": None, **tires}
    return Vehicle.checked(vehicle.given, **others)


def _mass(factor: float) -> dict[str, float]:
    names = ("sprung_mass", "roll_inertia", "pitch_inertia", "yaw_inertia")
    return dict.fromkeys(names, factor)


NOMINAL = "nominal"
SPREAD = {
    NOMINAL: Variant("as it is", is_quick=True),
    "light": Variant("less load", factors=_mass(0.9)),
    "heavy": Variant("more load", factors=_mass(1.15), is_quick=True),
    "grip_less": Variant("less tire grip", tires={"LMUX": 0.85, "LMUY": 0.85}),
    "grip_more": Variant("more tire grip", tires={"LMUX": 1.1, "LMUY": 1.1}),
    "slow_actuators": Variant(
        "actuators of the controller respond 50 ms later",
        values={f"{name}_actuator_dead_time": 0.05 for name in DELAYED},
        is_quick=True,
    ),
    "noisy_imu": Variant(
        "an imu with the noise and the errors of one in a series car",
        values={
            "accelerometer_noise_density": 2e-3,
            "accelerometer_bias_y": 0.05,
            "accelerometer_scale_error": 0.01,
            "gyro_noise_density": 2e-4,
            "gyro_bias_x": 2e-3,
            "gyro_bias_z": 2e-3,
            "imu_delay": 0.01,
            "sensor_seed": 1,
        },
        is_quick=True,
    ),
}
"""By name, the vehicle itself first."""
