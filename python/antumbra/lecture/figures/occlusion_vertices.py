"""Figure 24: ambient occlusion computed beforehand at the vertices of a mesh, and where finer meshes hardly help."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question
from antumbra.lecture.measures.vertices import PLACES, cells_of, errors_of_meshes
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.sketches.vertices import finer, plot
from antumbra.lecture.stages import Part, Plot
from antumbra.lecture.stages.quantities import table_of

SHOWN = [1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 24, 32]


# fmt: off
def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    cells = cells_of(run)
    rows = {str(n): [found[f"{name}-{n}"] if n in of else "" for name, of in cells.items()] for n in sorted({n for of in cells.values() for n in of})}
    table = table_of(("n", "empty box", "with body", "mesh cut"), rows, "RMS error of the openness on the floor", bare=True)
    note = f"Bars: 95 %; {run.pick(PLACES)} places of the body, for the empty box 4 sets of vertices. Lines: predicted."
    return [finer(run, SHOWN), Plot(plot(run, found), note, table)]
# fmt: on


FIGURE = Figure(
    number=24, chapter=6, title="Openness at the vertices", seconds=Pick(7, 60),
    question=Question("Openness is computed at vertices and blended between. Cells half as wide leave a quarter of the error. With a body on the floor, what do they leave?",
                      ("a quarter", "a half", "about 0.7"), 2, ("halved",)),
    variants=[], measure=errors_of_meshes, stage=_stage,
    answer=Number("halved", "of the error is left, and {quarter:1} in the empty box. A cell that the contact line crosses blends the floor with "
        "what lies under the body; half the width has half as much of such floor, as wrong as before.", before="× "),
    equation=Equation([(r"\text{AO}(p) \approx \sum_{k} w_k(p) \, \mark{\text{AO}(v_k)}, \qquad \overline{e^2} \approx \frac{1}{12 \, n} \oint \text{AO}^2 \, \text{d}s",
                        "AO(p) ≈ sum over the vertices of w_k(p) AO(v_k); mean of e² ≈ (1 / 12 n) ∮ AO² ds along the contact line")],
                      "Marked: computed once, at vertices alone. e: what the blend is off by near the contact line, per unit of floor."),
    claims=[
        Claim("With a body on the floor, cells half as wide leave 1/√2 of the error.", "halved", near=0.5**0.5, within=0.1, main=True, measured="{halved}"),
        Claim("The contact line alone predicts it: ∮ AO² ds / 12 n.", "line", near=1.0, within=0.4, measured="squared error over that: {line}"),
        Claim("The mesh cut along that line converges again.", "along", below=-1.0, measured="slope {along}, uncut {body}"),
        Claim("On the floor of a cube, 2 × 2 vertices are off by 0.0654.", "two", near=1.0, within=0.03, measured="{two} of it, 3 × 3: {three} of 0.0160"),
    ],
)  # fmt: skip
