"""Figure 4: visibility and intensity are both needed, and their product is not the shadow."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.points import fraction_at, irradiance_at
from antumbra.lecture.measures.ratio import excess, ratio, times
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import disk_over_floor
from antumbra.lecture.sketches.product import WIDTH, seen_times_unshadowed
from antumbra.lecture.stages import Strip

# The light that the numbers are of [m].
MARKED = 0.5
RADII = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.75, 0.9, 1.1, 1.3, 1.6, 2.0]
INSIDE, OUTSIDE = (0.3, 0.0, 0.0), (0.95, 0.0, 0.0)
# What closed forms say of R = 0.5 at x = 0.3: the lens of two disks, and the boundary integral of what is seen.
VISIBLE, TRUE, PRODUCT = 0.5376215, 0.0994152, 0.0955001
LOOK = {
    "estimator": "area", "light_points": "area", "viewing_rays": Pick(32, 256), "size": Pick((96, 96), (256, 256)),
    "aov": "visible-fraction,unshadowed-direct",
    "eye": (0.0, 0.98, 0.0), "look_at": (0.0, 0.0, 0.0), "up": (0.0, 0.0, -1.0), "fov": 2 * np.arctan(WIDTH / 2 / 0.98),
}  # fmt: skip


def _measure(run: Run) -> Mapping[str, Quantity]:
    scene, rays, seed = run.scene(disk_over_floor(MARKED)), run.pick(Pick(2**20, 2**24)), run.seeded(1)

    def light(at: tuple[float, ...], seed: int, **options: str) -> Quantity:
        return irradiance_at(scene, at, rays, seed, light_points="area", **options)

    seen, true = fraction_at(scene, INSIDE, rays, seed), light(INSIDE, seed + 1)
    more = ratio(true, times(seen, light(INSIDE, seed + 2, shadows="off")))
    lit = ratio(light(OUTSIDE, seed + 3), light(OUTSIDE, seed + 4, shadows="off"))
    return {"seen": seen, "true": true, "more": excess(more), "lit": excess(lit)}


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Strip]:
    return [seen_times_unshadowed(run, RADII, MARKED, INSIDE[0])]


FIGURE = Figure(
    number=4, chapter=1, title="Visibility times intensity", seconds=Pick(5, 120),
    question=Question(
        "A point of the floor sees the share V of the light, and without the occluder it would get E. Does it get V · E?",
        ("yes", "some per cent more or less", "less than half of it"), 1, ("more",),
    ),
    variants=[Variant(f"r{r:g}", disk_over_floor(r), LOOK) for r in RADII],
    measure=_measure, stage=_stage, exr=["r0.5"],
    answer=Number("more", "So much more than V · E arrives at x = 0.3 m, the ring in the pictures, under a light of radius R = 0.5 m. The half of the light that is "
        "still seen there is the half with the larger cosines.", before="+"),
    equation=Equation(
        [(r"\int_{A_L} \mark{V} \, \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A \;\neq\; \frac{1}{A_L}\int_{A_L} \mark{V} \, \text{d}A "
          r"\, \cdot \int_{A_L} \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A",
          "∫ V cos θ cos θ′ / r² dA ≠ (1/A ∫ V dA) · ∫ cos θ cos θ′ / r² dA")],
        "Marked: V stands under the integral. It may leave it only where it is the same for all points of the light.",
    ),
    claims=[
        Claim("At x = 0.3 m there is 4.1 % more light than V · E.", "more", near=TRUE / PRODUCT - 1, within=0.003, main=True,
              measured="{more}; the closed form says 4.1 %"),
        Claim("V is the share that two overlapping disks leave.", "seen", near=VISIBLE, within=0.002,
              measured="{seen}; the lens formula says 0.5376"),
        Claim("Where all of the light is seen, the product is right.", "lit", near=0.0, within=0.002,
              measured="{lit} off at x = 0.95 m"),
    ],
)  # fmt: skip
