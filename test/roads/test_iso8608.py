"""Random roads: the spectrum of a class is recovered from them, and seeds are seeds."""

import numpy as np
import pytest

from vehicle_roll_sim.roads.iso8608 import HIGHEST, LOWEST, random_tracks, uniform
from vehicle_roll_sim.roads.profiles import RandomProfile

COUNT, SPACING = 40_000, 0.05
"""2 km"""


def spectra(tracks: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Spatial frequencies (1/m), and the one-sided density of each track (m^3), by definition."""
    frequency = np.fft.rfftfreq(tracks.shape[1], SPACING)
    lines = np.fft.rfft(tracks) * SPACING
    return frequency, 2.0 * np.abs(lines) ** 2 / (tracks.shape[1] * SPACING)


@pytest.mark.parametrize(("name", "roughness"), [("A", 16e-6), ("C", 256e-6), ("H", 262144e-6)])
def test_the_density_is_that_of_the_class_and_falls_with_the_square_of_the_frequency(
    name, roughness
):
    frequency, density = spectra(random_tracks(name, 3, COUNT, SPACING, 1.5))
    used = (frequency >= LOWEST) & (frequency <= HIGHEST)
    expected = roughness * (frequency[used] / 0.1) ** -2.0
    left, right = density[:, used]
    # heights are rounded to 1 nm: a white density of 2 SPACING (1e-9)^2 / 12
    assert left == pytest.approx(expected, rel=1e-3, abs=1e-18)
    octaves = np.array_split(right / expected, 20)  # random phases of two sources: in the mean
    assert np.mean(right / expected) == pytest.approx(1.0, abs=0.05)
    assert [part.mean() for part in octaves] == pytest.approx([1.0] * 20, abs=0.35)
    assert density[:, ~used].max() < 1e-16


def test_the_tracks_have_the_stated_coherence():
    """Over many seeds: the mean cross density over the densities."""
    length, cross, own = 2.0, 0.0, 0.0
    for seed in range(300):
        tracks = random_tracks("B", seed, 2000, SPACING, length)
        left, right = np.fft.rfft(tracks)
        cross, own = cross + np.conj(left) * right, own + np.abs(left) ** 2
    frequency = np.fft.rfftfreq(2000, SPACING)
    for n in (0.02, 0.1, 0.3, 1.0):
        line = round(n * 2000 * SPACING)
        found = (cross[line] / own[line]).real
        assert found == pytest.approx(np.exp(-frequency[line] * length), abs=0.12)  # 2 / sqrt(300)


def test_a_seed_gives_the_same_road_and_another_seed_another_one():
    first, again, other = (RandomProfile(start=0.0, seed=s, length=50.0) for s in (1, 1, 2))
    assert np.array_equal(first.tracks(), again.tracks())
    assert not np.array_equal(first.tracks(), other.tracks())


def test_the_random_numbers_are_those_of_splitmix64():
    """Its first three, for the seed 1234567, as others publish them."""
    known = (6457827717110365317, 3203168211198807973, 9817491932198370423)
    assert uniform(1234567, 3).tolist() == [(each >> 11) * 2.0**-53 for each in known]


def test_without_incoherence_both_tracks_are_the_same():
    left, right = random_tracks("D", 5, 1000, SPACING, 0.0)
    assert np.array_equal(left, right)


def test_a_random_road_begins_and_ends_level():
    tracks = RandomProfile(start=0.0, roughness="E", length=100.0).tracks()
    assert np.abs(tracks[:, [0, -1]]).max() == 0.0
    assert np.abs(tracks[:, :20]).max() < 0.1 * np.abs(tracks).max()
