"""Shadow rays over a picture, from a receiver to the cells of a square light, and their table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.lecture.geometry import Project, projector
from antumbra.lecture.measures.pixel_rays import Rays
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.three_pillars import ALBEDO, AREA, CORNER, RADIANCE, VIEW, U, V, three_pillars
from antumbra.lecture.stages import Drawing, Linked, Sketch, Table
from antumbra.lecture.stages.drawing import LIGHT, RIM

Array = NDArray[np.float64]


class Drawn(NamedTuple):
    """A shadow ray: its `end` on the light, the point that it `reached`, and whether it is `free`."""

    end: ArrayLike
    reached: ArrayLike
    free: bool


def rays_over(
    project: Project,
    size: tuple[int, int],
    light: Sequence[Array],
    cells: int,
    p: ArrayLike,
    rays: Sequence[Drawn],
) -> Drawing:
    """Rays from `p` to a square `light` (corner and two edges) of `cells` × `cells` cells."""
    sketch, (corner, u, v) = Sketch(*size), light
    for n in range(cells + 1):
        outline, share = n in (0, cells), n / cells
        for a, b in ((u, v), (v, u)):
            ends = project(corner + share * a), project(corner + share * a + b)
            sketch.line(*ends, colour=LIGHT if outline else RIM, width=3 if outline else 1)
    start = project(p)
    for row, ray in enumerate(rays):
        drawn = Sketch(*size).ray(start, project(ray.reached), ray.free)
        if not ray.free:
            drawn.circle(project(ray.end), 4, "none", stroke="#bf3a12")
        sketch.linked(row, drawn)
    x, y = project(corner + u / 2 + v / 2)
    sketch.circle(start, 7, "#fff", stroke="#0b0d14").text(
        (start[0], start[1] + 32), "receiver p", anchor="middle"
    )
    sketch.text((x + 72, y), "light")
    free = sum(ray.free for ray in rays)
    return sketch.done(
        f"{len(rays)} shadow rays from the receiver to the light: {free} free, {len(rays) - free} blocked."
    )


def table_of_rays(rays: Rays, note: str) -> Table:
    """The factors of each ray, their products, and the sum; the density per area and per solid angle."""
    columns = (
        (rays.cos, 3), (rays.cos_light, 3), (rays.squared, 2), (rays.pdf, 3), (rays.pdf_angle, 2), (rays.brings, 4),
    )  # fmt: skip
    rows = [
        [
            f"{n + 1}",
            "free" if free else "blocked",
            *(f"{factor[n]:.{places}f}" for factor, places in columns),
        ]
        for n, free in enumerate(rays.free)
    ]
    head = ("ray", "V", "cos θ", "cos θ′", "r²", "pdf [1/m²]", "pdf [1/sr]", "brings")
    caption = "The shadow rays of this pixel, factor by factor"
    foot = ["sum = pixel", "", "", "", "", "", "", f"{rays.brings.sum():.4f}"]
    return Table(head, rows, caption, foot, fine=(5, 6), note=note)


def shadow_rays_linked(run: Run, key: str, rays: Rays, cells: int) -> Linked:
    """The rays over the picture `key` of the three pillars, and their table; one is drawn to what it meets first."""
    start = rays.p + [0.0, 1e-4, 0.0]
    along = rays.points - start
    met = run.scene(three_pillars).closest_hit(np.repeat(start[None], len(along), 0), along).t
    ends = start + np.minimum(met, 1.0)[:, None] * along
    drawn = [Drawn(*ray) for ray in zip(rays.points, ends, rays.free.tolist(), strict=True)]
    overlay = rays_over(projector(**VIEW), VIEW["size"], (CORNER, U, V), cells, rays.p, drawn)
    alt = (
        "Three pillars and a ball under a square light; the receiver lies in the penumbra of the tallest pillar, "
        f"{int(rays.free.sum())} of {len(drawn)} rays are free."
    )
    picture = run.picture(key, alt, white=1.05 * run.white(key, share=90.0))
    note = (
        f"A ray brings fᵣ Lₑ / {len(drawn)} · V cos θ cos θ′ / (pdf r²), the pdf per area: 1/A = 1/({AREA:.2f} m²), "
        f"fᵣ = {ALBEDO:g}/π and Lₑ = {RADIANCE:g} W·m⁻²·sr⁻¹. Per solid angle the same pdf is r²/(A cos θ′), "
        "as antumbra explain prints it for any pixel. Point at a row: its ray lights up."
    )
    key_of_rays = (
        "Green, dot: free. Orange, dashed, cross: blocked, drawn as far as it got. "
        "One random point in each cell."
    )
    return Linked("ray", picture, overlay, table_of_rays(rays, note), key_of_rays)
