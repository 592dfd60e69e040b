"""Figure 11: a point light against square lights of growing size at the same power; how wide the penumbra is."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.penumbra import penumbra_widths
from antumbra.lecture.measures.points import irradiance_at
from antumbra.lecture.measures.ratio import excess, ratio
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.square_lights import BOARDS, LIGHT_HEIGHT, boards_under_square, irradiance_under
from antumbra.lecture.stages import Drawing, Frame, Part, Plot, Sketch, Strip, Table
from antumbra.lecture.stages.drawing import INK, LIGHT, LIT, PENUMBRA, UMBRA
from antumbra.study.plot import Curve, error_curves
from antumbra.study.statistics import Line

SIZES = [0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
FITTED = [0.1, 0.2, 0.4, 0.6, 0.8, 1.0]
DOUBLED = [(0.1, 0.2), (0.2, 0.4), (0.4, 0.8)]
RATIOS = [height / (LIGHT_HEIGHT - height) for height, _, _ in BOARDS]
WRITTEN = ["1/7", "1/3", "1"]
HALF = 1.6
FLOOR = {
    "estimator": "area", "viewing_rays": Pick(16, 64), "size": Pick((120, 120), (320, 320)), "up": (1.0, 0.0, 0.0),
    "eye": (0.0, 0.24, 0.0), "look_at": (0.0, 0.0, 0.0), "fov": 2 * np.arctan(HALF / 0.24),
}  # fmt: skip
VIEW = FLOOR | {"eye": (2.9, 2.3, 2.0), "look_at": (-0.2, 0.2, 0.2), "up": (0.0, 1.0, 0.0), "fov": 0.78}


def _widths(run: Run, size: float, board: int) -> NDArray[np.float64]:
    """16 replicates, on the line across the edge that lies in the middle of a board's shadow."""
    height, middle, _ = BOARDS[board]
    ends = [(side * size / 2, LIGHT_HEIGHT, 0.0) for side in (-1, 1)]
    half, row = 0.75 * RATIOS[board], middle / (1 - height / LIGHT_HEIGHT)
    line = ((-half, 0.0, row), (half, 0.0, row))
    return penumbra_widths(
        run, run.scene(boards_under_square(size)), line, ends, run.pick(Pick(1024, 16384)), board
    )


def _measure(run: Run) -> Mapping[str, Quantity]:
    width = {(s, b): _widths(run, s, b) for s in FITTED for b in range(3)}
    point, unit = (
        irradiance_at(
            run.scene(boards_under_square(s)),
            (0, 0, 0),
            2**18,
            run.seeded(1),
            shadows="off",
            light_points="area",
        )
        for s in (0.0, 1.0)
    )
    return {
        **{f"w{s:g}-{b}": mean_of(w) for (s, b), w in width.items()},
        "doubled": mean_of(
            np.mean([width[b, n] / width[a, n] for a, b in DOUBLED for n in range(3)], axis=0)
        ),
        "share": mean_of(np.mean([w / (s * RATIOS[b]) for (s, b), w in width.items()], axis=0)),
        "boards": mean_of(width[1.0, 2] / width[1.0, 0]),
        "below": excess(ratio(unit, point)),
    }


def _side(size: float) -> Drawing:
    """From the side, at the scale of the map beside it: 100 units are 1 m, up is x."""
    drawing = Sketch(300, 320, ground=LIT)
    light, edge, floor, half = 50.0, (150.0, 160.0), 250.0, 50 * size
    drawing.polygon([edge, (floor, 160 + half), (floor, 320), (150, 320)], UMBRA)
    if size > 0:
        drawing.polygon([edge, (floor, 160 - half), (floor, 160 + half)], PENUMBRA)
    for end in {-half, half}:
        drawing.line((light, 160 + end), (floor, 160 - end), faint=True)
        drawing.line((floor, 160 + end), (300, 160 + end), dash="2 4")
    drawing.line((150, 320), edge, width=5).line((floor, 0), (floor, 320), width=3)
    if size > 0:
        drawing.light((light, 160 - half), (light, 160 + half))
    else:
        drawing.circle((light, 160), 5, LIGHT, stroke=INK)
    drawing.text((14, 92 if size < 1 else 80), f"s = {size:g}").text((144, 290), "occluder", anchor="end")
    drawing.text((floor - 8, 26), "receiver", anchor="end")
    for a, b, word in ((light, 150, "d₁"), (150, floor, "d₂")):
        drawing.line((a + 4, 56), (b - 4, 56), faint=True)
        drawing.text(((a + b) / 2, 50), word, anchor="middle", fine=True)
    return drawing.done(
        f"Side view: a light of edge {size:g}, the edge of a board halfway, and the receiver, on which the penumbra is "
        f"{size:g} wide."
    )


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    white, frames = run.white("floor-0.5", share=99.9), []
    for size in SIZES:
        says = ", ".join(f"{size * r:.2f}" for r in RATIOS) if size else "no penumbra"
        pictures = [
            run.picture(f"floor-{size}", f"The receiver under a light of edge {size:g}: penumbras {says} wide.", white=white),
            run.picture(f"view-{size}", f"The three boards over the receiver, light of edge {size:g}.", white=white),
        ]  # fmt: skip
        word = f"s = {size:g}: penumbra {size:.2f} wide at d₂ = d₁" if size else "a point light: no penumbra"
        frames.append(
            Frame(f"{size:g}", word, pictures, f"s = {size:g}" if size else "point", "", _side(size))
        )
    strip = Strip(
        "s", "Edge s of the light, at the same power", frames, 8,
        ("From the side", "From below", "From outside"),
        note="Three boards hang over the receiver, their edges in line; from below, d₂/d₁ = 1/3, 1, 1/7 from left to right. From the "
        "side, the middle one. The point light sends as much straight down as the others, but more to the sides: it has no cos θ′.",
    )  # fmt: skip
    return [strip, _plot(measured)]


def _plot(measured: Mapping[str, Quantity]) -> Plot:
    curves = []
    for n in range(3):
        found = [measured[f"w{s:g}-{n}"] for s in FITTED]
        ends = [q.interval for q in found]
        values, low, high = [q.value for q in found], [a for a, _ in ends], [b for _, b in ends]
        curves.append(
            Curve(
                f"d₂/d₁ = {WRITTEN[n]}", FITTED, values, low, high, _predicted(RATIOS[n]), "line: s · d₂/d₁"
            )
        )
    drawing = error_curves(
        curves[::-1], x_title="edge s of the light", y_title="width of the penumbra", logarithmic=(False, False),
        label="The penumbra is as wide as s times d₂/d₁ under all three boards.", x_ticks=[0.2, 0.4, 0.6, 0.8, 1.0],
    )  # fmt: skip
    rows = [[f"{s:g}", *(f"{measured[f'w{s:g}-{n}'].value:.4f}" for n in range(3))] for s in FITTED]
    most = max(measured[f"w{s:g}-{n}"].error for s in FITTED for n in range(3))
    table = Table(
        ["s", *(f"d₂/d₁ = {word}" for word in WRITTEN)], rows,
        "Measured width of the penumbra by edge of the light and place of the board.", note=f"Each ± {most:.1g} at most.",
    )  # fmt: skip
    return Plot(drawing, "Marks: measured, 95 % of 16 replicates. Lines: similar triangles.", table)


def _predicted(slope: float) -> Line:
    x = np.array([FITTED[0], FITTED[-1]])
    return Line(x, slope * x, slope * x, slope * x)


FIGURE = Figure(
    number=11, chapter=3, title="A light that grows", seconds=Pick(5, 120),
    question=Question(
        "The light gets four times its area at the same power: its edge s doubles. How much wider does the penumbra become?",
        ("as wide as before", "twice as wide", "four times as wide"), 1,
    ),
    variants=[
        Variant(f"{name}-{s}", boards_under_square(s), options)
        for s in SIZES for name, options in (("floor", FLOOR), ("view", VIEW))
    ],
    measure=_measure, stage=_stage, exr=["view-0.5"],
    answer=Number("doubled", "times as wide. It lies between the two shadows that the ends of the light cast, so it goes with s, not with the area."),
    equation=Equation(
        [(r"w = \mark{s} \, \frac{d_2}{d_1}, \qquad L_e = \frac{\Phi}{\pi \, \mark{s}^2}", "w = s · d₂ / d₁, with Lₑ = Φ / (π s²)")],
        "Marked: the edge of the light. d₁ from the light to the occluder, d₂ from there to the receiver; Lₑ falls so that the power Φ stays.",
    ),
    claims=[
        Claim("The penumbra is s · d₂/d₁ wide, under every board.", "share", near=1.0, within=0.005, main=True,
              measured="{share} of it, over 18 widths"),
        Claim("Seven times the d₂/d₁, seven times as wide.", "boards", near=7.0, within=0.05,
              measured="{boards} times, 1 against 1/7"),
        Claim("Without boards the floor below keeps its light but for 7.7 %.", "below", near=irradiance_under(1.0, 2.0) * 4 - 1, within=0.003,
              measured="{below:1} from the point to s = 1; the closed form says −7.67 %"),
    ],
)  # fmt: skip
