"""Ten lines of NumPy are the estimator `area`: the pieces that Python gets are the ones that the renderer uses."""

from __future__ import annotations

import numpy as np
import pytest

import antumbra as am

SIZE, RAYS = (48, 32), 64


def ten_lines(scene, size, rays, seed):
    """Direct light at every pixel's centre, and its standard error, by the area form of the rendering equation."""
    random = np.random.default_rng(seed)
    origins, directions = scene.camera_rays(size)
    hit = scene.closest_hit(origins, directions)
    samples = np.zeros((rays, len(hit), 3))
    for sample in samples:
        s = scene.sample_light(hit.receivers, None, random.random((len(hit), 3)))
        cos = np.maximum(np.nan_to_num((hit.normal * s.direction).sum(axis=1)), 0)
        free = ~scene.occluded(hit.receivers, s.target)
        sample[:] = scene.brdf(hit, -directions, s.direction) * s.radiance * (cos * free / s.pdf)[:, None]
    return samples.mean(axis=0), samples.std(axis=0, ddof=1) / np.sqrt(rays)


@pytest.mark.parametrize("name", ["pillars", "cornell-box", "antumbra", "many-lights"])
def test_ten_lines_of_numpy_equal_the_estimator_area(name):
    scene = am.builtin(name, **({"lights": 20} if name == "many-lights" else {}))
    mine, my_error = ten_lines(scene, SIZE, RAYS, seed=9)
    image = scene.render(
        size=SIZE,
        estimator="area",
        viewing="centre",
        viewing_rays=RAYS,
        sampler="random",
        aov="direct",
        seed=9,
    )
    theirs = image.aov["direct"].reshape(-1, 3)
    # Mean over pixels and colours: a sum of thousands of independent terms, so normal. The estimator's own error is
    # taken as large as ours (the same number of independent samples). Two-sided, α = 1e-6: |z| < 4.9.
    difference = (mine - theirs).mean()
    error = np.sqrt(2 * (my_error.mean(axis=1) ** 2).sum()) / len(mine)
    assert error > 0
    assert abs(difference) < 4.9 * error
    # And pixel by pixel: no tile of 8 × 8 is off by more than 6 of its errors.
    width, height = SIZE
    tiles = (mine - theirs).mean(axis=1).reshape(height // 8, 8, width // 8, 8).mean(axis=(1, 3))
    tile_error = (
        np.sqrt((2 * my_error.mean(axis=1) ** 2).reshape(height // 8, 8, width // 8, 8).mean(axis=(1, 3))) / 8
    )
    assert (np.abs(tiles) <= 6 * tile_error + 1e-6 * np.abs(mine).max()).all()
