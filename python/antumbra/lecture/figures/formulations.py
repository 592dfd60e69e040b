"""Figure 10: directions, points of all surfaces, points of the lights: which of them is better, and where."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.three_forms import FORMS, ONE, at_the_middle
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import low_room
from antumbra.lecture.sketches.three_forms import frames, near_a_corner, plot
from antumbra.lecture.stages import Panel, Part, Strip, Tabs

RATIOS = [0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.2, 1.3, 1.4, 1.45, 1.5, 1.58]
SHOWN = [0.1, 0.4, 0.8, 1.45, 1.58]
LOOK = low_room.VIEW | {
    "sampler": "random", "viewing": "centre", "viewing_rays": Pick(32, 128), "shadow_rays": 1,
    "size": Pick((72, 48), (240, 160)), "aov": "emission",
}  # fmt: skip


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    rays, names = run.pick(LOOK["viewing_rays"]), tuple(FORMS.values())
    cost = f"a direction took {found['time-hemisphere']:1} and a point of all surfaces {found['time-surfaces']:1} times as long as"
    shown = [
        ("noise", "Pictures", "R", names, f"{rays} random samples a pixel, all through its centre."),
        ("variance", "Scatter", "radius", names, "Standard deviation of one sample, over the light of the pixel. Black: the light itself, and no light."),
        ("better", "Who is better", "size", ("at equal rays", "at equal time"), "Yellow: points of the light; blue: directions; "
         f"black: the light, and what it does not reach. In this run {cost} a point of the light."),
    ]  # fmt: skip
    label = "Radius R of the light over the height h of the room, at the same power"
    each = zip(*(frames(run, found, at, rays) for at in RATIOS), strict=True)
    panels = [
        Panel(value, name, [Strip(key, label, strip, labels, note, RATIOS.index(1.45))])
        for (value, name, key, labels, note), strip in zip(shown, each, strict=True)
    ]
    return [
        Tabs(
            "show",
            "What is shown",
            [*panels, Panel("corner", "Near a corner", [near_a_corner(found)], late=True)],
        ),
        plot(found, RATIOS, SHOWN),
    ]


FIGURE = Figure(
    number=10, chapter=3, title="Three ways to sample one integral", seconds=Pick(4, 140),
    question=Question(
        "The light grows. Which share of the hemisphere, counted with cos θ, must it fill before random directions are better than random points of it?",
        ("10 %", "a third", "half", "two thirds"), 3, ("even",),
    ),
    variants=[
        Variant(f"{form}-{at}", low_room.low_room(at), LOOK | ONE[form]) for at in RATIOS for form in FORMS
    ],
    measure=lambda run: at_the_middle(run, RATIOS), stage=_stage, exr=["hemisphere-0.4", "surfaces-0.4", "area-0.4"],
    answer=Number("even", "of the hemisphere. Below, points of the light are better; above, directions: there near points count many times as much as far ones."),
    equation=Equation(
        [
            (r"L_o = \int_{\mark{\Omega}} f_r L_e \cos\theta \, \text{d}\omega", "L_o = ∫ over the hemisphere of f_r L_e cos θ dω"),
            (r"\phantom{L_o} = \int_{\mark{A}} f_r L_e V \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A", "= ∫ over all surfaces of f_r L_e V cos θ cos θ′ / r² dA"),
            (r"\phantom{L_o} = \int_{\mark{A_L}} f_r L_e V \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A", "= ∫ over the lights of f_r L_e V cos θ cos θ′ / r² dA"),
        ],
        "Marked: what is sampled. The value is the same; Lₑ is 0 for most directions and most surfaces, and 1/r² has no bound in corners.",
    ),
    claims=[
        Claim("Directions draw level at R/h = 1.45.", "even", near=low_room.filled(low_room.even_ratio()), within=0.01,
              main=True, measured="{even}; the closed form says 67.8 %"),
        Claim("All surfaces: the mean square times all areas over the light’s.", "surfaces", near="areas", within=0.8,
              measured="{surfaces} times at R/h = 1; the areas are as {areas:v} to 1"),
        Claim("In a corner with the light, points of it scatter as 1/distance².", "corner", near=-2.0, within=0.05,
              measured="slope of the mean square {corner}"),
    ],
)  # fmt: skip
