"""Maps of the causes of noise, all on one scale."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from antumbra.lecture.measures.causes import KNOWN, PAIRS, SQUARES, parts
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Drawing, Panel, Picture, Row, Sketch, Tabs
from antumbra.lecture.stages.drawing import INK, LIT, PENUMBRA
from antumbra.lecture.stages.quantities import tabs_of

_KNOWN = {
    "visibility": "visibility, ḡ² Var V", "geometry": "geometry, v̄² Var g", "interaction": "V with g", "whole": "all",
}  # fmt: skip


def causes(run: Run, found: Mapping[str, Quantity], one: Picture) -> Tabs:
    """For each cause the picture `one`, the noise of all causes, and its own; covariances side by side."""
    first = parts(run)[0]
    high = float(np.quantile(np.sqrt(first.whole), 0.99))

    def shown(name: str, words: str, signed: bool = False) -> Picture:
        part, ramp, low = getattr(first, name), "signed" if signed else "amber", -high if signed else 0.0
        # An estimate of a variance may fall below 0, a covariance may be negative: its root with its sign.
        root = np.sign(part) * np.sqrt(np.abs(part)) if signed else np.sqrt(np.maximum(part, 0.0))
        share = f": {found[name]:1}" if name in found else ""
        return run.map(
            root,
            f"{'Root of the covariance, with its sign,' if signed else 'Standard deviation'} by pixel, {words}{share}.",
            f"{words}{share}",
            name=name.replace("_", "-"),
            ramp=ramp,
            low=low,
            high=high,
            unit="W·m⁻²·sr⁻¹" + (", signed root" if signed else ""),
            noise=True,
        )

    total = shown("whole", "all together")
    rows = {name: (words, [one, total, shown(name, words)]) for name, words in SQUARES.items()}
    pairs = [shown(name, words, signed=True) for name, words in PAIRS.items()]
    maps = tabs_of("cause", "Cause of the noise", {**rows, "covariances": ("covariances", pairs)})
    return replace(maps, panels=[*maps.panels, Panel("known", "known answer", [half_hidden(found)])])


def half_hidden(found: Mapping[str, Quantity]) -> Row:
    """The half-hidden disk from the side, and its parts: by closed form, and measured (`half-…` of `found`)."""
    note = "Bars: variance of one shadow ray, measured; lines: closed forms. Then measured / closed form, in W² m⁻⁴."
    return Row([_from_the_side(), _bars(found)], note)


def _from_the_side() -> Drawing:
    sketch, receiver, (left, right, top, plate) = (
        Sketch(620, 440, ground=LIT),
        (310.0, 390.0),
        (70.0, 550.0, 60.0, 230.0),
    )
    sketch.polygon([receiver, (left, top), (310.0, top)], PENUMBRA)
    sketch.polygon([receiver, (310.0, top), (right, top)], "#fff")
    sketch.light((left, top), (right, top)).line((120.0, plate), (310.0, plate), width=7)
    sketch.line((40.0, 390.0), (580.0, 390.0), width=3).circle(receiver, 6, "#fff", stroke=INK)
    words = (
        ((310, 40), "disk light, R = h = 1", "middle"), ((110, plate + 8), "plate", "end"),
        ((310, 428), "receiver", "middle"),
    )  # fmt: skip
    for at, text, anchor in words:
        sketch.text(at, text, anchor=anchor)
    sketch.text((215, 150), "V = 0", anchor="middle", ink="#fff").text((405, 150), "V = 1", anchor="middle")
    return sketch.done("From the side: a plate hides half of a disk light from a receiver.")


def _bars(found: Mapping[str, Quantity]) -> Drawing:
    sketch, scale, height = Sketch(620, 440, ground=LIT), 590.0, 34.0
    for n, (name, words) in enumerate(_KNOWN.items()):
        of, y = found[f"half-{name}"], 46.0 + 86 * n
        sketch.polygon(
            [(14, y), (14 + scale * of.value, y), (14 + scale * of.value, y + height), (14, y + height)],
            PENUMBRA,
        )
        edge = 14 + scale * KNOWN[name]
        sketch.line((edge, y - 5), (edge, y + height + 5), width=4)
        sketch.text((14, y - 10), f"{words}: {of:1} / {KNOWN[name]:.3f}")
    said = ", ".join(f"{words} {found[f'half-{name}']}" for name, words in _KNOWN.items())
    return sketch.done(f"Parts of the variance, measured: {said}.")
