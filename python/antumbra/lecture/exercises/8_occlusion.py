"""Exercise 8 · how open is a point?

Ambient occlusion is the share of open directions, weighted by cos θ: AO = (1/π) ∫ V cos θ dω; 1 is open. With
directions drawn with density cos θ/π the sample is V alone: the cosine is in the density. The directions below are even
over the hemisphere, so that light from low down, which hardly counts, counts as much as light from above.

Fill the gap: which z = cos θ makes the density cos θ/π? (P(cos θ < z) = z².)

    python 8_occlusion.py            your picture, 8_occlusion.png, and how far it is from the right one
    antumbra check 8_occlusion.py    is it right, and if not, which term is wrong?
"""

import numpy as np

from antumbra.lecture.exercises import show

KIND = "occlusion"


def about(n, z, phi):
    """Unit vectors with n · ω = z, at the angle φ about n; n (N, 3), z and φ (N, 1)."""
    x = np.where(np.abs(n[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    t = np.cross(n, x)
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    return np.sqrt(1 - z**2) * (np.cos(phi) * t + np.sin(phi) * np.cross(n, t)) + z * n


def estimator(scene, at, u):
    pair = u(2)
    z = pair[:, :1]  # GAP
    wi = about(at.normal, z, 2 * np.pi * pair[:, 1:])
    return 1.0 - scene.occluded(at, directions=wi)


if __name__ == "__main__":
    show(__file__, "corner", estimator, right="ambient-occlusion", viewing_rays=64)
