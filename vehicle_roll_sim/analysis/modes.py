"""The modes of a linear model: poles, frequency, damping and participating states."""

import dataclasses
import math
from collections.abc import Iterable

import numpy as np
from scipy import linalg

from vehicle_roll_sim.model.records import WHEELS

NEUTRAL = 1e-6
"""1/s: poles closer to 0 count as 0; the remainder is rounding."""
SHARE = 0.4
"""Smallest participation of a state that is listed, relative to the largest one in the mode."""
MOTIONS = {
    "roll": "roll",
    "roll_rate": "roll",
    "z": "bounce",
    "w": "bounce",
    "pitch": "pitch",
    "pitch_rate": "pitch",
    "v": "yaw",
    "yaw_rate": "yaw",
    **{
        f"{name}_{wheel}": "front hop" if wheel.endswith("f") else "rear hop"
        for name in ("unsprung_velocity", "suspension_compression")
        for wheel in WHEELS
    },
}
"""The motion of a mode in which a state participates most."""
BODY_MOTIONS = ("bounce", "pitch", "roll", "yaw", "front hop", "rear hop")


@dataclasses.dataclass(frozen=True)
class Mode:
    """A real pole, or a conjugate pair.

    pole: 1/s; of a pair, the one with the positive imaginary part. frequency: natural frequency,
    |pole| / 2 pi (Hz). damping: damping ratio, -Re / |pole|; negative if the mode grows.
    time_constant: -1 / Re (s); inf if it does not decay. states: the states with the largest
    participation, largest first.
    """

    pole: complex
    frequency: float
    damping: float
    time_constant: float
    states: tuple[str, ...]

    @property
    def motion(self) -> str:
        """One of BODY_MOTIONS, or '' for a mode of tires or wheel speeds, or one without swing."""
        return MOTIONS.get(self.states[0], "") if self.pole.imag else ""


def natural_modes(modes: Iterable[Mode]) -> dict[str, Mode]:
    """The slowest oscillation of each of BODY_MOTIONS that has one."""
    found = {}
    for mode in modes:
        if mode.motion:
            found.setdefault(mode.motion, mode)
    return {motion: found[motion] for motion in BODY_MOTIONS if motion in found}


def modes_of(a: np.ndarray, state_names: tuple[str, ...]) -> list[Mode]:
    """The modes of dx/dt = A x, slowest first; a: (n, n) (1/s).

    The participation of state k in a mode is the magnitude of element k of the left eigenvector
    times that of the right one, which is independent of the units of the states (Perez-Arriaga,
    Verghese and Schweppe, 1982).
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
