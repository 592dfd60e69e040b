"""Exercise 7 · two strategies, one light

One sample toward a point of a light, one into a direction with density cos θ/π: each alone is right, so their sum
counts all light twice. Weights w₁ + w₂ = 1 mend it, each a function of the direction; the balance heuristic (Veach and
Guibas 1995) gives each strategy its share of the density, so that none divides by a small number that the other would
have made large.

Fill the gap: what is the weight of a strategy that draws a direction with density `mine`, if the other draws it with
density `other`?

    python 7_mis_weight.py            your picture, 7_mis_weight.png, and how far it is from the right one
    antumbra check 7_mis_weight.py    is it right, and if not, which term is wrong?
"""

import numpy as np

from antumbra.lecture.exercises import show


def about(n, z, phi):
    """Unit vectors with n · ω = z, at the angle φ about n; n (N, 3), z and φ (N, 1)."""
    x = np.where(np.abs(n[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    t = np.cross(n, x)
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    return np.sqrt(1 - z**2) * (np.cos(phi) * t + np.sin(phi) * np.cross(n, t)) + z * n


def weight(mine, other):
    return np.ones_like(mine)  # GAP


def estimator(scene, at, u):
    n, pair = at.shading_normal, u(2)

    def cosine(wi):
        return np.maximum((n * wi).sum(axis=1), 0)

    s = scene.sample_light(at, u=u(3))
    cos = cosine(s.direction)
    free = ~scene.occluded(at, s.target)
    w = weight(s.pdf, cos / np.pi) * cos * free / s.pdf
    light = scene.brdf(at, at.wo, s.direction) * s.radiance * w[:, None]

    wi = about(n, np.sqrt(pair[:, :1]), 2 * np.pi * pair[:, 1:])
    found = scene.find_light(at, directions=wi)
    w = weight(cosine(wi) / np.pi, found.pdf) * np.pi
    return light + scene.brdf(at, at.wo, wi) * found.radiance * w[:, None]


if __name__ == "__main__":
    show(__file__, "cornell-box", estimator)
