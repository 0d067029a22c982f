"""A driver's right foot: holds a commanded speed by equal wheel torques and brakes."""

import dataclasses

import numpy as np

from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.vehicle.parameters import Vehicle

PROPORTIONAL = 2.0
"""1/s: acceleration asked for per speed that is missing."""
INTEGRAL = 1.0
"""1/s^2: its growth, which takes care of slope and resistance."""
STANDING = 0.2
"""m/s: a vehicle that shall stand and is slower than this is held by its brakes from then on."""
RUNAWAY = 1.0
"""m/s: a vehicle that is held and is faster than this is driven again; a stop springs back less."""
DEFAULT_DRIVE_LIMIT, DEFAULT_BRAKE_LIMIT = 800.0, 2000.0
"""N m at each wheel."""


class SpeedController:
    """Proportional-integral control of the forward speed, the same torque at every wheel.

    drive_limit, brake_limit: the largest torque of a wheel's drive and of its brake (N m).
    """

    def __init__(
        self,
        vehicle: Vehicle,
        drive_limit: float = DEFAULT_DRIVE_LIMIT,
        brake_limit: float = DEFAULT_BRAKE_LIMIT,
    ):
        self.drive_limit, self.brake_limit = drive_limit, brake_limit
        radius = vehicle.tire_radius - float(np.mean(vehicle.static_tire_compression))
        mass = vehicle.sprung_mass + float(vehicle.per_wheel("unsprung_mass").sum())
        mass += WHEEL_COUNT * vehicle.wheel_inertia / radius**2
        self._torque_of = mass * radius / WHEEL_COUNT
        """N m at each wheel for 1 m/s^2."""
        self.reset()

    def reset(self) -> None:
        """Forget what slope and resistance took."""
        self._kept, self._held = 0.0, False

    def drive(self, command: Command, target: float, speed: float, period: float) -> Command:
        """`command` with the torques for a period (s) that bring `speed` to `target` (m/s).

        A commanded brake counts where it is the stronger one, and then nothing drives against it.
        """
        self._held = target == 0.0 and abs(speed) < (RUNAWAY if self._held else STANDING)
        if self._held:
            self._kept = 0.0
            return self._with(command, 0.0, self.brake_limit)
        missing = target - speed
        torque = self._torque_of * (PROPORTIONAL * missing + self._kept)
        braking = torque * speed < 0.0 and abs(speed) > STANDING
        limit = self.brake_limit if braking else self.drive_limit
        is_braked = any(command.brake_torque)
        winds_up = is_braked or (abs(torque) >= limit and torque * missing >= 0.0)
        if not winds_up:
            self._kept += INTEGRAL * missing * period
        torque = float(np.clip(torque, -limit, limit))
        if braking or is_braked:
            return self._with(command, 0.0, abs(torque) if braking else 0.0)
        return self._with(command, torque, 0.0)

    @staticmethod
    def _with(command: Command, drive: float, brake: float) -> Command:
        brakes = tuple(max(brake, commanded) for commanded in command.brake_torque)
        return dataclasses.replace(
            command, wheel_torque=(drive,) * WHEEL_COUNT, brake_torque=brakes
        )
