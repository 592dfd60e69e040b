"""Exercise 3 · a lamp seen from the side

The area form over the lights: L = ∫ f_r L_e V cos θ cos θ′ / r² dA, its points drawn with the density p(x) = 1/A over
the lamp's area (`s.pdf_area`). A lamp that is seen from the side covers less of the sky than one seen from the front.

Fill the gap: what is cos θ′? (`s.cos_light` has it. Why is it not needed with the density `s.pdf` in solid angle?)

    python 3_cos_light.py            your picture, 3_cos_light.png, and how far it is from the right one
    antumbra check 3_cos_light.py    is it right, and if not, which term is wrong?
"""

import numpy as np

from antumbra.lecture.exercises import show

KIND = "lamps"


def estimator(scene, at, u):
    s = scene.sample_light(at, u=u(3), light_points="area")
    f = scene.brdf(at, at.wo, s.direction)
    cos = np.maximum((at.shading_normal * s.direction).sum(axis=1), 0)
    free = ~scene.occluded(at, s.target)
    cos_light = 1.0  # GAP
    geometry = cos * cos_light / s.distance**2
    return f * s.radiance * (geometry * free / s.pdf_area)[:, None]


if __name__ == "__main__":
    show(__file__, "cornell-box", estimator)
