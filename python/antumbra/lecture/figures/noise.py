"""Figure 14: where the noise of one shadow ray comes from; the parts add up to what the renderer shows."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures import decompose
from antumbra.lecture.measures.replicates import mean_of, of_interval
from antumbra.lecture.pictures import luminance
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import half_hidden_disk, two_windows
from antumbra.lecture.stages import Panel, Part, Row, Table, Tabs
from antumbra.study import statistics

NAMES = {
    "light": "which light", "visibility": "visibility", "geometry": "geometry", "interaction": "V with g",
    "covariances": "covariances", "place": "pixel",
}  # fmt: skip
SIZE, VIEW = Pick((60, 42), (240, 168)), {"eye": (-7.4, 5.6, 5.4), "look_at": (0.3, 0.55, 0.3), "fov": 0.5}
ONE = {
    "estimator": "area", "lights": "uniform", "light_points": "area", "sampler": "random", "filter": "box",
    "viewing_rays": 1, "shadow_rays": 1, "size": SIZE,
}  # fmt: skip


def _parts(run: Run, replicate: int) -> decompose.Parts:
    scene, count = run.scene(two_windows()), run.pick(Pick(8, 16))
    found: decompose.Parts = run.once(
        replicate,
        lambda: decompose.of_picture(scene, run.pick(SIZE), 4, count, run.seeded(replicate), **VIEW),
    )
    return found


def _shares(run: Run) -> dict[str, Quantity]:
    all_parts = [_parts(run, r) for r in range(4)]
    each = {n: [getattr(p, n).mean() / p.whole.mean() for p in all_parts] for n in NAMES}
    return {name: mean_of(values, "%") for name, values in each.items()}


def _measure(run: Run) -> Mapping[str, Quantity]:
    whole = statistics.mean([_parts(run, r).whole.mean() for r in range(4)])
    rendered = statistics.variance([luminance(image.pixels) for image in run.images("one")])
    half = decompose.of_point(
        run.scene(half_hidden_disk()), (0, 0, 0), (0, 1, 0), run.pick(Pick(2**17, 2**21)), run.seeded(9)
    )
    return _shares(run) | {
        "adds": of_interval(statistics.ratio(rendered, whole)),
        "half": mean_of(half.whole),
        "seen": mean_of(half.visibility),
    }


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    found, white = _parts(run, 0), run.white("one", share=98)
    high = float(np.quantile(np.sqrt(found.whole), 0.99))
    total = run.map(
        np.sqrt(found.whole),
        "The noise of all causes together.",
        "all together",
        name="all",
        ramp="amber",
        high=high,
    )
    one = run.picture(run.image("one").pixels, "One shadow ray a pixel: noise everywhere.", "one shadow ray", name="one",
                      white=white, noise=True)  # fmt: skip
    panels = []
    for name, text in NAMES.items():
        part, caption = getattr(found, name), f"this cause: {measured[name]:1}"
        root = np.sign(part) * np.sqrt(np.abs(part))
        ramp, low = ("signed", -high) if name == "covariances" else ("amber", 0.0)
        alt = f"{text}: {measured[name]:v} of the variance."
        picture = run.map(root, alt, caption, name=name, ramp=ramp, low=low, high=high, noise=True)
        panels.append(Panel(name, text, [Row([one, total, picture])]))
    note = "Maps: standard deviation of one sample, all on one scale; covariances: orange adds, blue takes away. "
    rows = [[NAMES[name], f"{share:1}"] for name, share in measured.items() if name in NAMES]
    table = Table(("part of the variance", "share"), rows, "Shares of the variance, mean over the picture", foot=("sum", "100 %"),
        note=note + "Four independent estimates of 16 places a pixel; each ± is of that row alone.")  # fmt: skip
    return [Tabs("cause", "Cause of the noise", panels), table]


FIGURE = Figure(
    number=14, chapter=4, title="Causes of noise", seconds=Pick(7, 90),
    question=Question("Two equal windows light the pillars. A sample draws one of them, and a point on it. What makes most of its noise?",
                      ("whether the point is seen", "which window it is on", "where on the window it lies"), 1),
    variants=[Variant("one", two_windows(), ONE | VIEW, Pick(48, 128))],
    measure=_measure, stage=_stage,
    answer=Number("light", "So much of the variance is the choice of the window. Visibility makes {visibility:1}, geometry {geometry:1}: "
        "ask both windows first."),
    equation=Equation(
        [(r"\text{Var} X = \overline{\text{Var}(V g)} + \mark{\text{Var} \, \bar{x}_{\text{light}}} + \text{Var} \, \bar{x}_{\text{pixel}}",
          "Var X = mean of Var(V g) + variance of the means of the lights + variance of the means of the places in the pixel"),
         (r"\text{Var}(V g) = \bar{g}^2 \, \text{Var} V + \bar{v}^2 \, \text{Var} g + \text{Var}\big((V - \bar{v})(g - \bar{g})\big) + 2 \textstyle\sum \text{Cov}",
          "Var(V g) = ḡ² Var V + v̄² Var g + Var((V − v̄)(g − ḡ)) + 2 · the sum of the covariances")],
        "Marked: the choice of the light. V and g = f L cos θ cos θ′ / (r² pdf) hang on the same point, so their product splits in four.",
    ),
    claims=[
        Claim("The parts add up to the variance of the rendered picture.", "adds", near=1.0, within=0.05, main=True,
              measured="rendered / sum of the parts: {adds}"),
        Claim("A half-hidden disk has the variance of the closed form.", "half", near=0.8224670334, within=0.02,
              measured="{half}; the closed form says 0.8225"),
        Claim("Three quarters of that disk's variance are visibility.", "seen", near=0.75 * 0.8224670334, within=0.02, measured="{seen} of {half:v}"),
    ],
)  # fmt: skip
