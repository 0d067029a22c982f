"""What every control law is, and a driver whom laws assist.

A law sees the signals of the topic `motion`, by name, and answers with fields of a Command. The
node around it publishes them; `Assisted` applies them without ROS, with the same result.
"""

import abc
import dataclasses
import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.simulation.command import Command, Feedback, Programme, command_at

SIGNALS = ("u", "v", "yaw_rate", "roll", "roll_rate")
"""States that a law sees, besides the time and the angles of the wheels (SI units, rad)."""


class ControlLaw(abc.ABC):
    """A control law; `commanded` names the fields of a Command that it sets.

    Its answer depends only on the samples since the last reset.
    """

    commanded: ClassVar[tuple[str, ...]]

    def __init__(self):
        self.reset()

    def answer(self, motion: Mapping[str, float]) -> dict:
        """The commands for the period that begins with a sample: values of `commanded` by name.

        motion: `time` (s), `steering` and `rear_steering` as they were in the period that ends
        (rad), and SIGNALS. A time that is not after the previous one resets the law first.
        """
        if motion["time"] <= self._time:
            self.reset()
        self._time = motion["time"]
        return self.law(motion)

    @abc.abstractmethod
    def law(self, motion: Mapping[str, float]) -> dict:
        """The law itself; the arguments and the result are those of `answer`."""

    def reset(self) -> None:
        """Forget previous samples."""
        self._time = math.inf


class Assisted(Feedback):
    """A driver with control laws beside him, each of which sets commands that he leaves alone.

    Laws see the steering that was commanded. Where the vehicle has an actuator of the steering, the
    node sees what it lets act instead. Use a new object, with new laws, for each run. Raises
    InputError if two laws set one command.
    """

    def __init__(self, driver: Programme | Feedback, *laws: ControlLaw):
        names = [name for law in laws for name in law.commanded]
        for name in names:
            if names.count(name) > 1:
                raise InputError("laws", name, "each command set by one law only")
        self.driver, self.laws = driver, laws
        self._applied = Command()

    def command(self, time: float, state: Mapping[str, float] | np.void) -> Command:
        """The driver's command with those of the laws; raises InputError if he sets one of them."""
        driven = command_at(self.driver, time, state)
        motion = {name: float(state[name]) for name in SIGNALS}
        motion |= {name: getattr(self._applied, name) for name in ("steering", "rear_steering")}
        answers = {}
        for law in self.laws:
            answers |= law.answer({"time": time, **motion})
        for name in answers:
            if np.any(getattr(driven, name)):
                problem = "the driver sets it too"
                raise InputError(name, getattr(driven, name), "set by a law only", problem)
        self._applied = dataclasses.replace(driven, **answers)
        return self._applied
