"""The least-squares problem: what the logs have, less what the model does, over its spread."""

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from vehicle_roll_sim.comparison.driving import Driving
from vehicle_roll_sim.comparison.fleet_driving import drive_all
from vehicle_roll_sim.identification.free import applied
from vehicle_roll_sim.identification.free_value import Free
from vehicle_roll_sim.identification.sensors import Sensors
from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.log import Log
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.plausibility import unwarned

STEP = 1e-3
"""Of the scale of a value: for finite differences. A wheel that lands makes the response uneven on
the scale of 1e-5, where the landing passes from one step of the integration to the next."""
Signals = list[dict[str, np.ndarray]]
"""What the model does in each log: quantities at its times, (n,) each."""


@dataclasses.dataclass(frozen=True)
class Prior:
    """What is known of a value beforehand: mean and standard deviation, in its unit."""

    mean: float
    deviation: float


class Problem:
    """Residuals and their derivatives at scaled values: value over `Free.scale`.

    logs: of all manoeuvres. simulation: model, road and step to use, with the vehicle to start
    from. priors: by name. workers: threads of the batch. spreads: standard deviation of each
    compared quantity of each log, by which its residuals are divided; the caller sets them.
    """

    def __init__(
        self,
        logs: Sequence[Log],
        simulation: Simulation,
        free: Sequence[Free],
        driving: Driving,
        priors: Mapping[str, Prior],
        workers: int | None = None,
    ):
        self.logs, self.free, self.driving, self.priors = list(logs), list(free), driving, priors
        self.simulation, self.workers = simulation, workers
        self.scales = np.array([each.scale for each in free])
        self.runs = 0
        self.spreads = [dict.fromkeys(log.compared, 1.0) for log in self.logs]
        self._dynamic = [not each.is_reading for each in free]
        self._kept: dict[bytes, Signals] = {}

    @property
    def start(self) -> np.ndarray:
        """Scaled values to start from, (p,)."""
        return np.array([each.start for each in self.free]) / self.scales

    @property
    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Scaled bounds, (p,) each."""
        lower, upper = ([getattr(f, side) for f in self.free] for side in ("lower", "upper"))
        return np.array(lower) / self.scales, np.array(upper) / self.scales

    def values(self, scaled: np.ndarray) -> dict[str, float]:
        """Values by name, in their units."""
        found = (scaled * self.scales).tolist()
        return {each.name: value for each, value in zip(self.free, found, strict=True)}

    def sensors(self, scaled: np.ndarray) -> Sensors:
        """The sensors at these values."""
        values = self.values(scaled)
        read = {each.name: values[each.name] for each in self.free if each.is_reading}
        return Sensors(read)

    def residuals(self, scaled: np.ndarray) -> np.ndarray:
        """All residuals over their spreads, then those of the priors; inf where no vehicle fits."""
        try:
            signals = self._signals(scaled)
        except InputError:
            return np.full(self.count, np.inf)
        return np.concatenate((*self._rows(signals, scaled), self._of_priors(scaled)))

    def check(self, scaled: np.ndarray) -> None:
        """Raise InputError if the model cannot be driven at these values."""
        self._signals(scaled)

    @property
    def count(self) -> int:
        """How many residuals there are."""
        return self.rows + len(self._given())

    @property
    def rows(self) -> int:
        """How many residuals there are without those of the priors."""
        return sum(len(log.time) * len(log.compared) for log in self.logs)

    def jacobian(self, scaled: np.ndarray, is_central: bool = False) -> np.ndarray:
        """Derivatives of the residuals by the scaled values, shape (residuals, p).

        is_central: differences to both sides, where the bounds leave room for them.
        """
        back, ahead = self._steps(scaled)
        behind = self._rows_at(scaled, back) if is_central else self._rows_at(scaled, 0.0 * back)
        back = back if is_central else 0.0 * back
        columns = (self._rows_at(scaled, ahead) - behind).T / (ahead - back)
        slopes = np.zeros((len(self._given()), len(scaled)))
        for row, (j, name, scale) in enumerate(self._given()):
            slopes[row, j] = scale / self.priors[name].deviation
        return np.vstack((columns, slopes))

    def _steps(self, scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Changes of each value for differences, back and ahead, (p,) each; ahead is not 0.

        At an upper bound, ahead is back.
        """
        lower, upper = self.bounds
        back = np.maximum(scaled - STEP, lower) - scaled
        ahead = np.minimum(scaled + STEP, upper) - scaled
        is_stuck = scaled + STEP > upper
        return np.where(is_stuck, 0.0, back), np.where(is_stuck, -STEP, ahead)

    def _rows_at(self, scaled: np.ndarray, steps: np.ndarray) -> np.ndarray:
        """Residuals without priors with each value alone changed by its step, shape (p, n)."""
        points = [scaled + each for each in np.diag(steps)]
        return np.array(
            [
                np.concatenate(self._rows(s, at))
                for s, at in zip(self._signals_of(points), points, strict=True)
            ]
        )

    def errors(self, scaled: np.ndarray) -> list[dict[str, np.ndarray]]:
        """Simulated less measured signals of each log, in SI units, (n,) each."""
        signals, sensors = self._signals(scaled), self.sensors(scaled)
        return [
            {
                name: sensors.reading(name, true[name], log) - log.signals[name]
                for name in log.compared
            }
            for log, true in zip(self.logs, signals, strict=True)
        ]

    def _given(self) -> list[tuple[int, str, float]]:
        """Place, name and scale of the values that have a prior."""
        all_ = enumerate(self.free)
        return [(j, each.name, each.scale) for j, each in all_ if each.name in self.priors]

    def _of_priors(self, scaled: np.ndarray) -> np.ndarray:
        found = [
            (scaled[j] * scale - self.priors[name].mean) / self.priors[name].deviation
            for j, name, scale in self._given()
        ]
        return np.array(found)

    def _rows(self, signals: Signals, scaled: np.ndarray) -> list[np.ndarray]:
        """Residuals of each quantity of each log over their spreads."""
        sensors = self.sensors(scaled)
        return [
            (sensors.reading(name, true[name], log) - log.signals[name]) / spread[name]
            for log, true, spread in zip(self.logs, signals, self.spreads, strict=True)
            for name in log.compared
        ]

    def _signals(self, scaled: np.ndarray) -> Signals:
        """What the model does at these values.

        The runs for the derivatives, which usually follow, are made together with this one.
        """
        if self._key(scaled) not in self._kept:
            self._kept = {}
            ahead = np.diag(self._steps(scaled)[1])
            self._signals_of([scaled, *(scaled + each for each in ahead)])
        return self._kept[self._key(scaled)]

    def _signals_of(self, points: Sequence[np.ndarray]) -> list[Signals]:
        """What the models of some scaled values do; what is not known yet is driven together."""
        new = {self._key(p): p for p in points if self._key(p) not in self._kept}
        self._kept |= zip(new, self._simulated(list(new.values())), strict=True)
        return [self._kept[self._key(p)] for p in points]

    def _key(self, scaled: np.ndarray) -> bytes:
        """Equal for scaled values with which the model does the same."""
        return np.where(self._dynamic, scaled, 0.0).tobytes()

    def _simulated(self, points: Sequence[np.ndarray]) -> list[Signals]:
        """What the models of some scaled values do, all driven together."""
        if not points:
            return []
        return self._driven([(scaled, self.logs) for scaled in points])

    def _driven(self, cases: Sequence[tuple[np.ndarray, list[Log]]]) -> list[Signals]:
        """What models do, all driven together. cases: scaled values, and logs that drive them."""
        pairs = []
        for scaled, logs in cases:
            with unwarned():
                vehicle, sensors = applied(self.simulation.vehicle, self.values(scaled))
                model = self.like(vehicle)
            pairs += [(sensors.driving(log), model) for log in logs]
        self.runs += len(pairs)
        driven = iter(drive_all(pairs, self.driving, self.workers))
        return [[_whole(next(driven).signals, len(log.time)) for log in logs] for _, logs in cases]

    def rows_with(self, logs: Sequence[list[Log]], scaled: np.ndarray) -> list[np.ndarray]:
        """Residuals without priors if the models are driven by other logs, (n,) for each set."""
        found = self._driven([(scaled, each) for each in logs])
        return [np.concatenate(self._rows(signals, scaled)) for signals in found]

    def like(self, vehicle) -> Simulation:
        """A simulation of another vehicle."""
        given = self.simulation
        return Simulation(
            vehicle,
            given.options,
            step=given.step_ns * 1e-9,
            rollover_angle=given.rollover_angle,
            road=given.road,
            check_step=False,
        )


def _whole(signals: dict[str, np.ndarray], count: int) -> dict[str, np.ndarray]:
    """Signals of a model that stopped early, as in a rollover, with their last values held."""
    return {name: np.pad(each, (0, count - len(each)), "edge") for name, each in signals.items()}
