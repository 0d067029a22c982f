"""What an agent may command: fractions of the command limits of the node."""

from collections.abc import Mapping, Sequence

import numpy as np

from vehicle_roll_sim.declaration import InputError, validated
from vehicle_roll_sim.learning.names import mapping_of, names_of
from vehicle_roll_sim.live.channels import BRAKE, DRIVE, OF_ROAD, SPEED, WIND, Channel, channels
from vehicle_roll_sim.live.command_limits import CommandLimits
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.records import WHEEL_COUNT, WHEELS
from vehicle_roll_sim.vehicle.parameters import Vehicle

ENDING = "_cmd"
"""Suffix of the topic names, which the names of actions lack."""
ACTIONS: dict[str, Channel] = {
    topic.removesuffix(ENDING): channel
    for topic, channel in channels().items()
    if channel.field not in (SPEED, WIND, *OF_ROAD)
}
"""Each action has the name of the topic on which the node takes the same command."""
STEERING = ("steering", "rear_steering")
TOTALS = {DRIVE: ("wheel_torque", "drive_shares"), BRAKE: ("brake_torque", "brake_shares")}
"""Field of a command to which a total torque is distributed, and attribute with the shares."""


class Actions:
    """The actions of an agent: numbers from -1, or 0 for brakes, to 1; 1 stands for the limit.

    names: of ACTIONS. limits: values of CommandLimits other than the defaults. Raises
    InputError. Attributes: `elements`, the name of each number; `lowest`, shape (k,); the highest
    of all is 1.
    """

    def __init__(self, names: Sequence[str], limits: Mapping[str, float]):
        limits = mapping_of("limits", limits, "{'brake_torque_limit': 3000.0}")
        self.names = names_of("actions", names, ACTIONS)
        self.limits = CommandLimits(**validated(CommandLimits, limits, "limits."))
        for name in limits:
            if name not in self._used_limits():
                raise InputError(f"limits.{name}", limits[name], "a limit of one of the actions")
        self.elements = tuple(
            f"{name}_{wheel}" if wheel else name
            for name in self.names
            for wheel in (WHEELS if ACTIONS[name].size == WHEEL_COUNT else ("",))
        )
        sizes = [ACTIONS[name].size for name in self.names]
        places = np.split(np.arange(sum(sizes)), np.cumsum(sizes)[:-1])
        self._places = dict(zip(self.names, places, strict=True))
        self.lowest = np.concatenate(
            [np.full(ACTIONS[name].size, max(-1.0, ACTIONS[name].smallest)) for name in self.names]
        )

    def _used_limits(self) -> set[str]:
        used = {ACTIONS[name].limit for name in self.names}
        return used | ({"steering_rate_limit"} if set(self.names) & {*STEERING} else set())

    def checked(self, given, count: int) -> np.ndarray:
        """Actions of `count` agents, clamped to their range, shape (count, k).

        Raises InputError for another shape and for numbers that are not finite.
        """
        allowed = f"finite numbers of shape {(count, len(self.elements))}"
        try:
            values = np.asarray(given, np.float64)
        except (TypeError, ValueError):
            raise InputError("action", given, allowed) from None
        if values.shape != (count, len(self.elements)):
            raise InputError("action", "", allowed, f"shape {values.shape}")
        if not np.isfinite(values).all():
            raise InputError("action", values[~np.isfinite(values)][0], allowed)
        return np.clip(values, self.lowest, 1.0)

    def add_to(
        self, commands: np.ndarray, actions: np.ndarray, before: np.ndarray, shares: dict, ns: int
    ) -> None:
        """Add actions to the commands of a manoeuvre.

        commands: COMMAND records, shape (n,), changed in place. actions: shape (n, k). before: the
        commands of the period before, for the limit of the steering rate. shares: of total torques,
        as from `shares_of`, each of shape (n, 4). ns: length of the period.
        """
        for name in self.names:
            channel = ACTIONS[name]
            values = getattr(self.limits, channel.limit) * actions[:, self._places[name]]
            if name in STEERING:
                commands[name] = self._within_rate(values[:, 0], before[name], ns)
            elif channel.field in TOTALS:
                commands[TOTALS[channel.field][0]] += values * shares[channel.field]
            else:
                commands[name] += values

    def _within_rate(self, wanted: np.ndarray, before: np.ndarray, ns: int) -> np.ndarray:
        if self.limits.steering_rate_limit == 0.0:
            return wanted
        most = self.limits.steering_rate_limit * (ns / NANOSECONDS)
        return before + np.clip(wanted - before, -most, most)


def shares_of(vehicle: Vehicle) -> dict[str, np.ndarray]:
    """How a vehicle distributes total torques to its wheels, shape (4,), by their names."""
    return {total: getattr(vehicle, shares) for total, (_, shares) in TOTALS.items()}


def check_action_names(names: Sequence[str], is_steered: bool) -> None:
    """Raise InputError if agent and manoeuvre both steer the front wheels."""
    if is_steered and "steering" in names:
        allowed = "with manoeuvre=None only: a manoeuvre steers itself"
        raise InputError("actions", "steering", allowed)
