"""Figure 15: the noise of one shadow ray against the size of the light, fully lit pixels and penumbra apart."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from antumbra.lecture.chapters import SUM
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.lit_and_penumbra import Classes, noises, squares
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import CENTRED, builtin
from antumbra.lecture.stages import Frame, Part, Plot, Strip
from antumbra.lecture.stages.quantities import table_of
from antumbra.study.plot import error_curves, measured

SIZES = [0.25, 0.32, 0.4, 0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0]
ONE = CENTRED | {"light_points": "area", "sampler": "random", "shadow_rays": 1}
TRUTH = CENTRED | {
    "light_points": "area",
    "sampler": "owen",
    "shadow_rays": Pick(64, 256),
    "aov": "visible-fraction,unshadowed-direct",
}


def _squares(run: Run) -> Classes:
    found: Classes = run.once("squares", lambda: squares(run, SIZES))
    return found


def _frame(run: Run, found: Mapping[str, Quantity], size: float, white: float) -> Frame:
    noise = luminances(run, f"one-{size}").std(0, ddof=1)
    says = f"edge {size:g} m: lit pixels {found[f'lit-{size:g}']:1}, penumbra {found[f'penumbra-{size:g}']:1}"
    pictures = [
        run.picture(run.image(f"one-{size}").pixels, f"One shadow ray a pixel, light of {says}.", name=f"one-{size}", white=white, noise=True),
        run.picture(f"truth-{size}", f"The same without noise, edge of the light {size:g} m.", white=white, noise=True),
        run.map(noise / white, f"Noise of one ray: {says}.", name=f"noise-{size}", ramp="amber", high=0.5, unit="of white", noise=True),
    ]  # fmt: skip
    return Frame(f"{size:g}", says, pictures, short=f"{size:g} m")


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    white = run.white("truth-0.25")
    strip = Strip("size", "Edge of the square light, at constant power", [_frame(run, found, s, white) for s in SIZES],
                  ("one shadow ray", "many", "noise of one"), tells=SIZES.index(2.0), begins=SIZES.index(1.0))  # fmt: skip
    curves = [
        measured(name, SIZES, each, fit=[name == "lit" and s <= 1 for s in SIZES]) for name, each in _squares(run).items()
    ]  # fmt: skip
    curves[0] = replace(curves[0], note=f"slope {found['lit']}")
    svg = error_curves(
        curves, x_title="edge of the light [m], same power", y_title="noise of one ray, unshadowed = 1",
        chosen="penumbra", x_ticks=[0.25, 0.5, 1, 2, 4], y_ticks=[1, 1 / 3, 1 / 10, 1 / 30, 1 / 100],
        label="Noise of one shadow ray against the size of the light: lit pixels and penumbra pixels.",
    )  # fmt: skip
    note = f"Bars: 95 %, {len(run.images('one-1.0'))} independent pictures. The line is fitted to lit pixels, edges up to 1 m."
    rows = {f"{s:g}": (found[f"lit-{s:g}"], found[f"penumbra-{s:g}"]) for s in (0.25, 0.5, 1.0, 2.0, 4.0)}
    table = table_of(("edge [m]", "fully lit", "penumbra"), rows, "Noise of one shadow ray by edge of the light",
                     note="Standard deviation of one ray over the unshadowed light.")  # fmt: skip
    return [strip, Plot(svg, note, table)]


FIGURE = Figure(
    number=15, chapter=4, title="How large a light", seconds=Pick(2, 85),
    question=Question("One shadow ray per pixel. The edge of the square light is doubled from 1 to 2 m, at the same power. What happens to the noise of a penumbra pixel?",
                      ("it doubles", "it hardly changes", "it halves"), 1, ("penumbra-doubled",)),
    variants=[Variant(f"{kind}-{s}", builtin("pillars", light_size=s), options, count)
              for s in SIZES for kind, options, count in (("one", ONE, Pick(16, 48)), ("truth", TRUTH, 1))],
    measure=lambda run: noises(_squares(run), SIZES), stage=_stage, exr=["one-1.0"],
    answer=Number("penumbra-doubled", "is the noise of a penumbra pixel, from an edge of 1 m to one of 2 m; that of a fully lit pixel is × {lit-doubled:1}. The penumbra grows wider.", before="× "),
    equation=Equation([SUM], "Marked: one shadow ray. In the penumbra V jumps between 0 and 1; in the light only the cosines and r "
        "vary, and the less the smaller the light. A fair coin for V gives 1/2; under an edge of 4 m cosines and r vary so much that the penumbra is noisier."),
    claims=[
        Claim("Fully lit: the noise grows with the edge of the light.", "lit", near=1.0, within=0.05, main=True, measured="slope {lit}, edges up to 1 m"),
        Claim("In the penumbra the edge from 1 to 2 m changes little.", "penumbra-doubled", near=1.0, within=0.2, measured="× {penumbra-doubled}"),
        Claim("There, under an edge of 1 m, it is 1/3 to 1/2: at most that of a fair coin.", "penumbra-1", near=5 / 12, within=1 / 12, measured="{penumbra-1} of the unshadowed light"),
    ],
)  # fmt: skip
