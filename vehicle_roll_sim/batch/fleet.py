"""Simulations that are stepped together, each with its own command, on all processors."""

import itertools
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from vehicle_roll_sim.batch.evaluate import checked_workers
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.actuators import ACTUATORS, COMMAND_SIZE
from vehicle_roll_sim.model.compiled.jit import interruptible, kernel_argument, silently
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import EVENTS, Condition
from vehicle_roll_sim.model.integration.integrator import STAGE_VECTORS
from vehicle_roll_sim.model.integration.step_each import CONDITION, NOW, PROGRESS_SIZE, step_each
from vehicle_roll_sim.model.records import COMMAND, OUTPUTS, STATE, STATE_SIZE
from vehicle_roll_sim.model.road.layout import PLANE
from vehicle_roll_sim.simulation.actuators import Actuation
from vehicle_roll_sim.simulation.advance_address import PLANT, address_of_advance
from vehicle_roll_sim.simulation.sensors import NEVER, Sensors
from vehicle_roll_sim.simulation.simulation import Simulation

RUNNING = int(Condition.RUNNING)


class Fleet:
    """Copies of simulations, stepped together; each equals `Simulation.step` to the bit.

    count: number of places, at least 1, all empty at first. step_ns: integration step of all (ns).
    workers: number of threads, by default one for each processor that the process may use. Raises
    InputError for an invalid number of workers.

    Attributes, arrays with one element or row for each place, which the next call overwrites:
    `states` (STATE records), `outputs` (OUTPUTS), `events` (EVENTS), `state_vectors`, shape (count,
    STATE_SIZE), and `output_vectors`, the same numbers as flat vectors. `sensors` has those of each
    place, or None. A copied or pickled fleet is independent of the original, with its own threads.
    """

    def __init__(self, count: int, step_ns: int, workers: int | None = None):
        self.step_ns = step_ns
        self.states, self.outputs = np.zeros(count, STATE), np.full(count, np.nan, OUTPUTS)
        self.events = np.full(count, np.nan, EVENTS)
        self._plant = tuple(np.zeros(count, kind) for kind in PLANT)
        self._stages = np.zeros((count, STAGE_VECTORS, STATE_SIZE))
        self._grounds = [PLANE] * count
        self._actuators = np.zeros(count, ACTUATORS)
        self._acting = np.zeros((count, 0), COMMAND)
        self._progress = np.zeros((count, PROGRESS_SIZE), np.int64)
        self.sensors: list[Sensors | None] = [None] * count
        self._sensing: list[int] = []
        threads = min(checked_workers(workers), count)
        self._bounds = [count * i // threads for i in range(threads + 1)]
        self._complete()

    def _complete(self) -> None:
        """Add what a copy cannot take over: views of own arrays, addresses and threads."""
        count, threads = len(self), len(self._bounds) - 1
        self.state_vectors = self.states.view(np.float64).reshape(count, STATE_SIZE)
        self.output_vectors = self.outputs.view(np.float64).reshape(count, -1)
        self._arguments = ()
        self._pool = ThreadPoolExecutor(threads, "fleet") if threads > 1 else None

    def __getstate__(self) -> dict:
        added = ("state_vectors", "output_vectors", "_arguments", "_pool")
        return {name: value for name, value in vars(self).items() if name not in added}

    def __setstate__(self, state: dict) -> None:
        vars(self).update(state)
        self._complete()

    def __len__(self) -> int:
        return len(self.states)

    @property
    def times_ns(self) -> np.ndarray:
        """Simulated time at each place (ns), shape (count,)."""
        return self._progress[:, NOW]

    @property
    def times(self) -> np.ndarray:
        """Simulated time at each place (s), shape (count,)."""
        return self.times_ns / NANOSECONDS

    @property
    def conditions(self) -> np.ndarray:
        """The Condition at each place, as a number, shape (count,)."""
        return self._progress[:, CONDITION]

    @property
    def runs(self) -> np.ndarray:
        """Whether the simulation at each place can continue, shape (count,)."""
        return self.conditions == RUNNING

    def place(self, i: int, simulation: Simulation) -> None:
        """Copy a simulation to a place; raises InputError unless it has the step of the fleet."""
        if simulation.step_ns != self.step_ns:
            allowed = f"{self.step_ns / NANOSECONDS:g} s, the step of the fleet"
            raise InputError("step", simulation.step_ns / NANOSECONDS, allowed)
        plant, memory = simulation.arrays()
        of_fleet = (*self._plant[:-1], self.states, self.outputs, self.events, self._stages)
        for kept, given in zip(of_fleet, (*plant, *memory), strict=True):
            kept[i] = given if kept is self._stages else given[0]
        self._grounds[i] = simulation.ground
        self._place_actuators(i, simulation.actuation)
        self.sensors[i] = simulation.sensors.copy() if simulation.has_sensors else None
        self._sensing = [k for k, each in enumerate(self.sensors) if each]
        self._progress[i] = simulation.time_ns, simulation.condition
        self._arguments = ()

    def _place_actuators(self, i: int, given: Actuation) -> None:
        """Copy actuators, with room for the longest memory of all places."""
        missing = len(given.memory) - self._acting.shape[1]
        if missing > 0:
            self._acting = np.pad(self._acting, ((0, 0), (0, missing)))
        self._actuators[i] = given.actuators[0]
        self._acting[i, : len(given.memory)] = given.memory

    def step(self, commands: np.ndarray, steps: np.ndarray) -> None:
        """Advance each simulation until it must stop, at most by its number of steps.

        commands: COMMAND records, shape (count,), held meanwhile. steps: shape (count,), 0 for a
        place that does not move.
        """
        steps = np.where(self.runs, steps, 0)
        while self._sensing and steps.any():
            some = np.minimum(steps, self._steps_to_samples())
            self._move(commands, some)
            self._sample(some)
            steps = np.where(self.runs, steps - some, 0)
        self._move(commands, steps)

    def _steps_to_samples(self) -> np.ndarray:
        """Steps of each place until a sensor takes a sample, shape (count,)."""
        until = np.full(len(self), NEVER)
        for i in self._sensing:
            until[i] = self.sensors[i].until(int(self.times_ns[i]))
        return (until - self.times_ns) // self.step_ns

    def _sample(self, moved: np.ndarray) -> None:
        """Let sensors take their samples where steps were made, shape (count,)."""
        for i in self._sensing:
            if moved[i]:
                self.sensors[i].sample(int(self.times_ns[i]), self.states[i], self.outputs[i])

    def _move(self, commands: np.ndarray, steps: np.ndarray) -> None:
        """Advance as `step` does, without sensors."""
        held = kernel_argument(np.ascontiguousarray(commands))
        arguments = (*self._as_arguments(), held, steps, self.step_ns, self._progress)
        ranges = itertools.pairwise(self._bounds)
        if self._pool is None:
            _step_some(arguments, *next(ranges))
            return
        for done in [self._pool.submit(_step_some, arguments, *each) for each in ranges]:
            done.result()

    def _as_arguments(self) -> tuple:
        """Address, memory, plants and actuators in the form in which `step_each` takes them."""
        if not self._arguments:
            outputs, events = kernel_argument(self.outputs), kernel_argument(self.events)
            memory = (self.state_vectors, outputs, events, self._stages)
            plants = (*map(kernel_argument, self._plant), *joined(self._grounds))
            numbers = self._acting.view(np.float64).reshape(*self._acting.shape, COMMAND_SIZE)
            actuation = (kernel_argument(self._actuators), self._acting, numbers)
            self._arguments = (address_of_advance(), memory, plants, actuation)
        return self._arguments

    def close(self) -> None:
        """End the threads."""
        if self._pool is not None:
            self._pool.shutdown()


def joined(arrays: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Flat arrays as one, and where each begins and ends in it, shape (n, 2); equal ones once."""
    places, parts, end = {}, [], 0
    for array in arrays:
        if (content := array.tobytes()) not in places:
            places[content] = end, end + len(array)
            parts.append(array)
            end += len(array)
    return np.concatenate(parts), np.array([places[array.tobytes()] for array in arrays])


def _step_some(arguments: tuple, first: int, last: int) -> None:
    """Step the simulations from `first` to before `last`, in this thread."""
    with silently():  # divergence is detected from the result
        interruptible(step_each, (*arguments, first, last))
