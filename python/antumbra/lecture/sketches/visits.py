"""What shadow rays visit: maps of any hit and closest hit, and the table of all scenes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from antumbra._words import written
from antumbra.lecture.measures.visits import COUNTS, RAYS, shadow_rays
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Picture, Row, Table
from antumbra.scene import Scene

_WHAT = "boxes and triangles"


def maps_of_visits(
    run: Run, scene: Scene, name: str, size: tuple[int, int], saved: Mapping[str, Quantity]
) -> Row:
    """Three maps of one shadow ray a pixel; `saved`: by "blocked" and by "free" ones."""
    asked = shadow_rays(scene, size)
    blocked, high = asked.visits.blocked, float(np.percentile(asked.total("closest"), 99))
    any_hit, closest = (asked.picture(asked.total(kind)) for kind in ("any", "closest"))
    where = asked.picture(blocked)
    run.exr(np.nan_to_num(np.stack([any_hit, closest, where], 2)), name)

    def heat(kind: str, caption: str) -> Picture:
        total = asked.total(kind)
        means = [f"{total[some].mean():.0f}" for some in (blocked, ~blocked)]
        alt = f"{caption}: {means[0]} {_WHAT} for a blocked ray, {means[1]} for a free one."
        ramps = {"free": "blue", "blocked": "amber"}
        values = asked.picture(total)
        return run.map_of_two(
            values, where == 1, alt, caption, name=f"{name}-{kind}", ramps=ramps, high=high, unit=_WHAT
        )

    alt = f"Saved: {saved['blocked']:v} for blocked rays, {saved['free']:v} for free ones."
    less = run.map(
        closest - any_hit, alt, "saved by any hit", name=f"{name}-saved", ramp="amber", high=high / 2,
        unit=_WHAT, noise=True,
    )  # fmt: skip
    note = "One ray a pixel, to the middle of a light; black: no ray."
    return Row([heat("any", "any hit"), heat("closest", "closest hit"), less], note)


def table_of_visits(
    measured: Mapping[str, Quantity], scenes: Sequence[str], note: str, clock: bool = True
) -> Table:
    """A line for the blocked and the free rays of each scene, its quantities named `scene_count_rays`.

    Without the `clock` no rates: those of few rays are noise.
    """
    rows = []
    for name in scenes:
        for word in RAYS.values():
            counts = [written(measured[f"{name}_{count}_{word}"].value) for count in COUNTS]
            share, saved = (
                f"{100 * measured[f'{name}_{what}_{word}'].value:.1f} %" for what in ("share", "saved")
            )
            rate, faster = (measured[f"{name}_{what}_{word}"] for what in ("any_rate", "faster"))
            timed = [written(rate.value, 2), f"{faster:r}"] if clock else []
            rows.append([f"{name}, {word}", share, *counts, saved, *timed])
    head = (
        "rays", "share", "any hit: boxes", "closest: boxes", "any hit: triangles", "closest: triangles", "saved",
        *(("M rays/s, any hit", "rays/s over closest hit") if clock else ()),
    )  # fmt: skip
    return Table(
        head,
        rows,
        "Boxes and triangles visited by a shadow ray",
        fine=(1, 4, 5, 7)[: 4 if clock else 3],
        note=note,
    )
