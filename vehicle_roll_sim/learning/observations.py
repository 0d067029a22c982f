"""What an agent may observe: states, outputs, and what the node publishes of them, by name."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.batch.fleet import Fleet
from vehicle_roll_sim.learning.names import names_of
from vehicle_roll_sim.live.command_limits import LARGEST_LIMIT
from vehicle_roll_sim.manoeuvres.base import LONGEST
from vehicle_roll_sim.model.integration.events import plausible_magnitudes
from vehicle_roll_sim.model.records import STATE, WHEELS
from vehicle_roll_sim.runs.columns import ACCELERATIONS, MEASURED, OUTPUT_QUANTITIES
from vehicle_roll_sim.runs.metrics import load_transfer_ratio, sideslip_angle
from vehicle_roll_sim.simulation.signals import OUTPUT_SIGNALS, STATE_SIGNALS, Signal
from vehicle_roll_sim.vehicle.sensor_parameters import QUANTITIES, Quantity

LARGEST = {
    "s": LONGEST,
    "N": LARGEST_LIMIT,
    "": 1e3,
    "rad": np.pi,
    "m/s^2": 1e4,
    "m": 1e12,
    "m/s": 1e3,
    "rad/s": 1e6,
}
"""Bound of an output by its unit. A bound is never reached in plausible runs."""


class Observation(NamedTuple):
    """An observation: where it comes from, and what it is.

    of: the values of all places of a fleet, shape (n,) or (n, k). bound: magnitude to which values
    are clamped. size: number of values of one place. signal: unit and meaning. parts: names of the
    values if there are several.
    """

    of: Callable[[Fleet], np.ndarray]
    bound: float
    size: int
    signal: Signal
    parts: tuple[str, ...] = WHEELS


def _observations() -> dict[str, Observation]:
    bounds = plausible_magnitudes()[0]
    found = {
        name: Observation(
            lambda fleet, name=name: fleet.states[name],
            float(np.max(bounds[name])),
            STATE[name].shape[0] if STATE[name].shape else 1,
            signal,
        )
        for name, signal in STATE_SIGNALS.items()
    }
    for name in OUTPUT_QUANTITIES:
        found[name] = _output(OUTPUT_SIGNALS[name], lambda fleet, name=name: fleet.outputs[name], 4)
    for axis, name in enumerate(ACCELERATIONS):
        meaning = f"acceleration of the sprung c.g., {('forward', 'to the left')[axis]}"
        found[name] = _output(
            OUTPUT_SIGNALS["acceleration"]._replace(meaning=meaning),
            lambda fleet, axis=axis: fleet.outputs["acceleration"][:, axis],
        )
    found["steering"] = _output(
        OUTPUT_SIGNALS["commanded_steering"]._replace(meaning="steering command, front"),
        lambda fleet: fleet.outputs["commanded_steering"][:, 0],
    )
    return found | {
        "lift_off": Observation(
            _lift_off, 1.0, len(WHEELS), Signal("", "", "1 for a tire without load, else 0")
        ),
        "load_transfer_ratio": Observation(
            lambda fleet: load_transfer_ratio(fleet.outputs["normal_force"]),
            1.0,
            1,
            Signal("", "", "(right - left) / total normal load, 0 when no tire carries load"),
        ),
        "sideslip_angle": _output(
            Signal("rad", "", "from the heading to the velocity over ground; 0 at standstill"),
            _sideslip,
        ),
        "time": _output(Signal("s", "", "since the beginning of the episode"), lambda f: f.times),
        **{MEASURED + name: _measured(name, each) for name, each in QUANTITIES.items()},
    }


def _measured(name: str, quantity: Quantity) -> Observation:
    """The last reading of a quantity; nan at places whose vehicle has no sensor of it."""
    unknown = np.full(len(quantity.values), np.nan)

    def of(fleet: Fleet) -> np.ndarray:
        at_places = [each[name] if each and name in each else unknown for each in fleet.sensors]
        return np.array(at_places)

    unit = "" if quantity.is_orientation else quantity.unit
    bound = 1.0 if quantity.is_orientation else LARGEST[unit]
    meaning = f"{quantity.what}, as the sensors of the vehicle say"
    return Observation(of, bound, len(unknown), Signal(unit, "", meaning), quantity.values)


def _output(signal: Signal, of: Callable[[Fleet], np.ndarray], size: int = 1) -> Observation:
    return Observation(of, LARGEST[signal.unit], size, signal)


def _lift_off(fleet: Fleet) -> np.ndarray:
    return (fleet.outputs["normal_force"] == 0.0).astype(np.float64)


def _sideslip(fleet: Fleet) -> np.ndarray:
    states = fleet.states
    velocity = (states["u"], states["v"], states["w"])
    return np.nan_to_num(sideslip_angle(velocity, states["roll"], states["pitch"]))


OBSERVATIONS = _observations()
"""All observations by name, in SI units and radians."""
USUAL = (
    *("roll", "roll_rate", "yaw_rate", "u", "v"),
    *("lateral_acceleration", "load_transfer_ratio", "steering"),
)
"""The observations of an environment that names none."""


class Signals(Mapping):
    """The observations of all places of a fleet: `signals["roll"]` has shape (n,)."""

    def __init__(self, fleet: Fleet):
        self._fleet = fleet

    def __getitem__(self, name: str) -> np.ndarray:
        return OBSERVATIONS[name].of(self._fleet)

    def __iter__(self):
        return iter(OBSERVATIONS)

    def __len__(self) -> int:
        return len(OBSERVATIONS)


class Observer:
    """Reads some observations of a fleet. names: of OBSERVATIONS; raises InputError.

    Attributes: `elements`, the name of each number; `bounds`, the magnitude to which each is
    clamped, shape (m,).
    """

    def __init__(self, names: Sequence[str]):
        self.names = names_of("observations", names, OBSERVATIONS)
        self.elements = tuple(
            f"{name}_{part}" if part else name
            for name in self.names
            for part in (OBSERVATIONS[name].parts if OBSERVATIONS[name].size > 1 else ("",))
        )
        sizes = [OBSERVATIONS[name].size for name in self.names]
        self.bounds = np.repeat([OBSERVATIONS[name].bound for name in self.names], sizes)

    def observe(self, fleet: Fleet) -> np.ndarray:
        """The numbers of all places, shape (n, m)."""
        columns = [OBSERVATIONS[name].of(fleet) for name in self.names]
        whole = np.concatenate([each.reshape(len(fleet), -1) for each in columns], axis=1)
        return np.clip(whole, -self.bounds, self.bounds)
