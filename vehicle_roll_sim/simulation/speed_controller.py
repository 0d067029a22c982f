"""Speed controller: tracks a commanded speed with drive and brake torques.

They are equal at all wheels, but for a vehicle with a `front_drive_share`, which distributes the
drive torque; the drive limit then is that of the mean over the wheels.
"""

import dataclasses

import numpy as np

from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.parameters import Vehicle

PROPORTIONAL = 2.0
"""1/s: proportional gain, acceleration demand per speed error."""
SHARE_OF_A_PERIOD = 0.5
"""Largest fraction of the speed error corrected within one period, over which torques are held."""
INTEGRAL = 0.25
"""Integral gain (1/s^2) over the square of the proportional gain: critical damping."""
HARDEST, EASIEST = 4.0, 1.0
"""m/s^2: largest acceleration demand on the tires, slope included; and the smallest limit on the
acceleration alone. Equal torques much beyond that lock or spin the wheels of the unloaded axle."""
STANDING = 0.2
"""m/s: below this speed a vehicle with target speed 0 is held by its brakes."""
RUNAWAY = 1.0
"""m/s: above this speed a held vehicle is controlled again; the rebound after a stop is slower."""
DEFAULT_DRIVE_LIMIT, DEFAULT_BRAKE_LIMIT = 800.0, 2000.0
"""N m at each wheel."""


class SpeedController:
    """Proportional-integral control, with feedforward of slope and rolling resistance.

    drive_limit, brake_limit: largest drive and brake torque at each wheel (N m).
    """

    def __init__(
        self,
        vehicle: Vehicle,
        drive_limit: float = DEFAULT_DRIVE_LIMIT,
        brake_limit: float = DEFAULT_BRAKE_LIMIT,
    ):
        self.drive_limit, self.brake_limit = drive_limit, brake_limit
        front, *_, rear = vehicle.per_wheel("tire_radius")
        radius = float((front + rear) / 2 - np.mean(vehicle.static_tire_compression))
        mass = vehicle.mass
        inertia = mass + WHEEL_COUNT * vehicle.wheel_inertia / radius**2
        self._torque_of_gravity = mass * radius / WHEEL_COUNT
        self._torque_of_acceleration = inertia * radius / WHEEL_COUNT
        """N m at each wheel for 1 m/s^2."""
        resistance = vehicle.rolling_resistance_coefficient * GRAVITY
        self._torque_of_resistance = resistance * self._torque_of_gravity
        is_given = vehicle.front_drive_share is not None
        self.distribution = WHEEL_COUNT * vehicle.drive_shares if is_given else np.ones(4)
        """Torque of each wheel over their mean."""
        self.reset()

    def reset(self) -> None:
        """Reset the integral part."""
        self._kept, self._held = 0.0, False

    def memory(self) -> dict:
        """The integral part (m/s^2), and whether the brakes hold the vehicle."""
        return {"kept": float(self._kept), "held": bool(self._held)}

    def remember(self, memory: dict) -> None:
        """Take over what `memory` returned."""
        self._kept, self._held = memory["kept"], memory["held"]

    def drive(
        self, command: Command, target: float, speed: float, period: float, slope: float = 0.0
    ) -> Command:
        """`command` with the wheel torques for a period (s) that bring `speed` to `target` (m/s).

        slope: component of gravity along the vehicle (m/s^2), positive if it heads downhill. At
        each wheel the larger of the commanded and the controller's brake torque applies; while a
        brake is commanded there is no drive torque.
        """
        is_braked = any(command.brake_torque)
        return self._with(command, *self.torques(target, speed, period, slope, is_braked))

    def torques(
        self,
        target: float,
        speed: float,
        period: float,
        slope: float = 0.0,
        is_braked: bool = False,
    ) -> tuple[float, float]:
        """Mean drive torque over the wheels, and brake torque at each (N m), likewise.

        is_braked: whether a brake is commanded.
        """
        climb = -self._torque_of_gravity * slope
        if self._is_to_be_held(target, speed, climb):
            self._kept = 0.0
            return 0.0, self.brake_limit
        drive_limit = 0.0 if is_braked else self.drive_limit
        missing, gain = target - speed, min(PROPORTIONAL, SHARE_OF_A_PERIOD / period)
        wanted = gain * missing + self._kept
        asked = _bearable(wanted, slope)
        torque = self._torque_of_acceleration * asked + climb
        torque += float(np.sign(target)) * self._torque_of_resistance
        most = drive_limit if torque * target > 0.0 else drive_limit + self.brake_limit
        beyond = torque - _within(most, torque)
        winds_up = is_braked or (wanted - asked) * missing > 0.0 or beyond * missing > 0.0
        if not winds_up:
            self._kept += INTEGRAL * gain**2 * missing * period
        return self._shared(torque, speed, climb, drive_limit)

    def _is_to_be_held(self, target: float, speed: float, climb: float) -> bool:
        """Whether the brakes hold the vehicle; they keep holding while it rebounds after a stop."""
        slow = abs(speed) < (RUNAWAY if self._held else STANDING)
        self._held = target == 0.0 and slow and abs(climb) < self.brake_limit
        return self._held

    def _shared(
        self, torque: float, speed: float, climb: float, drive_limit: float
    ) -> tuple[float, float]:
        """Split a wheel torque into drive and brake torque (N m).

        climb: the part of the torque that balances the slope (N m). A torque against the motion is
        left to the brake as far as possible. Near standstill the brake only provides what exceeds
        the drive limit, and it holds the vehicle on a slope that is too steep for the drive.
        """
        is_too_steep = abs(climb) > drive_limit and torque * climb > 0.0
        if torque * speed >= 0.0 and not (is_too_steep and abs(speed) < STANDING):
            return _within(drive_limit, torque), 0.0
        if abs(speed) < STANDING:
            drive = _within(drive_limit, torque)
            return drive, min(abs(torque - drive), self.brake_limit)
        brake = _within(self.brake_limit, torque)
        return _within(drive_limit, torque - brake), abs(brake)

    def _with(self, command: Command, drive: float, brake: float) -> Command:
        brakes = tuple(max(brake, commanded) for commanded in command.brake_torque)
        drives = tuple((drive * self.distribution).tolist())
        return dataclasses.replace(command, wheel_torque=drives, brake_torque=brakes)


def _within(limit: float, value: float) -> float:
    return max(-limit, min(limit, value))


def _bearable(acceleration: float, slope: float) -> float:
    """Limit an acceleration (m/s^2) to what the tires can transmit on this slope (m/s^2)."""
    ahead, back = max(EASIEST, HARDEST + slope), max(EASIEST, HARDEST - slope)
    return max(-back, min(ahead, acceleration))
