"""Figure 24: ambient occlusion computed beforehand at the vertices of a mesh, and where finer meshes hardly help."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question
from antumbra.lecture.measures.vertices import BODY_CELLS, CELLS, CUBE, PLACES, errors_of_meshes
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.open_box import HEIGHT
from antumbra.lecture.sketches.vertices import finer, plot
from antumbra.lecture.stages import Part, Plot
from antumbra.lecture.stages.quantities import table_of

SHOWN = [1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 24, 32]
# Half of what is between 1/√2 and the next choice, a half.
CHOICE = (0.5**0.5 - 0.5) / 2
# Over the width h of a cell the openness beside the body rises by about h over the body's height, of itself; so may the
# blend be off by less than the law has it, and twice that in the square.
RISE = 2 / BODY_CELLS[1] / HEIGHT
# Noise of a vertex in a coarse run, 0.003 of 0.0160 in the square, and the interval of 4 replicates (3.2 standard errors).
NOISE = 0.05


# fmt: off
def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    rows = {str(n): [found[f"{name}-{n}"] if n in cells else "" for name, cells in CELLS.items()] for n in sorted({n for cells in CELLS.values() for n in cells})}
    table = table_of(("n", "empty box", "with body", "mesh cut"), rows, "RMS error of the openness on the floor", bare=True)
    note = f"Bars: 95 %; {run.pick(PLACES)} places of the body, for the empty box 4 sets of vertices. Lines: predicted."
    return [finer(run, SHOWN, BODY_CELLS[1]), Plot(plot(found), note, table)]
# fmt: on


FIGURE = Figure(
    number=24, chapter=6, title="Openness at the vertices", seconds=Pick(11, 60),
    question=Question("Openness is computed at vertices and blended between. Cells half as wide leave a quarter of the error. With a body on the floor, what do they leave?",
                      ("a quarter", "a half", "about 0.7"), 2, ("halved",)),
    variants=[], measure=errors_of_meshes, stage=_stage,
    answer=Number("halved", "of the error is left, and {quarter:1} in the empty box. A cell that the contact line crosses blends the floor with "
        "what lies under the body; half the width has half as much of such floor, as wrong as before.", before="× "),
    equation=Equation([(r"\text{AO}(p) \approx \sum_{k} w_k(p) \, \mark{\text{AO}(v_k)}, \qquad \overline{e^2} \approx \frac{1}{12 \, n} \oint \text{AO}^2 \, \text{d}s",
                        "AO(p) ≈ sum over the vertices of w_k(p) AO(v_k); mean of e² ≈ (1 / 12 n) ∮ AO² ds along the contact line")],
                      "Marked: computed once, at vertices alone. e: what the blend is off by near the contact line, per unit of floor; ≈ for narrow cells."),
    claims=[
        Claim("With a body on the floor, cells half as wide leave about 0.7 of the error; 1/√2 in the limit.", "halved", near=0.5**0.5, within=CHOICE, main=True, measured="{halved}"),
        Claim("In the limit the contact line alone predicts it: ∮ AO² ds / 12 n.", "line", near=1.0, within=RISE,
              measured=f"squared error over that, n = {BODY_CELLS[1]} and {BODY_CELLS[2]}: {{line}}"),
        Claim("The mesh cut along that line converges again.", "along", below=-1.0, measured="slope {along}, uncut {body}"),
        Claim(f"On the floor of a cube, one cell is off by {CUBE[1]:.4f}, 2 × 2 cells by {CUBE[2]:.4f}.", "cube", near=1.0, within=NOISE,
              measured="the farther one: {cube} of it"),
    ],
)  # fmt: skip
