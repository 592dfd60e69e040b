"""The test of bias: rarely a false alarm, and a planted bias is found, even one that cancels in the mean."""

from __future__ import annotations

import numpy as np
import pytest

from antumbra.study.bias import bias
from antumbra.study.quantiles import t_quantile


def noisy(random, replicates, truth, sigma):
    return truth + random.normal(0, sigma, (replicates, *truth.shape))


TRUTH = np.linspace(0.5, 1.5, 16 * 16).reshape(16, 16)


def test_false_alarms_are_rarer_than_alpha():
    random = np.random.default_rng(1)
    alarms = [
        bias(noisy(random, 6, TRUTH, 0.3), noisy(random, 6, TRUTH, 0.1), alpha=0.05).flagged
        for _ in range(600)
    ]
    # The count is binomial with p ≤ 0.05: beyond 3.1 standard deviations once in 1,000.
    assert np.mean(alarms) < 0.05 + 3.1 * np.sqrt(0.05 * 0.95 / 600)


def test_a_bias_is_found():
    random = np.random.default_rng(2)
    found = bias(noisy(random, 6, 1.1 * TRUTH, 0.1), noisy(random, 6, TRUTH, 0.1))
    assert found.flagged and found.p < 1e-3
    # The 95 % interval of this one draw; the seed is fixed.
    assert found.difference.contains(0.1)


def test_a_bias_that_cancels_in_the_mean_is_found_where_it_is():
    random = np.random.default_rng(3)
    wrong = TRUTH.copy()
    wrong[:4, :4] += 0.5
    wrong[12:, 12:] -= 0.5
    found = bias(noisy(random, 8, wrong, 0.1), TRUTH)
    assert found.flagged and found.tile in {(0, 0, 4, 4), (12, 12, 4, 4)}


def test_a_reference_that_found_the_light_by_luck_accuses_nobody():
    # A light that one of 1,000 directions hits: most tiles of the reference are black, with no spread at all.
    random = np.random.default_rng(4)
    for _ in range(100):
        lucky = 1e3 * (random.uniform(size=(6, 16, 16)) < 1e-3)
        assert not bias(noisy(random, 6, np.ones((16, 16)), 0.1), lucky).flagged


def test_what_too_few_samples_found_is_not_tested():
    random = np.random.default_rng(5)
    lit, black = noisy(random, 6, TRUTH, 0.1), np.zeros((6, 16, 16))
    assert bias(lit, TRUTH).tested == 1
    # Few samples that found light: means of single replicates spread by more than themselves.
    lucky = 1e3 * (random.uniform(size=(6, 16, 16)) < 1e-3)
    for x, reference in ((black, lit), (black, TRUTH), (lit, black), (lit, lucky), (black, black)):
        found = bias(x, reference)
        assert not found.flagged and found.tested == 0 and np.isnan(found.p)


def test_a_black_tile_is_not_tested_and_the_others_are():
    random = np.random.default_rng(6)
    x = noisy(random, 6, TRUTH, 0.1)
    x[:, :4] = 0
    # Black in both: no light is there to be tested.
    x[:, 12:, 12:] = 0
    truth = TRUTH.copy()
    truth[12:, 12:] = 0
    found = bias(x, truth)
    # Of 16 tiles and the whole, one has no light, and four are black in one of the two.
    assert found.tested == (17 - 1 - 4) / (17 - 1)
    # The whole picture is darker than the reference by a fifth.
    assert found.flagged and found.tile is None


def test_black_replicates_of_many_samples_lack_light():
    random = np.random.default_rng(8)
    lit, black = noisy(random, 6, TRUTH, 0.1), np.zeros((6, 16, 16))
    for reference in (lit, TRUTH):
        # A light that one sample in 10⁵ finds, and 6 × 256 pixels: none of exp(−n / 10⁵) pictures would be black.
        found = bias(black, reference, samples=1024)
        assert found.flagged and found.tested > 0 and 0 < found.p <= 17 * np.exp(-6 * 256 * 1024 / 1e5)
        assert found.difference.contains(-TRUTH.mean())
        assert not bias(black, reference, samples=512).flagged
    # Three channels are found together; pixels that the reference has no light in count for nothing.
    colours = np.repeat(lit[..., None], 3, -1)
    assert bias(np.zeros_like(colours), colours, samples=1024).p == pytest.approx(
        bias(black, lit, samples=1024).p
    )
    half = lit.copy()
    half[:, 8:] = 0
    assert not bias(black, half, samples=1024).flagged and bias(black, half, samples=2048).flagged
    # A black reference is at fault itself, and one that is lit by luck, or too noisy to exclude 0, accuses nobody.
    lucky = 1e3 * (random.uniform(size=(6, 16, 16)) < 1e-3)
    for x, reference in ((lit, black), (black, lucky), (black, black)):
        assert not bias(x, reference, samples=1e9).flagged
    assert not bias(black, TRUTH, np.full((16, 16), 100.0), samples=1e9).flagged


def test_without_noise_only_a_real_difference_counts():
    same = np.stack([TRUTH] * 3)
    assert not bias(same, TRUTH).flagged
    assert bias(same, TRUTH + 0.01).flagged


def test_pictures_of_another_size_are_told():
    with pytest.raises(ValueError, match="same picture"):
        bias(np.zeros((3, 4, 4)), np.zeros((4, 5)))


def test_what_is_hidden_is_what_would_be_flagged():
    random = np.random.default_rng(7)
    x, reference = noisy(random, 8, TRUTH, 0.1), noisy(random, 8, TRUTH, 0.1)
    # One test of the whole picture, then one of 17: Bonferroni's share of α makes the threshold larger.
    for tiles, count in ((1, 1), (4, 17)):
        found = bias(x, reference, tiles=tiles)
        by_hand = t_quantile(1 - 1e-3 / (2 * count), 7) / t_quantile(0.975, 7) * found.difference.half
        assert found.hidden == pytest.approx(by_hand, rel=1e-9)
        assert bias(x - found.difference.value + 1.001 * found.hidden, reference, tiles=tiles).flagged
    shifted = x - found.difference.value
    alone = bias(x, reference, tiles=1).hidden
    assert not bias(shifted + 0.999 * alone, reference, tiles=1).flagged
