"""Figure 8: one pixel taken apart, ray by ray."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from antumbra.lecture.chapters import SUM
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.pixel_rays import rays_of_pixel
from antumbra.lecture.measures.points import irradiance_at
from antumbra.lecture.measures.ratio import excess, ratio, times
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.three_pillars import ALBEDO, AREA, PIXEL, VIEW, three_pillars
from antumbra.lecture.sketches.pixel import shadow_rays_linked
from antumbra.lecture.stages import Linked

CELLS, TIMES = 3, 200
ONE: dict[str, Any] = VIEW | {
    "estimator": "area", "light_points": "area", "sampler": "stratified", "viewing": "centre", "viewing_rays": 1,
    "shadow_rays": CELLS**2,
}  # fmt: skip


def _measure(run: Run) -> Mapping[str, Quantity]:
    rays, light = rays_of_pixel(run, CELLS, ONE), Quantity(ALBEDO / np.pi)
    many = {"rays": run.pick(Pick(2**20, 2**25)), "seed": run.seeded(1)}
    found = irradiance_at(
        run.scene(three_pillars), rays.p, **many, estimator="hemisphere", directions="cosine"
    )
    true, value = times(light, found), float(rays.brings.sum())
    again = [float(image.pixels[0, 0, 0]) for image in run.images("pixel")]
    noise = float(np.std(again, ddof=1))
    factors = {"cos": rays.cos, "cos_light": rays.cos_light, "squared": rays.squared}
    return {
        **{
            f"varies_{name}": Quantity(float(np.std(f) / np.mean(f)), unit="%") for name, f in factors.items()
        },
        "value": Quantity(value, 1.96 * noise, "W·m⁻²·sr⁻¹", f"error of nine rays: {TIMES} replicates"),
        "integral": true,
        "sum": excess(Quantity(value / again[0])),
        "mean": excess(ratio(mean_of(again), true)),
        "rule": ratio(Quantity(noise, 1.96 * noise / np.sqrt(2 * TIMES)), true, unit="%"),
        "pdf": Quantity(float(abs(rays.pdf * AREA - 1).max())),
    }


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Linked]:
    return [shadow_rays_linked(run, "scene", rays_of_pixel(run, CELLS, ONE), CELLS)]


FIGURE = Figure(
    number=8, chapter=2, title="One pixel, ray by ray", seconds=Pick(2, 25),
    question=Question(
        "Nine shadow rays leave this pixel, one to each cell of the light, and some are blocked. How far is their sum from the integral, as a rule?",
        ("by 2 %", "by 20 %", "by 60 %"), 1, ("rule",),
    ),
    variants=[
        Variant("scene", three_pillars, {"estimator": "area", "viewing_rays": Pick(4, 64), "shadow_rays": 4} | VIEW),
        Variant("pixel", three_pillars, ONE | {"crop": (*PIXEL, 1, 1)}, replicates=TIMES),
    ],
    measure=_measure, stage=_stage, exr=["scene"],
    answer=Number("rule", "of the integral: so far nine rays miss it, as a rule. These say {value}, it is {integral:1}. "
        "From ray to ray cos θ varies by {varies_cos}, r² by {varies_squared}, cos θ′ by {varies_cos_light}; V jumps."),
    equation=Equation([SUM], "Marked: one row of the table. Everything outside the mark is the same for all nine rays."),
    claims=[
        Claim("The rows add up to the pixel.", "sum", near=0.0, within=1e-5, main=True, measured="{sum} off the same pixel of the picture"),
        Claim("Nine rays are right on average.", "mean", near=0.0, within=0.05, measured=f"mean of {TIMES} such sums: " + "{mean} off random directions"),
        Claim("As a rule nine rays miss by 10 to 30 %.", "rule", near=0.2, within=0.1, measured="standard error {rule} of the pixel, 200 replicates"),
    ],
)  # fmt: skip
