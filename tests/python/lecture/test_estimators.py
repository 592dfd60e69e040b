"""Estimators of figures 18 and 19 on made-up replicates of which variances, bias and errors are known.

Intervals: of 400 experiments each with an interval of 95 % no more than 42 may miss, 20 + 5 √(400 · 0.05 · 0.95);
α = 3·10⁻⁶. Values: the mean of the experiments lies within five standard errors of the truth, α = 6·10⁻⁷.
"""

from __future__ import annotations

import numpy as np
import pytest

from antumbra.lecture.measures.ends import level, square_of
from antumbra.lecture.measures.ratio import farthest_from_one, scaled
from antumbra.lecture.measures.split import Scatter, mse_of, scatter_of, square_bias_of
from antumbra.lecture.quantity import Quantity
from antumbra.study.statistics import Interval

EXPERIMENTS, MISSED = 400, 42
# Pixels of each experiment, the light that they have, σ_p and σ_s, and the bias.
SHAPE, LIGHT, PLACE, SHADOW, BIAS = (8, 8), 3.0, 0.7, 1.9, 0.25
MANY = 16


def checked(intervals: list[Interval], truth: float) -> None:
    """Values and intervals of all experiments against the truth."""
    values = np.array([each.value for each in intervals])
    assert abs(values.mean() - truth) < 5 * values.std(ddof=1) / len(values) ** 0.5
    assert sum(not each.contains(truth) for each in intervals) <= MISSED


def a_scatter(random: np.random.Generator, count: int = 24) -> Scatter:
    """Of pictures with one shadow ray, and with `MANY` of which the first is the same."""
    place = LIGHT + PLACE * random.standard_normal((count, *SHAPE))
    shadow = SHADOW * random.standard_normal((MANY, count, *SHAPE))
    return scatter_of(place + shadow[0], place + shadow.mean(0), MANY)


@pytest.mark.parametrize(("viewing", "rays"), [(100, 1), (20, 9), (1, 199)])
def test_both_variances_and_what_a_split_has_of_them(viewing, rays):
    random = np.random.default_rng(11)
    found = [a_scatter(random).variance(viewing, rays) for _ in range(EXPERIMENTS)]
    checked(found, (PLACE**2 + SHADOW**2 / rays) / viewing)


def test_the_advised_split_of_many_replicates():
    # σ² of the estimates over 4000 · 64 pixels: N* within 1 %.
    found = a_scatter(np.random.default_rng(12), 4000).advised(4.0)
    assert found == pytest.approx(2 * SHADOW / PLACE, rel=0.01)


def pictures(random: np.random.Generator, bias: float) -> tuple[np.ndarray, np.ndarray]:
    """16 replicates whose mean is off by `bias`, and 4 of a truth with noise of its own."""
    each = LIGHT + bias + SHADOW * random.standard_normal((16, *SHAPE))
    return each, LIGHT + 0.3 * random.standard_normal((4, *SHAPE))


def test_squared_error_has_the_noise_of_the_truth_taken_off():
    random = np.random.default_rng(13)
    found = [mse_of(*pictures(random, BIAS)) for _ in range(EXPERIMENTS)]
    checked(found, BIAS**2 + SHADOW**2)


@pytest.mark.parametrize("bias", [0.0, BIAS, 1.5])
def test_squared_bias_has_all_noise_taken_off(bias):
    random = np.random.default_rng(14)
    checked([square_bias_of(*pictures(random, bias)) for _ in range(EXPERIMENTS)], bias**2)


def test_an_interval_of_the_bias_is_wider_by_the_noise_of_the_truth():
    random = np.random.default_rng(15)
    each, truth = pictures(random, 1.5)
    exact = LIGHT + 1e-9 * (truth - LIGHT)
    assert square_bias_of(each, truth).half > 1.01 * square_bias_of(each, exact).half


def test_square_of_what_is_lost():
    random = np.random.default_rng(16)
    lost = [BIAS + 0.5 * random.standard_normal((4, 16, 16)) for _ in range(EXPERIMENTS)]
    found = [square_of(each) for each in lost]
    checked([Interval(each.value, *each.interval) for each in found], BIAS**2)


def test_level_of_equal_errors():
    random = np.random.default_rng(17)

    def one() -> Interval:
        # Independent normal estimates of 40, 10 and 0.1, whose standard errors are known.
        sure = [2.0, 1.0, 0.004]
        values = random.normal([40.0, 10.0, 0.1], sure)
        found = level(*(Quantity(v, 1.96 * s) for v, s in zip(values, sure, strict=True)))
        return Interval(found.value, *found.interval)

    found = [one() for _ in range(EXPERIMENTS)]
    assert sum(not each.contains(300.0) for each in found) <= MISSED
    # A quotient is not where its parts are: its mean is larger by the relative variance of the square, 0.0016.
    assert np.mean([each.value for each in found]) == pytest.approx(300.48, abs=5 * 26 / EXPERIMENTS**0.5)
    assert level(Quantity(40.0), Quantity(10.0), Quantity(0.1, 0.1)).interval == (0.0, np.inf)


def test_a_scaled_bias_that_may_be_nothing_keeps_its_lower_end():
    found = scaled(Quantity(0.02, 0.03, low=0.0, high=0.05), 1 / 4, "%")
    assert (found.value, *found.interval) == (0.005, 0.0, 0.0125) and found.unit == "%"


def test_the_farthest_ratio_is_that_whose_interval_reaches_farthest():
    near, wide = Quantity(1.05, 0.01), Quantity(1.0, 0.2)
    assert farthest_from_one([near, wide]) is wide and farthest_from_one([near]) is near
