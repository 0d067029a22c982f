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
from vehicle_roll_sim.simulation.options import Options
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

    def begin(self, vehicle: Vehicle, options: Options) -> None:  # noqa: B027 - many need none
        """Called on a copy of the law before each run, with the vehicle and options of the run.

        Sets attributes that follow from them, or change in the run. Raises InputError if the law
        does not apply to this vehicle.
        """

    @abc.abstractmethod
    def answer(self, sensed: Sensed) -> Mapping[str, float | Sequence[float]]:
        """The commands of the period that begins, by name: a value for each of `commands`.

        They replace those of the manoeuvre and are held for the period.
        """


class Controlled(Feedback):
    """The driver of one run of a simulation with control laws.

    driver: of the manoeuvre; its commands are held for each period, too. laws: each sets commands
    of its own. Raises InputError if two set the same one, or if the answer of a law is not what its
    `commands` say, or is not allowed.
    """

    def __init__(self, simulation: Simulation, driver: Programme | Feedback, *laws: ControlLaw):
        names = [name for law in laws for name in law.commands]
        for name in names:
            if names.count(name) > 1:
                raise InputError("laws", name, "each command set by one law only")
        self._simulation, self._driver, self._laws = simulation, driver, [*map(copy.copy, laws)]
        for law in self._laws:
            law.begin(simulation.vehicle, simulation.options)
        self._last = IDLE

    def command(self, time: float, state) -> Command:
        simulation = self._simulation
        asked = command_at(self._driver, time, state)
        applied = simulation.acting(self._last)
        sensed = Sensed(time, simulation.state, simulation.outputs, applied, asked)
        answers = {}
        for law in self._laws:
            answers |= _answer_of(law, sensed)
        self._last = asked.replaced(**answers)
        return self._last


def _answer_of(law: ControlLaw, sensed: Sensed) -> Mapping[str, float | Sequence[float]]:
    """The answer of a law; raises InputError unless it is a value for each of its commands."""
    answer, wanted = law.answer(sensed), law.commands
    if not isinstance(answer, Mapping) or answer.keys() != {*wanted}:
        raise InputError("answer of the controller", answer, f"a dict of {', '.join(wanted)}")
    return answer
