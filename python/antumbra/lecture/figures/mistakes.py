"""Figure 16: five classical wrong estimators beside the right one, the term that each breaks, the tests that find it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.five_tests import RAYS, SIGNS, TESTS, WITHIN, all_tests, passed
from antumbra.lecture.mistakes import MISTAKES, SPOKEN, TESTED, Mistake, sum_with
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import low_room
from antumbra.lecture.stages import Panel, Part, Row, Tabs
from antumbra.lecture.stages.formula import Formula
from antumbra.lecture.stages.quantities import table_of

GUESS = {"A": "no-distance", "B": "area", "C": "no-cos-light"}
ROOM = low_room.low_room(0.4)
LOOK = low_room.VIEW | {
    "light_points": "area", "viewing_rays": Pick(4, 32), "shadow_rays": RAYS, "size": Pick((120, 80), (360, 240)), "aov": "emission",
}  # fmt: skip


def _guess(run: Run) -> Row:
    """Three pictures, each exposed for itself."""
    return Row([
        run.picture(key, f"The room under its light: picture {letter}.", letter, name=f"which-{letter}",
                    white=run.white(key, share=85) * 1.7)
        for letter, key in GUESS.items()
    ])  # fmt: skip


def _panel(run: Run, mistake: Mistake) -> Panel:
    right, wrong = run.light(mistake.estimator), run.light(mistake.name)
    lamp = run.aov(mistake.estimator, "emission")[..., 1] > 0
    share = np.where(lamp, 1.0, np.maximum(wrong, 1e-9) / np.maximum(right, 1e-9))
    low, high = np.quantile(share[right > 0.01 * right.max()], [0.02, 0.98])
    span = f"{low:.2g} to {high:.2g} times" if high > 1.02 * low else f"{high:.3g} times"
    white = run.white(mistake.estimator, share=85) * 1.7
    row = Row([
        run.picture(mistake.estimator, "The right picture.", "right", name=f"{mistake.name}-right", white=white),
        run.picture(mistake.name, "The wrong picture at the same exposure.", f"{mistake.name}, at the same exposure", white=white),
        run.map(np.log2(share), f"The wrong picture has {span} the light.", f"wrong over right: {span}", name=f"{mistake.name}-share",
                ramp="signed", low=-4.0, high=4.0, ticks={-4: "1/16", -2: "1/4", 0: "1", 2: "4", 4: "16"}, unit="times"),
    ])  # fmt: skip
    return Panel(
        mistake.name, mistake.name, [row, Formula([(mistake.latex, mistake.spoken)], mistake.why)], late=True
    )


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    panels = [
        Panel("which", "Which is right?", [_guess(run)]),
        *(_panel(run, mistake) for mistake in MISTAKES),
    ]
    cells = {name: [found[f"{name}-{test}"] for test in TESTS] for name, _, _ in TESTED}
    most = max(q.error / q.value for row in cells.values() for q in row)
    table = table_of(
        ("estimator", *TESTS.values()), {name: [f"{SIGNS[passed(q)]} {q.value:.2f}" for q in row] for name, row in cells.items()},
        "Five tests of the right estimators and the wrong ones.",
        note=f"What came out over what should, N = {RAYS}: ✗ where the 95 % interval lies outside of 1 ± {WITHIN}. The interval is ± {100 * most:.0f} % of the number at most. Straight below a small light at r = 1, and to the "
        "side of a larger one, against the closed form; there against twice the size of everything, one ray in place of 16, and random directions.",
    )  # fmt: skip
    return [Tabs("mistake", "Which mistake is shown", panels), table]


FIGURE = Figure(
    number=16, chapter=4, title="One of three is right", seconds=Pick(2, 90),
    question=Question("The same room three times, each picture exposed for itself. Two of the estimators lack a term. Which picture is right?", "ABC", 1, ("found", "worst"), looks=True),
    variants=[
        Variant("area", ROOM, LOOK | {"estimator": "area"}), Variant("mis", ROOM, LOOK | {"estimator": "mis"}),
        *(Variant(m.name, ROOM, LOOK | {"estimator": m.estimator, "mistake": m.name}) for m in MISTAKES),
    ],
    measure=lambda run: all_tests(run, TESTED), stage=_stage, exr=["area", "no-cos-light"],
    answer=Number("more", "too much light at the side in C, which lacks cos θ′: no noise, nothing to see. A lacks 1/r², B is right.", before="+"),
    equation=Equation(
        [(sum_with(r"\mark{\cos\theta'}", r"\mark{\text{pdf}}", r"\mark{r^2}", r"\mark{\frac{1}{N}}"), SPOKEN)],
        "Marked: what is left out or mistaken. Only a second way to the same number finds it.",
    ),
    claims=[
        Claim("Together the five tests find all five mistakes.", "found", near=5.0, within=0.5, main=True, measured="{found} of 5 found"),
        Claim("The right estimators pass all of them.", "worst", near=1.0, within=WITHIN, measured="the farthest: {worst} of what it should be"),
        Claim("Straight below at r = 1, three mistakes are not found.", "below", near=3.0, within=0.5, measured="{below} of 5 pass there"),
    ],
)  # fmt: skip
