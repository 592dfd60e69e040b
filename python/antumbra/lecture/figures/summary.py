"""Figure 26: every technique of the lecture on one scene: rays, time, error, efficiency."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.summary import COUNTS, WAYS, of_ways
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import PILLARS_VIEW, two_windows
from antumbra.lecture.sketches.summary import by_efficiency, one_by_one
from antumbra.lecture.stages import Part

LOOK = PILLARS_VIEW | {
    "size": Pick((60, 42), (160, 112)),
    "viewing": "centre",
    "viewing_rays": 1,
    "sampler": "random",
}
TRUTH = LOOK | {"estimator": "mis", "sampler": "owen", "shadow_rays": Pick(128, 1024)}
# Of all surfaces a coarse picture is off by 400 % a pixel: 4 % of the mean of 2,520 pixels and 4 pictures. Six times that:
# 3.2 for the interval of so few, and as much for the mean itself.
LOOSE = 0.25


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    return [one_by_one(run, found), by_efficiency(run, found)]


FIGURE = Figure(
    number=26, chapter=6, title="Every technique, one picture", seconds=Pick(5, 90),
    question=Question("Fourteen techniques, 64 samples a pixel each. How many times fewer samples than directions drawn evenly does the best one need for the same error?",
                      ("about 50", "about 500", "more than 5,000"), 2, ("fewer",)),
    variants=[
        Variant("truth", two_windows(), TRUTH, 4, truth=True),
        *(Variant(f"{key}-{n}", two_windows(), LOOK | way.of(n), 6) for key, way in WAYS.items() for n in COUNTS),
    ],
    measure=of_ways, stage=_stage, exr=["truth", "best-64"],
    answer=Number("fewer", "Points of the lights instead of directions, each light by itself, and well spread. By time it is {second-best:v} in this run.", before="÷ "),
    equation=Equation([(r"\varepsilon = \frac{1}{\mark{\text{Var}} \cdot \mark{t}}", "efficiency = 1 / (variance · time)")],
                      "Marked: twice the samples halve one and double the other, so ε stays; but for samplers that do better than random."),
    claims=[
        Claim("The best technique needs less than 1/5,000 of the samples.", "fewer", above=5, main=True, measured="1 in {fewer:1}"),
        Claim("The eleven that draw points of lights have the true mean.", "off-points", near=1.0, within=0.01, measured="farthest: {off-points:1}"),
        Claim("So have the three others, as far as their noise lets see.", "off-directions", near=1.0, within=LOOSE,
              measured="farthest: {off-directions:1}"),
        Claim("Under one square the four known variances are met.", "square", near=1.0, within=0.05,
              measured="farthest: {square:1} of it"),
    ],
)  # fmt: skip
