"""How figures split the rays of a pixel and count pairs of quarters: closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from antumbra.lecture.measures.ends import End, rmse
from antumbra.lecture.measures.pairs import EXPECTED, Samples
from antumbra.lecture.measures.split import Scatter
from antumbra.lecture.quantity import Quantity


@pytest.mark.parametrize(
    ("place", "light", "cv", "cs", "best"),
    [(0.01, 0.25, 1.0, 1.0, 5.0), (0.04, 0.09, 4.0, 1.0, 3.0), (0.2, 0.05, 1.0, 1.0, 0.5)],
)
def test_the_advised_split_is_that_of_the_table_of_closed_forms(place, light, cv, cs, best):
    # CF38a, b, c; agreement of float64.
    of = Scatter(np.full((3, 2, 3), place), np.full((3, 2, 3), light))
    assert of.advised(cv / cs) == pytest.approx(best, rel=1e-14)

    def cost_times_variance(n):
        return of.variance(1.0, n).value * (cv + n * cs)

    # CF38d is the least cost × variance of b, 0.49; beside N* it is more.
    assert cost_times_variance(best) == pytest.approx(
        ((place * cv) ** 0.5 + (light * cs) ** 0.5) ** 2, rel=1e-14
    )
    assert cost_times_variance(best) < min(cost_times_variance(0.9 * best), cost_times_variance(1.1 * best))


def test_pairs_of_quarters_are_counted():
    quarter = np.array([[0.1, 0.1], [0.7, 0.1], [0.1, 0.7], [0.7, 0.7]])
    each, other = np.repeat(quarter, 4, 0), np.tile(quarter, (4, 1))
    assert Samples(each, other, np.ones(16, bool), np.zeros(16)).different == 16
    assert Samples(each, each, np.ones(16, bool), np.zeros(16)).different == 4
    # From left to right, then downwards; what lies on the middle belongs to the right, or to what is below.
    pixel, light = np.array([[0.7, 0.1], [0.1, 0.7]]), np.array([[0.5, 0.5], [0.2, 0.499]])
    assert Samples(pixel, light, np.ones(2, bool), np.zeros(2)).pairs.tolist() == [[1, 3], [2, 0]]


def test_where_only_the_light_scatters_no_shadow_ray_is_too_many():
    nothing, some = np.zeros((3, 2, 2)), np.ones((3, 2, 2))
    assert Scatter(nothing - 0.1, some).advised() == math.inf
    assert Scatter(some, nothing - 0.1).advised() == 0.0


def test_pairs_that_theory_expects():
    # 16 tries with 1/16 each, and four rounds of random matchings of four quarters with four.
    random = np.random.default_rng(3)
    tries = [len(np.unique(random.integers(0, 16, 16))) for _ in range(4000)]
    rounds = [
        len({(a, b) for _ in range(4) for a, b in enumerate(random.permutation(4))}) for _ in range(4000)
    ]
    for found, way in ((tries, "random"), (rounds, "two")):
        # Five standard errors of the mean (α = 6·10⁻⁷).
        assert abs(np.mean(found) - EXPECTED[way]) < 5 * np.std(found) / 4000**0.5


def test_bias_stays_and_noise_falls_with_the_work():
    end = End(np.full((2, 2), 0.3), Quantity(0.09), np.full((2, 2), 16.0), 4.0, Quantity(16.0))
    assert end.error(100.0) == pytest.approx(0.5)
    assert rmse([end], 100.0, 2.0) == pytest.approx([0.25])
    assert rmse([end], 1e12, 1.0) == pytest.approx([0.3])
