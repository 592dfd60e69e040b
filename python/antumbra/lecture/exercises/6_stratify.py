"""Exercise 6 · nine shadow rays that know of each other

Nine shadow rays each, to nine random points of the lamp. Their mean is right already, but random points clump: where
two fall together, somewhere else there is none.

Fill the gap: let shadow ray k fall into cell k of a grid of 3 × 3 cells. (`u(3)` is one number, which light, and two,
where on it.) The check asks for the same mean with less noise, where a wall hides part of the lamp.

    python 6_stratify.py            your picture, 6_stratify.png, and how far it is from the right one
    antumbra check 6_stratify.py    is it right, and if not, which term is wrong?
"""

import numpy as np

from antumbra.lecture.exercises import show

# Standard deviation of one answer, at most; random points have 0.0055.
NOISE = {"lamp partly hidden": 0.0042}


def estimator(scene, at, u):
    light = 0.0
    for k in range(9):  # noqa: B007
        which, x, y = u(3).T
        x, y = x, y  # GAP
        s = scene.sample_light(at, u=np.column_stack([which, x, y]))
        f = scene.brdf(at, at.wo, s.direction)
        cos = np.maximum((at.shading_normal * s.direction).sum(axis=1), 0)
        free = ~scene.occluded(at, s.target)
        light += f * s.radiance * (cos * free / s.pdf)[:, None] / 9
    return light


if __name__ == "__main__":
    show(__file__, "pillars", estimator, viewing_rays=1)
