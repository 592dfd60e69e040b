"""How surfaces look. Colours are one number or three (linear, Rec. 709), in [0, 1].

A `roughness` in [0, 1] is the perceptual one: GGX facets of α = roughness²; 0 is polished.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

from antumbra._values import Color, Described, Fields, color, fraction, within


@dataclass(frozen=True)
class Diffuse(Described):
    """f_r = ρ/π: the same radiance into every direction (Lambert).

    `albedo` ρ in [0, 1], one number or three.
    """

    albedo: Color = 0.5

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {"albedo": color("albedo", self.albedo)}


@dataclass(frozen=True)
class DiffuseTransmission(Described):
    """Paper, cloth, a leaf: light leaves evenly on both sides of a thin surface.

    `reflectance` ρ and `transmittance` τ in [0, 1], one number or three: f_r is ρ/π on the side of the light and τ/π on
    the other. Where ρ + τ is above 1, both are scaled down.
    """

    reflectance: Color = 0.25
    transmittance: Color = 0.25

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "reflectance": color("reflectance", self.reflectance),
            "transmittance": color("transmittance", self.transmittance),
        }


@dataclass(frozen=True)
class Mirror(Described):
    """A perfect mirror.

    `reflectance` in [0, 1], one number or three: the share of light reflected.
    """

    reflectance: Color = 1.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {"reflectance": color("reflectance", self.reflectance)}


@dataclass(frozen=True)
class MetallicRoughness(Described):
    """glTF's metallic-roughness model: GGX microfacets with visible normals over a diffuse base.

    `base` colour in [0, 1], one number or three; `metallic` 0 (dielectric) to 1 (metal); perceptual `roughness` 0 to
    1, α = roughness².
    """

    base: Color = 0.8
    metallic: float = 0.0
    roughness: float = 0.5

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "base": color("base", self.base),
            "metallic": [fraction("metallic", self.metallic)],
            "roughness": [fraction("roughness", self.roughness)],
        }


@dataclass(frozen=True)
class ClearCoat(Described):
    """glTF's metallic-roughness model under a clear coat (KHR_materials_clearcoat): varnish, car paint.

    `base`, `metallic` and `roughness` as in `MetallicRoughness`; the share `strength` of the surface lies under a coat
    of the index of refraction 1.5 and the perceptual roughness `coat_roughness`. It gives back at most the light that
    it gets.
    """

    base: Color = 0.8
    metallic: float = 0.0
    roughness: float = 0.5
    strength: float = 1.0
    coat_roughness: float = 0.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        shares = ("metallic", "roughness", "strength", "coat_roughness")
        return {
            "base": color("base", self.base),
            **{name: [fraction(name, getattr(self, name))] for name in shares},
        }


@dataclass(frozen=True)
class Principled(Described):
    """Disney's model as Mitsuba 3 has it (Burley 2012 and 2015): a base, facets, glass, sheen and a clear coat.

    `base` colour in [0, 1], one number or three; `ior` from 0.1 to 10; every other number from 0 to 1. `metallic`,
    `roughness` (α = roughness²) and `anisotropic` say how the facets reflect, `spec_trans` how much of what is not
    metal is glass, `spec_tint` and `sheen_tint` how far a reflection takes the tint of the base. `clearcoat` is a
    second lobe, narrow where `clearcoat_gloss` is 1; `flatness` goes from a rough diffuse base to one that light
    wanders through.
    Its parts are added: a white base, or sheen, gives back up to a quarter more light than it gets.
    """

    base: Color = 0.5
    metallic: float = 0.0
    roughness: float = 0.5
    anisotropic: float = 0.0
    ior: float = 1.5
    spec_trans: float = 0.0
    spec_tint: float = 0.0
    sheen: float = 0.0
    sheen_tint: float = 0.0
    clearcoat: float = 0.0
    clearcoat_gloss: float = 0.0
    flatness: float = 0.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        names = [f.name for f in dataclasses.fields(self) if f.name not in ("base", "ior")]
        shares = {name: [fraction(name, getattr(self, name))] for name in names}
        return {"base": color("base", self.base), "ior": [within("ior", self.ior, 0.1, 10.0)], **shares}


@dataclass(frozen=True)
class Conductor(Described):
    """A metal that reflects by Fresnel's equations, polished or of GGX facets.

    `metal`: a chemical symbol (Ag, Al, Au, Be, Cr, Cu, Hg, Ir, K, Li, Mo, Na, Nb, Ni, Rh, Ta, TiN, V, VN, W), or the
    complex index of refraction as a pair (η, k), each one number or three.
    """

    metal: str | tuple[Color, Color] = "Al"
    roughness: float = 0.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        eta, k = _metal(self.metal) if isinstance(self.metal, str) else self.metal
        return {
            "eta": color("eta", eta),
            "k": color("k", k),
            "roughness": [fraction("roughness", self.roughness)],
        }


@dataclass(frozen=True)
class Dielectric(Described):
    """A body of glass or water, clear or of GGX facets: it reflects and refracts.

    `ior`: its index of refraction over that around it, 0.1 to 10. Shadow rays do not pass it; paths do.
    """

    ior: float = 1.5
    roughness: float = 0.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "ior": [within("ior", self.ior, 0.1, 10.0)],
            "roughness": [fraction("roughness", self.roughness)],
        }


@dataclass(frozen=True)
class ThinDielectric(Described):
    """A pane of glass without thickness: light goes straight through or is mirrored, between its faces too.

    `ior`: its index of refraction over that around it, 0.1 to 10. With a `roughness` GGX facets spread both about their
    directions. Shadow rays do not pass it; paths do.
    """

    ior: float = 1.5
    roughness: float = 0.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "ior": [within("ior", self.ior, 0.1, 10.0)],
            "roughness": [fraction("roughness", self.roughness)],
        }


@dataclass(frozen=True)
class Plastic(Described):
    """A clear coat, polished or of GGX facets, over a diffuse base; all light but what the base keeps comes back.

    `albedo` of the base, one number or three; `ior`: the coat's index of refraction over that outside, 0.1 to 10.
    `nonlinear`: light between coat and base takes the base's colour at each bounce, so that it deepens; else the colour
    stays as given.
    """

    albedo: Color = 0.5
    ior: float = 1.5
    roughness: float = 0.0
    nonlinear: bool = True

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "albedo": color("albedo", self.albedo),
            "ior": [within("ior", self.ior, 0.1, 10.0)],
            "roughness": [fraction("roughness", self.roughness)],
            "nonlinear": [float(self.nonlinear)],
        }


@dataclass(frozen=True)
class Blend(Described):
    """Two materials in one: light is reflected as by (1 − `weight`) of the `first` and `weight` of the `second`.

    Each ray meets one of the two, drawn by a hash of the ray, so that a picture of a blend is noisier than its parts.
    """

    first: Material
    second: Material
    weight: float = 0.5

    def fields(self) -> Fields:
        """Its own number; a scene adds the two materials."""
        return {"weight": [fraction("weight", self.weight)]}

    def parts(self) -> dict[str, Material]:
        """The materials that it is made of."""
        return {"first": self.first, "second": self.second}


@dataclass(frozen=True)
class TwoSided(Described):
    """One material on the `front` of a surface, where its normal points, and another one on its `back`.

    Every other material looks alike from both sides.
    """

    front: Material
    back: Material

    def fields(self) -> Fields:
        """No numbers of its own; a scene adds the two materials."""
        return {}

    def parts(self) -> dict[str, Material]:
        """The materials that it is made of."""
        return {"front": self.front, "back": self.back}


Material = (
    Diffuse
    | DiffuseTransmission
    | Mirror
    | MetallicRoughness
    | ClearCoat
    | Principled
    | Conductor
    | Dielectric
    | ThinDielectric
    | Plastic
    | Blend
    | TwoSided
)


def _metal(name: str) -> tuple[list[float], list[float]]:
    from antumbra import _core

    known = _core.metals()
    found = {symbol.lower(): (eta, k) for symbol, eta, k in known}.get(name.lower())
    if found is None:
        symbols = ", ".join(symbol for symbol, _, _ in known)
        raise ValueError(f'there is no metal "{name}"; there are: {symbols}')
    return found
