"""The causes of noise: known V and g give known parts."""

from __future__ import annotations

import numpy as np

from antumbra.lecture.measures.decompose import parts


def test_parts_of_independent_v_and_g():
    # V is 0 or 1 with ½ each, g = 1 ± 0.3 apart from it: ḡ² Var V = ¼, v̄² Var g = ¼ · 0.09, the product's as much.
    random = np.random.default_rng(7)
    shape = (20_000, 1, 1, 8)
    found = parts(random.integers(0, 2, shape).astype(float), random.normal(1.0, 0.3, shape))
    for part, truth in zip(found, (0.25, 0.0225, 0.0225, 0.0, 0.0, 0.0, 0.0, 0.0), strict=True):
        # Five standard errors of the mean (α = 6·10⁻⁷), and what is left of the bias: of order 1/8² of the part.
        slack = 5 * part.std() / np.sqrt(len(part)) + truth / 8**2
        assert abs(part.mean() - truth) <= slack, (part.mean(), truth)
    assert np.allclose(found.whole, sum(found))


def test_two_lights_and_places():
    # Without noise inside, only the choice of the light (1 or 3) and the place (0 or 2 on top) are left.
    g = np.array([[1.0, 3.0], [3.0, 5.0]])[None, :, :, None].repeat(4, -1)
    found = parts(np.ones_like(g), g)
    assert np.allclose([part[0] for part in found], [0, 0, 0, 0, 0, 0, 1, 2])


def test_covariances_of_v_that_hangs_on_g():
    # V = 1 where g = 2, 0 where g = 1, each with ½: a = ḡ(V − v̄) = ±¾, b = v̄(g − ḡ) = ±¼, their product's third
    # factor is ¼ always, so that 2 Cov(a, b) = 2 · ¾ · ¼ and the other two are 0.
    v = np.random.default_rng(8).integers(0, 2, (20_000, 1, 1, 16)).astype(float)
    found = parts(v, 1.0 + v)
    truths = (0.75**2, 0.25**2, 0.0, 2 * 0.75 * 0.25, 0.0, 0.0)
    for part, truth in zip(found, truths, strict=False):
        # Five standard errors of the mean, and the jackknife's rest of order 1/16².
        slack = 5 * part.std() / np.sqrt(len(part)) + 1 / 16**2
        assert abs(part.mean() - truth) <= slack, (part.mean(), truth)
    # Sample by sample the parts add up to the scatter of X = V g, whose variance is 1.
    assert np.allclose(found.whole, (v * (1.0 + v)).var(-1, ddof=1)[:, 0, 0])
