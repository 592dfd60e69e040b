"""A figure that renders in no time and has every kind of stage."""

from __future__ import annotations

import numpy as np

from antumbra.lecture import keep
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.scenes import builtin
from antumbra.lecture.stages import (
    Drawing,
    Entry,
    Frame,
    Key,
    Linked,
    Panel,
    Plot,
    Row,
    Sketch,
    Strip,
    Table,
    Tabs,
)

# What stands in every record of a figure.
RECORD = {
    "form": keep.FORM, "name": "one", "key": "0", "antumbra": "0", "quick": False, "seed": 0, "seconds": 1.0, "rays": 0,
    "files": [], "stage": [], "number": 1, "chapter": 1, "title": "", "question": {}, "answer": {}, "equation": {},
    "claims": [], "numbers": {}, "command": "", "exr": [],
}  # fmt: skip

LOOK = {"estimator": "area", "viewing_rays": Pick(1, 2), "size": (24, 16)}


def _measure(run):
    mean = mean_of([image.pixels.mean() for image in run.images("a")])
    return {"mean": mean, "again": mean}


def _parts(run):
    """One part of every kind."""
    picture = run.picture("a", "Pillars, half in shadow.", "as it is", noise=True)
    share = run.map(np.full((16, 24), 0.5), "Half everywhere.", name="half", unit="%")
    steps = np.linspace(0, 2, 16 * 24).reshape(16, 24)
    ramps = {"free": "blue", "blocked": "amber"}
    two = run.map_of_two(steps, steps > 1, "Two halves.", name="two", ramps=ramps, high=1.0, unit="boxes")
    drawing = (
        Sketch(56, 32, ground="var(--lit)").light((4, 8), (4, 24)).text((20, 10), "light").done("A light.")
    )
    other = Sketch(56, 32).circle((10, 10), 5, "#15181f").done("A ball.")
    frames = [
        Frame(
            f"{i}",
            f"i = {i}: <half>",
            [picture, share],
            more=", and more",
            drawing=d,
            facts=[f"fact {i}"],
            term=i // 2,
        )
        for i, d in enumerate([drawing, other, drawing])
    ]
    rays = Sketch(24, 16)
    for row, free in enumerate((True, False)):
        rays.linked(row, Sketch(24, 16).ray((1, 1), (12 + row, 8), free))
    wide = Table([f"quite a long head {n}" for n in range(6)], [["1"] * 6], "A wide table.")
    table = Table(["ray", "V", "pdf"], [["1", "free", "0.5"], ["2", "blocked", "0.5"]], "Two rays.", fine=[2])
    rows = [["one", "1,200", "3 ± 1"], ["two", "30", "2"], ["three", "4", "10"]]
    sorts = Table(["way", "rays", "worth"], rows, "Three ways.", sorted=1)
    axes = Drawing('<g data-s="random"><path class="ln" d="M0 0L9 9"/></g>', 620, 440, "A line.")
    return [
        Strip("i", "Which", frames, labels=("side", "picture"), tells=2),
        Key([Entry("var(--umbra)", "Umbra", "none", drawing, 0), Entry("#fff", "Lit", "all", always="outside")], "i"),
        Row([picture, picture, picture, two], note="Three alike."),
        Tabs(
            "sampler",
            "Sampler",
            [Panel(w, w, [Row([picture, picture])], w == "told") for w in ("random", "owen", "told")],
        ),
        wide,
        sorts,
        Linked("ray", picture, rays.done("Two rays."), table),
        Plot(axes, "95 %.", Table(["N", "RMSE"], [["1", "1.00"]], "Errors.", foot=["slope", "−0.5"])),
    ]  # fmt: skip


def figure(number: int) -> Figure:
    """A figure with every kind of stage; of the second one the answer is not proved."""
    return Figure(
        number=number,
        chapter=1,
        title=f"Made up, {number}",
        question=Question("What is the mean?", ("small", "large"), 0, ("mean" if number == 1 else "again",)),
        variants=[Variant("a", builtin("pillars"), LOOK, replicates=2)],
        measure=_measure,
        stage=lambda run, measured: _parts(run),
        answer=Number("mean", "The mean is {mean}."),
        equation=Equation(
            [(r"x = \mark{\frac{1}{N}} \sum_{i=1}^N \mark{x_i}", "x = 1/N sum of x_i")], "Marked: N, x."
        ),
        claims=[
            Claim("It is small.", "mean", below=1e3, main=True),
            Claim("It is <large>.", "again", above=1e3),
        ],
        seconds=Pick(0.5, 1.0),
    )
