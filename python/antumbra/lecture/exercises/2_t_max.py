"""Exercise 2 · where a shadow ray ends

V(p, p′) asks whether anything lies *between* the receiver and the light. The shadow ray below is an endless ray toward
the light point: what lies behind the light blocks it too, and so does the light itself.

Fill the gap: how far may the ray go? (`s.distance` is the distance r of the light point. What happens at exactly r?)

    python 2_t_max.py            your picture, 2_t_max.png, and how far it is from the right one
    antumbra check 2_t_max.py    is it right, and if not, which term is wrong?
"""

import numpy as np

from antumbra.lecture.exercises import show


def estimator(scene, at, u):
    s = scene.sample_light(at, u=u(3))
    f = scene.brdf(at, at.wo, s.direction)
    cos = np.maximum((at.shading_normal * s.direction).sum(axis=1), 0)
    reach = np.inf  # GAP
    free = ~scene.occluded(at, directions=s.direction, max_distance=reach)
    return f * s.radiance * (cos * free / s.pdf)[:, None]


if __name__ == "__main__":
    show(__file__, "pillars", estimator)
