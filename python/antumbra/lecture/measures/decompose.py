"""Where the variance of one shadow ray comes from: V and g of the light point, the choice of the light, the pixel.

One sample is X = V · g, with g = f_r L_e cos θ cos θ′ / (r² pdf), the pdf that of light and light point together. V
and g hang on the same light point: X − v̄ḡ = ḡ(V − v̄) + v̄(g − ḡ) + (V − v̄)(g − ḡ). Which light, and where in the
pixel, are added by the law of total variance:
Var X = E Var(X | place, light) + E Var(E[X | light] | place) + Var E[X | place].
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.pictures import luminance
from antumbra.scene import Scene


class Parts(NamedTuple):
    """Estimates of the parts of the variance of one sample, (…,) each; they add up to the whole."""

    visibility: NDArray[np.float64]
    """ḡ² Var V"""
    geometry: NDArray[np.float64]
    """v̄² Var g"""
    interaction: NDArray[np.float64]
    """Var (V − v̄)(g − ḡ)"""
    visibility_geometry: NDArray[np.float64]
    """2 Cov of ḡ(V − v̄) and v̄(g − ḡ); may be negative, as the next two."""
    visibility_interaction: NDArray[np.float64]
    """2 Cov of ḡ(V − v̄) and (V − v̄)(g − ḡ)"""
    geometry_interaction: NDArray[np.float64]
    """2 Cov of v̄(g − ḡ) and (V − v̄)(g − ḡ)"""
    light: NDArray[np.float64]
    """Var of E[X | light]"""
    place: NDArray[np.float64]
    """Var of E[X | place in the pixel]"""

    @property
    def covariances(self) -> NDArray[np.float64]:
        """The three covariances together."""
        total: NDArray[np.float64] = (
            self.visibility_geometry + self.visibility_interaction + self.geometry_interaction
        )
        return total

    @property
    def whole(self) -> NDArray[np.float64]:
        """Var X."""
        total: NDArray[np.float64] = np.sum(self, axis=0)
        return total


def parts(v: NDArray[Any], g: NDArray[Any]) -> Parts:
    """The parts from samples `v` (0 or 1) and `g` of shape (…, places, lights, samples), lights chosen all alike.

    Samples are random; the lights are all there are; the places stand for a pixel evenly. The whole is unbiased. Its
    split by V and g holds products of means, whose bias of order 1/samples the jackknife takes off (Quenouille 1956).
    """
    places, lights, samples = v.shape[-3:]
    x = v * g
    inside, means = x.var(-1, ddof=1), x.mean(-1)
    # The scatter of finitely many samples is in the scatter of their means, and comes off there.
    noise = inside.mean(-1) / samples
    light = (means.var(-1) - (lights - 1) / lights * noise).mean(-1)
    by_place = means.mean(-1)
    place = by_place.var(-1, ddof=1) - (noise / lights).mean(-1) if places > 1 else np.zeros(light.shape)
    return Parts._make([*_split(v, g), light, place])


def _split(v: NDArray[Any], g: NDArray[Any]) -> NDArray[np.float64]:
    """ḡ² Var V, v̄² Var g, Var (V − v̄)(g − ḡ), and 2 Cov of each two, averaged over places and lights: (6, …).

    Less the jackknife's estimate of their bias: from what they are without the first sample, the second, and so on.
    """
    n, v_mean, g_mean = v.shape[-1], v.mean(-1), g.mean(-1)
    x, y = v - v_mean[..., None], g - g_mean[..., None]
    sums = {(a, b): (x**a * y**b).sum(-1) for a, b in ((2, 0), (0, 2), (1, 1), (2, 1), (1, 2), (2, 2))}
    whole = _terms(v_mean, g_mean, sums, n)
    without = np.zeros_like(whole)
    for k in range(n):
        # The means of the rest, from those of all.
        p, q = -x[..., k] / (n - 1), -y[..., k] / (n - 1)
        rest = {(a, b): total - x[..., k] ** a * y[..., k] ** b for (a, b), total in sums.items()}
        without += _terms(v_mean + p, g_mean + q, _shifted(rest, p, q, n - 1), n - 1) / n
    found: NDArray[np.float64] = n * whole - (n - 1) * without
    return found


_Sums = dict[tuple[int, int], NDArray[np.float64]]


def _shifted(s: _Sums, p: NDArray[np.float64], q: NDArray[np.float64], n: int) -> _Sums:
    """Sums of (x − p)^a (y − q)^b over `n` samples whose means are p and q, from those of x^a y^b."""
    return {
        (2, 0): s[2, 0] - n * p * p,
        (0, 2): s[0, 2] - n * q * q,
        (1, 1): s[1, 1] - n * p * q,
        (2, 1): s[2, 1] - q * s[2, 0] - 2 * p * s[1, 1] + 2 * n * p * p * q,
        (1, 2): s[1, 2] - p * s[0, 2] - 2 * q * s[1, 1] + 2 * n * p * q * q,
        (2, 2): s[2, 2]
        - 2 * q * s[2, 1]
        - 2 * p * s[1, 2]
        + q * q * s[2, 0]
        + p * p * s[0, 2]
        + 4 * p * q * s[1, 1]
        - 3 * n * p * p * q * q,
    }


def _terms(v: NDArray[np.float64], g: NDArray[np.float64], s: _Sums, n: int) -> NDArray[np.float64]:
    """The six parts from the means of V and g and from sums of powers of their distances from these."""
    each = [
        g * g * s[2, 0],
        v * v * s[0, 2],
        s[2, 2] - s[1, 1] ** 2 / n,
        2 * v * g * s[1, 1],
        2 * g * s[2, 1],
        2 * v * s[1, 2],
    ]
    return np.stack([part.mean((-1, -2)) for part in each]) / (n - 1)


def of_picture(scene: Scene, size: tuple[int, int], side: int, count: int, seed: int, **camera: Any) -> Parts:
    """The parts for each pixel, (H, W): `side`² places of a pixel, `count` samples a light; 0 where nothing is seen."""
    width, height = size
    origins, directions = scene.camera_rays((width * side, height * side), **camera)
    # Rows of places of rows of pixels → a pixel and its places.
    order = np.arange(len(origins)).reshape(height, side, width, side).transpose(0, 2, 1, 3).ravel()
    origins, directions = origins[order], directions[order]
    hit = scene.closest_hit(origins, directions)
    seen = np.isfinite(hit.t)
    at, wo = hit.receivers[seen], -directions[seen]
    found = _samples(scene, at, None, lambda wi: scene.brdf(at, wo, wi), count, seed)
    whole = np.zeros((2, len(order), *found[0].shape[1:]))
    whole[:, seen] = found
    v, g = whole.reshape(2, height, width, side * side, *found[0].shape[1:])
    return parts(v, g)


def of_point(scene: Scene, point: Any, normal: Any, count: int, seed: int) -> Parts:
    """The parts for the irradiance at a point: 64 independent estimates, (64,), of `count` samples a light in all."""
    points, normals = (np.tile(np.asarray(x, np.float64), (count, 1)) for x in (point, normal))
    found = _samples(scene, points, normals, lambda wi: np.ones(wi.shape), 1, seed)
    v, g = (np.moveaxis(x.reshape(64, count // 64, -1), 1, 2)[:, None] for x in found)
    return parts(v, g)


def _samples(
    scene: Scene, at: Any, normals: Any, reflected: Callable[[Any], Any], count: int, seed: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """V and g of `count` random points of each light, for N receivers or points: (N, lights, count) each."""
    lights, n = len(scene.info()["lights"]), len(at)
    facing = at.normals if normals is None else normals
    random = np.random.default_rng(seed)
    v, g = np.empty((2, n, lights, count))
    for light in range(lights):
        for k in range(count):
            u = np.column_stack([np.full(n, (light + 0.5) / lights), random.random((n, 2))])
            drawn = scene.sample_light(at, normals, u, lights="uniform", light_points="area")
            cosine = np.maximum(np.einsum("ij,ij->i", facing, drawn.direction), 0.0)
            arriving = luminance((reflected(drawn.direction) * drawn.radiance)[None])[0]
            g[:, light, k] = arriving * cosine / drawn.pdf
            v[:, light, k] = ~scene.occluded(at, drawn.target)
    return v, g
