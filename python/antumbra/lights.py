"""Lights for `Scene.add_light`. World space, angles in radians; colours are one number or three (linear, Rec. 709).

Area lights are surfaces: seen, hit, blocking and black. They shine from their front.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from antumbra._values import (
    Color,
    Described,
    Fields,
    Vector,
    color,
    direction,
    length,
    number,
    vector,
    within,
)

if TYPE_CHECKING:
    from datetime import datetime
    from os import PathLike

    import numpy as np
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Point(Described):
    """A point at `position` (3,) of radiant `intensity` I [W/sr], the same into every direction: E = I cos θ / r²."""

    position: Vector
    intensity: Color

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "position": vector("position", self.position),
            "intensity": color("intensity", self.intensity),
        }


@dataclass(frozen=True)
class Spot(Described):
    """A point that shines into a cone: full `intensity` [W/sr] up to the half-angle `inner`, none from `outer` on.

    `position` and `direction` (3,); `range`: the distance at which it has faded to nothing, or None.
    """

    position: Vector
    direction: Vector
    intensity: Color
    inner: float
    outer: float
    range: float | None = None

    def fields(self) -> Fields:
        """Its numbers by name."""
        outer = within("outer", self.outer, 1e-6, math.pi)
        fields = {
            "position": vector("position", self.position),
            "direction": direction("direction", self.direction),
            "intensity": color("intensity", self.intensity),
            "inner": [within("inner", self.inner, 0.0, outer)],
            "outer": [outer],
        }
        return fields if self.range is None else fields | {"range": [length("range", self.range)]}


@dataclass(frozen=True)
class Directional(Described):
    """Parallel light from infinity: `irradiance` [W/m²] of a surface that faces `to_light` (3,)."""

    to_light: Vector
    irradiance: Color

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "to_light": direction("to_light", self.to_light),
            "irradiance": color("irradiance", self.irradiance),
        }


@dataclass(frozen=True)
class Sun(Described):
    """A disc at infinity about `to_light` (3,): `half_angle` (the sun of the earth: 0.00465), `radiance`."""

    to_light: Vector
    half_angle: float
    radiance: Color

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "to_light": direction("to_light", self.to_light),
            "half_angle": [within("half_angle", self.half_angle, 1e-9, math.pi / 2)],
            "radiance": color("radiance", self.radiance),
        }


@dataclass(frozen=True)
class Rectangle(Described):
    """corner + s·u + t·v, s and t in [0, 1]; `corner`, `u`, `v` (3,). Shines from the side of u × v."""

    corner: Vector
    u: Vector
    v: Vector
    radiance: Color = 1.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "corner": vector("corner", self.corner),
            "u": direction("u", self.u),
            "v": direction("v", self.v),
            "radiance": color("radiance", self.radiance),
        }


@dataclass(frozen=True)
class Disk(Described):
    """A disk about `center` (3,) with `radius`; shines from the side of `normal` (3,), of any length.

    Its points are drawn evenly over its area, also with `light_points="solid-angle"`.
    """

    center: Vector
    normal: Vector
    radius: float
    radiance: Color = 1.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "center": vector("center", self.center),
            "normal": direction("normal", self.normal),
            "radius": [length("radius", self.radius)],
            "radiance": color("radiance", self.radiance),
        }


@dataclass(frozen=True)
class Triangle(Described):
    """A triangle `a`, `b`, `c` (3,) each; shines from the side of (b−a) × (c−a)."""

    a: Vector
    b: Vector
    c: Vector
    radiance: Color = 1.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        corners = {name: vector(name, getattr(self, name)) for name in "abc"}
        return corners | {"radiance": color("radiance", self.radiance)}


@dataclass(frozen=True)
class Sphere(Described):
    """A sphere about `center` (3,) with `radius`; shines outwards."""

    center: Vector
    radius: float
    radiance: Color = 1.0

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "center": vector("center", self.center),
            "radius": [length("radius", self.radius)],
            "radiance": color("radiance", self.radiance),
        }


@dataclass(frozen=True, eq=False)
class Environment:
    """Light from all around: a constant radiance (one number or three), a lat-long picture, or a file, times `scale`.

    A picture is (H, W, 3) float of linear radiance, row 0 at the top (+y); a direction is
    (sin φ sin θ, cos θ, −cos φ sin θ) with φ = 2πu, θ = πv. A file is the path of an EXR or HDR picture. `azimuth`
    [rad] turns it clockwise, seen from above: what stood in the north (−z) then stands there, π/2 is east (+x).
    `nearest`: each pixel is a patch of one radiance, instead of bilinear interpolation.
    """

    radiance: Color | ArrayLike | str | PathLike[str]
    scale: float = 1.0
    azimuth: float = 0.0
    nearest: bool = False

    def fields(self) -> Fields:
        """The constant radiance, where there is no picture."""
        scale = within("scale", self.scale, 0.0, math.inf)
        return {"radiance": [scale * c for c in color("radiance", cast("Color", self.radiance))]}

    def placed(self) -> tuple[float, float, bool]:
        """Scale, azimuth and `nearest` of a picture."""
        scale = within("scale", self.scale, 0.0, math.inf)
        return scale, within("azimuth", self.azimuth, -math.inf, math.inf), bool(self.nearest)


@dataclass(frozen=True)
class Sky(Described):
    """A clear sky with its sun: a dome (Hosek and Wilkie 2012) over a diffuse ground, and a disc as a second light.

    `elevation` of the sun, 0 to π/2, and `azimuth`, clockwise from north (−z) over east (+x) [rad]; `turbidity` 1 to
    10 (2 very clear, 3 clear, 6 hazy); `albedo` of the ground, 0 to 1; `distance` of the sun in astronomical units, for
    the size of its disc. Radiance is linear Rec. 709 of ∫ L(λ) x̄ȳz̄(λ) dλ [W·m⁻²·sr⁻¹]: its luminance times 683 is
    cd/m².
    """

    elevation: float
    azimuth: float = math.radians(225)
    turbidity: float = 3.0
    albedo: float = 0.3
    distance: float = 1.0

    @classmethod
    def at(
        cls, time: datetime, latitude: float, longitude: float, *, turbidity: float = 3.0, albedo: float = 0.3
    ) -> Sky:
        """The sky of a place, north and east positive [rad], at a `time` that knows its offset from UTC.

        The sun's place is right to 0.006°, plus what the air of the day does to a low sun. Raises ValueError at night.

        >>> import math
        >>> from datetime import UTC, datetime
        >>> noon = datetime(2026, 6, 21, 12, tzinfo=UTC)
        >>> round(math.degrees(Sky.at(noon, math.radians(51.48), 0.0).elevation), 1)
        62.0
        """
        from antumbra import _core

        if time.tzinfo is None:
            raise ValueError(f"{time.isoformat()} has no offset from UTC: +02:00 or Z is needed behind it")
        latitude = within("latitude", latitude, -math.pi / 2, math.pi / 2)
        longitude = within("longitude", longitude, -2 * math.pi, 2 * math.pi)
        elevation, azimuth, distance = _core.sun_position(time.timestamp(), latitude, longitude, 1010.0, 10.0)
        if elevation < 0:
            below = f"{-math.degrees(elevation):.2f}° below the horizon"
            raise ValueError(f"the sun stands {below} at {time.isoformat()}: a sky needs one above it")
        return cls(elevation, azimuth, turbidity, albedo, distance)

    def picture(self, width: int = 1024, *, sun: bool = True) -> NDArray[np.float32]:
        """As a lat-long picture, (width/2, width, 3) float32; `sun`: its disc drawn in, the energy kept."""
        from antumbra import _core

        return _core.sky(self.fields(), int(within("width", width, 2, 1 << 14)), sun)[0]

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "elevation": [within("elevation", self.elevation, 0.0, math.pi / 2)],
            "azimuth": [number("azimuth", self.azimuth)],
            "turbidity": [within("turbidity", self.turbidity, 1.0, 10.0)],
            "albedo": [within("albedo", self.albedo, 0.0, 1.0)],
            "distance": [within("distance", self.distance, 0.9, 1.1)],
        }


Light = Point | Spot | Directional | Sun | Rectangle | Disk | Triangle | Sphere | Environment | Sky
