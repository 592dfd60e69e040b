"""The same picture as theirs, in small: a part of each reference, rendered with few rays, within the noise of both."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))

from agreement import scenes
from agreement.compare import Noisy, compare

# What a reference and we may differ by beyond noise: of the mean, and of the median tile.
MEAN, TILE = 0.01, 0.02
# Two-sided tail of a normal number at 4.5 standard deviations: α = 7·10⁻⁶ each, 2·10⁻⁴ for all of them. The errors have
# few degrees of freedom, but thousands of pixels share in each sum.
SIGMAS = 4.5
# x, y, width, height, with something of everything in it.
PARTS = {
    "cornell-box": (32, 48, 64, 64),
    "veach-mis": (40, 32, 80, 48),
    "veach-bidir": (0, 0, 64, 64),
    "staircase2": (32, 40, 64, 64),
    "coffee": (16, 40, 72, 64),
    "classroom": (40, 40, 80, 48),
    "living-room": (40, 40, 80, 48),
    "gen-many-lights": (40, 24, 80, 48),
    "veach-ajar": (88, 16, 64, 64),
}
RAYS = {"ao": 32, "clay_direct": 24, "direct": 24, "path": 16}
CASES = {
    "cornell-box": ("ao", "clay_direct", "direct", "path"),
    "veach-mis": ("ao", "clay_direct", "direct", "path"),
    "veach-bidir": ("ao", "clay_direct", "direct"),
    "staircase2": ("ao", "clay_direct", "direct"),
    "coffee": ("ao", "clay_direct", "direct", "path"),
    "classroom": ("ao", "clay_direct", "direct"),
    "living-room": ("ao", "clay_direct", "direct"),
    "gen-many-lights": ("ao", "clay_direct"),
    "veach-ajar": ("ao",),
}


@pytest.mark.parametrize("scene", CASES)
def test_a_part_of_each_reference(data, scene):
    x, y, w, h = PARTS[scene]
    here = np.s_[y : y + h, x : x + w]
    opened = scenes.opened(data, scenes.reference(data, scene, "ao"))
    for variant in CASES[scene]:
        ref = scenes.reference(data, scene, variant)
        ours = scenes.render(opened, ref, RAYS[variant], crop=PARTS[scene])
        found = compare(ours.grey, Noisy(ref.grey.value[here], ref.grey.error[here]))
        told = f"{scene}.{variant}: {found}"
        assert abs(found.mean) <= MEAN + SIGMAS * found.mean_error, told
        # A median of n tiles is uncertain by about 1/√n of the noise.
        spread = SIGMAS / np.sqrt(w * h / 64)
        assert found.tile <= np.hypot(TILE, found.tile_noise) * (1.0 + spread), told


def test_a_wrong_picture_is_told_from_noise():
    rng = np.random.default_rng(4)
    truth = 0.2 + rng.random((64, 64))
    noise = np.full((64, 64), 0.05)
    theirs = Noisy(truth + noise * rng.standard_normal(truth.shape), noise)
    ours = Noisy(truth + noise * rng.standard_normal(truth.shape), noise)
    brighter = Noisy(ours.value * 1.03, noise)
    turned = Noisy(ours.value[:, ::-1], noise)
    assert compare(ours, theirs).holds
    assert not compare(brighter, theirs).holds
    assert not compare(turned, theirs).holds


def test_one_bright_pixel_of_noise_is_left_out():
    truth, noise = np.ones((64, 64)), np.full((64, 64), 0.01)
    value, error = truth.copy(), noise.copy()
    value[5, 5], error[5, 5] = 500.0, 400.0
    found = compare(Noisy(value, error), Noisy(truth, noise))
    assert found.holds
    assert found.left_out == 1 / 64**2
