"""Figure 14: where the noise of one shadow ray comes from; the parts add up to what the renderer shows."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures import decompose
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.replicates import mean_of, of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import PILLARS_VIEW, half_hidden_disk, two_windows
from antumbra.lecture.stages import Part, Picture
from antumbra.lecture.stages.quantities import table_of, tabs_of
from antumbra.study import statistics

# Parts of the variance that are squares, and 2 Cov of each two of V, g and V·g.
SQUARES = {
    "light": "which light", "visibility": "visibility", "geometry": "geometry", "interaction": "V with g", "place": "pixel",
}  # fmt: skip
PAIRS = {
    "visibility_geometry": "2 Cov(V, g)", "visibility_interaction": "2 Cov(V, V with g)", "geometry_interaction": "2 Cov(g, V with g)",
}  # fmt: skip
SIZE, PARTS = Pick((60, 42), (240, 168)), 4
ONE = PILLARS_VIEW | {
    "estimator": "area", "lights": "uniform", "light_points": "area", "sampler": "random", "filter": "box",
    "viewing_rays": 1, "shadow_rays": 1, "size": SIZE,
}  # fmt: skip


def _parts(run: Run) -> list[decompose.Parts]:
    """Independent estimates of the parts."""
    scene, count, size = run.scene(two_windows()), run.pick(Pick(8, 16)), run.pick(SIZE)
    found: list[decompose.Parts] = run.once("parts", lambda: [
        decompose.of_picture(scene, size, 4, count, run.seeded(n), **PILLARS_VIEW) for n in range(PARTS)
    ])  # fmt: skip
    return found


def _measure(run: Run) -> Mapping[str, Quantity]:
    names = [*SQUARES, *PAIRS, "covariances"]
    whole = statistics.mean([parts.whole.mean() for parts in _parts(run)])
    rendered = statistics.variance(luminances(run, "one"))
    count, scene = run.pick(Pick(2**17, 2**21)), run.scene(half_hidden_disk())
    half = decompose.of_point(scene, (0, 0, 0), (0, 1, 0), count, run.seeded(9))
    return {
        **{n: mean_of([getattr(p, n).mean() / p.whole.mean() for p in _parts(run)], "%") for n in names},
        "adds": of_interval(statistics.ratio(rendered, whole)),
        "half": mean_of(half.whole),
        "seen": mean_of(half.visibility),
    }


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    parts, white = _parts(run)[0], run.white("one", share=98)
    high = float(np.quantile(np.sqrt(parts.whole), 0.99))

    def shown(name: str, words: str, signed: bool = False) -> Picture:
        part, ramp, low = getattr(parts, name), "signed" if signed else "amber", -high if signed else 0.0
        root, share = np.sign(part) * np.sqrt(np.abs(part)), f": {found[name]:1}" if name in found else ""
        return run.map(root, f"Standard deviation by pixel, {words}{share}.", f"{words}{share}", name=name.replace("_", "-"),
                       ramp=ramp, low=low, high=high, noise=True)  # fmt: skip

    one = run.picture(run.image("one").pixels, "One shadow ray a pixel: noise everywhere.", "one shadow ray", name="one",
                      white=white, noise=True)  # fmt: skip
    total = shown("whole", "all together")
    tabs = tabs_of("cause", "Cause of the noise", {
        **{name: (words, [one, total, shown(name, words)]) for name, words in SQUARES.items()},
        "covariances": ("covariances", [shown(name, words, signed=True) for name, words in PAIRS.items()]),
    })  # fmt: skip
    rows = {words: (found[name],) for name, words in (SQUARES | PAIRS).items()}
    table = table_of(
        ("part of the variance", "share"), rows, "Shares of the variance, mean over the picture", foot=("sum", "100 %"),
        note="Maps: standard deviation of one sample, all on one scale; covariances: orange adds, blue takes away. "
        f"{PARTS} independent estimates of 16 places a pixel; each ± is of that row alone.",
    )  # fmt: skip
    return [tabs, table]


FIGURE = Figure(
    number=14, chapter=4, title="Causes of noise", seconds=Pick(7, 90),
    question=Question("Two equal windows light the pillars. A sample draws one of them, and a point on it. What makes most of its noise?",
                      ("whether the point is seen", "which window it is on", "where on the window it lies"), 1),
    variants=[Variant("one", two_windows(), ONE, Pick(48, 128))],
    measure=_measure, stage=_stage,
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
        Claim("A half-hidden disk has the variance of the closed form.", "half", near=0.8224670334, within=0.02,
              measured="{half}; the closed form says 0.8225"),
        Claim("Three quarters of that disk's variance are visibility.", "seen", near=0.75 * 0.8224670334, within=0.02, measured="{seen} of {half:v}"),
    ],
)  # fmt: skip
