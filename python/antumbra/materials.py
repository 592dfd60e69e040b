"""How surfaces look: `Diffuse`, `Mirror`, `MetallicRoughness`. Colours are one number or three (linear, Rec. 709)."""

from __future__ import annotations

from dataclasses import dataclass

from antumbra._values import Color, Described, Fields, color, fraction


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


Material = Diffuse | Mirror | MetallicRoughness
