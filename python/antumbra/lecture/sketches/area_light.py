"""A square light, the edge of a board halfway to the receiver, and the penumbra, from the side."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.square_lights import DISTANCE_RATIOS
from antumbra.lecture.stages import Drawing, Frame, Sketch
from antumbra.lecture.stages.drawing import INK, LIGHT, LIT, PENUMBRA, UMBRA

# Where light, board and receiver stand; the board reaches from the top to the middle.
_LIGHT, _BOARD, _FLOOR, _MIDDLE, _WIDTH = 50.0, 150.0, 250.0, 160.0, 300.0


def from_the_side(size: float, says: str) -> Drawing:
    """For a light of edge `size` (0: a point) and what `says` of its penumbra.

    At the scale of a map of 3.2 m beside it: 100 units are 1 m.
    """
    drawing, half, edge = Sketch(_WIDTH, 2 * _MIDDLE, ground=LIT), 50 * size, (_BOARD, _MIDDLE)
    drawing.polygon([edge, (_FLOOR, _MIDDLE - half), (_FLOOR, 0), (_BOARD, 0)], UMBRA)
    if size > 0:
        drawing.polygon([edge, (_FLOOR, _MIDDLE - half), (_FLOOR, _MIDDLE + half)], PENUMBRA)
    for end in sorted({-half, half}):
        drawing.line((_LIGHT, _MIDDLE + end), (_FLOOR, _MIDDLE - end), faint=True)
        drawing.line((_FLOOR, _MIDDLE + end), (_WIDTH, _MIDDLE + end), dash="2 4")
    drawing.line((_BOARD, 0), edge, width=5).line((_FLOOR, 0), (_FLOOR, 2 * _MIDDLE), width=3)
    if size > 0:
        drawing.light((_LIGHT, _MIDDLE - half), (_LIGHT, _MIDDLE + half))
    else:
        drawing.circle((_LIGHT, _MIDDLE), 5, LIGHT, stroke=INK)
    drawing.text((6, 30), f"s = {size:g} m")
    drawing.text((_BOARD - 6, 76), "occluder", anchor="end").text((_FLOOR - 8, 306), "receiver", anchor="end")
    for a, b, word in ((_LIGHT, _BOARD, "d₁"), (_BOARD, _FLOOR, "d₂")):
        drawing.line((a + 4, 262), (b - 4, 262), faint=True)
        drawing.text(((a + b) / 2, 256), word, anchor="middle")
    return drawing.done(
        f"Side view: a light of edge {size:g} m, the edge of a board halfway, and the receiver: {says}."
    )


def frame(run: Run, found: Mapping[str, Quantity], size: float, white: float) -> Frame:
    """The side view, the floor from below the boards, and everything from outside, under a light of edge `size`.

    `found`: the widths w`size`-`board`.
    """
    widths = [found[f"w{size:g}-{board}"] for board in range(len(DISTANCE_RATIOS))] if size else []
    says = (
        f"penumbras {', '.join(f'{w.value:.2f}' for w in widths)} m wide"
        if size
        else "one edge for each board"
    )
    below = f"The receiver under a light of edge {size:g} m: {says}."
    outside = f"The three boards over the receiver, light of edge {size:g} m."
    views = ((f"floor-{size}", below), (f"view-{size}", outside))
    pictures = [run.picture(key, alt, white=white) for key, alt in views]
    last = f"penumbra {widths[-1].value:.2f} m wide at d₂ = d₁" if size else "no penumbra"
    word = f"s = {size:g} m: {last}" if size else f"a point light: {last}"
    return Frame(
        f"{size:g}", word, pictures, f"s = {size:g} m" if size else "point", "", from_the_side(size, last)
    )
