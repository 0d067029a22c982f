"""Least-squares values of a problem, with their uncertainty."""

import dataclasses
import functools
import math
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.identification import input_noise
from vehicle_roll_sim.identification.free_value import Free
from vehicle_roll_sim.identification.problem import Problem
from vehicle_roll_sim.identification.serial_covariance import Block
from vehicle_roll_sim.identification.uncertainty import Uncertainty, newton_step, uncertainty_of
from vehicle_roll_sim.input_errors import InputError

FIRST_SPREAD = 0.02
"""Of the peak of a signal: spread of its residuals in the first fit."""
LEAST_SPREAD = 1e-6
"""Of the peak: smallest spread, for logs without noise."""
LOOSE, TIGHT = 1e-3, 1e-5
"""Relative change of the sum of squares at which the first fit and the others end."""
SMALLEST_STEP = 1e-5
"""Relative change of the values at which a fit ends."""
MOST_WEIGHTINGS, SETTLED = 4, 0.1
"""Fits with spreads of the residuals, until these change by less."""
MOST_STEPS = 40
"""Evaluations of a fit."""
BESIDE, MOST_RESTARTS = 0.25, 2
"""Standard errors by which a fit may end beside the best values without beginning again from there;
0.25 add 3 % to the error."""


@dataclasses.dataclass(frozen=True)
class Estimate:
    """Values of a problem, by `problem.free`.

    scaled: values over their scales, (p,). cost: sum of squared residuals over their spreads.
    is_converged: whether the fit ended by itself. step: by which the derivatives say that the best
    scaled values are away from these, (p,): not 0 where wheels that land make the cost uneven.
    """

    problem: Problem
    scaled: np.ndarray
    uncertainty: Uncertainty
    cost: float
    is_converged: bool
    step: np.ndarray

    @property
    def free(self) -> list[Free]:
        """What was identified."""
        return self.problem.free

    @property
    def values(self) -> dict[str, float]:
        """Values by name, in their units."""
        return self.problem.values(self.scaled)

    @property
    def errors(self) -> dict[str, float]:
        """Standard errors by name, in units of the values."""
        found = self.uncertainty.errors * self.problem.scales
        return {each.name: float(error) for each, error in zip(self.free, found, strict=True)}

    @property
    def beside(self) -> float:
        """The largest step over its standard error (Bates and Watts, 1981, judge a fit so)."""
        errors = np.maximum(self.uncertainty.errors, np.finfo(float).tiny)
        return float(np.max(np.abs(self.step) / errors))

    @property
    def is_beside(self) -> bool:
        """Whether the fit may have ended beside the best values."""
        return not self.beside <= BESIDE

    @property
    def intervals(self) -> dict[str, tuple[float, float]]:
        """Intervals of 95 % by name."""
        factor, values = self.uncertainty.quantile, self.values
        return {
            name: (values[name] - factor * error, values[name] + factor * error)
            for name, error in self.errors.items()
        }

    @property
    def spreads(self) -> list[dict[str, float]]:
        """Root mean square of the residuals by quantity, of each log, in SI units."""
        errors = self.problem.errors(self.scaled)
        return [{name: _rms(each) for name, each in of_log.items()} for of_log in errors]


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def estimated(problem: Problem, progress: Callable[[int], None] = lambda runs: None) -> Estimate:
    """Fit with spreads in proportion to the peaks, then with those of the residuals.

    In the first fit, large residuals count less (soft_l1): a model that at first rolls over in one
    manoeuvre is brought near by the others.

    progress: called with the number of runs so far. Raises InputError if the model cannot be
    simulated at the start.
    """
    _check_start(problem)
    problem.spreads = [
        {name: _least(log.signals[name], FIRST_SPREAD) for name in log.compared}
        for log in problem.logs
    ]
    scaled, cost, is_converged = _fit(problem, problem.start, LOOSE, progress, "soft_l1")
    for _ in range(MOST_WEIGHTINGS):
        if _respread(problem, scaled) < SETTLED:
            break
        scaled, cost, is_converged = fitted(problem, scaled, progress)
    best = _estimate(problem, scaled, cost, is_converged)
    for _ in range(MOST_RESTARTS):
        start = best.scaled + best.step
        if not best.is_beside or not np.isfinite(problem.residuals(start)).all():
            break
        scaled, cost, is_converged = fitted(problem, start, progress)
        if not cost < best.cost:
            break
        best = _estimate(problem, scaled, cost, is_converged)
    progress(problem.runs)
    return best


def _estimate(problem: Problem, scaled: np.ndarray, cost: float, is_converged: bool) -> Estimate:
    """The values at which a fit ended, with their uncertainty."""
    residuals, slopes = problem.residuals(scaled), problem.jacobian(scaled, is_central=True)
    uncertainty = uncertainty_of(*_blocks(problem, scaled, residuals, slopes))
    step = _step_within(problem, scaled, residuals, slopes)
    return Estimate(problem, scaled, uncertainty, cost, is_converged, step)


def _step_within(
    problem: Problem, scaled: np.ndarray, residuals: np.ndarray, slopes: np.ndarray
) -> np.ndarray:
    """The Newton step; values that it would move out of their bounds are held, (p,)."""
    lower, upper = problem.bounds
    after = scaled + newton_step(slopes, residuals)
    is_held = (after < lower) | (after > upper)
    step = newton_step(np.where(is_held, 0.0, slopes), residuals)
    return np.clip(scaled + step, lower, upper) - scaled


def _respread(problem: Problem, scaled: np.ndarray) -> float:
    """Set the spreads to those of the residuals; returns the largest relative change.

    Spreads that have settled stay as they are.
    """
    before = problem.spreads
    after = [
        {n: max(_rms(e), _least(log.signals[n], LEAST_SPREAD)) for n, e in of_log.items()}
        for log, of_log in zip(problem.logs, problem.errors(scaled), strict=True)
    ]
    pairs = zip(after, before, strict=True)
    change = max(abs(now[n] / old[n] - 1.0) for now, old in pairs for n in now)
    if change >= SETTLED:
        problem.spreads = after
    return change


def _check_start(problem: Problem) -> None:
    problem.check(problem.start)
    if not np.isfinite(problem.residuals(problem.start)).all():
        allowed = "values from which the model can be driven by the logs"
        raise InputError("free", "", allowed, "the model is not finite with the values given")


def _least(signal: np.ndarray, share: float) -> float:
    return share * float(np.abs(signal).max()) or 1.0


def fitted(
    problem: Problem, start: np.ndarray, progress: Callable[[int], None]
) -> tuple[np.ndarray, float, bool]:
    """Least squares with the spreads as they are: values, sum of squares, whether it ended."""
    return _fit(problem, start, TIGHT, progress, is_central=True)


def _fit(
    problem: Problem,
    start: np.ndarray,
    tolerance: float,
    progress: Callable[[int], None],
    loss: str = "linear",
    *,
    is_central: bool = False,
) -> tuple[np.ndarray, float, bool]:
    """Least squares within the bounds: values, sum of squares, whether it ended by itself."""
    from scipy.optimize import least_squares  # scipy takes 0.25 s to import

    def residuals(scaled: np.ndarray) -> np.ndarray:
        progress(problem.runs)
        return problem.residuals(scaled)

    lower, upper = problem.bounds
    found = least_squares(
        residuals,
        np.clip(start, lower, upper),
        functools.partial(problem.jacobian, is_central=is_central),
        bounds=(lower, upper),
        ftol=tolerance,
        xtol=SMALLEST_STEP,
        loss=loss,
        gtol=None,
        max_nfev=MOST_STEPS,
    )
    return found.x, 2.0 * float(found.cost), found.status > 0


def _blocks(
    problem: Problem, scaled: np.ndarray, residuals: np.ndarray, slopes: np.ndarray
) -> tuple[list[Block], np.ndarray]:
    """Residuals and derivatives log by log, and the derivatives of the priors' residuals."""
    drawn = input_noise.responses(problem, scaled)
    blocks, place = [], 0
    for log in problem.logs:
        shape = (len(log.compared), len(log.time))
        end = place + math.prod(shape)
        of_log = residuals[place:end].reshape(shape).T
        of_values = slopes[place:end].reshape(*shape, -1).transpose(1, 0, 2)
        by_noise = drawn[:, place:end].reshape(-1, *shape).transpose(0, 2, 1)
        blocks.append(Block(of_log, of_values, log.interval, by_noise))
        place = end
    return blocks, slopes[place:]
