"""Figure 8: one pixel taken apart, ray by ray."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.chapters import SUM
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.points import irradiance_at
from antumbra.lecture.measures.ratio import excess, ratio, times
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.sketches.pixel import Drawn, projector, rays_over
from antumbra.lecture.stages import Linked, Table
from antumbra.lecture.three_pillars import AREA, CORNER, PIXEL, RADIANCE, VIEW, U, V, three_pillars

CELLS, TIMES = 3, 200
ONE: dict[str, Any] = {
    "estimator": "area",
    "light_points": "area",
    "sampler": "stratified",
    "viewing": "centre",
    "viewing_rays": 1,
    "shadow_rays": CELLS**2,
} | VIEW
# f_r of the floor, times what the light sends.
BRDF_LIGHT = 0.6 / np.pi * RADIANCE


Array = NDArray[np.float64]


class Rays(NamedTuple):
    """The factors of all rays (N,) from the receiver p, computed anew from the points; cell after cell of the light."""

    p: Array
    points: Array
    free: NDArray[np.bool_]
    cos: Array
    cos_light: Array
    squared: Array
    pdf: Array

    @property
    def brings(self) -> Array:
        """What each adds to the pixel."""
        found: Array = (
            BRDF_LIGHT / len(self.free) * self.free * self.cos * self.cos_light * AREA / self.squared
        )
        return found


def _rays(run: Run) -> Rays:
    found = run.scene(three_pillars).explain(PIXEL, seed=run.seeded(0), **ONE)
    [met] = [ray.receiver for ray in found.viewing_rays if ray.receiver]
    p = np.array(met.position)
    points = np.array([ray.point for ray in found.light_rays])
    cells = [np.floor(CELLS * ((points - CORNER) @ edge) / (edge @ edge)) for edge in (U, V)]
    rays = [found.light_rays[n] for n in np.lexsort(cells)]
    along = np.array([ray.point for ray in rays]) - p
    squared = np.sum(along**2, 1)
    cos_light = abs(along @ np.cross(U, V)) / AREA / np.sqrt(squared)
    # The renderer has its density in solid angle: 1/A is pdf cos θ′ / r².
    pdf = np.array([ray.pdf for ray in rays]) * cos_light / squared
    return Rays(
        p,
        along + p,
        np.array([ray.visible for ray in rays]),
        along[:, 1] / np.sqrt(squared),
        cos_light,
        squared,
        pdf,
    )


def _measure(run: Run) -> Mapping[str, Quantity]:
    scene, rays = run.scene(three_pillars), _rays(run)
    value, pixel = float(rays.brings.sum()), float(run.image("pixel").pixels[0, 0, 0])
    light = Quantity(0.6 / np.pi)
    options = {"estimator": "hemisphere", "directions": "cosine"}
    true = times(light, irradiance_at(scene, rays.p, run.pick(Pick(2**20, 2**25)), run.seeded(1), **options))
    again = [float(image.pixels[0, 0, 0]) for image in run.images("pixel")]
    noise = float(np.std(again, ddof=1))
    spread = {
        f"varies_{name}": Quantity(float(np.std(factor) / np.mean(factor)), unit="%")
        for name, factor in (("cos", rays.cos), ("cos_light", rays.cos_light), ("squared", rays.squared))
    }
    return spread | {
        "value": Quantity(value, 1.96 * noise, note=f"error of nine rays: {TIMES} replicates"),
        "integral": true,
        "missed": Quantity(abs(value - true.value), true.error),
        "sum": excess(Quantity(value / pixel)),
        "score": Quantity(abs(value - true.value) / noise),
        "rule": ratio(Quantity(noise, 1.96 * noise / np.sqrt(2 * TIMES)), true, unit="%"),
        "pdf": Quantity(float(abs(rays.pdf * AREA - 1).max())),
    }


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Linked]:
    scene, rays = run.scene(three_pillars), _rays(run)
    # A blocked ray is drawn to what it meets first.
    start = np.repeat(rays.p[None] + [0.0, 1e-4, 0.0], CELLS**2, 0)
    reached = np.minimum(scene.closest_hit(start, rays.points - start).t, 1.0)
    ends = start + reached[:, None] * (rays.points - start)
    rows = [
        [f"{n + 1}", "free" if rays.free[n] else "blocked", *(f"{factor[n]:.{places}f}" for factor, places in
          ((rays.cos, 3), (rays.cos_light, 3), (rays.squared, 2), (rays.pdf, 3), (rays.brings, 4)))]
        for n in range(CELLS**2)
    ]  # fmt: skip
    foot = ["sum = pixel", "", "", "", "", "", f"{rays.brings.sum():.4f}"]
    note = f"Contribution = f_r L_e / 9 · V cos θ cos θ′ / (pdf r²), f_r = 0.6/π, L_e = {RADIANCE:g}, pdf = 1/A = 1/{AREA:.2f}. Point at a row: its ray lights up. antumbra explain has such a table for any pixel."
    table = Table(
        ("ray", "V", "cos θ", "cos θ′", "r²", "pdf", "contribution"),
        rows,
        "The nine shadow rays of this pixel, factor by factor",
        foot,
        fine=(5,),
        note=note,
    )
    free = int(rays.free.sum())
    alt = f"Three pillars and a ball under a square light; the receiver lies in the penumbra of the tallest pillar, {free} of nine rays are free."
    picture = run.picture("scene", alt, white=1.05 * run.white("scene", share=90.0))
    overlay = rays_over(
        projector(**VIEW),
        VIEW["size"],
        (CORNER, U, V),
        CELLS,
        rays.p,
        [Drawn(*ray) for ray in zip(rays.points, ends, rays.free.tolist(), strict=True)],
    )
    return [Linked("ray", picture, overlay, table, "Green, dot: free. Orange, dashed, cross: blocked, drawn as far as it got. One random point in each cell.")]  # fmt: skip


FIGURE = Figure(
    number=8, chapter=2, title="One pixel, ray by ray", seconds=Pick(3, 25),
    question=Question(
        "Nine shadow rays leave this pixel, one to each cell of the light, and some are blocked. How far is their sum from the integral, as a rule?",
        ("by 2 %", "by 20 %", "by 60 %"), 1,
    ),
    variants=[
        Variant("scene", three_pillars, {"estimator": "area", "viewing_rays": Pick(4, 64), "shadow_rays": 4} | VIEW),
        Variant("pixel", three_pillars, ONE | {"crop": (*PIXEL, 1, 1)}, replicates=TIMES),
    ],
    measure=_measure, stage=_stage, exr=["scene"],
    answer=Number("value", "The integral is {integral:1}; nine rays miss it by {rule:v}, as a rule. "
        "From ray to ray cos θ varies by {varies_cos}, r² by {varies_squared}, cos θ′ by {varies_cos_light}; V jumps.", digits=2),
    equation=Equation([SUM], "Marked: one row of the table. Everything outside the mark is the same for all nine rays."),
    claims=[
        Claim("The rows add up to the pixel.", "sum", near=0.0, within=1e-5, main=True, measured="{sum} off the same pixel of the picture"),
        Claim("Nine rays agree with the integral within their error.", "score", below=1.96, measured="{score} standard errors from random directions"),
        Claim("Nine rays leave more than 10 %.", "rule", above=0.1, measured="standard error {rule} of the pixel, 200 replicates"),
    ],
)  # fmt: skip
