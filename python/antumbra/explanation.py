"""One pixel taken apart: `Explanation`, with its viewing rays, receivers and rays to the lights."""

from __future__ import annotations

from typing import Any, NamedTuple

from antumbra.messages import Message

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
    """cos θ at the receiver."""
    cos_light: float
    """|cos θ′| at the light; 1 where it has no surface, NaN where a direction found it."""
    radiance: Triple
    """L_e [W·m⁻²·sr⁻¹]; for lights without size the irradiance at normal incidence [W/m²]."""
    brdf: Triple
    """f_r [1/sr]; for mirrors f_r · cos θ / pdf."""
    pdf: float
    """p(light) · p(ω_i) in solid angle at the receiver [1/sr]; for single directions p(light)."""
    weight: float
    """Its share against the other strategy (mis), times what a mistake adds."""
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


class Explanation:
    """A pixel with everything that makes it, as `Scene.explain` returns it.

    `pixel` (column, row); `size` of the whole picture; `value`: its radiance, the sum of what its rays bring, which is
    what a render with the same settings has; `viewing_rays`; `lights`: their names by number; `settings`: those that
    were given, as words; `messages`. `print` shows it as a table.
    """

    def __init__(
        self, name: str, pixel: tuple[int, int], found: dict[str, Any], given: dict[str, str]
    ) -> None:
        """Names what the core found."""
        self.name, self.pixel, self.settings = name, pixel, given
        self.size: tuple[int, int] = tuple(found["size"])
        self.value: Triple = tuple(found["value"])
        self.lights: list[str] = found["lights"]
        self.messages = [Message(*said) for said in found["messages"]]
        self.viewing_rays = [_viewing_ray(ray) for ray in found["viewing_rays"]]

    @property
    def light_rays(self) -> list[LightRay]:
        """All rays to the lights, viewing ray after viewing ray."""
        return [row for ray in self.viewing_rays for row in ray.light_rays]

    def as_dict(self) -> dict[str, Any]:
        """Plain dicts, lists and numbers; what is infinite or not a number is None."""
        rays = []
        for ray in self.viewing_rays:
            rows = [{key: _plain(x) for key, x in row._asdict().items()} for row in ray.light_rays]
            met = ray.receiver._asdict() if ray.receiver else None
            rays.append({**ray._asdict(), "receiver": met, "light_rays": rows})
        return {
            "scene": self.name,
            "pixel": self.pixel,
            "size": self.size,
            "settings": self.settings,
            "lights": self.lights,
            "value": self.value,
            "viewing_rays": rays,
            "messages": [message._asdict() for message in self.messages],
        }

    def __str__(self) -> str:
        """The whole table, 80 columns wide."""
        from antumbra._table import explained

        return explained(self)

    def __repr__(self) -> str:
        """`<Explanation pillars 320,240: 0.0413 0.0384 0.0339, 4 rays to lights>`."""
        value = " ".join(f"{c:.3g}" for c in self.value)
        rays = f"{len(self.light_rays):,} rays to lights"
        return f"<Explanation {self.name} {self.pixel[0]},{self.pixel[1]}: {value}, {rays}>"


def _viewing_ray(found: dict[str, Any]) -> ViewingRay:
    rows = [LightRay(**{key: _tuple(x) for key, x in row.items()}) for row in found["light_rays"]]
    met = found["met"] and Receiver(**{key: _tuple(x) for key, x in found["met"].items()})
    return ViewingRay(
        _tuple(found["origin"]), _tuple(found["direction"]), met, _tuple(found["emission"]), rows
    )


def _tuple(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and not abs(value) < float("inf") else value


def _sum(parts: list[Triple]) -> Triple:
    return (sum(p[0] for p in parts), sum(p[1] for p in parts), sum(p[2] for p in parts))
