"""A pixel and the rays that make it: plain facts."""

from __future__ import annotations

from typing import NamedTuple

Triple = tuple[float, float, float]


class LightRay(NamedTuple):
    """One ray from a receiver to a light, with every factor of what it brings.

    `brings` = V · `weight` · `radiance` · `brdf` · `cos` / (`pdf` · shadow rays · viewing rays).
    """

    by_direction: bool
    """It was drawn as a direction; else as a point of a light."""
    light: int | None
    """Number of the light; None where a direction found none."""
    direction: Triple
    """ω_i, unit length; 0 if the light does not shine here at all."""
    point: Triple | None
    """p′, where it ends; None at infinity."""
    distance: float
    """r; inf at infinity."""
    cos: float
    """|cos θ| at the receiver; 1 for mirrors, whose f_r holds it."""
    cos_light: float
    """|cos θ′| at the light; 1 where it has no surface, NaN where a direction found it."""
    radiance: Triple
    """L_e [W·m⁻²·sr⁻¹]; for lights without size the irradiance at normal incidence [W/m²]."""
    brdf: Triple
    """f_r [1/sr]; for mirrors f_r · cos θ / pdf."""
    pdf: float
    """p(light) · p(ω_i) in solid angle at the receiver [1/sr]; for single directions p(light)."""
    weight: float
    """Its share against the other strategy (mis), times what a mistake adds and what an alpha mask covers."""
    visible: bool | None
    """V; None = not asked, because nothing could be carried."""
    blocker: str | None
    """Name of the object that it meets first, if it is not free."""
    brings: Triple
    """What it adds to the pixel [W·m⁻²·sr⁻¹]."""

    @property
    def distance2(self) -> float:
        """r²."""
        return self.distance * self.distance


class Receiver(NamedTuple):
    """What a viewing ray meets."""

    position: Triple
    normal: Triple
    """Geometric unit normal on the viewer's side."""
    shading_normal: Triple
    distance: float
    """Along the viewing ray."""
    object: str
    material: str
    albedo: Triple
    """ρ."""


class ViewingRay(NamedTuple):
    """One viewing ray with everything that it finds."""

    origin: Triple
    direction: Triple
    receiver: Receiver | None
    """None: it meets nothing."""
    emission: Triple
    """What light that is seen itself (a lamp, the sky) adds to the pixel."""
    light_rays: list[LightRay]

    @property
    def brings(self) -> Triple:
        """What it adds to the pixel, all in all."""
        return _sum([self.emission, *(row.brings for row in self.light_rays)])


class Pixel:
    """A pixel with the rays that make it; `Explanation` says more."""

    name: str
    pixel: tuple[int, int]
    size: tuple[int, int]
    value: Triple
    settings: dict[str, str]
    lights: list[str]
    viewing_rays: list[ViewingRay]

    @property
    def light_rays(self) -> list[LightRay]:
        """All rays to the lights, viewing ray after viewing ray."""
        return [row for ray in self.viewing_rays for row in ray.light_rays]


def _sum(parts: list[Triple]) -> Triple:
    return (sum(p[0] for p in parts), sum(p[1] for p in parts), sum(p[2] for p in parts))
