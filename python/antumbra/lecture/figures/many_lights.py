"""Figure 21: a shadow ray to each of many lights, or one for all of them."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.many_lights import LAMPS, MOST, RAYS, WAYS, of_lamps
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.scenes.point_lights import VARIANCES
from antumbra.lecture.sketches.many_lights import lamps, plot, table
from antumbra.lecture.stages import Part, Plot

SHOWN = [1, 2, 3, 5, 10, 20, 30, 50, 100, 200, 400, 1000]
LOOK = {
    "estimator": "area", "sampler": "random", "viewing": "centre", "viewing_rays": 1, "size": Pick((40, 30), (120, 90)),
    "eye": (1.0, 5.5, 7.2), "look_at": (0.1, 0.3, 0.4), "fov": 0.72, "aov": ["emission"],
}  # fmt: skip
FINE = {"size": Pick((40, 30), (200, 150))}


def _variants() -> list[Variant]:
    def of(key: str, k: int, way: str, rays: int, replicates: int | Pick) -> Variant:
        look = LOOK | {"lights": way, "shadow_rays": rays} | (FINE if key else {})
        return Variant(f"{key}{way}-{k}", builtin("many-lights", lights=k), look, replicates)

    seen = [of("seen-", k, way, 1, 1) for k in SHOWN for way in ("uniform", "contribution", "all")]
    timed = [
        of("", k, way, 1 if way == "all" else RAYS, Pick(6 * (k in LAMPS.quick), 6))
        for k in LAMPS.full for way in WAYS if k <= MOST or way != "all"
    ]  # fmt: skip
    return [*seen, *timed]


# fmt: off
def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    note = "Bars: of the noise 95 %, of the time the range of the pictures. A ray to each up to 1,000 lamps; beyond, a forecast: time with the number " \
        "of lamps, noise as it is. At least one ray, or one pass over all lamps."
    return [lamps(run, SHOWN), Plot(plot(run, found), note, table(run, found))]
# fmt: on


FIGURE = Figure(
    number=21, chapter=5, title="A thousand lamps", seconds=Pick(6, 250),
    question=Question("One shadow ray to each of 1,000 lamps. Instead, each ray may go to a lamp drawn at random, all alike. How many rays have as little noise?",
                      ("1,000", "about 5,000", "more than 20,000"), 2, ("alike",)),
    variants=_variants(), measure=of_lamps, stage=_stage, exr=["all-1000", "contribution-1000"],
    answer=Number("alike", "With lamps drawn by what each would give unshadowed, {chosen:1} are enough: one such ray shows the picture, "
        "with {noise-contribution-1000:1} noise."),
    equation=Equation([(r"L_o \approx \frac{1}{N} \sum_{j=1}^{N} \frac{f_r \, L_e \, V \, \cos\theta \, \cos\theta'}{\mark{P(k_j)} \, \text{pdf}(p'_j) \, r^2}",
                        "L_o ≈ (1/N) · sum over N shadow rays of f_r L_e V cos θ cos θ′ / (P(k) pdf r²)")],
                      "Marked: how likely lamp k was to be drawn: one in 1,000, or its power, or its light here, over that of all."),
    claims=[
        Claim("Rays to lamps drawn alike: more than 20,000 for the noise of one to each of 1,000.", "alike", above=20, main=True, measured="{alike}"),
        Claim("By contribution, fewer rays than one to each that may light the place.", "chosen", below="traced",
              measured="{chosen}, to each {traced:v}; means agree, {same}"),
        Claim("For a noise of 10 %, rays by contribution take less time than one to each.", f"cost-contribution-{MOST}", below=f"cost-all-{MOST}",
              measured=f"{{cost-contribution-{MOST}:v}} a pixel, to each {{cost-all-{MOST}:v}}"),
        Claim(f"Under 1,000 points the variance of a ray is as known: {VARIANCES['uniform']:,.0f} alike, {VARIANCES['power']:,.0f} by power.", "closed",
              near=1.0, within=0.05, measured="the farther one: {closed} of it"),
    ],
)  # fmt: skip
