"""Figure 7: a shadow ray starts on a surface; a fixed distance above it is right at one scale only."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.start_points import starts_measured, worst_file
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.leaning_board import ANGLE, leaning_board, look
from antumbra.lecture.sketches.start_points import starts_compared
from antumbra.lecture.stages import Part

# The same scene written in three units: coordinates of one metre.
FILES = {"kilometres": 1e-3, "metres": 1.0, "millimetres": 1e3}
STARTS = {"none": "none", **{f"{power}": f"epsilon:1e{power}" for power in range(-10, 2)}, "safe": "safe"}
RAYS = {"estimator": "area", "viewing": "centre", "viewing_rays": 1, "shadow_rays": 1, "aov": "albedo"}
# The scene, and a column of pixels across the foot of the board, from below it.
CAMERAS = {
    file: {
        "all": look(scale, (2.9, 1.4, 2.7), (0.08, 0.13, 0.2), 0.42) | {"size": Pick((280, 160), (560, 320))},
        "foot": look(scale, (1.3, 0.5, 0.0), (0.2, 0.0, 0.0), 0.19) | {"size": Pick((4, 600), (4, 2400))},
    }
    for file, scale in FILES.items()
}


def _measure(run: Run) -> Mapping[str, Quantity]:
    found = starts_measured(run, FILES, list(STARTS), CAMERAS)
    fixed = min((worst_file(found, start) for start in STARTS if start != "safe"), key=lambda q: q.value)
    return found | {"ours": worst_file(found, "safe"), "fixed": fixed, "powers": Quantity(len(STARTS) - 2)}


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    return starts_compared(run, measured, FILES, list(STARTS))


FIGURE = Figure(
    number=7, chapter=2, title="Where a shadow ray starts", seconds=Pick(2, 12),
    question=Question(
        "A shadow ray that starts at a rounded point may be blocked by the surface that it leaves. "
        "Why do viewing rays, computed with the same numbers, not suffer?",
        ("they are computed more exactly", "they ask what is first, not if anything is there", "some do, unseen"), 1, ("viewing",),
    ),
    variants=[
        Variant(f"{start}-{file}-{view}", leaning_board(scale), {**RAYS, **CAMERAS[file][view], "self_intersection": option})
        for start, option in STARTS.items() for file, scale in FILES.items() for view in ("all", "foot")
    ],
    measure=_measure, stage=_stage, exr=["none-metres-all"],
    answer=Number("false_metres_none", "So many lit pixels are in false shadow without an offset, in the file in metres; of the viewing rays {viewing} are wrong, in all three. "
        "A hit a rounding too early is the right surface still; to a shadow ray it is a wrong yes."),
    equation=Equation(
        [(r"V_{\varepsilon}(p, p') = V(\mark{p + \varepsilon \, n}, \; p')", "V_ε(p, p′) = V(p + ε n, p′)"),
         (r"2^{-24} \, |p| \lesssim \varepsilon, \qquad \text{lost} = \varepsilon \, \cot \beta", "2^−24 |p| at most about ε; lost: ε cot β")],
        "Marked: the start. ε has to exceed the rounding of p, which grows with its coordinates; under a board at the angle β it loses ε cot β of the shadow.",
    ),
    claims=[
        Claim("Our start has the visibility of the closed form, in all three files.", "ours", below=0.0005, main=True,
              measured="{ours} of the pixels differ, in the worst file"),
        Claim("No fixed ε is right in all three, of those tried.", "fixed", above=0.002, measured="the best of none and {powers} powers of ten leaves {fixed} wrong in one"),
        Claim("Under the board, ε = 0.1 m loses ε cot β.", "foot_kilometres_-4", near=100 / float(np.tan(ANGLE)), within=2.0,
              measured="{foot_kilometres_-4} (half a pixel); the closed form says 83.9 mm"),
        Claim("No viewing ray meets a wrong surface.", "viewing", below=0.0005, measured="{viewing} do, in all three files"),
    ],
)  # fmt: skip
