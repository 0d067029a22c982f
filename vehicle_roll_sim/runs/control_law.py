"""Control laws: controllers without ROS, asked once per command period like a node in lockstep."""

import abc
import copy
import dataclasses
from collections.abc import Mapping, Sequence
from typing import ClassVar, NamedTuple

import numpy as np

from vehicle_roll_sim.declaration import InputError, keep_validated
from vehicle_roll_sim.model.frames import quaternion
from vehicle_roll_sim.simulation.command import IDLE, Command, Feedback, Programme, command_at
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle

COMMANDED = ("steering", "rear_steering", "wheel_torque", "brake_torque", "normal_force")
"""The fields of a Command that a control law may set."""


class Sensed(NamedTuple):
    """What a control law knows at the beginning of a command period, in SI units and radians.

    time: since the reset. state: STATE record, outputs: OUTPUTS record, of this time; the next step
    overwrites them. applied: the command of the period before, as the actuators applied it. asked:
    the command of the manoeuvre for this period.
    """

    time: float
    state: np.record
    outputs: np.record
    applied: Command
    asked: Command

    @property
    def attitude(self) -> tuple[float, float, float, float]:
        """Orientation of the body as a quaternion (x, y, z, w), as in the message `imu`."""
        roll, pitch, yaw = (float(self.state[name]) for name in ("roll", "pitch", "yaw"))
        return quaternion(roll, 0.0 if np.isnan(pitch) else pitch, yaw)


@dataclasses.dataclass(kw_only=True)
class ControlLaw(abc.ABC):
    """A controller without ROS. A subclass is a dataclass; its fields are declared parameters.

    It names in `commands` the fields of a Command that it sets, some of COMMANDED. Raises
    InputError for a parameter that is not allowed.
    """

    commands: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self):
        keep_validated(self)

    def begin(self, vehicle: Vehicle) -> None:  # noqa: B027 - many laws have no memory
        """Called on a copy of the law before each run; sets attributes that change in the run."""

    @abc.abstractmethod
    def answer(self, sensed: Sensed) -> Mapping[str, float | Sequence[float]]:
        """The commands of the period that begins, by name: a value for each of `commands`.

        They replace those of the manoeuvre and are held for the period.
        """


class Controlled(Feedback):
    """The driver of one run of a simulation with a control law.

    driver: of the manoeuvre; its commands are held for each period, too. Raises InputError if the
    answer of the law is not what its `commands` say, or is not allowed.
    """

    def __init__(self, simulation: Simulation, driver: Programme | Feedback, law: ControlLaw):
        self._simulation, self._driver, self._law = simulation, driver, copy.copy(law)
        self._law.begin(simulation.vehicle)
        self._last = IDLE

    def command(self, time: float, state) -> Command:
        simulation = self._simulation
        asked = command_at(self._driver, time, state)
        applied = simulation.acting(self._last)
        sensed = Sensed(time, simulation.state, simulation.outputs, applied, asked)
        answer, wanted = self._law.answer(sensed), self._law.commands
        if not isinstance(answer, Mapping) or answer.keys() != {*wanted}:
            raise InputError("answer of the controller", answer, f"a dict of {', '.join(wanted)}")
        self._last = dataclasses.replace(asked, **answer)
        return self._last
