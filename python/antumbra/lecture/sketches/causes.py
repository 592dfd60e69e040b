"""Maps of the causes of noise, all on one scale."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from antumbra._words import written
from antumbra.lecture.measures.causes import KNOWN, PAIRS, SQUARES, parts
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Drawing, Panel, Picture, Row, Sketch, Tabs
from antumbra.lecture.stages.drawing import INK, LIT, PENUMBRA
from antumbra.lecture.stages.quantities import tabs_of

# Under the half-hidden disk: the parts, and the size of a drawing.
_KNOWN = {"visibility": "visibility", "geometry": "geometry", "interaction": "V with g", "whole": "all"}
_KNOWN_SIZE = (380.0, 300.0)


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
            words,
            name=name.replace("_", "-"),
            ramp=ramp,
            low=low,
            high=high,
            unit="W·m⁻²·sr⁻¹" + (", signed root" if signed else ""),
            noise=True,
        )

    total = shown("whole", "all together")
    # The answer is not the first that is seen.
    order = sorted(SQUARES, key=lambda name: name == "light")
    rows = {name: (SQUARES[name], [one, total, shown(name, SQUARES[name])]) for name in order}
    pairs = [shown(name, words, signed=True) for name, words in PAIRS.items()]
    maps = tabs_of("cause", "Cause of the noise", {**rows, "covariances": ("covariances", pairs)}, ["light"])
    return replace(maps, panels=[*maps.panels, Panel("known", "known", [half_hidden(found)])])


def half_hidden(found: Mapping[str, Quantity]) -> Row:
    """The half-hidden disk from the side, and its parts: by closed form, and measured (`half-…` of `found`)."""
    most = max(found[f"half-{name}"].error for name in _KNOWN)
    note = (
        f"Bars: variance of one shadow ray [W² m⁻⁴], measured within {written(most, 1)}; lines: closed forms. "
        "Numbers: measured / closed form. ḡ² Var V, v̄² Var g, Var (V − v̄)(g − ḡ), and all; covariances are 0."
    )
    return Row([_from_the_side(), _bars(found)], note)


def _from_the_side() -> Drawing:
    sketch, receiver, top, plate = Sketch(*_KNOWN_SIZE, ground=LIT), (190.0, 246.0), 56.0, 150.0
    sketch.polygon([receiver, (40.0, top), (190.0, top)], PENUMBRA)
    sketch.polygon([receiver, (190.0, top), (340.0, top)], "#fff")
    sketch.light((40.0, top), (340.0, top)).line((90.0, plate), (190.0, plate), width=6)
    sketch.line((10.0, 246.0), (370.0, 246.0), width=3).circle(receiver, 6, "#fff", stroke=INK)
    words = (
        ((190, 36), "disk, R = h = 1", "middle"),
        ((84, plate + 8), "plate", "end"),
        ((190, 286), "receiver", "middle"),
    )
    for at, text, anchor in words:
        sketch.text(at, text, anchor=anchor)
    sketch.text((134, 100), "V = 0", anchor="middle", ink="#fff").text((246, 100), "V = 1", anchor="middle")
    return sketch.done("From the side: a plate hides half of a disk light from a receiver.")


def _bars(found: Mapping[str, Quantity]) -> Drawing:
    sketch, scale, height = Sketch(*_KNOWN_SIZE, ground=LIT), 420.0, 22.0
    for n, (name, words) in enumerate(_KNOWN.items()):
        of, y = found[f"half-{name}"], 40.0 + 70 * n
        end, edge = 10 + scale * of.value, 10 + scale * KNOWN[name]
        sketch.polygon([(10, y), (end, y), (end, y + height), (10, y + height)], PENUMBRA)
        sketch.line((edge, y - 4), (edge, y + height + 4), width=4)
        sketch.text((10, y - 10), f"{words} {of.value:.3f} / {KNOWN[name]:.3f}")
    said = ", ".join(f"{words} {found[f'half-{name}']}" for name, words in _KNOWN.items())
    return sketch.done(f"Parts of the variance, measured: {said}.")
