"""A square light, the edge of a board halfway to the receiver, and the penumbra, from the side."""

from __future__ import annotations

from antumbra.lecture.stages import Drawing, Sketch
from antumbra.lecture.stages.drawing import INK, LIGHT, LIT, PENUMBRA, UMBRA

# Where light, board and receiver stand; the board reaches from the top to the middle.
_LIGHT, _BOARD, _FLOOR, _MIDDLE, _WIDTH = 50.0, 150.0, 250.0, 160.0, 300.0


def from_the_side(size: float) -> Drawing:
    """For a light of edge `size` (0: a point), at the scale of a map of 3.2 m beside it: 100 units are 1 m."""
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
    drawing.text((14, 92 if size < 1 else 80), f"s = {size:g} m")
    drawing.text((_BOARD - 6, 30), "occluder", anchor="end").text((_FLOOR - 8, 306), "receiver", anchor="end")
    for a, b, word in ((_LIGHT, _BOARD, "d₁"), (_BOARD, _FLOOR, "d₂")):
        drawing.line((a + 4, 262), (b - 4, 262), faint=True)
        drawing.text(((a + b) / 2, 256), word, anchor="middle", fine=True)
    return drawing.done(
        f"Side view: a light of edge {size:g} m, the edge of a board halfway, and the receiver, on which the penumbra "
        f"is {size:g} m wide."
    )
