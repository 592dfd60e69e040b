"""A pixel and the rays that make it: arrays, of which a row is made when it is asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

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

    @property
    def pdf_area(self) -> float | None:
        """The same density per area of the light [1/m²], `pdf` · cos θ′ / r²; None where the light has no area."""
        found = self.pdf * self.cos_light / self.distance2 if self.distance > 0 else np.nan
        return found if self.point is not None and np.isfinite(found) else None


class LightRays(Sequence[LightRay]):
    """Rays to the lights, as `LightRay` one by one, or all at once: `array("cos")` is that of all, (N,) or (N, 3).

    In the arrays, what is not there is −1 (light, blocker, visible) or NaN (point).
    """

    def __init__(self, arrays: Mapping[str, NDArray[Any]], names: Sequence[str]) -> None:
        """`names`: of the objects, by the numbers of `blocker`."""
        self._arrays, self._names = arrays, names

    def array(self, name: str) -> NDArray[Any]:
        """What `LightRay` calls so, of all rays."""
        return self._arrays[name]

    def __len__(self) -> int:
        """How many."""
        return len(self._arrays["pdf"])

    @overload
    def __getitem__(self, index: int) -> LightRay: ...
    @overload
    def __getitem__(self, index: slice) -> LightRays: ...
    def __getitem__(self, index: int | slice) -> LightRay | LightRays:
        """One ray, or some of them."""
        if isinstance(index, slice):
            return LightRays({name: values[index] for name, values in self._arrays.items()}, self._names)
        row = {name: values[index].tolist() for name, values in self._arrays.items()}
        known = {name: _tuple(value) for name, value in row.items()}
        return LightRay(
            **{
                **known,
                "light": None if row["light"] < 0 else row["light"],
                "point": None if np.isnan(row["point"][0]) else known["point"],
                "visible": None if row["visible"] < 0 else bool(row["visible"]),
                "blocker": None if row["blocker"] < 0 else self._names[row["blocker"]],
            }
        )

    def __iter__(self) -> Iterator[LightRay]:
        """One by one."""
        return (self[i] for i in range(len(self)))


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
    light_rays: LightRays

    @property
    def brings(self) -> Triple:
        """What it adds to the pixel, all in all."""
        r, g, b = (np.asarray(self.emission) + self.light_rays.array("brings").sum(0)).tolist()
        return r, g, b


class ViewingRays(Sequence[ViewingRay]):
    """The viewing rays of a pixel, made one by one."""

    def __init__(self, found: Mapping[str, Any], light_rays: LightRays) -> None:
        """Of what the core found."""
        self._rays, self._met, self._names = found["viewing_rays"], found["receivers"], found["names"]
        self._first = np.concatenate([[0], np.cumsum(self._rays["rows"])])
        self._light_rays = light_rays

    def __len__(self) -> int:
        """How many."""
        return len(self._rays["met"])

    @overload
    def __getitem__(self, index: int) -> ViewingRay: ...
    @overload
    def __getitem__(self, index: slice) -> list[ViewingRay]: ...
    def __getitem__(self, index: int | slice) -> ViewingRay | list[ViewingRay]:
        """One viewing ray, or some of them."""
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        at = range(len(self))[index]
        origin, direction, emission = (
            _tuple(self._rays[n][at].tolist()) for n in ("origin", "direction", "emission")
        )
        rows = self._light_rays[int(self._first[at]) : int(self._first[at + 1])]
        return ViewingRay(origin, direction, self._receiver(int(self._rays["met"][at])), emission, rows)

    def _receiver(self, at: int) -> Receiver | None:
        if at < 0:
            return None
        known = {name: _tuple(values[at].tolist()) for name, values in self._met.items()}
        for name in ("object", "material"):
            known[name] = self._names[known[name]]
        return Receiver(**known)


class Pixel:
    """A pixel with the rays that make it; `Explanation` says more."""

    name: str
    pixel: tuple[int, int]
    size: tuple[int, int]
    value: Triple
    settings: dict[str, str]
    lights: list[str]
    viewing_rays: ViewingRays
    light_rays: LightRays
    """All rays to the lights, viewing ray after viewing ray."""


def _tuple(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value
