"""Covariances against closed forms, and intervals against what they promise, with known noise."""

import math

import numpy as np
import pytest

from vehicle_roll_sim.identification.input_noise import noise_of
from vehicle_roll_sim.identification.serial_covariance import Block, effective_number, window_of
from vehicle_roll_sim.identification.uncertainty import newton_step, uncertainty_of

COUNT, INTERVAL = 600, 0.01
TIME = np.arange(COUNT) * INTERVAL
REGRESSORS = np.stack([np.ones(COUNT), np.sin(2.0 * TIME), TIME / TIME[-1]], axis=1)


POLYNOMIALS = np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, COUNT), 7)
"""Slow, and many, as what values of a vehicle do."""


def fitted(noise: np.ndarray, regressors: np.ndarray = REGRESSORS):
    """Values and uncertainty of the regression of a noise, whose true values are all 0."""
    values, *_ = np.linalg.lstsq(regressors, noise, rcond=None)
    residuals = regressors @ values - noise
    spread = math.sqrt(np.mean(residuals**2))
    slopes = regressors[:, np.newaxis, :] / spread
    block = Block(residuals[:, np.newaxis] / spread, slopes, INTERVAL, np.zeros((0, COUNT, 1)))
    return values, uncertainty_of([block], np.zeros((0, regressors.shape[1])))


def slow(noise: np.random.Generator) -> np.ndarray:
    """Noise of sensors behind a low-pass filter: correlated over a tenth of a second."""
    return np.convolve(noise.normal(size=COUNT + 14), np.hanning(17)[1:-1], mode="valid")


@pytest.mark.parametrize("seed", [7])
def test_intervals_cover_what_they_promise_although_residuals_are_correlated(seed):
    noise, covered, white = np.random.default_rng(seed), [], []
    for _ in range(200):
        values, found = fitted(slow(noise))
        covered.append(np.abs(values) <= found.quantile * found.errors)
        white.append(np.abs(values) <= 1.96 * np.sqrt(np.diag(found.naive)))
    # of 200 cases 95 % have a standard error of 1.5 %: 90 % to 98 % are more than 2 of them
    shares = np.mean(covered, axis=0)
    assert (shares >= 0.90).all()
    assert (shares <= 0.98).all()
    assert np.mean(white) < 0.65  # residuals taken for white promise far too much


def test_standard_errors_are_those_of_the_noise_although_a_fit_leaves_less_of_it():
    kernel = np.hanning(17)[1:-1]
    lags = np.correlate(kernel, kernel, "full")[14:]
    apart = np.abs(np.subtract.outer(np.arange(COUNT), np.arange(COUNT)))
    of_noise = np.where(apart < len(lags), lags[np.minimum(apart, len(lags) - 1)], 0.0)
    hat = np.linalg.pinv(POLYNOMIALS)
    expected = np.diag(hat @ of_noise @ hat.T)
    noise = np.random.default_rng(9)
    found = [fitted(slow(noise), POLYNOMIALS)[1].errors ** 2 for _ in range(100)]
    # the variance of one record has a relative error of 0.43: 3 standard errors. Covariances of
    # what eight values leave, as they are, give 0.60
    np.testing.assert_allclose(np.mean(found) / np.mean(expected), 1.0, atol=0.13)


def test_the_covariance_of_white_residuals_is_that_of_ordinary_least_squares():
    noise, ratios = np.random.default_rng(5), []
    for _ in range(40):
        _, found = fitted(noise.normal(size=COUNT))
        ratios.append(found.errors**2 / np.diag(np.linalg.inv(REGRESSORS.T @ REGRESSORS)))
    # each has a relative error of about 0.15 by the few lags of the window and the spread
    np.testing.assert_allclose(np.mean(ratios, axis=0), 1.0, atol=0.1)


def test_the_number_of_independent_residuals_is_that_of_the_noise():
    residuals = slow(np.random.default_rng(2))[:, np.newaxis]
    kernel = np.hanning(17)[1:-1]
    expected = COUNT * np.sum(kernel**2) / np.sum(kernel) ** 2
    found = effective_number(residuals, window_of(residuals))
    assert found == pytest.approx(expected, rel=0.3)  # one record of 6 s


def test_values_that_act_alike_are_named_with_their_difference():
    block = Block(
        np.random.default_rng(3).normal(size=(COUNT, 1)),
        REGRESSORS[:, np.newaxis, [0, 1, 1]],
        INTERVAL,
        np.zeros((0, COUNT, 1)),
    )
    found = uncertainty_of([block], np.zeros((0, 3)))
    unknown = [each for each in found.combinations if not each.is_identifiable]
    assert len(unknown) == 1
    np.testing.assert_allclose(np.abs(unknown[0].weights), [0, 0.5**0.5, 0.5**0.5], atol=1e-6)
    assert unknown[0].weights[1] * unknown[0].weights[2] < 0.0


def test_a_prior_makes_them_identifiable_and_is_all_that_is_known_of_the_difference():
    slopes = 100.0 * REGRESSORS[:, np.newaxis, [0, 1, 1]]
    noise = np.random.default_rng(3).normal(size=(COUNT, 1))
    block = Block(noise, slopes, INTERVAL, np.zeros((0, COUNT, 1)))
    found = uncertainty_of([block], np.array([[0.0, 20.0, 0.0]]))
    assert all(each.is_identifiable for each in found.combinations)
    assert found.errors[1] == pytest.approx(1 / 20.0, rel=0.01)
    assert found.correlations[1, 2] == pytest.approx(-1.0, abs=1e-3)


def test_the_newton_step_of_a_linear_model_leads_to_its_best_values():
    noise, away = np.random.default_rng(8).normal(size=COUNT), np.array([0.3, -2.0, 5.0])
    best, *_ = np.linalg.lstsq(REGRESSORS, noise, rcond=None)
    residuals = REGRESSORS @ (best + away) - noise
    np.testing.assert_allclose(newton_step(REGRESSORS, residuals), -away, rtol=1e-9)


def test_the_noise_of_a_signal_is_told_from_its_motion():
    noise = np.random.default_rng(4).normal(0.0, 1e-3, COUNT)
    swing = 0.5 * np.sin(2 * np.pi * TIME)
    assert noise_of(swing + noise) == pytest.approx(1e-3, rel=0.15)  # 3 standard errors
    assert noise_of(swing) < 2e-6


def test_noise_that_drives_the_model_adds_what_it_does_to_the_values():
    slopes = REGRESSORS[:, np.newaxis, :]
    draws = np.random.default_rng(6).normal(size=(500, 3)) * [0.1, 0.2, 0.3]
    drawn = (draws @ REGRESSORS.T)[:, :, np.newaxis]
    block = Block(np.zeros((COUNT, 1)), slopes, INTERVAL, drawn)
    found = uncertainty_of([block], np.zeros((0, 3)))
    np.testing.assert_allclose(found.errors, [0.1, 0.2, 0.3], rtol=0.1)  # of 500 draws
