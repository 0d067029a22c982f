"""What can be read of a simulation: time, state, and the parts that compiled code takes."""

import math

import numpy as np

from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import STATE_NAMES
from vehicle_roll_sim.model.tire.coefficients import as_one
from vehicle_roll_sim.simulation.command import IDLE, Command, held_command
from vehicle_roll_sim.simulation.sensing import cg_motion
from vehicle_roll_sim.simulation.snapshot import Restorable

LONGEST_STEP = 0.1
"""s"""


class Readable(Restorable):
    """The reading of a simulation, whose members `Simulation` constructs."""

    @property
    def time(self) -> float:
        """Simulated time since the last reset (s)."""
        return self.time_ns / NANOSECONDS

    @property
    def state_vector(self) -> np.ndarray:
        """The state as a flat vector (a view), shape (STATE_SIZE,), named by STATE_NAMES."""
        return self._vector

    @property
    def output_vector(self) -> np.ndarray:
        """The outputs as a flat vector (a view), in the order of OUTPUTS."""
        return self._output_vector

    @property
    def model_state(self) -> np.ndarray:
        """The states of the model in the order of its equations, shape (n,), see `state_names`."""
        return self.state_vector[self._places]

    @property
    def cg_motion(self) -> tuple[float, ...]:
        """x, y, z of the sprung c.g. in the ground frame (m), and u, v, w in the body frame (m/s).

        nan for components that the model does not have: z and w in the 8 DOF model.
        """
        return self.cg_motion_at(self.state)

    def cg_motion_at(self, state) -> tuple[float, ...]:
        """`cg_motion` at another STATE record of the same vehicle and model."""
        return cg_motion(state, self._axis_depth)

    @property
    def has_rolled_over(self) -> bool:
        """Whether the roll angle has reached that of a rollover since the last reset."""
        return not math.isnan(self.events["rollover_time"][0])

    @property
    def static_suspension_compression(self) -> np.ndarray:
        """Static compression of the suspension springs, shape (4,) (m; eq. 19)."""
        return self._vehicle[0]["static_suspension_compression"]

    def sense(self) -> None:
        """Let the sensors that are due take a sample; whoever moves the parts calls this."""
        self.sensors.sample(self.time_ns, self.state, self.outputs)

    def stage_times(self, steps: int) -> np.ndarray:
        """Times of the ends and midpoints of the next steps (s), shape (2 * steps + 1,)."""
        halves = np.arange(2 * steps + 1)
        return (self.time_ns + halves * (self.step_ns / 2)) / NANOSECONDS

    def largest_stable_step(self, command: Command | None = None) -> float:
        """Largest step (s), up to 0.1, at which the fastest mode about the present state is stable.

        command: the command held; by default none. nan if the linearization is not finite.
        """
        return self._modes.largest_step(self.state_vector, command or IDLE, LONGEST_STEP)

    def acting(self, command: Command) -> Command:
        """What acts at the present time, `command` being the last one that was given.

        That is the command itself, but where the vehicle has actuators.
        """
        if not self.has_actuators:
            return command
        return held_command(self.actuation.records()[0], float(self.state["u"]))

    def parts(self) -> tuple:
        """State, plant, outputs, events and work space, in the form in which kernels take them."""
        outputs, events = kernel_argument(self._outputs), kernel_argument(self._events)
        return self.state_vector, self._plant, outputs, events, self._stages

    def arrays(self) -> tuple[tuple[np.ndarray, ...], tuple[np.ndarray, ...]]:
        """Vehicle, tires, options and limits; and state, outputs, events and work space.

        All but the work space are arrays of one record. The next step overwrites the second group.
        """
        vehicle, tires, *others = self._records
        return (vehicle, as_one(tires), *others), self._own

    def note_moved(self, until_ns: int, condition: int, culprit: int) -> None:
        """Note the time (ns), the condition and the culprit with which a kernel left the parts."""
        self.time_ns, self.condition = until_ns, Condition(condition)
        if self.condition is Condition.DIVERGED:
            self.implausible = STATE_NAMES[culprit]
