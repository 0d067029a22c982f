"""The largest stable step: limited by Runge-Kutta's stability for the fastest mode about a state.

The modes are the eigenvalues of the numerical Jacobian of the model, so they include everything in
it, coupled: wheel hop, wheel spin against tire slip, and tire lag. The condition is that no
decaying mode grows in the integration.
"""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.compiled.jit import kernel_argument, silently
from vehicle_roll_sim.model.integration.events import LIMITS, no_events
from vehicle_roll_sim.model.integration.integrator import STAGE_VECTORS
from vehicle_roll_sim.model.integration.rates_of import rates_of
from vehicle_roll_sim.model.records import OUTPUTS, STATE_NAMES, STATE_SIZE, U
from vehicle_roll_sim.simulation.advance_address import address_of_advance
from vehicle_roll_sim.simulation.command import IDLE, NO_FORCE, Command
from vehicle_roll_sim.simulation.plant import Plant

DIFFERENCE = 1e-6
"""Finite-difference step of a state, relative to its magnitude if that exceeds 1 (SI units).

Small enough for the nonlinearities; the rounding error is about 1e-9 of the rates.
"""
ROUNDING = 1e-9
"""Tolerance on the growth of a mode per step."""
NEAREST, FURTHEST = 2.61, 2.97
"""Bounds on the modulus of pole times step at the stability limit, in any direction of the left
half plane; it is 2.79 for a mode that does not oscillate and 2.83 for an undamped one."""
HALVINGS = 20
"""Bisections of that interval: they give the largest step to within 1e-6 of it."""


class Modes:
    """Linearization of the model of one vehicle about any of its states.

    places: indices of the model's states among STATE_NAMES.

    The dry friction of brakes and rolling resistance is omitted: its derivative is zero except
    where it holds a wheel, and a held wheel has slower modes than a wheel just released.
    """

    def __init__(self, plant: Plant, places: np.ndarray):
        vehicle, limits = plant.vehicle.copy(), np.full(1, -math.inf, LIMITS)
        vehicle["rolling_resistance_coefficient"] = 0.0
        limits["rollover_angle"] = limits["stop_angle"] = math.inf
        limits["largest"] = math.nan
        limits["largest"][0, places] = math.inf
        self._plant, self._limits, self._places = plant._replace(vehicle=vehicle), limits, places
        self._outputs, self._events = np.full(1, np.nan, OUTPUTS), no_events()
        self._stages = np.zeros((STAGE_VECTORS, STATE_SIZE))

    def slopes(self, state: np.ndarray, command: Command) -> tuple[np.ndarray, np.ndarray]:
        """Rates of the model's states at a flat state vector, shape (n,), and the Jacobian (n, n).

        nan where a rate is not finite, and in its row of the Jacobian.
        """
        count = len(self._places)
        sizes = DIFFERENCE * np.maximum(1.0, np.abs(state[self._places]))
        states = np.repeat(state[np.newaxis], 2 * count + 1, axis=0)
        ahead, back = states[:-1:2], states[1::2]
        ahead[np.arange(count), self._places] += sizes
        back[np.arange(count), self._places] -= sizes
        widths = (ahead - back)[np.arange(count), self._places]
        rates = self._rates(states, command)
        return rates[-1], ((rates[:-1:2] - rates[1::2]) / widths[:, np.newaxis]).T

    def _rates(self, states: np.ndarray, command: Command) -> np.ndarray:
        """Rates of the model's states at state vectors, shape (k, n); nan if one is not finite."""
        if command.brake_torque != NO_FORCE:
            command = dataclasses.replace(command, brake_torque=NO_FORCE)
        records = command.records()
        plant = self._plant.arguments(self._limits, records)
        outputs, events = kernel_argument(self._outputs), kernel_argument(self._events)
        rates, culprits = np.empty(states.shape), np.empty(len(states), np.int64)
        about = (kernel_argument(records), plant, outputs, events, self._stages)
        with silently():
            rates_of(address_of_advance(), states, *about, rates, culprits)
        bad = np.flatnonzero(culprits >= 0)
        rates[bad, culprits[bad]] = math.nan
        return rates[:, self._places]

    def largest_step(self, state: np.ndarray, command: Command, most: float) -> float:
        """Largest stable step (s), up to `most` (s); nan if the Jacobian is not finite."""
        _, slopes = self.slopes(state, command)
        finite = np.isfinite(slopes).all()
        return largest_stable_step(np.linalg.eigvals(slopes), most) if finite else math.nan

    def check_start(self, state: np.ndarray, step: float) -> None:
        """Raise InputError if a run cannot start at a state, with this step (s) or at all."""
        rates, slopes = self.slopes(state, IDLE)
        speed = state[U]
        if not np.isfinite(rates).all():
            name = STATE_NAMES[self._places[np.argmin(np.isfinite(rates))]]
            problem = f"straight ahead at {speed:.4g} m/s the rate of {name} is not finite"
            raise InputError("vehicle", "", "a different tire or different values", problem)
        if not np.isfinite(slopes).all():
            return
        largest = largest_stable_step(np.linalg.eigvals(slopes), step)
        if largest < step:
            allowed = f"at most {rounded_down(largest):g} s at {speed:.4g} m/s with this vehicle"
            raise InputError("step", step, allowed)


def growth(exponents: np.ndarray) -> float:
    """Largest amplification of a mode in one Runge-Kutta step.

    exponents: products of pole and step, shape (n,). The amplification is the modulus of the
    stability polynomial, the Taylor series of the exponential up to fourth order.
    """
    z = exponents
    return float(np.abs(1 + z * (1 + z / 2 * (1 + z / 3 * (1 + z / 4)))).max())


def largest_stable_step(poles: np.ndarray, most: float) -> float:
    """Largest step (s), up to `most` (s), in which no mode grows; poles: shape (n,) (1/s).

    The real part of an unstable mode is ignored; only its frequency limits the step.
    """
    calm = np.minimum(poles.real, 0.0) + 1j * poles.imag
    if growth(calm * most) <= 1 + ROUNDING:
        return most
    quickest = float(np.abs(calm).max())
    stable, unstable = NEAREST / quickest, min(most, FURTHEST / quickest)
    for _ in range(HALVINGS):
        middle = (stable + unstable) / 2
        if growth(calm * middle) <= 1 + ROUNDING:
            stable = middle
        else:
            unstable = middle
    return stable


def rounded_down(value: float) -> float:
    """`value` rounded down to two significant digits."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.floor(value / unit) * unit
