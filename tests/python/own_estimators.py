"""Estimators as students write them: right ones, and ones with one term wrong each, with what the check says of it."""

from __future__ import annotations

import numpy as np


def cosine(at, direction):
    return np.maximum((at.shading_normal * direction).sum(axis=1), 0)


def area(scene, at, u):
    """L = f_r L_e V cos θ / p(ω), ω toward a point of a light."""
    s = scene.sample_light(at, u=u(3))
    f = scene.brdf(at, at.wo, s.direction)
    free = ~scene.occluded(at, s.target)
    return f * s.radiance * (cosine(at, s.direction) * free / s.pdf)[:, None]


def about(n, z, turn):
    """Unit vectors with n · ω = z, turned about n."""
    x = np.where(np.abs(n[:, :1]) < 0.9, [[1.0, 0, 0]], [[0, 1.0, 0]])
    t = np.cross(n, x)
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    r, phi = np.sqrt(1 - z**2), 2 * np.pi * turn
    return r * (np.cos(phi) * t + np.sin(phi) * np.cross(n, t)) + z * n


def toward(n, pair, even=False):
    """Unit vectors about n with density cos θ/π, or 1/(2π)."""
    return about(n, pair[:, :1] if even else np.sqrt(1 - pair[:, :1]), pair[:, 1:])


def hemisphere(scene, at, u):
    """L = f_r L_e cos θ / p(ω), ω with density cos θ/π."""
    wi = toward(at.shading_normal, u(2))
    return scene.brdf(at, at.wo, wi) * scene.find_light(at, directions=wi).radiance * np.pi


def cubed(scene, at, u):
    """ω with density 3 cos² θ/(2π): rarely toward a low lamp."""
    pair = u(2)
    z = np.cbrt(1 - pair[:, :1])
    wi = about(at.shading_normal, z, pair[:, 1:])
    return scene.brdf(at, at.wo, wi) * scene.find_light(at, directions=wi).radiance * (2 * np.pi / (3 * z))


def mis(scene, at, u):
    """Both, with the balance heuristic: each sample is divided by the sum of both densities."""
    s, wi = scene.sample_light(at, u=u(3)), toward(at.shading_normal, u(2))
    free, found = ~scene.occluded(at, s.target), scene.find_light(at, directions=wi)

    def term(direction, radiance, pdf, seen):
        cos = cosine(at, direction)
        f = scene.brdf(at, at.wo, direction)
        return f * radiance * (cos * seen / (pdf + cos / np.pi))[:, None]

    return term(s.direction, s.radiance, s.pdf, free) + term(wi, found.radiance, found.pdf, 1)


def spoiled(spoil):
    """`area` times `spoil(sample, cos θ)`."""

    def estimator(scene, at, u):
        s = scene.sample_light(at, u=u(3))
        f = scene.brdf(at, at.wo, s.direction)
        cos = cosine(at, s.direction)
        finite = np.where(np.isfinite(s.distance) & (s.distance > 0), s.distance, 1)
        free = ~scene.occluded(at, s.target)
        wrong = spoil(s._replace(distance=finite, cos_light=np.maximum(s.cos_light, 1e-6)), cos)
        return f * s.radiance * (cos * free / s.pdf * wrong)[:, None]

    return estimator


def no_shadow(scene, at, u):
    s = scene.sample_light(at, u=u(3))
    return scene.brdf(at, at.wo, s.direction) * s.radiance * (cosine(at, s.direction) / s.pdf)[:, None]


def beyond(scene, at, u):
    """Shadow rays go on behind the light (a little before its surface they would meet it)."""
    s = scene.sample_light(at, u=u(3))
    f = scene.brdf(at, at.wo, s.direction)
    dark = scene.occluded(at, s.target) | scene.occluded(
        s.target + 1e-3 * s.direction, directions=s.direction
    )
    return f * s.radiance * (cosine(at, s.direction) * ~dark / s.pdf)[:, None]


def endless(scene, at, u):
    s = scene.sample_light(at, u=u(3))
    f = scene.brdf(at, at.wo, s.direction)
    free = ~scene.occluded(at, directions=s.direction)
    return f * s.radiance * (cosine(at, s.direction) * free / s.pdf)[:, None]


def no_offset(scene, at, u):
    s = scene.sample_light(at, u=u(3))
    f = scene.brdf(at, at.wo, s.direction)
    free = ~scene.occluded(at.position, s.target)
    return f * s.radiance * (cosine(at, s.direction) * free / s.pdf)[:, None]


def reaching(share):
    """Shadow rays that end at `share` of the distance r."""

    def estimator(scene, at, u):
        s = scene.sample_light(at, u=u(3))
        f = scene.brdf(at, at.wo, s.direction)
        free = ~scene.occluded(at, directions=s.direction, max_distance=s.distance * share)
        return f * s.radiance * (cosine(at, s.direction) * free / s.pdf)[:, None]

    return estimator


def above(step):
    """Shadow rays that start a step above the surface, in scene units."""

    def estimator(scene, at, u):
        s = scene.sample_light(at, u=u(3))
        f = scene.brdf(at, at.wo, s.direction)
        free = ~scene.occluded(at.position + step * at.normal, s.target)
        return f * s.radiance * (cosine(at, s.direction) * free / s.pdf)[:, None]

    return estimator


def one_lamp_of_many(scene, at, u):
    """p(light) is left out."""
    s = scene.sample_light(at, u=u(3))
    count = len(scene.info()["lights"])
    f = scene.brdf(at, at.wo, s.direction)
    free = ~scene.occluded(at, s.target)
    return f * s.radiance * (cosine(at, s.direction) * free / s.pdf / count)[:, None]


def even(scene, at, u):
    """L = f_r L_e cos θ / p(ω), ω even over the hemisphere: few directions find a light."""
    wi = toward(at.shading_normal, u(2), even=True)
    light = scene.find_light(at, directions=wi).radiance
    return scene.brdf(at, at.wo, wi) * light * (cosine(at, wi) * 2 * np.pi)[:, None]


def even_over_cosine(scene, at, u):
    wi = toward(at.shading_normal, u(2), even=True)
    return scene.brdf(at, at.wo, wi) * scene.find_light(at, directions=wi).radiance * np.pi


def cosine_over_even(scene, at, u):
    wi = toward(at.shading_normal, u(2))
    light = scene.find_light(at, directions=wi).radiance
    return scene.brdf(at, at.wo, wi) * light * (cosine(at, wi) * 2 * np.pi)[:, None]


def both_in_full(scene, at, u):
    return area(scene, at, u) + hemisphere(scene, at, u)


def three_added(scene, at, u):
    return area(scene, at, u) + area(scene, at, u) + area(scene, at, u)


def grey(scene, at, u):
    """Its own albedo instead of the surface's."""
    s = scene.sample_light(at, u=u(3))
    free = ~scene.occluded(at, s.target)
    return 0.8 / np.pi * s.radiance * (cosine(at, s.direction) * free / s.pdf)[:, None]


def openness(scene, at, u):
    """(1/π) ∫ V cos θ dω, ω with density cos θ/π."""
    return 1.0 - scene.occluded(at, directions=toward(at.normal, u(2)))


def even_openness(scene, at, u):
    return 1.0 - scene.occluded(at, directions=toward(at.normal, u(2), even=True))


def openness_above(step):
    """Rays that start a step above the surface, in scene units."""

    def estimator(scene, at, u):
        return 1.0 - scene.occluded(at.position + step * at.normal, directions=toward(at.normal, u(2)))

    return estimator


RIGHT = [area, hemisphere, cubed, even, mis]
# Each with words of what the check must say.
WRONG = {
    "no cosine": (spoiled(lambda s, cos: 1 / np.maximum(cos, 1e-6)), "cos θ at the receiver is missing"),
    "cosine twice": (spoiled(lambda s, cos: cos), "cos θ at the receiver comes twice"),
    "no cosine at the light": (spoiled(lambda s, cos: 1 / s.cos_light), "cos θ′ at the light is missing"),
    "no distance": (spoiled(lambda s, cos: s.distance**2), "1/r² is missing"),
    "distance not squared": (spoiled(lambda s, cos: s.distance), "1/r stands where 1/r² should"),
    "distance cubed": (spoiled(lambda s, cos: 1 / s.distance), "1/r³ stands where 1/r² should"),
    "area measure": (spoiled(lambda s, cos: s.distance**2 / s.cos_light), "cos θ′/r² is missing"),
    "solid angle measure": (spoiled(lambda s, cos: s.cos_light / s.distance**2), "cos θ′/r² comes twice"),
    "counted twice": (both_in_full, "counts twice"),
    "three samples added": (three_added, "3 samples are added up"),
    "half": (spoiled(lambda s, cos: 0.5), "counts half"),
    "no π": (spoiled(lambda s, cos: np.pi), "the π is missing"),
    "even over cosine": (even_over_cosine, "directions drawn evenly"),
    "cosine over even": (cosine_over_even, "directions drawn with density cos θ/π"),
    "no shadow": (no_shadow, "V is missing"),
    "beyond the light": (beyond, "a wall behind the lamp"),
    "endless shadow rays": (endless, "blocked by the lamp itself"),
    "to the light itself": (reaching(1.0), "end at r exactly"),
    "almost to the light": (reaching(1 - 1e-6), "end at r exactly"),
    "a little beyond the light": (reaching(1.001), "blocked by the lamp itself"),
    "far before the light": (reaching(0.8), "end long before the light"),
    "an offset of 2 cm": (above(0.02), "too large an offset"),
    "an offset of half a metre": (above(0.5), "too large an offset"),
    "an offset higher than a lamp": (above(1.2), "too large an offset"),
    "no offset": (no_offset, "false shadow"),
    "p(light)": (one_lamp_of_many, "p(light) is missing"),
    "own albedo": (grey, "albedo"),
}
WRONG_OPENNESS = {
    "directions drawn evenly": (even_openness, "divided by the density cos θ/π of cosine-weighted ones"),
    "no offset": (openness_above(0.0), "false shadow"),
    "an offset of 2 cm": (openness_above(0.02), "too large an offset"),
    "an offset above a low wall": (openness_above(0.12), "too large an offset"),
}
