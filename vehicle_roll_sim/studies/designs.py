"""The points of a design: full grids, Latin hypercubes, Sobol sequences, random draws."""

import dataclasses
import itertools
from collections.abc import Sequence

import numpy as np
from scipy import stats
from scipy.stats import qmc

from vehicle_roll_sim.studies.study import LATIN_HYPERCUBE, SALTELLI, SOBOL, Study

SMALLEST_SHARE = 1e-12
"""Probabilities of exactly 0 or 1 would be infinitely far out."""


@dataclasses.dataclass(frozen=True)
class Points(Sequence):
    """The values of the factors at all points: at each point of the grid, the same draws.

    grid: values of the gridded factors at each of its points, by name. draws: values of the drawn
    ones, shape (samples,), by name. A point is made when it is asked for.
    """

    names: tuple[str, ...]
    grid: list[dict]
    draws: dict[str, np.ndarray]
    samples: int

    def __len__(self) -> int:
        return len(self.grid) * self.samples

    def __getitem__(self, index: int | slice) -> dict | list[dict]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        position, draw = divmod(range(len(self))[index], self.samples)
        point = self.grid[position] | {name: float(v[draw]) for name, v in self.draws.items()}
        return {name: point[name] for name in self.names}


def points_of(study: Study) -> Points:
    """All points of a study in order."""
    levels = study.gridded
    grid = [dict(zip(levels, each, strict=True)) for each in itertools.product(*levels.values())]
    draws = draws_of(study) if study.drawn else {}
    return Points(tuple(study.factors), grid, draws, study.samples)


def draws_of(study: Study) -> dict[str, np.ndarray]:
    """The drawn values by name, each of shape (samples,)."""
    dimension, runs = len(study.drawn), study.settings.runs
    generator = np.random.default_rng(study.settings.seed)
    if study.design == SALTELLI:
        shares = saltelli(qmc.Sobol(2 * dimension, seed=generator).random(runs))
    elif study.design == SOBOL:
        shares = qmc.Sobol(dimension, seed=generator).random(runs)
    elif study.design == LATIN_HYPERCUBE:
        shares = qmc.LatinHypercube(dimension, seed=generator).random(runs)
    else:
        shares = generator.random((runs, dimension))
    for column in np.clip(shares, SMALLEST_SHARE, 1 - SMALLEST_SHARE, out=shares).T:
        column[:] = stats.norm.ppf(column)  # takes several times the memory of its argument
    return drawn_at(study, shares)


def saltelli(shares: np.ndarray) -> np.ndarray:
    """The points for Sobol indices: A, B, and for each factor A with this factor's values of B.

    shares: (n, 2 d). Returns (n (d + 2), d), in these blocks (Saltelli et al. 2010).
    """
    first, second = np.hsplit(shares, 2)
    blocks = [first, second]
    for column in range(first.shape[1]):
        mixed = first.copy()
        mixed[:, column] = second[:, column]
        blocks.append(mixed)
    return np.concatenate(blocks)


def drawn_at(study: Study, scores: np.ndarray) -> dict[str, np.ndarray]:
    """The values of the drawn factors at independent normal scores (n, d), by name.

    The scores are correlated as the study says; each factor then has the value at the probability
    of its score (a Gaussian copula).
    """
    together = scores @ np.linalg.cholesky(study.correlation).T
    pairs = zip(study.drawn.items(), together.T, strict=True)
    return {name: each.at(stats.norm.cdf(column)) for (name, each), column in pairs}
