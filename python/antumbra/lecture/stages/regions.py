"""Drawings of umbra, penumbra and antumbra: the side view, and the key of the four regions."""

from __future__ import annotations

from collections.abc import Sequence

from antumbra.lecture.geometry import Disks
from antumbra.lecture.stages.base import Drawing
from antumbra.lecture.stages.drawing import ANTUMBRA, LIGHT, LIT, PENUMBRA, RIM, UMBRA, Sketch
from antumbra.lecture.stages.key import Entry, Key

# Of the side view: units of the drawing per unit of the scene, and where the light stands.
_SCALE, _LEFT, _WIDTH, _HEIGHT = 40.0, 36.0, 560.0, 320.0


def side_view(disks: Disks, g: float) -> Drawing:
    """Light, occluder and receiver `g` behind it from the side: as high as a map of ± 4 units beside it."""

    def at(x: float, y: float) -> tuple[float, float]:
        return _LEFT + _SCALE * (disks.a + x), _HEIGHT / 2 - _SCALE * y

    R, r, a = disks
    umbra, outside, closed = disks.umbra(g), disks.penumbra(g), min(g, disks.length)
    rest = max(disks.umbra(closed), 0.0)
    sketch = Sketch(_WIDTH, _HEIGHT, ground=LIT)
    sketch.polygon([at(0, r), at(g, outside), at(g, -outside), at(0, -r)], PENUMBRA)
    sketch.polygon([at(0, r), at(closed, rest), at(closed, -rest), at(0, -r)], UMBRA)
    if umbra < 0:
        sketch.polygon([at(closed, 0), at(g, -umbra), at(g, umbra)], ANTUMBRA)
    for top, side in ((R, -1), (-R, 1), (R, 1), (-R, -1)):
        sketch.line(at(-a, top), at(g, top + (side * r - top) * (a + g) / a), width=0.8, faint=True)
    for y in sorted({outside, -outside, umbra, -umbra}):
        sketch.line(at(g, y), (_WIDTH, at(g, y)[1]), dash="2 4")
    sketch.light(at(-a, R), at(-a, -R)).line(at(0, r), at(0, -r), width=7)
    sketch.line((at(g, 0)[0], 6), (at(g, 0)[0], _HEIGHT - 6), width=3)
    _labels(sketch, disks, at(g, 0)[0])
    state = "an umbra" if umbra > 0 else "an antumbra" if umbra < 0 else "the point where the umbra closes"
    return sketch.done(
        f"Side view: light, occluder, and the receiver {g:g} behind it, which meets {state} inside of the penumbra."
    )


def _labels(sketch: Sketch, disks: Disks, receiver: float) -> None:
    """Names and sizes, clear of each other, of rays and of the `receiver` also where text is 33 units high."""
    R, r, a = disks
    light, occluder, below = _LEFT, _LEFT + _SCALE * a, _HEIGHT - 58
    sketch.text((8, 106), "light").text((8, 236), f"R = {R:g}")
    sketch.line((occluder, 70), (occluder, _HEIGHT / 2 - _SCALE * r), dash="1 3")
    sketch.text((occluder + 8, 62), "occluder", anchor="end")
    sketch.text((occluder + 8, 236), f"r = {'½' if r == 0.5 else f'{r:g}'}", anchor="end")
    sketch.line((light, below), (occluder, below))
    for end in (light, occluder):
        sketch.line((end, below - 6), (end, below + 6))
    sketch.text(((light + occluder) / 2, below + 38), f"a = {a:g}", anchor="middle")
    left = receiver < 0.7 * _WIDTH
    sketch.text((receiver + (8 if left else -8), 30), "receiver", anchor="start" if left else "end")


def regions_key(strip: str, facts: Sequence[int], note: str = "") -> Key:
    """The four regions, with what a receiver there sees of a round light; `facts`: which fact of a frame each shows."""
    rows = [
        ("var(--umbra)", "Umbra", "no point visible", 0.0, 21.0, "The light is wholly covered."),
        (
            "var(--penumbra)",
            "Penumbra",
            "outline cut",
            10.0,
            14.0,
            "A part of the light and of its outline is covered.",
        ),
        (
            "var(--antumbra)",
            "Antumbra",
            "whole outline, not all inside",
            0.0,
            10.0,
            "A ring of the light is visible.",
        ),
        ("var(--lit)", "Lit", "every point visible", 0.0, 0.0, "The whole light is visible."),
    ]
    entries = [
        Entry(
            colour, name, text, _face(shift, radius, alt), fact, "" if fact >= 0 else "outside the penumbra"
        )
        for (colour, name, text, shift, radius, alt), fact in zip(rows, facts, strict=True)
    ]
    return Key(entries, strip, note)


def _face(shift: float, covered: float, alt: str) -> Drawing:
    """A light of radius 17 behind a disk."""
    sketch = Sketch(52, 52).circle((26, 26), 17, LIGHT)
    if covered:
        sketch.circle((26 + shift, 26), covered, UMBRA, stroke="var(--soft)")
    return sketch.circle((26, 26), 17, "none", stroke=RIM, dash="2 2").done(alt)
