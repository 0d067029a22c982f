"""The modes of a linear model: its poles, how they swing, and which states move in them."""

import dataclasses
import math

import numpy as np
from scipy import linalg

NEUTRAL = 1e-6
"""1/s: a pole this near to 0 is 0, and the rest of it rounding."""
SHARE = 0.4
"""States that take part in a mode at least this much, relative to the one that does most."""


@dataclasses.dataclass(frozen=True)
class Mode:
    """A real pole, or a pair of which `pole` is the one with the positive imaginary part (1/s).

    frequency: natural, |pole| / 2 pi (Hz). damping: ratio, -Re / |pole|; negative if the mode
    grows. time_constant: -1 / Re (s), inf where nothing decays. states: those that take part in it
    most, the first more than the others.
    """

    pole: complex
    frequency: float
    damping: float
    time_constant: float
    states: tuple[str, ...]


def modes_of(a: np.ndarray, state_names: tuple[str, ...]) -> list[Mode]:
    """The modes of dx/dt = A x, the slowest first.

    The part of state k in a mode is |left eigenvector k times right eigenvector k|, which does not
    depend on the units of the states (Perez-Arriaga, Verghese and Schweppe, 1982).
    """
    poles, left, right = linalg.eig(a, left=True, right=True)
    parts = np.abs(left.conj() * right)
    modes = []
    for i in sorted(range(len(poles)), key=lambda i: (abs(poles[i]), -poles[i].imag)):
        if poles[i].imag >= 0.0:
            modes.append(_mode(complex(poles[i]), parts[:, i], state_names))
    return modes


def _mode(pole: complex, parts: np.ndarray, state_names: tuple[str, ...]) -> Mode:
    size = abs(pole)
    if size < NEUTRAL:
        pole, size = 0j, 0.0
    damping = -pole.real / size if size else math.nan
    time_constant = -1 / pole.real if pole.real else math.inf
    order = np.argsort(-parts, kind="stable")
    names = tuple(state_names[k] for k in order if parts[k] >= SHARE * parts.max())
    return Mode(pole, size / (2 * math.pi), damping, time_constant, names)
