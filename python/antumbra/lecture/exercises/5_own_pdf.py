"""Exercise 5 · a density of your own

The hemisphere form, L = ∫ f_r L_e cos θ dω, with directions that gather about the normal: z = cos θ = u^(1/3), and φ
even around it. Any density will do if the sample is divided by it, and if it is above zero where light may come from.

Fill the gap: with which density p(ω) per solid angle are these directions drawn? (P(cos θ < z) = z³, dω = dz dφ.)

    python 5_own_pdf.py            your picture, 5_own_pdf.png, and how far it is from the right one
    antumbra check 5_own_pdf.py    is it right, and if not, which term is wrong?
"""

import numpy as np

from antumbra.lecture.exercises import show


def about(n, z, phi):
    """Unit vectors with n · ω = z, at the angle φ about n; n (N, 3), z and φ (N, 1)."""
    x = np.where(np.abs(n[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    t = np.cross(n, x)
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    return np.sqrt(1 - z**2) * (np.cos(phi) * t + np.sin(phi) * np.cross(n, t)) + z * n


def estimator(scene, at, u):
    pair = u(2)
    z = np.cbrt(1 - pair[:, :1])
    wi = about(at.shading_normal, z, 2 * np.pi * pair[:, 1:])
    pdf = 1.0  # GAP
    light = scene.find_light(at, directions=wi).radiance
    return scene.brdf(at, at.wo, wi) * light * z / pdf


if __name__ == "__main__":
    show(__file__, "cornell-box", estimator)
