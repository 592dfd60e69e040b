"""Figure 5: what it costs to know that something is in the way, and what it costs to know what is first."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import SEGMENT
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question
from antumbra.lecture.measures.visits import visits_measured
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.sketches.visits import maps_of_visits, table_of_visits
from antumbra.lecture.stages import Panel, Part, Tabs

SCENES = {
    "interior": builtin("interior"), "scan": builtin("scan", triangles=50_000), "many-lights": builtin("many-lights"),
}  # fmt: skip
SIZE, TIMES = Pick((240, 168), (640, 448)), Pick(4, 8)


def _measure(run: Run) -> Mapping[str, Quantity]:
    found: dict[str, Quantity] = {}
    differ = []
    for n, (name, build) in enumerate(SCENES.items()):
        run.at(n / len(SCENES), f"shadow rays of {name}")
        of_scene, different = visits_measured(run, run.scene(build), run.pick(SIZE), run.pick(TIMES))
        found |= {f"{name}_{what}": quantity for what, quantity in of_scene.items()}
        differ.append(different)
    free = max((found[f"{name}_saved_free"] for name in SCENES), key=lambda each: each.value)
    return {**found, "free": free, "differ": Quantity(max(differ), unit="%")}


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    panels = []
    for name, build in SCENES.items():
        saved = {word: measured[f"{name}_saved_{word}"] for word in ("blocked", "free")}
        panels.append(Panel(name, name, [maps_of_visits(run, run.scene(build), name, run.pick(SIZE), saved)]))
    times = (
        "Rates are left out: those of a coarse run's few rays are noise, but for their ratio, which has its interval below." if run.quick
        else "Rates: of the renderer's own, all cores; medians of 21 calls of each kind in turn, of their ratio with its 95 %. Any hit computes no place, so free rays may gain time."
    )  # fmt: skip
    note = f"Means over {run.pick(TIMES)} random points of a light. Visits: of a counting traversal. {times}"
    return [Tabs("scene", "Scene", panels), table_of_visits(measured, list(SCENES), note, not run.quick)]


FIGURE = Figure(
    number=5, chapter=2, title="Anything, or the first thing", seconds=Pick(4, 45),
    question=Question(
        "A shadow ray may stop at any blocker, a viewing ray has to find the first surface. "
        "How many of its visits does that save in a room?",
        ("more than half", "a few per cent", "nothing at all"), 1, ("interior_saved",),
    ),
    variants=[], measure=_measure, stage=_stage,
    answer=Number("interior_saved", "So much less is visited in the room: {interior_saved_blocked} less by blocked rays, {interior_saved_free} by free ones, and {interior_share_free:v} are free. "
        "A free ray has to look at every box on its way, whatever it asks."),
    equation=Equation([SEGMENT], "Marked: any t will do. To say 0, one is enough; to say 1, there must be none in all boxes on the way."),
    claims=[
        Claim("Both give the same answer.", "differ", below=1e-5, main=True, measured="{differ} of the rays differ, in the worst of three scenes"),
        Claim("In the room any hit saves 1 to 6 % of all visits.", "interior_saved", near=0.035, within=0.025,
              measured="{interior_saved}; {interior_saved_blocked} of those of blocked rays"),
        Claim("A free ray gains nothing.", "free", near=0.0, within=1e-4, measured="{free} saved, in the best of three scenes"),
        Claim("By the clock, too, a blocked ray of the room is faster.", "interior_faster_blocked", above=1.0,
              measured="{interior_faster_blocked:r} times the rays/s of closest hit"),
    ],
)  # fmt: skip
