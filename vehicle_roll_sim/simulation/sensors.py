"""The sensors of a vehicle: devices that take samples in their own periods, and their memory.

The random numbers of a sample are a function of the seed, the device and the number of the sample,
so that they depend neither on other devices nor on who asks.
"""

import copy
import itertools
import math

import numpy as np

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.sensors import make_normal, measure
from vehicle_roll_sim.simulation.sensing import KINDS
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.sensor_parameters import (
    DEFAULT_PERIOD,
    DEVICES,
    QUANTITIES,
    Quantity,
    devices_of,
    labels_of,
    seed_of,
)

WHOLE = 1e-6
"""Share of a unit by which a time may differ from a multiple of it."""
BLOCK = 64
"""Samples whose random numbers are made at once."""
WORDS = 4
"""Random words that a step of the counter gives."""
NEVER = 2**62
"""ns"""
NOTHING = np.zeros(0)


class Device:
    """One device: its errors, its clock, and what it has read so far.

    name: of DEVICES. axis_depth: of the roll axis in the 8 DOF model (m), else None. memory: an
    array of one record: seed, number of samples taken, time (ns) at which the last reading arrived,
    walks of the biases, that reading, and the readings that are still under way. Raises InputError
    for a period that is not a multiple of the step (ns), and a delay that is not one of the period.
    """

    def __init__(self, name: str, vehicle: Vehicle, step_ns: int, axis_depth: float | None):
        self._number = list(DEVICES).index(name)
        self._kind = KINDS[name](vehicle, axis_depth)
        quantities = {n: each for n, each in QUANTITIES.items() if each.device == name}
        period, delay = f"{name}_period", f"{name}_delay"
        self.period_ns = step_ns * _whole(vehicle, period, DEFAULT_PERIOD, step_ns, "the step")
        self._delay = _whole(vehicle, delay, 0.0, self.period_ns, period)
        self._dropout = vehicle.given.get(f"{name}_dropout", 0.0)
        interval = self.period_ns / NANOSECONDS
        self._errors = np.hstack([_errors(vehicle, each, interval) for each in quantities.values()])
        self._errors = np.ascontiguousarray(self._errors)
        self.labels = labels_of(quantities)
        self.places = _places({name: len(each.values) for name, each in quantities.items()})
        self._channels = _places({name: len(each.errors) for name, each in quantities.items()})
        channels, values = self._errors.shape[1], len(self.labels)
        self.memory = np.zeros(
            1,
            [
                ("seed", np.uint64),
                ("count", np.int64),
                ("arrived_ns", np.int64),
                ("walk", float, channels),
                ("reading", float, values),
                ("queue", float, (1 + self._delay, values)),
            ],
        )
        self._block = (-1, -1)
        self._normal, self._chances = np.zeros((BLOCK, channels, 2)), np.zeros(BLOCK)

    @property
    def described(self) -> np.ndarray:
        """All numbers on which the readings depend, besides the seed."""
        clock = (self._number, self.period_ns, self._delay, self._dropout)
        return np.concatenate((clock, self._errors.ravel(), self._kind.described))

    @property
    def reading(self) -> np.ndarray:
        """The last reading that has arrived, as `labels` name it (a view)."""
        return self.memory["reading"][0]

    @property
    def arrived_ns(self) -> int:
        """The simulated time at which it arrived (ns)."""
        return int(self.memory["arrived_ns"][0])

    def rest(self, seed: int) -> None:
        """Forget everything."""
        self.memory[:] = 0
        self.memory["seed"] = seed

    def sample(self, time_ns: int, state, outputs) -> None:
        """Take a sample at a time (ns), of a STATE and an OUTPUTS record, unless it is taken."""
        if time_ns % self.period_ns or time_ns < self.memory["count"][0] * self.period_ns:
            return
        number = time_ns // self.period_ns
        normal, chance = self._random(number)
        walk, queue = self.memory["walk"][0], self.memory["queue"][0]

        def erring(truth: np.ndarray) -> np.ndarray:
            measured = np.empty(len(truth))
            measure(truth, normal, self._errors, walk, measured)
            return measured

        queue[number % len(queue)] = self._kind.sense(state, outputs, erring)
        arrives = number >= self._delay and chance >= self._dropout
        if arrives or number == 0:
            self.memory["reading"][0] = queue[max(number - self._delay, 0) % len(queue)]
            self.memory["arrived_ns"] = time_ns
        self.memory["count"] = number + 1

    def _random(self, number: int) -> tuple[np.ndarray, float]:
        """Standard normal numbers of a sample, shape (n, 2), and a uniform one."""
        block = (int(self.memory["seed"][0]), number // BLOCK)
        if block != self._block:
            self._block = block
            self._fill(*block)
        return self._normal[number % BLOCK], float(self._chances[number % BLOCK])

    def _fill(self, seed: int, block: int) -> None:
        """Make the random numbers of a block of samples: Philox 4x64, Salmon et al. (2011)."""
        numbers = self._normal[0].size
        steps = math.ceil((numbers + 1) / WORDS)
        key, start = [seed, self._number], [block * BLOCK * steps, 0, 0, 0]
        generator = np.random.Philox(
            key=np.array(key, np.uint64), counter=np.array(start, np.uint64)
        )
        words = generator.random_raw(BLOCK * steps * WORDS).reshape(BLOCK, -1)
        uniform = ((words >> np.uint64(12)).astype(float) + 0.5) / 2.0**52
        self._normal[:] = uniform[:, :numbers].reshape(self._normal.shape)
        self._chances[:] = uniform[:, numbers]
        make_normal(self._normal.reshape(-1, 2))

    def variance(self, quantity: str) -> float:
        """Of one component of a quantity, in the square of its unit: that of noise and rounding."""
        channel = self._channels[quantity].start
        noise, resolution = self._errors[2, channel], self._errors[4, channel]
        return float(noise**2 + resolution**2 / 12)


class Sensors:
    """All sensors of one simulation. `sensors["gyro"]` is the last reading of a quantity.

    vehicle, step_ns: the vehicle and the integration step (ns). axis_depth: as for Device. devices:
    those that the vehicle has, by name. Raises the InputErrors of Device.
    """

    def __init__(self, vehicle: Vehicle, step_ns: int, axis_depth: float | None):
        self.devices = {
            name: Device(name, vehicle, step_ns, axis_depth) for name in devices_of(vehicle)
        }
        self.is_present = bool(self.devices)
        self.seed = seed_of(vehicle)
        self.labels = tuple(label for each in self.devices.values() for label in each.labels)

    def __contains__(self, quantity: str) -> bool:
        return QUANTITIES[quantity].device in self.devices

    def __getitem__(self, quantity: str) -> np.ndarray:
        device = self.devices[QUANTITIES[quantity].device]
        return device.reading[device.places[quantity]].copy()

    @property
    def memory(self) -> tuple[np.ndarray, ...]:
        """The memory of each device."""
        return tuple(each.memory for each in self.devices.values())

    @property
    def described(self) -> tuple[np.ndarray, ...]:
        """What the readings depend on, besides the seed."""
        return tuple(each.described for each in self.devices.values())

    def variance(self, quantity: str) -> float:
        """That of noise and rounding of a component, in the square of the quantity's unit."""
        return self.devices[QUANTITIES[quantity].device].variance(quantity)

    def readings(self) -> np.ndarray:
        """The last readings of all devices, as `labels` name them."""
        if not self.devices:
            return NOTHING
        return np.concatenate([each.reading for each in self.devices.values()])

    def rest(self, seed: int | None = None) -> None:
        """Forget everything. seed: of all noise, by default that of the vehicle."""
        for each in self.devices.values():
            each.rest(self.seed if seed is None else seed)

    def until(self, time_ns: int) -> int:
        """The time (ns) of the first sample after a time (ns)."""
        periods = (each.period_ns for each in self.devices.values())
        return min(((time_ns // period + 1) * period for period in periods), default=NEVER)

    def sample(self, time_ns: int, state, outputs) -> None:
        """Let the devices take a sample whose clocks say so at a time (ns).

        state, outputs: STATE and OUTPUTS records at that time.
        """
        for each in self.devices.values():
            each.sample(time_ns, state, outputs)

    def copy(self) -> "Sensors":
        """Sensors that continue like these, independently of them."""
        return copy.deepcopy(self)


def _places(sizes: dict[str, int]) -> dict[str, slice]:
    """Where parts of these sizes lie, one after the other."""
    ends = np.cumsum([0, *sizes.values()]).tolist()
    return dict(zip(sizes, itertools.starmap(slice, itertools.pairwise(ends)), strict=True))


def _errors(vehicle: Vehicle, quantity: Quantity, interval: float) -> np.ndarray:
    """Errors of the components of a quantity as `measure` takes them; interval: of samples (s)."""

    def of(measure: str) -> float:
        return vehicle.given.get(f"{quantity.prefix}_{measure}", 0.0)

    errors = np.zeros((5, len(quantity.errors)))
    errors[0] = 1.0 + of("scale_error")
    errors[1] = [of(f"bias{ending}") for ending in quantity.biases] or 0.0
    errors[2] = of("noise_density") / math.sqrt(interval)
    errors[3] = of("bias_walk") * math.sqrt(interval)
    errors[4] = of("resolution")
    return errors


def _whole(vehicle: Vehicle, name: str, usual: float, unit_ns: int, unit: str) -> int:
    """A time of a device (s) in multiples of a unit (ns); raises InputError unless it is one."""
    time = vehicle.given.get(name, usual)
    count = time * NANOSECONDS / unit_ns
    if abs(count - round(count)) > WHOLE:
        allowed = f"a multiple of {unit}, {unit_ns / NANOSECONDS:g} s"
        raise InputError(vehicle.stated_at.get(name, name), time, allowed)
    return round(count)
