"""The largest step: what Runge-Kutta bears of the quickest mode of the model about a state.

The modes are the eigenvalues of the slopes of the model's own rates, so that they have all that the
model has: wheels on their springs, spin against the slip of the tires, their lag, coupled. One that
decays must not grow in the integration.
"""

import dataclasses
import math
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.compiled.jit import kernel_argument, silently
from vehicle_roll_sim.model.integration.advance import advance
from vehicle_roll_sim.model.integration.events import LIMITS, Condition, no_events
from vehicle_roll_sim.model.integration.integrator import K1, STAGE_VECTORS
from vehicle_roll_sim.model.records import OUTPUTS, STATE_NAMES, STATE_SIZE, U
from vehicle_roll_sim.simulation.command import NO_FORCE, Command
from vehicle_roll_sim.simulation.plant import Plant

DIFFERENCE = 1e-6
"""Change of a state for its slopes, relative to its size where that is above 1 (SI units): small
beside what bends them, and 1e-9 of the rates is rounding."""
ROUNDING = 1e-9
"""By which a mode that stays as it is may seem to grow in a step."""
NEAREST, FURTHEST = 2.61, 2.97
"""Between these lies, in any direction of the left half plane, the end of the stable products of
pole and step: 2.79 for a mode without frequency, 2.83 for one without damping."""
HALVINGS = 20
"""Of that interval: the largest step to within 1e-6 of it."""


class Modes:
    """The model of one vehicle about any of its states.

    places: of the model's states among STATE_NAMES.

    Dry friction, of brakes and rolling resistance, is left out: it has no slope but where it holds
    a wheel, and that is slower than one that has just been let go.
    """

    def __init__(self, plant: Plant, places: np.ndarray):
        vehicle, limits = plant.vehicle.copy(), np.full(1, -math.inf, LIMITS)
        vehicle["rolling_resistance_coefficient"] = 0.0
        limits["rollover_angle"], limits["largest"] = math.inf, math.nan
        limits["largest"][0, places] = math.inf
        self._plant, self._limits, self._places = plant._replace(vehicle=vehicle), limits, places
        self._outputs, self._events = np.full(1, np.nan, OUTPUTS), no_events()
        self._stages = np.zeros((STAGE_VECTORS, STATE_SIZE))

    def slopes(self, state: np.ndarray, command: Command) -> tuple[np.ndarray, np.ndarray]:
        """Rates of the model's states at a flat state vector, and their slopes, shape (n, n).

        nan where a rate is not finite, and in all its slopes.
        """
        rates = self._rates_under(command)
        columns = []
        for place in self._places:
            back, ahead = state.copy(), state.copy()
            size = DIFFERENCE * max(1.0, abs(state[place]))
            back[place] -= size
            ahead[place] += size
            columns.append((rates(ahead) - rates(back)) / (ahead[place] - back[place]))
        return rates(state), np.array(columns).T

    def _rates_under(self, command: Command) -> Callable[[np.ndarray], np.ndarray]:
        records = dataclasses.replace(command, brake_torque=NO_FORCE).records()
        plant = self._plant.arguments(self._limits, records)
        outputs, events = kernel_argument(self._outputs), kernel_argument(self._events)

        def rates(state: np.ndarray) -> np.ndarray:
            with silently():
                _, condition, culprit = advance(
                    *(state, records, 0, 0, 1, plant, outputs, events, self._stages)
                )
            found = self._stages[K1, self._places]
            if condition == Condition.DIVERGED:
                found[self._places == culprit] = math.nan
            return found

        return rates

    def largest_step(self, state: np.ndarray, command: Command, most: float) -> float:
        """Largest stable step (s) up to `most`; nan where the slopes are not finite."""
        _, slopes = self.slopes(state, command)
        finite = np.isfinite(slopes).all()
        return largest_stable_step(np.linalg.eigvals(slopes), most) if finite else math.nan

    def check_start(self, state: np.ndarray, step: float) -> None:
        """Raise InputError if a run cannot begin at a state: with this step (s), or at all."""
        rates, slopes = self.slopes(state, Command())
        speed = state[U]
        if not np.isfinite(rates).all():
            name = STATE_NAMES[self._places[np.argmin(np.isfinite(rates))]]
            problem = f"straight ahead at {speed:.4g} m/s the rate of {name} is not finite"
            raise InputError("vehicle", "", "another tire or other values", problem)
        if not np.isfinite(slopes).all():
            return
        largest = largest_stable_step(np.linalg.eigvals(slopes), step)
        if largest < step:
            allowed = f"at most {_rounded_down(largest):g} s at {speed:.4g} m/s with this vehicle"
            raise InputError("step", step, allowed)


def growth(exponents: np.ndarray) -> float:
    """The most by which a step of Runge-Kutta multiplies a mode, given products of pole and step.

    The stability polynomial of the fourth order: the exponential's series up to there.
    """
    z = exponents
    return float(np.abs(1 + z * (1 + z / 2 * (1 + z / 3 * (1 + z / 4)))).max())


def largest_stable_step(poles: np.ndarray, most: float) -> float:
    """Largest step (s), up to `most`, in which no mode grows; poles in 1/s.

    A mode that grows by itself may do so: of it only the frequency counts.
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


def _rounded_down(value: float) -> float:
    """To two digits."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.floor(value / unit) * unit
