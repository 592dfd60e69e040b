"""Masks of occlusion: every method the same bits, the bits of `Scene.occluded`, and what they mean."""

from __future__ import annotations

import numpy as np
import pytest

import antumbra as am

METHODS = ("occluders", "receivers", "rays")


def looked_at(scene: am.Scene, size: tuple[int, int]) -> am.Hit:
    return scene.closest_hit(*scene.camera_rays(size))


@pytest.mark.parametrize(("name", "radius"), [("pillars", 1.5), ("cornell-box", 150.0), ("pillars", None)])
def test_every_method_gives_the_bits_of_rays(name, radius):
    scene = am.builtin(name)
    hit = looked_at(scene, (16, 12))
    found = [scene.occlusion_masks(hit, directions=64, radius=radius, method=m, turned=True) for m in METHODS]
    for one in found[1:]:
        np.testing.assert_array_equal(one.masks, found[0].masks)
        np.testing.assert_array_equal(one.frames, found[0].frames)
    seen = np.isfinite(hit.t)
    x, y, z = (found[0].directions[:, k, None] for k in range(3))
    # The core's order of operations, in single precision: (x s + y t) + z n.
    along = [(x * s + y * t) + z * n for s, t, n in found[0].frames[seen]]
    alone = scene.occluded(
        hit.receivers[np.repeat(np.flatnonzero(seen), 64)],
        directions=np.concatenate(along),
        max_distance=np.tile(found[0].lengths, seen.sum()),
    )
    np.testing.assert_array_equal(found[0].blocked[seen].ravel(), alone)
    assert not found[0].masks[~seen].any() and np.isnan(found[0].frames[~seen]).all()


def test_a_cap_above_is_counted_exactly():
    # Directions are stratified in sin²θ: of N, the N sin²α within α of the normal, give or take one.
    for count in (64, 256, 512, 1024):
        scene = am.Scene()
        scene.add_shape(am.shapes.Sphere((0.0, 2.0, 0.0), 1.0))
        found = scene.occlusion_masks([[0.0, 0.0, 0.0]], [[0.0, 3.0, 0.0]], directions=count)
        assert abs(found.openness[0] - 0.75) <= 1 / count
        assert found.blocked.sum() == count - round(float(found.openness[0]) * count)


def test_a_falloff_lies_in_the_lengths():
    found = am.Scene().occlusion_masks([[0.0] * 3], [[0.0, 0.0, 1.0]], radius=2.0, falloff="linear")
    # The weight 1 − t/R of an occluder at t is the share of rays longer than t: to 1/N of evenly spread numbers.
    for t in (0.1, 0.5, 1.0, 1.7):
        assert abs(np.mean(found.lengths > t) - (1 - t / 2)) < 2 / 256
    assert found.openness[0] == 1


def test_the_table_decides_most():
    scene = am.builtin("pillars")
    hit = looked_at(scene, (24, 16))
    work = scene.occlusion_masks(hit, directions=256, radius=1.0).work
    assert 0 < work.tested < 0.3 * 256 * work.in_range and work.rays == 0
    assert work.law <= work.tested and work.in_range <= work.pairs


def test_what_is_wrong_is_named():
    scene = am.builtin("pillars")
    points, up = [[0.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]]
    wrong = [
        ({"directions": 100}, "100 directions: 64, 256, 512 or 1024"),
        ({"radius": -1.0}, "radius = -1.0"),
        ({"radius": np.inf}, "radius"),
        ({"falloff": "linear"}, "needs a radius"),
        ({"falloff": "cubic", "radius": 1.0}, 'no falloff "cubic"'),
        ({"method": "magic"}, 'no method "magic"'),
    ]
    for words, text in wrong:
        with pytest.raises(ValueError, match=text):
            scene.occlusion_masks(points, up, **words)
    with pytest.raises(TypeError):
        scene.occlusion_masks(points, up, directions=2.5)
    with pytest.raises(ValueError, match="normals"):
        scene.occlusion_masks(points)
    assert scene.occlusion_masks(np.zeros((0, 3)), np.zeros((0, 3))).masks.shape == (0, 4)
