"""The pieces of an estimator: viewing rays, points of lights, BSDFs. What `Scene` inherits of them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra import _core, settings
from antumbra._arrays import matching, places
from antumbra.errors import OptionError
from antumbra.hit import Hit, Receivers


class LightSamples(NamedTuple):
    """One drawn light point per receiver, as `Scene.sample_light` describes."""

    direction: NDArray[np.float32]
    target: NDArray[np.float64]
    distance: NDArray[np.float32]
    radiance: NDArray[np.float32]
    pdf: NDArray[np.float32]
    cos_light: NDArray[np.float32]
    light: NDArray[np.uint32]

    @property
    def pdf_area(self) -> NDArray[np.float32]:
        """p(light) · p(x) over the light's area [1/m²]: the density in solid angle times dω/dA = cos θ′ / r²."""
        return self.pdf * self.cos_light / self.distance**2


class LightsFound(NamedTuple):
    """What one direction per receiver finds, as `Scene.find_light` describes."""

    radiance: NDArray[np.float32]
    pdf: NDArray[np.float32]


# What light points heed; `threads` changes the time alone.
_HEEDED = ("lights", "light_points", "threads")


def _words(options: dict[str, Any]) -> list[tuple[str, str]]:
    """Options of light points; one light is drawn for each receiver, never all of them."""
    words = settings.words(options)
    for option in words.keys() - {*_HEEDED}:
        own = ": the scene's own lights are asked" if option in ("light", "environment") else ""
        raise OptionError(f"{option} is not heeded here{own}; {', '.join(_HEEDED)} are")
    if words.get("lights") == "all":
        raise OptionError(
            'lights = all: one light is drawn here; "uniform", "power" or "contribution" chooses it'
        )
    return [*words.items()]


class Pieces:
    """The methods of a scene that an estimator of one's own is made of."""

    _core: _core.Scene

    def camera_rays(
        self, size: tuple[int, int] | None = None, **options: Any
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """One viewing ray through the centre of each pixel: origins and unit directions, (H·W, 3) float64 each.

        `size` = (width, height), or the camera's own; options of the camera as in `render`. Row after row from the
        top: `x.reshape(height, width, 3)` is the picture.
        """
        return self._core.camera_rays(list(settings.words({"size": size, **options}).items()))

    def sample_light(
        self,
        points: ArrayLike | Hit | Receivers,
        normals: ArrayLike | None = None,
        u: ArrayLike | None = None,
        **options: Any,
    ) -> LightSamples:
        """Draws one light and one point of it for each receiver, from three numbers `u` (N, 3) in [0, 1) each.

        Gives `direction` ω_i (N, 3), `target` (N, 3), where the shadow ray ends, `distance` r (N,), `radiance` L_e
        (N, 3), `pdf` (N,): p(light) · p(ω_i) in solid angle at the receiver [1/sr], `cos_light` |cos θ′| (N,) and
        `light` (N,), its number. The density over the light's area is `pdf_area` = pdf · cos θ′ / r².
        Light that arrives = f · radiance · cos θ / pdf, if the segment to the target is free. Where no light can
        reach, radiance is 0, pdf and distance are 1; lights without size have p(light) as pdf and their irradiance as
        radiance.
        Options: `lights` (how one is chosen: "uniform", which is the default here, "power", "contribution"),
        `light_points`, `threads`; others raise OptionError.
        """
        if u is None:
            raise TypeError("u is missing: three numbers in [0, 1) per point are needed, (N, 3)")
        start, facing, count = places(points, normals)
        cube = matching("u", u, "points", count)
        words = _words(options)
        return LightSamples(*self._core.sample_light(start, facing, cube, words))

    def find_light(
        self,
        points: ArrayLike | Hit | Receivers,
        normals: ArrayLike | None = None,
        directions: ArrayLike | None = None,
        **options: Any,
    ) -> LightsFound:
        """What a ray from each receiver along its direction (N, 3) finds of the lights.

        Gives `radiance` L_e (N, 3) of what the ray meets first, 0 where that is no light, and `pdf` (N,) [1/sr]: how
        densely `sample_light` with the same options draws that direction, 0 where it finds none. Lights without size
        are never found. Options are those of `sample_light`.
        """
        if directions is None:
            raise TypeError("directions are missing: one per point is needed, (N, 3)")
        start, facing, count = places(points, normals)
        toward = matching("directions", directions, "points", count)
        words = _words(options)
        return LightsFound(*self._core.find_light(start, facing, toward, words))

    def brdf(self, hit: Hit | Receivers, wo: ArrayLike, wi: ArrayLike) -> NDArray[np.float32]:
        """f_r(ω_o, ω_i) [1/sr] at each receiver, (N, 3) float32, without the cosine.

        `wo`, `wi` (N, 3): unit vectors in world space, both away from the surface; 0 if they lie on different sides.
        """
        receivers = hit.receivers if isinstance(hit, Hit) else hit
        if not isinstance(receivers, Receivers):
            raise TypeError(f"hit is a {type(hit).__name__}: a Hit or its receivers are needed")
        out = matching("wo", wo, "receivers", len(receivers))
        return self._core.brdf(receivers._core, out, matching("wi", wi, "receivers", len(receivers)))
