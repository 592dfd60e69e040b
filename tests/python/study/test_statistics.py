"""Statistics on synthetic data whose truth is known. Seeds are fixed.

Coverage tests count how many of M = 2,000 intervals of level 95 % hold the truth. The count is binomial: beyond
±3.3 standard deviations (±1.6 %) by chance once in 1,000 (α = 10⁻³ each).
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from antumbra.study import statistics as st
from antumbra.study.quantiles import t_quantile

M = 2_000
ALLOWED = 3.3 * math.sqrt(0.95 * 0.05 / M)


def coverage(intervals, truth):
    return np.mean([found.contains(truth) for found in intervals])


# Of printed tables (Abramowitz and Stegun 26.10, and NIST's handbook 1.3.6.7), to their last digit.
@pytest.mark.parametrize(("dof", "t975"), [(1, 12.706), (2, 4.303), (3, 3.182), (7, 2.365), (30, 2.042)])
def test_quantiles_are_those_of_the_tables(dof, t975):
    assert t_quantile(0.975, dof) == pytest.approx(t975, abs=6e-4)
    assert t_quantile(0.025, dof) == -t_quantile(0.975, dof)


def test_the_interval_of_a_mean_covers_it():
    x = np.random.default_rng(1).normal(3.0, 2.0, (M, 5))
    assert abs(coverage(map(st.mean, x), 3.0) - 0.95) < ALLOWED


def test_the_jackknife_interval_of_a_picture_s_variance_covers_it():
    # 400 cells of different variance: their average is 1/3. With so many cells the pseudo-values are nearly normal.
    sigma = np.sqrt(np.linspace(0, 2 / 3, 401)[1:])
    truth = float((sigma**2).mean())
    random = np.random.default_rng(3)
    found = [st.variance(random.normal(0, 1, (8, 400)) * sigma + 5) for _ in range(M)]
    # The jackknife is not exact: twice what chance alone would allow.
    assert abs(coverage(found, truth) - 0.95) < 2 * ALLOWED


def test_variance_and_its_parts_agree():
    x = np.random.default_rng(4).normal(0, 1, (6, 10, 3))
    expected = x.var(axis=0, ddof=1).mean()
    assert st.variance(x).value == pytest.approx(expected, rel=1e-12)
    assert st.variance_by_replicate(x).mean() == pytest.approx(expected, rel=1e-12)
    without = [np.delete(x, k, axis=0).var(axis=0, ddof=1).mean() for k in range(6)]
    assert st.variances_without(x) == pytest.approx([expected, *without], rel=1e-12)


def test_the_reference_s_own_noise_is_taken_off_an_error():
    random = np.random.default_rng(5)
    truth = random.uniform(0, 1, 4_000)
    reference = truth + random.normal(0, 0.5, truth.shape)
    x = truth + random.normal(0, 1.0, (10, *truth.shape))
    plain, found = (st.mse_of(st.squared_errors(x, reference, own)) for own in (0.0, 0.25))
    # Of 4,000 cells, the average square of the reference's noise is right to 0.25·√(2/4000) = 0.0056; four of those.
    assert abs(found.value - 1.0) < 4 * (0.0056 + found.half / 2)
    assert plain.value - found.value == pytest.approx(0.25, rel=1e-12)


@pytest.mark.parametrize("sigma", [0.0, 0.1])
def test_the_interval_of_an_error_against_a_noisy_reference_covers_it(sigma):
    # A bias of 0.5 in each of 60 cells, with noise or without (a regular grid); the reference's noise is shared.
    random = np.random.default_rng(8)
    found, alone = [], []
    for _ in range(M):
        x = 0.5 + random.normal(0, sigma, (6, 60)) if sigma else np.full((6, 60), 0.5)
        reference = random.normal(0, 1.0, (8, 60))
        own = reference.var(axis=0, ddof=1) / 8
        squared = st.squared_errors(x, reference.mean(axis=0), own)
        found.append(st.mse_of(squared, own_half=st.reference_half(x, reference)))
        alone.append(st.mse_of(squared))
    assert coverage(alone, 0.25 + sigma**2) < 0.5
    # The jackknife of a square is careful: it holds more than 95 %, less than 99.
    assert 0.95 - ALLOWED < coverage(found, 0.25 + sigma**2) < 0.99


@pytest.mark.parametrize("bias", [0.0, 0.5])
def test_the_interval_of_an_error_holds_the_noise_of_a_picture_with_errors(bias):
    # Sixty pixels of three channels that err alike, as of a grey scene; some are four times as noisy as others.
    random = np.random.default_rng(10)
    error = np.repeat(np.where(np.arange(60) % 2, 0.25, 1.0)[:, None], 3, 1)
    found, alone = [], []
    for _ in range(M):
        x = bias + random.normal(0, 0.1, (6, 60, 3))
        reference = error * random.normal(0, 1.0, (60, 1))
        squared = st.squared_errors(x, reference, error**2)
        found.append(st.mse_of(squared, own_half=st.error_half(x, reference, error)))
        alone.append(st.mse_of(squared))
    assert coverage(alone, bias**2 + 0.01) < 0.5
    # The distribution of a square is skewed: a normal interval of it may hold a little less, or more.
    assert 0.9 - ALLOWED < coverage(found, bias**2 + 0.01) < 0.99


def test_the_jackknife_over_a_reference_leaves_one_out():
    random = np.random.default_rng(9)
    x, r = random.normal(0, 1, (5, 7)), random.normal(0, 1, (6, 7))

    def whole(of):
        return float(st.squared_errors(x, of.mean(axis=0), of.var(axis=0, ddof=1) / len(of)).mean())

    pseudo = [6 * whole(r) - 5 * whole(np.delete(r, j, axis=0)) for j in range(6)]
    assert st.reference_half(x, r) == pytest.approx(st.mean(pseudo).half, rel=1e-9)


def test_slopes_of_power_laws_are_found():
    n = np.array([1, 4, 16, 64])
    exact = 7.0 * n**-1.5
    assert st.slopes(n, np.stack([exact, 3 * exact])) == pytest.approx([-1.5, -1.5], abs=1e-12)


def test_the_interval_of_a_slope_covers_it():
    random = np.random.default_rng(6)
    n = np.array([1.0, 9.0, 36.0, 100.0])
    # Errors of a common factor per replicate (a seed) and a small one of their own.
    noise = random.normal(0, 0.3, (M, 6, 1)) + random.normal(0, 0.05, (M, 6, 4))
    assert abs(coverage((st.slope(n, e) for e in np.exp(noise) / n), -1.0) - 0.95) < ALLOWED


def test_the_jackknife_interval_of_a_variance_s_slope_covers_it():
    random = np.random.default_rng(8)
    n = np.array([1.0, 4.0, 16.0])
    found = []
    for _ in range(M):
        # 200 cells; the replicate at N = 16 shares half of its noise with that at N = 4, as a common seed may do.
        noise = random.normal(0, 1, (3, 6, 200))
        noise[2] = (noise[2] + noise[1]) / math.sqrt(2)
        x = noise / n[:, None, None] ** 0.75
        found.append(st.variance_slope(n, np.stack([st.variances_without(v) for v in x], axis=1)))
    assert np.mean([f.value for f in found]) == pytest.approx(-1.5, abs=0.01)
    assert abs(coverage(found, -1.5) - 0.95) < 2 * ALLOWED


def test_the_band_of_a_line_lies_about_it():
    random = np.random.default_rng(7)
    n = np.array([1.0, 4.0, 16.0])
    errors = np.exp(random.normal(0, 0.1, (8, 3))) * 2 / n
    found = st.line(n, errors, [1, 4, 16])
    assert (found.low < found.value).all() and (found.value < found.high).all()
    x = random.normal(0, 1, (3, 8, 200)) / n[:, None, None] ** 0.75
    variances = np.stack([st.variances_without(v) for v in x], axis=1)
    spread = st.variance_line(n, variances, n)
    assert (spread.low < n**-0.75).all() and (n**-0.75 < spread.high).all()
    assert np.diff(np.log(spread.value)) * 2 == pytest.approx(
        st.variance_slope(n, variances).value * np.diff(np.log(n))
    )
    assert np.diff(np.log(found.value)) == pytest.approx(st.slope(n, errors).value * np.diff(np.log(n)))


def test_efficiency_and_ratio():
    found = st.efficiency(st.Interval(0.5, 0.4, 0.625), 4.0)
    assert tuple(found) == pytest.approx((0.5, 0.4, 0.625))
    assert tuple(st.ratio(st.Interval(6, 6, 6), st.Interval(3, 2, 4))) == pytest.approx((2, 1.5, 8 / 3))
    assert math.isnan(st.efficiency(st.Interval(0, 0, 0), 1.0).value)


@pytest.mark.parametrize(
    ("interval", "claim", "expected"),
    [
        ((-0.51, -0.49), {"near": -0.5, "within": 0.02}, "supported"),
        ((-0.60, -0.49), {"near": -0.5, "within": 0.02}, "undecided"),
        ((-0.60, -0.55), {"near": -0.5, "within": 0.02}, "not supported"),
        ((0.1, 0.3), {"above": 0.0}, "supported"),
        ((-0.1, 0.3), {"above": 0.0}, "undecided"),
        ((-0.3, -0.1), {"above": 0.0}, "not supported"),
        ((1.0, 2.0), {"below": 3.0}, "supported"),
        ((-math.inf, math.inf), {"below": 3.0}, "undecided"),
    ],
)
def test_verdicts(interval, claim, expected):
    low, high = interval
    assert st.verdict(st.Interval((low + high) / 2, low, high), **claim) == expected


@pytest.mark.parametrize(
    ("value", "half", "text"),
    [
        (3.9991, 0.0142, "3.999 ± 0.014"),
        (-0.4987, 0.0023, "−0.499 ± 0.002"),
        (12345.6, 78.0, "12,346 ± 78"),
        (1.5e-7, 2e-9, "(1.50 ± 0.02) · 10⁻⁷"),
        (0.5, 0.0, "0.5"),
        (0.5, math.inf, "0.5 ± ?"),
    ],
)
def test_numbers_are_printed_as_far_as_they_are_known(value, half, text):
    assert st.plus_minus(value, half) == text


def test_what_cannot_be_answered_is_told():
    with pytest.raises(ValueError, match="at least one"):
        st.mean([])
    assert st.mean([1.0]) == (1.0, -math.inf, math.inf)
    with pytest.raises(ValueError, match="at least 3"):
        st.variance([[1.0], [2.0]])
    with pytest.raises(ValueError, match="above 0"):
        st.slope([1, 2], [[1.0, 0.0], [1.0, 1.0]])


def test_pseudo_values_are_the_jackknife_s():
    x = np.random.default_rng(11).normal(0, 2, (7, 5, 4))
    found = st.variance_pseudo_values(x)
    whole = x.var(axis=0, ddof=1)
    # By their definition, K θ − (K−1) θ without one; sums of seven numbers of double precision.
    by_hand = [7 * whole - 6 * np.delete(x, k, axis=0).var(axis=0, ddof=1) for k in range(7)]
    assert np.allclose(found, by_hand, rtol=0, atol=1e-12) and np.allclose(found.mean(axis=0), whole)
    with pytest.raises(ValueError, match="at least 3"):
        st.variance_pseudo_values(x[:2])
