"""The points of a design: full grids, Latin hypercubes, Sobol sequences, random draws."""

import itertools

import numpy as np
from scipy import stats
from scipy.stats import qmc

from vehicle_roll_sim.studies.study import LATIN_HYPERCUBE, SALTELLI, SOBOL, Study

SMALLEST_SHARE = 1e-12
"""Probabilities of exactly 0 or 1 would be infinitely far out."""


def points_of(study: Study) -> list[dict[str, float | str | bool]]:
    """The values of the factors at all points: at each point of the grid, the same draws."""
    levels = study.gridded
    grid = [dict(zip(levels, each, strict=True)) for each in itertools.product(*levels.values())]
    draws = draws_of(study) if study.drawn else [{}]
    points = ({**one, **draw} for one, draw in itertools.product(grid, draws))
    return [{name: point[name] for name in study.factors} for point in points]


def draws_of(study: Study) -> list[dict[str, float]]:
    """The drawn values, by name."""
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
    return drawn_at(study, stats.norm.ppf(np.clip(shares, SMALLEST_SHARE, 1 - SMALLEST_SHARE)))


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


def drawn_at(study: Study, scores: np.ndarray) -> list[dict[str, float]]:
    """The values of the drawn factors at independent normal scores, shape (n, d).

    The scores are correlated as the study says; each factor then has the value at the probability
    of its score (a Gaussian copula).
    """
    together = scores @ np.linalg.cholesky(study.correlation).T
    shares = stats.norm.cdf(together)
    columns = [each.at(shares[:, i]).tolist() for i, each in enumerate(study.drawn.values())]
    return [dict(zip(study.drawn, row, strict=True)) for row in zip(*columns, strict=True)]
