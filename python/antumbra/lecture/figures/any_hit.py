"""Figure 5: what it costs to know that something is in the way, and what it costs to know what is first."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.chapters import SEGMENT
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.measures.visits import disagree, rates, shadow_rays
from antumbra.lecture.quantity import Quantity, written
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.stages import Panel, Part, Picture, Row, Table, Tabs

SCENES = {"interior": builtin("interior"), "scan": builtin("scan", triangles=50_000), "many-lights": builtin("many-lights")}  # fmt: skip
SIZE, TIMES = Pick((240, 168), (640, 448)), Pick(4, 8)
COUNTS = ("any_boxes", "closest_boxes", "any_primitives", "closest_primitives")
RAYS = {True: "blocked", False: "free"}
WHAT = "boxes and triangles"


def _measure(run: Run) -> Mapping[str, Quantity]:
    found, differ = {}, 0.0
    for name, build in SCENES.items():
        scene, size = run.scene(build), run.pick(SIZE)
        asked = [
            shadow_rays(scene, size, np.random.default_rng(run.seeded(n))) for n in range(run.pick(TIMES))
        ]
        differ = max(differ, disagree(scene, asked[0]))
        run.rays += sum(2 * len(each.targets) for each in asked)
        for blocked, word in RAYS.items():
            for count in COUNTS:
                found[f"{name}_{count}_{word}"] = mean_of([each.mean(count, blocked) for each in asked])
            found[f"{name}_share_{word}"] = mean_of(
                [np.mean(each.visits.blocked == blocked) for each in asked], unit="%"
            )
            found[f"{name}_saved_{word}"] = mean_of(
                [each.saved(each.visits.blocked == blocked) for each in asked], unit="%"
            )
            for kind, rate in zip(("any", "closest"), rates(scene, asked[0], blocked), strict=True):
                found[f"{name}_{kind}_rate_{word}"] = Quantity(
                    rate, note="million rays a second, best of five"
                )
        found[f"{name}_saved"] = mean_of([each.saved() for each in asked], unit="%")
    free = max((found[f"{name}_saved_free"] for name in SCENES), key=lambda each: each.value)
    return {**found, "free": free, "differ": Quantity(differ, unit="%")}


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    panels = [Panel(name, name, [_maps(run, name, measured)]) for name in SCENES]
    rows = []
    for name in SCENES:
        for word in RAYS.values():
            counts = [written(measured[f"{name}_{count}_{word}"].value) for count in COUNTS]
            rates = [written(measured[f"{name}_{kind}_rate_{word}"].value, 2) for kind in ("any", "closest")]
            share, saved = (
                f"{measured[f'{name}_{what}_{word}'].value:.1%}".replace("%", " %")
                for what in ("share", "saved")
            )
            rows.append([f"{name}, {word}", share, *counts, saved, *rates])
    head = ["rays", "share", "boxes, any hit", "closest hit", "triangles, any hit", "closest hit", "saved", "M rays/s, any hit", "closest hit"]  # fmt: skip
    note = f"Means over {run.pick(TIMES)} random points of a light. Rates: these rays in one call on all cores, the best of five."
    return [
        Tabs("scene", "Scene", panels),
        Table(head, rows, "Boxes and triangles visited by a shadow ray", fine=(1, 4, 5, 7, 8), note=note),
    ]


def _maps(run: Run, name: str, measured: Mapping[str, Quantity]) -> Row:
    asked = shadow_rays(run.scene(SCENES[name]), run.pick(SIZE))
    blocked, high = asked.visits.blocked, float(np.percentile(asked.total("closest"), 99))

    def heat(kind: str, caption: str) -> Picture:
        total = asked.total(kind)
        alt = f"{caption}: {total[blocked].mean():.0f} boxes and triangles for a blocked ray, {total[~blocked].mean():.0f} for a free one."
        return run.map_of_two(
            asked.picture(total), asked.picture(blocked) == 1, alt, caption, name=f"{name}-{kind}",
            ramps={"free": "blue", "blocked": "amber"}, high=high, unit=WHAT,
        )  # fmt: skip

    any_hit, closest = (asked.picture(asked.total(kind)) for kind in ("any", "closest"))
    run.exr(np.nan_to_num(np.stack([any_hit, closest, asked.picture(blocked)], 2)), name)
    alt = f"Saved: {measured[f'{name}_saved_blocked']:v} for blocked rays, nothing for free ones."
    saved = run.map(
        closest - any_hit,
        alt,
        "saved by any hit",
        name=f"{name}-saved",
        ramp="amber",
        high=high / 2,
        unit=WHAT,
        noise=True,
    )
    return Row(
        [heat("any", "any hit"), heat("closest", "closest hit"), saved],
        "One ray a pixel, to the middle of a light; black: no ray.",
    )


FIGURE = Figure(
    number=5, chapter=2, title="Anything, or the first thing", seconds=Pick(5, 45),
    question=Question(
        "A shadow ray may stop at any blocker, a viewing ray has to find the first surface. "
        "How much of what the shadow rays of a room visit does that save?",
        ("more than half", "a few per cent", "nothing at all"), 1,
    ),
    variants=[], measure=_measure, stage=_stage,
    answer=Number("interior_saved", "So much less is visited in the room: {interior_saved_blocked} less by blocked rays, nothing less by free ones, and most are free. "
        "A free ray has to look at every box on its way, whatever it asks."),
    equation=Equation([SEGMENT], "Marked: any t will do. To say 0, one is enough; to say 1, there must be none in all boxes on the way."),
    claims=[
        Claim("A free ray gains nothing.", "free", near=0.0, within=1e-6, main=True, measured="{free} saved, in the best of three scenes"),
        Claim("A blocked ray gains, where much lies behind its blocker.", "interior_saved_blocked", above=0.05,
              measured="{interior_saved_blocked} in the interior, {many-lights_saved_blocked} among the lamps, {scan_saved_blocked} in the stone"),
        Claim("Both give the same answer.", "differ", below=1e-5, measured="{differ} of the rays differ"),
    ],
)  # fmt: skip
