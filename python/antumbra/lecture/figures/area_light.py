"""Figure 11: a point light and square lights of growing size, all of the same power; how wide the penumbra is."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import numpy as np

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.penumbra import board_widths
from antumbra.lecture.measures.ratio import times
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.square_lights import DISTANCE_RATIOS, boards_under_square, irradiance_under
from antumbra.lecture.sketches.area_light import frame
from antumbra.lecture.stages import Part, Plot, Strip
from antumbra.lecture.stages.quantities import curve_of, table_of
from antumbra.study.plot import error_curves

SIZES = [0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
FITTED = [0.1, 0.2, 0.4, 0.6, 0.8, 1.0]
DOUBLED = [(0.1, 0.2), (0.2, 0.4), (0.4, 0.8)]
# The floor from below the boards, and everything from the light's side: left to right in the same order.
FLOOR = {
    "estimator": "area", "viewing_rays": Pick(16, 64), "size": Pick((120, 120), (320, 320)), "up": (-1.0, 0.0, 0.0),
    "eye": (0.0, 0.24, 0.0), "look_at": (0.0, 0.0, 0.0), "fov": 2 * np.arctan(1.6 / 0.24),
}  # fmt: skip
VIEW = FLOOR | {"eye": (2.9, 2.3, 2.0), "look_at": (-0.2, 0.2, 0.2), "up": (0.0, 1.0, 0.0), "fov": 0.78}


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    white = run.white("floor-0.5", share=99.9)
    strip = Strip(
        "s", "Edge s of the light, always the same power", [frame(run, found, size, white) for size in SIZES],
        ("From the side", "From below", "From outside"),
        note="Three boards hang over the receiver, their edges in line, from left to right with d₂/d₁ = 1/7, 1/3, 1. From the side, "
        "the last one. The point light has the power of the squares and sends it to all sides: a quarter as much straight down.", tells=SIZES.index(0.7),
    )  # fmt: skip
    curves = [
        curve_of(f"d₂/d₁ = {word}", FITTED, [found[f"w{s:g}-{n}"] for s in FITTED], partial(np.multiply, r), "line: s · d₂/d₁")
        for n, (word, r) in enumerate(DISTANCE_RATIOS.items())
    ]  # fmt: skip
    drawing = error_curves(
        curves, x_title="edge s of the light [m]", y_title="width of the penumbra [m]", logarithmic=(False, False),
        chosen=curves[-1].name, x_ticks=[0.2, 0.4, 0.6, 0.8, 1.0],
        label=f"Width of the penumbra against s under three boards: {found['share']} of s times d₂/d₁.",
    )  # fmt: skip
    rows: dict[str, list[Quantity | str]] = {
        f"{s:g}": [*(times(found[f"w{s:g}-{n}"], Quantity(1000.0)) for n in range(3)), f"{found[f'below-{s:g}'].value:.3f}"]
        for s in FITTED
    }  # fmt: skip
    head, says = ("s [m]", *DISTANCE_RATIOS, "below"), "Measured width of the penumbra [mm]"
    note = f"{says} by s and d₂/d₁. Below: the light straight below, over that of the point light."
    table = table_of(head, rows, f"{says} by s and d₂/d₁.", bare=True, note=note)
    return [strip, Plot(drawing, "Marks: measured, 95 % of 16 replicates. Lines: similar triangles.", table)]


FIGURE = Figure(
    number=11, chapter=3, title="A light that grows", seconds=Pick(4, 120),
    question=Question(
        "The light gets four times its area at the same power: its edge s doubles. How much wider does the penumbra become?",
        ("as wide as before", "twice as wide", "four times as wide"), 1, ("doubled",),
    ),
    variants=[
        Variant(f"{name}-{s}", boards_under_square(s), options)
        for s in SIZES for name, options in (("floor", FLOOR), ("view", VIEW))
    ],
    measure=lambda run: board_widths(run, SIZES[1:], DOUBLED), stage=_stage, exr=["view-0.5"],
    answer=Number("doubled", "times as wide. It lies between the two shadows that the ends of the light cast, so it goes with s, not with the area."),
    equation=Equation(
        [(r"w = \mark{s} \, \frac{d_2}{d_1}, \qquad L_e = \frac{\Phi}{\pi \, \mark{s}^2}", "w = s · d₂ / d₁, with Lₑ = Φ / (π s²)")],
        "Marked: the edge of the light. d₁ from the light to the occluder, d₂ from there to the receiver; Lₑ falls so that the power Φ stays.",
    ),
    claims=[
        Claim("The penumbra is s · d₂/d₁ wide, under every board.", "share", near=1.0, within=0.005, main=True,
              measured="{share} of it, over {widths} widths"),
        Claim("Twice the edge, twice as wide.", "doubled", near=2.0, within=0.02, measured="{doubled} times, three boards"),
        Claim("Seven times the d₂/d₁, seven times as wide.", "boards", near=7.0, within=0.05,
              measured="{boards} times, 1 against 1/7"),
        Claim("Straight below, 1 m sends 3.69 times as much as the point light.", "below-1", near=irradiance_under(1.0, 2.0) * 16, within=0.01,
              measured="{below-1} times; closed form 3.693"),
    ],
)  # fmt: skip
