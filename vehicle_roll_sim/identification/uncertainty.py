"""How certain least-squares values are when the residuals are correlated in time.

The covariance is the sandwich H^-1 M H^-1 of H = J'J and M, the covariance of the gradient J'e.
M is that of residuals whose covariances over time are those that are found (serial_covariance.py),
and of what the noise of the steering and speed adds (input_noise.py). The idea is that of Newey and
West (1987).
"""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.identification.serial_covariance import (
    Block,
    effective_number,
    gradient_covariance,
    window_of,
)

ROUNDING = 1e-8
"""Of the largest singular value: a smaller one is that of rounding."""
CONFIDENCE = 0.95
LARGEST_ERROR = 0.5
"""Standard error over the scale of a value from which it counts as not identifiable."""


@dataclasses.dataclass(frozen=True)
class Combination:
    """A combination of values: `weights` over their scales, (p,), of length 1, and its error.

    singular_value: of the scaled sensitivities. error: standard error, over the scales.
    """

    weights: np.ndarray
    singular_value: float
    error: float

    @property
    def is_identifiable(self) -> bool:
        """Whether the logs say something of it."""
        return self.error < LARGEST_ERROR


@dataclasses.dataclass(frozen=True)
class Uncertainty:
    """Covariance of scaled values, (p, p), and what follows.

    naive: covariance if the residuals were white. effective: number of independent residuals.
    window: width over which residuals are correlated (s), of each log. combinations: from the most
    to the least certain one.
    """

    covariance: np.ndarray
    naive: np.ndarray
    effective: float
    window: list[float]
    combinations: list[Combination]

    @property
    def errors(self) -> np.ndarray:
        """Standard errors of the scaled values, (p,)."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def correlations(self) -> np.ndarray:
        """Correlation matrix, (p, p)."""
        return self.covariance / np.outer(self.errors, self.errors)

    @property
    def quantile(self) -> float:
        """Half width of a 95 % interval over the standard error (Student's t)."""
        from scipy.special import stdtrit  # scipy takes 0.25 s to import

        freedom = max(self.effective - len(self.covariance), 1.0)
        return float(stdtrit(freedom, (1.0 + CONFIDENCE) / 2.0))


def uncertainty_of(blocks: Sequence[Block], of_priors: np.ndarray) -> Uncertainty:
    """The uncertainty of values. of_priors: derivatives of the residuals of priors, (m, p)."""
    count = of_priors.shape[1]
    slopes = np.vstack([*(block.slopes.reshape(-1, count) for block in blocks), of_priors])
    inverse, values, directions, unknown = _inverse(slopes)
    windows = [window_of(block.residuals) for block in blocks]
    effective = sum(
        effective_number(block.residuals, width)
        for block, width in zip(blocks, windows, strict=True)
    )
    given = of_priors.T @ of_priors
    of_residuals = gradient_covariance(blocks, windows, inverse, given)
    gradient = given + of_residuals + sum(map(_of_drawn, blocks))
    covariance = inverse @ gradient @ inverse + unknown
    spread = np.mean([np.mean(block.residuals**2) for block in blocks])
    combinations = [
        Combination(row, float(value), math.sqrt(max(row @ covariance @ row, 0.0)))
        for value, row in zip(values, directions, strict=True)
    ]
    seconds = [width * block.interval for block, width in zip(blocks, windows, strict=True)]
    return Uncertainty(covariance, inverse * spread, effective, seconds, combinations)


def _inverse(slopes: np.ndarray) -> tuple[np.ndarray, ...]:
    """(J'J)^-1, singular values of J, their directions (rows), and what is not known at all.

    Singular values of rounding are raised to ROUNDING. What is not known at all is a covariance,
    (p, p), of their directions, in which the residuals say nothing: large and finite.
    """
    _, values, directions = np.linalg.svd(slopes, full_matrices=False)
    raised = np.maximum(values, ROUNDING * max(values[0], np.finfo(float).tiny))
    unknown = np.where(values < raised, 1.0 / raised**2, 0.0)
    inverse, unknown = ((directions.T * each) @ directions for each in (1.0 / raised**2, unknown))
    return inverse, values, directions, unknown


def newton_step(slopes: np.ndarray, residuals: np.ndarray) -> np.ndarray:
    """How far the derivatives, (n, p), say that the best values are away from these, (p,)."""
    return -_inverse(slopes)[0] @ (slopes.T @ residuals)


def _of_drawn(block: Block) -> np.ndarray:
    """Covariance of J'e by the noise that drives the model, (p, p)."""
    slopes = block.slopes.reshape(-1, block.slopes.shape[2])
    draws = block.drawn.reshape(len(block.drawn), len(slopes)) @ slopes
    return draws.T @ draws / max(len(draws), 1)
