"""Samples of one pixel in the pixel and on the light, linked: which quarter of the one meets which of the other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.pairs import COARSE, PIXEL, SET, Samples, usual
from antumbra.lecture.pictures import luminance
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.three_pillars import CORNER, U, V, three_pillars
from antumbra.lecture.stages import Linked, Sketch, Table

# Of the picture: the edge of pixel and light, and what is between them.
_EDGE, _GAP = 260, 90
_CELLS = 52


def _content(run: Run) -> NDArray[np.float64]:
    """The pixel enlarged and the light, (H, W): brighter where more of the pixel sees it."""
    scene, (column, row) = run.scene(three_pillars), PIXEL
    width, height = COARSE["size"]
    look = COARSE | {
        "size": (width * _EDGE, height * _EDGE),
        "crop": (column * _EDGE, row * _EDGE, _EDGE, _EDGE),
    }
    inside = luminance(
        scene.render(**look, estimator="area", viewing_rays=1, shadow_rays=16, seed=run.seeded(7)).pixels
    )
    origins, directions = scene.camera_rays(
        (width * 8, height * 8), **{n: COARSE[n] for n in ("eye", "look_at", "fov")}
    )
    chosen = np.arange(len(origins)).reshape(height * 8, width * 8)[row * 8 :, column * 8 :][:8, :8].ravel()
    at = scene.closest_hit(origins[chosen], directions[chosen]).receivers
    v, u = (np.indices((_CELLS, _CELLS)) + 0.5) / _CELLS
    points = (CORNER + u[..., None] * U + v[..., None] * V).reshape(-1, 3)
    # Rays end a little before the light, which rounded points may lie behind.
    every = at[np.tile(np.arange(len(at)), len(points))]
    along = points.repeat(len(at), 0) - every.positions
    blocked = scene.occluded(every, directions=along, max_distance=0.999)
    seen = 1.0 - blocked.reshape(_CELLS, _CELLS, -1).mean(2)
    light = np.kron(seen, np.ones((_EDGE // _CELLS,) * 2))
    # Both as shares of their brightest; the ground between them is dark.
    parts = [inside / np.percentile(inside, 99), np.zeros((_EDGE, _GAP)), 0.08 + 0.6 * light]
    return np.concatenate(parts, axis=1)


def _names(of: Samples) -> list[str]:
    return [f"{'abcd'[pixel]}{1 + light}" for pixel, light in of.pairs]


def linked(run: Run, way: str, says: str) -> Linked:
    """A usual set of samples drawn in one of `WAYS`, `says`: how, in words."""
    of = usual(run, way)
    names, order = _names(of), np.argsort(_names(of), kind="stable")
    sketch = _quarters()
    for row, n in enumerate(order):
        sketch.linked(row, _sample(of, int(n)))
    rows = [[names[n], "free" if of.free[n] else "blocked", f"{of.brings[n]:.3f}"] for n in order]
    table = Table(
        ("pair", "V", "brings"), rows, f"{SET} samples of the pixel, {says}",
        note="What one sample says of the pixel [W·m⁻²·sr⁻¹]. Point at a row or at a dot. "
        "Of 16 such sets the one whose number of pairs is nearest to the mean.",
    )  # fmt: skip
    alt = f"{SET} samples, {says}: {of.different} of 16 pairs of quarters of pixel and light."
    key = "Left: one pixel. Right: the light, bright where the pixel sees it; green dot: free, orange cross: blocked."
    picture = run.picture(_shown(run), alt, name=f"pixel-{way}", white=1.0)
    return Linked(f"sample-{way}", picture, sketch.done(alt), table, key)


def _quarters() -> Sketch:
    """Pixel and light in quarters, a to d and 1 to 4."""
    sketch, half = Sketch(2 * _EDGE + _GAP, _EDGE), _EDGE / 2
    for left, words in ((0, "abcd"), (_EDGE + _GAP, "1234")):
        sketch.line((left + half, 0), (left + half, _EDGE), colour="#fff", dash="2 4")
        sketch.line((left, half), (left + _EDGE, half), colour="#fff", dash="2 4")
        for n, word in enumerate(words):
            sketch.text((left + 8 + half * (n % 2), 22 + half * (n // 2)), word)
    return sketch


def _sample(of: Samples, n: int) -> Sketch:
    """Its dot in the pixel, its dot or cross on the light, and a thin line between."""
    start, end = _EDGE * of.pixel[n], _EDGE * of.light[n] + [_EDGE + _GAP, 0.0]
    drawn = Sketch(1, 1).line(start, end, colour="#fff", faint=True)
    drawn.circle(start, 5, "#fff", stroke="#15181f")
    # A ray of no length is its end alone.
    return drawn.ray(end, end, bool(of.free[n]))


def _shown(run: Run) -> NDArray[np.float64]:
    found: NDArray[np.float64] = run.once("pixel and light", lambda: _content(run))
    return found
