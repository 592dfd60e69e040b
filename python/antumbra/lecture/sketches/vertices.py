"""The box with its body: openness at the vertices of coarser and finer meshes, beside that of each pixel."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from antumbra.hit import Hit
from antumbra.lecture.measures.vertices import (
    BODY_CELLS,
    CELLS,
    CUT_CELLS,
    SMOOTH_CELLS,
    baked,
    exact,
    interpolated,
)
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.open_box import FLOOR, TRAY, Patch, around, body, open_box, walls
from antumbra.lecture.stages import Frame, Strip
from antumbra.lecture.stages.quantities import curve_of
from antumbra.lecture.variant import Pick
from antumbra.study.plot import Curve, error_curves

Floats = NDArray[np.float64]

_PLACE = (0.33, 0.37)
_VIEW = {"eye": (0.78, 1.75, 1.75), "look_at": (0.5, 0.07, 0.5), "fov": 0.53}
_SIZE, _RAYS, _SEEN = Pick((108, 72), (360, 240)), Pick(128, 1024), Pick(256, 1024)


def _hit(run: Run) -> Hit:
    scene = run.scene(open_box(TRAY, _PLACE))
    found: Hit = run.once("hit", lambda: scene.closest_hit(*scene.camera_rays(run.pick(_SIZE), **_VIEW)))
    return found


def _picture(run: Run, values: Floats) -> Floats:
    width, height = run.pick(_SIZE)
    return values.reshape(height, width)


def _truth(run: Run) -> Floats:
    """Openness of each pixel (H·W,)."""
    scene = run.scene(open_box(TRAY, _PLACE))
    found: Floats = run.once(
        "pixels",
        lambda: np.asarray(
            scene.ambient_occlusion(_hit(run), rays=run.pick(_SEEN), seed=run.seeded(9)), np.float64
        ),
    )
    return found


def _baked(run: Run, patches: Sequence[Patch], cells: int) -> Floats:
    """Openness of each pixel as the vertices of all patches give it (H·W,); 1 beside the box."""
    scene, hit = run.scene(open_box(TRAY, _PLACE)), _hit(run)
    values = np.ones(len(hit))
    for patch in patches:
        on = patch.holds(hit.position) & (hit.normal @ patch.normal > 0.5)
        if on.any():
            grid = baked(scene, patch, cells, run.pick(_RAYS), run.seeded(7))
            values[on] = interpolated(grid, patch, hit.position[on])
    return values


def finer(run: Run, cells: Sequence[int], tells: int) -> Strip:
    """A slider over meshes: what an even one and one cut along the contact line give, and what each pixel sees.

    `tells`: cells of a mesh that the numbers are of.
    """
    floor = FLOOR.holds(_hit(run).position)
    rest = [*walls(TRAY), *body(*_PLACE)]
    meshes = {
        "even": ([FLOOR, *rest], "grey under the body bleeds out"),
        "cut": ([*around(*_PLACE), *rest], "a sharp contact"),
    }
    run.exr(_picture(run, _truth(run)))
    true = run.picture(
        _picture(run, _truth(run)),
        "Each pixel by itself: darkest where body and floor meet.",
        name="pixels",
        white=1.0,
    )

    def frame(n: int) -> Frame:
        shown, off = [], []
        for name, (patches, words) in meshes.items():
            values = _baked(run, patches, n)
            off.append(math.sqrt(float(((values - _truth(run))[floor] ** 2).mean())))
            alt = f"{n} cells along the edge, {name}: {words}."
            shown.append(run.picture(_picture(run, values), alt, name=f"{name}-{n}", white=1.0))
        says = f"{n} × {n} cells: off by {off[0]:.2f}, cut {off[1]:.2f}"
        return Frame(str(n), says, [*shown, true], short=f"{n} × {n}")

    labels = ("even mesh", "cut along the body", "each pixel")
    label, frames = "Cells of the floor, a vertex at each corner", [frame(n) for n in cells]
    return Strip("cells", label, frames, labels, tells=cells.index(tells))


def plot(found: Mapping[str, Quantity]) -> str:
    """RMS error against the cells along the edge: measured marks, and what is predicted as lines."""
    closed = [exact(n, TRAY) for n in SMOOTH_CELLS]

    def form(n: Floats) -> Floats:
        return np.exp(np.interp(np.log(n), np.log(SMOOTH_CELLS), np.log(closed)))

    marks = {name: [found[f"{name}-{n}"] for n in cells] for name, cells in CELLS.items()}
    empty = curve_of("empty box", SMOOTH_CELLS, marks["empty"], form, "line: closed form")
    contact = found["contact"].value
    with_body = curve_of(
        "with body", BODY_CELLS, marks["body"], lambda n: np.sqrt(contact / n), "line: √(∮AO² ds/12n)"
    )
    low, high = zip(*(q.interval for q in marks["along"]), strict=True)
    along = Curve("mesh cut", CUT_CELLS, [q.value for q in marks["along"]], low, high)
    return error_curves(
        [with_body, empty, along], x_title="cells along the edge, n", y_title="RMS error of the openness",
        x_ticks=[4, 8, 16, 32], y_ticks=[0.3, 0.1, 0.03, 0.01, 0.003],
        label="RMS error against cells along the edge: steep in the empty box, flat with a body on the floor.",
    )  # fmt: skip
