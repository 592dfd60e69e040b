"""A ray from a cylinder through a light to a plane, with t where it meets them; the slider that moves the plane."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from antumbra._words import minus
from antumbra.lecture.measures.false_shadow import wrong_pixels
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Drawing, Frame, Sketch, Strip
from antumbra.lecture.stages.drawing import INK, LIGHT, LIT, RIM, Point

GREEN, ORANGE, SOFT = "#12793a", "#bf3a12", "#555c69"


def plane_moved(
    run: Run, heights: Sequence[float], start: float, p: Point, cylinder: tuple[float, float]
) -> Strip:
    """The plane at each height, without the test and with it: variants `off` and `on`; `cylinder`: axis and radius."""
    white = 1.3 * run.white(f"on{start}")
    falling = sorted(heights, reverse=True)
    frames = [_frame(run, height, start, p, cylinder, white) for height in falling]
    label = "Height of the plane [m]; the light is at 0, the cylinder above it"
    labels = ("side view", "test off", "test on")
    note = (
        "Green: the part from p to the light, t from 0 to 1. Orange: what a ray without end goes on to find. "
        "Test off: --distance-test off."
    )
    return Strip("plane", label, frames, labels, note=note, tells=falling.index(start))


def _frame(
    run: Run, height: float, start: float, p: Point, cylinder: tuple[float, float], white: float
) -> Frame:
    t = (p[1] - height) / p[1]
    where = "behind the light" if t > 1 else "at the light" if t == 1 else "between: a shadow"
    wrong = wrong_pixels(run, height, start)
    alts = {
        "off": f"Without the test, the plane at {height}: {wrong:v} of the pixels are wrong.",
        "on": f"With the test, the plane at {height}: the cylinder is {'lit' if t > 1 else 'dark'} below.",
    }
    pictures = [
        run.picture(f"{test}{height}", alt, white=white, colour=True, tones=128) for test, alt in alts.items()
    ]
    says = f"plane at {minus(f'{height:g}')} m: met at t = {t:.2f}, {where}"
    drawing = along_the_cylinder(p, height, *cylinder)
    return Frame(f"{height:g}", says, pictures, f"t = {t:.2f}", drawing=drawing)


def along_the_cylinder(p: Point, plane: float, axis: float, radius: float) -> Drawing:
    """The cut across the cylinder, z to the right and y up; the light is at (0, 0).

    `p` (z, y) on the cylinder, of `radius` about (0, `axis`); `plane`: its height.
    """

    def at(z: float, y: float) -> Point:
        return 90 + 76 * z, 122 - 76 * y

    t = (p[1] - plane) / p[1]
    start, light, end = at(*p), at(0, 0), at(p[0] * (1 - t), plane)
    sketch = Sketch(452, 280, ground=LIT)
    if t > 1:
        _false_shadow(sketch, at, plane, axis, radius)
    sketch.line(at(-1.1, plane), at(1.1, plane), width=3)
    sketch.circle(at(0, axis), 76 * radius, "#5f7f9f", stroke=INK).circle(light, 7, LIGHT, stroke=RIM)
    if t > 1:
        sketch.line(start, light, colour=GREEN, width=3).line(light, end, colour=ORANGE, width=3, dash="6 4")
    elif t == 1:
        sketch.line(start, light, colour=GREEN, width=3)
    else:
        sketch.line(start, end, colour=ORANGE, width=3, dash="6 4").line(end, light, colour=SOFT, dash="2 4")
    if t != 1:
        _cross(sketch, end)
    sketch.circle(start, 5, "#fff", stroke=INK)
    marks = [(start, "t = 0, p"), (light, "t = 1, light"), (end, f"t = {t:.2f}, plane")]
    low = -100.0
    for (x, y), words in sorted(marks, key=lambda mark: mark[0][1]):
        low = max(low + 36, y)
        sketch.line((x + 9, y), (180, low), colour=SOFT, dash="1 3").text((184, low + 5), words)
    return sketch.done(f"The ray from p through the light, at t = 1, meets the plane at t = {t:.2f}.")


def _false_shadow(sketch: Sketch, at: Callable[..., Point], plane: float, axis: float, radius: float) -> None:
    """What of the plane sees the cylinder behind the light, and the tangents that bound it."""
    sine = radius / axis
    cosine = (1 - sine * sine) ** 0.5
    for side in (-1, 1):
        touch = (-side * radius * cosine, axis - radius * sine)
        sketch.line(at(side * -plane * sine / cosine, plane), at(*touch), colour=ORANGE, dash="1 4")
    width = -plane * sine / cosine
    sketch.line(at(-width, plane), at(width, plane), colour=ORANGE, width=9)


def _cross(sketch: Sketch, center: Point) -> None:
    x, y = center
    for rise in (-6, 6):
        sketch.line((x - 6, y - rise), (x + 6, y + rise), colour=ORANGE, width=3)
