"""Figure 1: a ball slid along the viewing ray; without shadows nothing tells where it is."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import DIRECT
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.compare import share_changed
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import EYE, slid_ball
from antumbra.lecture.stages import Frame, Strip

SCALES = [round(1 - 0.04 * step, 2) for step in range(12)]
LOOK = {
    "estimator": "area", "viewing_rays": Pick(4, 8), "size": Pick((240, 168), (840, 588)),
    "eye": EYE, "look_at": (0.35, 0.3, 0.2), "fov": 0.6,
}  # fmt: skip


def _changed(run: Run, scale: float, shadows: str) -> Quantity:
    return share_changed(run, f"{shadows}-{SCALES[0]}", f"{shadows}-{scale}", white=run.white("off-1.0"))


def _measure(run: Run) -> Mapping[str, Quantity]:
    return {
        "off": _changed(run, SCALES[-1], "off"),
        "on": _changed(run, SCALES[-1], "on"),
        "first": _changed(run, SCALES[1], "on"),
    }


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Strip]:
    white, frames = 1.25 * run.white("off-1.0"), []
    for scale in SCALES:
        off, on = (_changed(run, scale, shadows) for shadows in ("off", "on"))
        pictures = [
            run.picture(f"off-{scale}", f"Without shadows, the ball at {scale} of its distance: {off:v} of the pixels changed.", white=white),
            run.picture(f"on-{scale}", f"With shadows, the ball at {scale} of its distance: {on:v} of the pixels changed.", white=white),
        ]  # fmt: skip
        frames.append(
            Frame(f"{scale}", f"distance {scale}: {off:v} and {on:v} of the pixels changed", pictures)
        )
    label = "Distance of the left ball from the eye, its size in proportion; at 1 it lies on the floor"
    return [Strip("distance", label, frames, ("V = 1 everywhere", "V as it is"), tells=len(frames) - 1)]


FIGURE = Figure(
    number=1, chapter=1, title="Where is the ball?", seconds=Pick(5, 80),
    question=Question(
        "The left ball is slid towards the eye and made smaller, so that it always covers the same pixels. "
        "Which of the two pictures tells?",
        ("both", "only the one with shadows", "neither"), 1, ("off", "on"),
    ),
    variants=[Variant(f"{v}-{s}", slid_ball(s), LOOK | {"shadows": v}, 2) for s in SCALES for v in ("off", "on")],
    measure=_measure, stage=_stage, exr=["off-1.0", f"on-{SCALES[-1]}"],
    answer=Number("on", "With shadows, so many pixels change when the ball comes to about half of its distance. Without "
        "them it is {off}. Where a thing is we read from where its shadow is."),
    equation=Equation([DIRECT], "Marked: the only term that knows of other surfaces. With V = 1 each point is lit as if it were alone."),
    claims=[
        Claim("Without shadows the pictures coincide.", "off", below=0.001, main=True, measured="{off} of the pixels change"),
        Claim("With shadows they do not.", "on", above=0.02, measured="{on} of the pixels change"),
        Claim("The first step is enough to tell.", "first", above=0.005, measured="{first} change after 4 % of the way"),
    ],
)  # fmt: skip
