"""A small writer of SVG for drawings beside and over pictures, with the page's colours, rays and labels: `Sketch`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from antumbra.lecture.stages.base import Drawing

Point = Sequence[float]

# Colours that pictures carry in both themes.
LIGHT, INK, RIM = "#f2b705", "#15181f", "#8a6a00"
UMBRA, PENUMBRA, ANTUMBRA, LIT = "var(--umbra)", "var(--penumbra)", "var(--antumbra)", "var(--lit)"


class Sketch:
    """Draws on `width` × `height` units, y down. Text stays dark on a pale ground in both themes.

    >>> sketch = Sketch(560, 320, ground=LIT)
    >>> sketch.line((0, 0), (10, 10)).text((5, 5), "receiver").done("A receiver.").width
    560
    """

    def __init__(self, width: float, height: float, ground: str = "") -> None:
        """An empty drawing, or one with a `ground` of this colour."""
        self.width, self.height = width, height
        self._parts: list[str] = []
        if ground:
            self._parts.append(f'<rect width="{_n(width)}" height="{_n(height)}" fill="{ground}"/>')

    def line(
        self, a: Point, b: Point, *, colour: str = INK, width: float = 1, dash: str = "", faint: bool = False
    ) -> Sketch:
        """A straight line."""
        return self._path(f"M{_p(a)}L{_p(b)}", colour, width, dash, faint)

    def curve(
        self, points: Iterable[Point], *, colour: str = INK, width: float = 1, dash: str = ""
    ) -> Sketch:
        """A line through points."""
        return self._path("M" + "L".join(_p(p) for p in points), colour, width, dash, False)

    def polygon(self, points: Iterable[Point], fill: str, *, stroke: str = "") -> Sketch:
        """A filled polygon."""
        edge = f' stroke="{stroke}"' if stroke else ""
        return self._add(f'<polygon points="{" ".join(_p(p) for p in points)}" fill="{fill}"{edge}/>')

    def circle(self, center: Point, radius: float, fill: str, *, stroke: str = "", dash: str = "") -> Sketch:
        """A disk or ring (`fill` "none")."""
        edge = (f' stroke="{stroke}"' if stroke else "") + (f' stroke-dasharray="{dash}"' if dash else "")
        x, y = center
        return self._add(f'<circle cx="{_n(x)}" cy="{_n(y)}" r="{_n(radius)}" fill="{fill}"{edge}/>')

    def light(self, a: Point, b: Point, width: float = 8) -> Sketch:
        """A light seen from its edge, with its rim."""
        return self.line(a, b, colour=RIM, width=width + 3).line(a, b, colour=LIGHT, width=width)

    def text(
        self,
        at: Point,
        words: str,
        *,
        anchor: str = "start",
        fine: bool = False,
        tells: bool = False,
        halo: str = "",
        ink: str = INK,
    ) -> Sketch:
        """A label; `fine`: a second one, which a phone and a slide leave out; `tells`: a result, hidden until the
        question is answered; `halo`: the colour of a rim that keeps lines behind it away; `ink` "" follows the theme.
        """
        kind = ' class="fine"' if fine else ' class="num"' if tells else ""
        rim = f";paint-order:stroke;stroke:{halo};stroke-width:6px" if halo else ""
        style = f' style="fill:{ink}{rim}"' if ink else ""
        x, y = at
        return self._add(
            f'<text x="{_n(x)}" y="{_n(y)}" text-anchor="{anchor}"{kind}{style}>{escape(words)}</text>'
        )

    def ray(self, a: Point, b: Point, free: bool) -> Sketch:
        """A shadow ray over a picture: free, solid to a dot; blocked, dashed to a cross where it was stopped."""
        kind = "f" if free else "b"
        self._add(
            f'<path class="ray c" d="M{_p(a)}L{_p(b)}"/><path class="ray {kind}" d="M{_p(a)}L{_p(b)}"/>'
        )
        if free:
            return self.circle(b, 4, "#12793a", stroke="#fff")
        x, y = b
        cross = f"M{_n(x - 6)} {_n(y - 6)}l12 12m0-12l-12 12"
        return self._path(cross, "#0b0d14", 6, "", False)._path(cross, "#ff8d5e", 3, "", False)

    def linked(self, row: int, group: Sketch) -> Sketch:
        """Adds what `group` drew as one thing with row `row` of the table of a `Linked` stage."""
        return self._add(f'<g class="rg1" data-j="{row}">{"".join(group._parts)}</g>')

    def raw(self, svg: str) -> Sketch:
        """Adds SVG as it is."""
        return self._add(svg)

    def done(self, alt: str) -> Drawing:
        """The drawing, with what it shows in a sentence."""
        return Drawing("".join(self._parts), self.width, self.height, alt)

    def _path(self, d: str, colour: str, width: float, dash: str, faint: bool) -> Sketch:
        more = (f' stroke-dasharray="{dash}"' if dash else "") + (' opacity=".55"' if faint else "")
        return self._add(f'<path d="{d}" fill="none" stroke="{colour}" stroke-width="{_n(width)}"{more}/>')

    def _add(self, svg: str) -> Sketch:
        self._parts.append(svg)
        return self


def _n(x: float) -> str:
    return f"{x:.1f}".removesuffix(".0")


def _p(point: Point) -> str:
    x, y = point
    return f"{_n(x)},{_n(y)}"
