"""Figure 18: the rays of a pixel, split into viewing rays and shadow rays; bias and noise, and the split that is best."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.split import CROPS, MANY, RAYS, VIEWING, WIDTH, cost, key_of, measured
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import PILLARS_VIEW, builtin
from antumbra.lecture.sketches.split import advice, bias_and_noise, noise_plot, plot_note, splits
from antumbra.lecture.stages import Part, Plot, Tabs

LOOK = PILLARS_VIEW | {"estimator": "area", "light_points": "area", "filter": "box", "sampler": "random"}
WHOLE = LOOK | {"size": Pick((96, 68), (240, 168))}
# By directions and light points both, which are drawn in solid angle.
TRUTH = {"estimator": "mis", "light_points": "solid-angle", "sampler": "owen"}
# Viewing and shadow rays of each: those of 200 rays, and one through the centre.
SPLITS = {key_of(v): {"viewing_rays": v, "shadow_rays": RAYS // v - 1} for v in VIEWING} | {
    f"centre{n}": {"viewing": "centre", "viewing_rays": 1, "shadow_rays": n} for n in (100, RAYS - 1)
}
PARTS = {"one": {"viewing_rays": 1, "shadow_rays": 1}, "place": {"viewing_rays": 1, "shadow_rays": MANY}}


def _measure(run: Run) -> Mapping[str, Quantity]:
    found = measured(run, run.white("all-truth"))
    # The clock of a coarse run's few rays is noise.
    return found if run.quick else {**found, "took": cost(run, WHOLE)}


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    white = run.white("all-truth")
    tabs = Tabs("show", "What is shown", [splits(run, found, white), advice(run, found, white)])
    return [tabs, Plot(noise_plot(run, found, white), plot_note(run, found), bias_and_noise(found))]


FIGURE = Figure(
    number=18, chapter=5, title="200 rays for a pixel", seconds=Pick(8, 70),
    question=Question(
        "200 rays for each pixel: one viewing ray through its centre with 199 shadow rays, or 100 viewing rays with one each. Which has the smaller error?",
        ("1 × 199 everywhere", "100 × 1 everywhere", "100 × 1 at edges, 1 × 199 in penumbras"), 2, ("edge", "penumbra"),
    ),
    variants=[
        Variant("all-truth", builtin("pillars"), WHOLE | {"sampler": "owen", "viewing_rays": 16, "shadow_rays": 4}),
        *(Variant(f"{key}-all", builtin("pillars"), WHOLE | how, Pick(8, 24)) for key, how in PARTS.items()),
        *(
            Variant(f"{key}-{where}", builtin("pillars"), LOOK | {"size": (WIDTH, 168), "crop": crop} | how, count, truth)
            for where, crop in CROPS.items()
            for options, count, truth in (
                (SPLITS, Pick(8, 64), False), (PARTS, Pick(32, 256), False), ({"truth": TRUTH | {"viewing_rays": Pick(1024, 4096)}}, 4, True),
            )
            for key, how in options.items()
        ),
    ],
    measure=_measure, stage=_stage, exr=["all-truth"],
    answer=Number("edge", "At the edge 100 × 1 has so many times less error: a ray through the centre sees one side alone. "
        "In the penumbra it has {penumbra:1} times the error.", before="÷ "),
    equation=Equation(
        [(r"\text{Var} = \frac{1}{V} \left( \sigma_p^2 + \frac{\sigma_s^2}{\mark{N}} \right), \qquad \mark{N}^{*} = \sqrt{\frac{\sigma_s^2}{\sigma_p^2} \cdot \frac{c_v}{c_s}}",
          "Var = (σ_p² + σ_s²/N) / V, best at N* = √(σ_s²/σ_p² · c_v/c_s)")],
        "Marked: shadow rays of each of V viewing rays. σₚ²: variance of the exact radiance over the pixel; σₛ²: of one shadow ray; c: what a ray costs. No N takes the bias of a centred ray away.",
    ),
    claims=[
        Claim("At the edge 100 × 1 has less than a third of the error.", "edge", above=3.0, main=True, measured="÷ {edge}"),
        Claim("In the penumbra it has √2 times the error.", "penumbra", near=2**0.5, within=0.15, measured="× {penumbra}"),
        Claim("Twice the shadow rays leave the bias of the edge as it is.", "more", near=1.0, within=0.05, measured="{more} of that with 100"),
        Claim("All splits have the variance (σₚ² + σₛ²/N) / V.", "law", near=1.0, within=0.2, measured="{law:r}, the farthest of 22"),
    ],
)  # fmt: skip
