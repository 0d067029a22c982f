"""Corridors around simulated signals in which the measured ones must lie.

In the manner of ISO 19364 and ISO 19365 as their public summaries describe them: the simulation
gives the boundaries, the measurement is laid over them. The tolerances are this package's own.
"""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import keep_validated, parameter


@dataclasses.dataclass(frozen=True)
class Tolerances:
    """Half sizes of the rectangle around each simulated point, and what share must be inside."""

    time_tolerance: float = parameter(
        "of the corridor over time, to both sides", "s", 0.0, 1.0, default=0.05
    )
    gain_tolerance: float = parameter(
        "of the simulated value, to both sides", "%", 0.0, 100.0, default=5.0
    )
    offset_tolerance: float = parameter(
        "of the measured peak, added at every value, to both sides", "%", 0.0, 100.0, default=5.0
    )
    inside: float = parameter(
        "least share of measured samples inside the corridor", "%", 1.0, 100.0, default=95.0
    )

    def __post_init__(self):
        keep_validated(self)

    def half_width(self, simulated: np.ndarray, peak: float) -> np.ndarray:
        """Tolerance of each simulated value, (n,), in its unit. peak: of the measured signal."""
        return (self.gain_tolerance * np.abs(simulated) + self.offset_tolerance * peak) / 100.0

    def accepts(self, share: float) -> bool:
        """Whether a share of samples (0 to 1) inside the corridor is enough."""
        return 100.0 * share >= self.inside


def over_time(
    simulated: np.ndarray, peak: float, interval: float, tolerances: Tolerances
) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper boundary over time, (n,) each: the outline of all rectangles.

    simulated: samples every `interval` (s), (n,). peak: of the measured signal, in its unit.
    """
    from scipy.ndimage import maximum_filter1d, minimum_filter1d  # scipy: 0.25 s

    half = tolerances.half_width(simulated, peak)
    size = 2 * int(tolerances.time_tolerance / interval + 1e-9) + 1
    lower = minimum_filter1d(simulated - half, size, mode="nearest")
    return lower, maximum_filter1d(simulated + half, size, mode="nearest")


def over_acceleration(
    at: np.ndarray,
    acceleration: np.ndarray,
    simulated: np.ndarray,
    half_widths: tuple[float, np.ndarray],
) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper boundary of a cross plot at some accelerations (m/s^2), (m,) each.

    at: (m,). acceleration, simulated: the simulated points, (n,) each. half_widths: of the
    rectangles, along the acceleration (m/s^2) and of each value, (n,). nan where no rectangle is.
    """
    along, half = half_widths
    order = np.argsort(acceleration, kind="stable")
    places, low, high = acceleration[order], (simulated - half)[order], (simulated + half)[order]
    first = np.searchsorted(places, at - along, side="left")
    last = np.searchsorted(places, at + along, side="right")
    lower, upper = np.full(len(at), np.nan), np.full(len(at), np.nan)
    for i, (begin, end) in enumerate(zip(first, last, strict=True)):
        if begin < end:
            lower[i], upper[i] = low[begin:end].min(), high[begin:end].max()
    return lower, upper


def share_inside(values: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> float:
    """Share of the values (n,) between the boundaries, 0 to 1; none where a boundary is nan."""
    return float(np.mean((lower <= values) & (values <= upper)))
