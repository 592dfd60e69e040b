"""Figure 14: where the noise of one shadow ray comes from; the parts add up to what the renderer shows."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.causes import ESTIMATES, KNOWN, PAIRS, PLACES, SIZE, SQUARES, shares
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import PILLARS_VIEW, two_windows
from antumbra.lecture.sketches.causes import causes
from antumbra.lecture.stages import Part
from antumbra.lecture.stages.quantities import table_of

ONE = PILLARS_VIEW | {
    "estimator": "area", "lights": "uniform", "light_points": "area", "sampler": "random", "filter": "box",
    "viewing_rays": 1, "shadow_rays": 1, "size": SIZE,
}  # fmt: skip


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    white = run.white("one", share=98)
    one = run.picture(run.image("one").pixels, "One shadow ray a pixel: noise everywhere.", "one shadow ray", name="one",
                      white=white, noise=True)  # fmt: skip
    table = table_of(
        ("part of the variance", "share"), {words: (found[name],) for name, words in (SQUARES | PAIRS).items()},
        "Shares of the variance, mean over the picture", foot=("sum", "100 %"),
        note="Maps: standard deviation of one sample, all on one scale; of covariances the root with its sign: orange adds, blue takes away. "
        f"{ESTIMATES} independent estimates of {PLACES**2} places a pixel; each ± is of that row alone.",
    )  # fmt: skip
    return [causes(run, found, one), table]


FIGURE = Figure(
    number=14, chapter=4, title="Causes of noise", seconds=Pick(3, 100),
    question=Question("Two equal windows light the pillars. A sample draws one of them, and a point on it. What makes most of its noise?",
                      ("whether the point is seen", "which window it is on", "where on the window it lies"), 1, ("light",)),
    variants=[Variant("one", two_windows(), ONE, Pick(48, 128))],
    measure=shares, stage=_stage,
    answer=Number("light", "of the variance is the choice of the window, and only {visibility:1} visibility: ask both windows first."),
    equation=Equation(
        [(r"\text{Var} X = \text{E} \, \text{Var}(V g) + \mark{\text{Var} \, \bar{x}_{\text{light}}} + \text{Var} \, \bar{x}_{\text{pixel}}",
          "Var X = mean of Var(V g) + variance of the means of the lights + variance of the means of the places in the pixel"),
         (r"\text{Var}(V g) = \bar{g}^2 \, \text{Var} V + \bar{v}^2 \, \text{Var} g + \text{Var}\big((V - \bar{v})(g - \bar{g})\big) + 2 \textstyle\sum \text{Cov}",
          "Var(V g) = ḡ² Var V + v̄² Var g + Var((V − v̄)(g − ḡ)) + 2 · the sum of the covariances")],
        "Marked: the choice of the light. E: mean over lights and places. V and g = f L cos θ cos θ′ / (r² pdf) hang on the same point, so their product splits in four.",
    ),
    claims=[
        Claim("The parts add up to the variance of the rendered picture.", "adds", near=1.0, within=0.05, main=True,
              measured="rendered / sum of the parts: {adds}"),
        Claim("The choice of the window is more than half of it.", "light", above=0.5, measured="{light}"),
        Claim("Where the answer is known, under a disk light half hidden by a plate, one shadow ray has the variance 0.8225.",
              "half-whole", near=KNOWN["whole"], within=0.02, measured="{half-whole} W² m⁻⁴"),
        Claim("There, seen or not seen (V) makes three quarters of it.", "half-visibility", near=KNOWN["visibility"], within=0.02,
              measured="{half-visibility} of {half-whole:v} W² m⁻⁴"),
    ],
)  # fmt: skip
