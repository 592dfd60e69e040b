"""Exercise 4 · a lamp far away

The same area form, L = ∫ f_r L_e V cos θ cos θ′ / r² dA. Radiance does not fall with the distance. Why is there an r²?

Fill the gap.

    python 4_distance.py            your picture, 4_distance.png, and how far it is from the right one
    antumbra check 4_distance.py    is it right, and if not, which term is wrong?
"""

import numpy as np

from antumbra.lecture.exercises import show

KIND = "lamps"


def estimator(scene, at, u):
    s = scene.sample_light(at, u=u(3), light_points="area")
    f = scene.brdf(at, at.wo, s.direction)
    cos = np.maximum((at.shading_normal * s.direction).sum(axis=1), 0)
    free = ~scene.occluded(at, s.target)
    falls = 1.0  # GAP
    geometry = cos * s.cos_light * falls
    return f * s.radiance * (geometry * free / s.pdf_area)[:, None]


if __name__ == "__main__":
    show(__file__, "cornell-box", estimator)
