"""Umbra, penumbra and antumbra of disks on one axis: the slider that moves the receiver."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antumbra.lecture.geometry import Disks
from antumbra.lecture.measures.regions import radii_of
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Strip
from antumbra.lecture.stages.regions import side_view


def receiver_moved(run: Run, disks: Disks, distances: Sequence[float], width: float) -> Strip:
    """Side view, map and picture of the receiver at each distance g behind the occluder: variants `g{g}`."""
    label = "Receiver, distance g behind the occluder"
    labels = ("Side view", "Regions", "Picture")
    return Strip("g", label, [_frame(run, disks, g, width) for g in distances], labels,
                 tells=distances.index(disks.length))  # fmt: skip


def _frame(run: Run, disks: Disks, g: float, width: float) -> Frame:
    key = f"g{g}"
    at, light, full = (
        radii_of(run, key, width), run.light(key), float(run.aov(key, "unshadowed-direct").max()),
    )  # fmt: skip
    name, radius = ("umbra", at.umbra) if at.umbra else ("antumbra", at.antumbra)
    meaning = f"{name} radius {radius:.2f}" if radius else "no umbra, no antumbra"
    true = (max(disks.umbra(g), 0.0), disks.penumbra(g), max(-disks.umbra(g), 0.0))
    found = zip((at.umbra, at.outside, at.antumbra), true, strict=True)
    centre = light[len(light) // 2, len(light) // 2] / full
    alts = (
        f"Region map at g = {g}: {meaning}, in a penumbra out to {at.outside:.2f}.",
        f"Picture of the receiver at g = {g}: its centre has {centre:.0%} of the unshadowed light.",
    )
    pictures = [
        run.classes(run.aov(key, "regions").astype(np.uint8), alts[0], name=f"{key}-map"),
        run.picture(key, alts[1], white=full),
    ]
    return Frame(
        f"{g:g}", f"g = {g}: {meaning}", pictures, f"g = {g}", f", penumbra out to {at.outside:.2f}",
        side_view(disks, g), [f"{m:.3f} / {t:.3f}" if m else "none here" for m, t in found],
    )  # fmt: skip
