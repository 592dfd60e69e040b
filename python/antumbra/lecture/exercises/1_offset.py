"""Exercise 1 · where a shadow ray starts

The shadow rays below start at the numbers that stand for the point p. Those are rounded: the start lies a little above
the surface or a little below it, and from below, the surface shadows itself. Why do viewing rays not suffer?

Fill the gap: where must the shadow ray start? (One answer is a small step ε along the normal: which ε? Another is `at`
itself, which knows a start that is safe.)

    python 1_offset.py            your picture, 1_offset.png, and how far it is from the right one
    antumbra check 1_offset.py    is it right, and if not, which term is wrong?
"""

import numpy as np

from antumbra.lecture.exercises import show


def estimator(scene, at, u):
    s = scene.sample_light(at, u=u(3))
    f = scene.brdf(at, at.wo, s.direction)
    cos = np.maximum((at.shading_normal * s.direction).sum(axis=1), 0)
    start = at.position  # GAP
    free = ~scene.occluded(start, s.target)
    return f * s.radiance * (cos * free / s.pdf)[:, None]


if __name__ == "__main__":
    show(__file__, "cornell-box", estimator)
