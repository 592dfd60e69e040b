"""Where an eclipse turns from total to annular, and how much of the sun is hidden."""

from __future__ import annotations

from collections.abc import Sequence

from antumbra.lecture.geometry import Bodies
from antumbra.lecture.measures.points import fraction_at
from antumbra.lecture.measures.regions import crossing, radii_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.scene import Scene


def tip_on_ground(run: Run, sky: Bodies, distances: Sequence[int], width: float) -> Quantity:
    """Distance of the moon [km] at which the umbra leaves the ground, by maps `ground-` of this width."""
    signed = {d: s for d in distances if (s := radii_of(run, f"ground-{d}", width).signed)}
    found = crossing(list(signed), list(signed.values()))
    # In single precision the ends of segments stand 2⁻²¹ of the sun's distance above its surface, 71 km.
    rim = sky.length(found.value) * 2**-21 * sky.unit / (sky.sun - sky.moon)
    note = f"spread about a line, {len(signed)} frames, and the rim of the sun in single precision"
    return Quantity(found.value, found.error + rim, "km", note)


def tip_in_map(run: Run, key: str, width: float) -> tuple[Quantity, Quantity]:
    """Radius of the umbra or antumbra, whichever there is, in a map `width` km wide, and how wide its pixels are."""
    found, pixels = radii_of(run, key, width), len(run.light(key))
    return Quantity(max(found.umbra, found.antumbra), 0.0, "km"), Quantity(width / pixels, 0.0, "km")


def hidden_share(run: Run, scene: Scene, sky: Bodies, beside: float, rays: int) -> Quantity:
    """Share of the sun that the moon hides from the ground `beside` km from the axis."""
    at = sky.on_ground(beside)
    seen = fraction_at(scene, at, rays, run.seeded(1), at / sky.earth)
    return Quantity(1 - seen.value, seen.error, "%", seen.note)
