"""Random roads after ISO 8608: their roughness by class, their tracks by seed.

The displacement has the one-sided spectral density Gd(n) = Gd(n0) (n / n0)^-2 over the spatial
frequency n, with n0 = 0.1 1/m and Gd(n0) of the class, and contains the wave lengths for which the
standard defines it. Of both tracks this is the expected density, of the left one the exact one.
"""

import numpy as np

REFERENCE = 0.1
"""1/m: n0."""
LOWEST, HIGHEST = 0.011, 2.83
"""1/m: limits of the spatial frequency."""
COARSEST = 0.175
"""m: distance of two points, of which the shortest wave then has two."""
ROUGHNESS = {name: 16e-6 * 4.0**k for k, name in enumerate("ABCDEFGH")}
"""m^3: Gd(n0), the geometric means of the classes."""
PRECISION = 9
"""Decimals of a height in m, so that machines that round sines differently give the same road."""
GOLDEN, FIRST_MIX, SECOND_MIX = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB
"""Of the generator splitmix64 (Steele, Lea and Flood, 2014)."""


def density(roughness: str, frequency: np.ndarray) -> np.ndarray:
    """Gd (m^3) at spatial frequencies (1/m)."""
    return ROUGHNESS[roughness] * (frequency / REFERENCE) ** -2.0


def uniform(seed: int, count: int) -> np.ndarray:
    """Random numbers from 0 to 1, shape (count,), by splitmix64: the same everywhere and always."""
    steps = np.arange(1, count + 1, dtype=np.uint64)
    mixed = np.uint64(seed % 2**64) + steps * np.uint64(GOLDEN)
    mixed = (mixed ^ (mixed >> np.uint64(30))) * np.uint64(FIRST_MIX)
    mixed = (mixed ^ (mixed >> np.uint64(27))) * np.uint64(SECOND_MIX)
    return ((mixed ^ (mixed >> np.uint64(31))) >> np.uint64(11)) * 2.0**-53


def random_tracks(
    roughness: str, seed: int, count: int, spacing: float, incoherence: float
) -> np.ndarray:
    """Heights of the left and the right track, shape (2, count) (m), periodic.

    spacing: distance of two points (m). incoherence: the length L (m) of the coherence of the two
    tracks, exp(-n L): long waves have the same phase left and right, short ones do not.
    """
    frequency = np.arange(count // 2 + 1) / (count * spacing)
    used = (frequency >= LOWEST) & (frequency <= HIGHEST)
    n = frequency[used]
    amplitude = np.sqrt(2.0 * density(roughness, n) / (count * spacing))
    phases = 2.0 * np.pi * uniform(seed, 2 * len(n)).reshape(2, -1)
    own = np.exp(1j * phases)
    coherence = np.exp(-n * incoherence)
    right = coherence * own[0] + np.sqrt(1.0 - coherence**2) * own[1]
    spectrum = np.zeros((2, len(frequency)), complex)
    spectrum[:, used] = amplitude * np.array([own[0], right]) * count / 2.0
    return np.round(np.fft.irfft(spectrum, count), PRECISION)
