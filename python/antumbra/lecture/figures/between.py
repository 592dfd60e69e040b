"""Figure 6: a light between a plane and a cylinder; what lies behind the light must not shadow."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.chapters import SEGMENT
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.compare import share_changed
from antumbra.lecture.measures.points import UP, irradiance_at
from antumbra.lecture.measures.ratio import excess, ratio
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity, minus
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.sketches.between import along_the_cylinder
from antumbra.lecture.stages import Frame, Strip

HEIGHTS = [-2.0, -1.7, -1.4, -1.1, -0.8, -0.5, -0.3, -0.15, 0.0, 0.05, 0.15, 0.3, 0.5]
HANGS = -1.1
# The cylinder: height of its axis over the light, its radius; the tangent from the light to it.
AXIS, RADIUS = 1.05, 0.45
TANGENT = RADIUS / (AXIS**2 - RADIUS**2) ** 0.5
# A receiver on its underside, (z, y) where the light is (0, 0).
P = (RADIUS * float(np.sin(0.5)), AXIS - RADIUS * float(np.cos(0.5)))
# A sphere of radius 0.05 and radiance 720 that is 1.1 away: E = π L (r/d)².
UNDER = np.pi * 720.0 * (0.05 / HANGS) ** 2
LOOK = {
    "estimator": "area", "viewing_rays": Pick(4, 16), "shadow_rays": Pick(1, 2), "size": Pick((240, 192), (480, 384)),
    "eye": (2.4, 1.0, 6.9), "look_at": (0.0, -0.08, 0.0),
}  # fmt: skip


def _measure(run: Run) -> Mapping[str, Quantity]:
    scene, rows, rays = (
        run.scene(builtin("plane-and-cylinder", plane=HANGS)),
        run.pick(Pick(512, 4096)),
        run.pick(Pick(2**16, 2**20)),
    )
    # What is lost along a line across the cylinder, 1 m long: half of the width of the false shadow.
    z = (np.arange(rows) + 0.5) / rows
    line = np.stack([0 * z, 0 * z + HANGS, z], 1)

    def light(test: str, seed: int) -> NDArray[np.float64]:
        found = scene.irradiance(line, UP, shadow_rays=16, light="light", distance_test=test, seed=seed)
        return np.asarray(found, np.float64)[:, 0]

    widths = [np.mean(1 - light("off", run.seeded(n)) / light("on", run.seeded(n))) for n in range(8)]
    under = irradiance_at(scene, (0.0, HANGS, 0.0), rays, run.seeded(8), light="light", light_points="area")
    return {
        "width": mean_of(widths, note=f"8 replicates, {16 * rows:,} shadow rays each"),
        "under": excess(ratio(under, Quantity(UNDER))),
        "wrong": _wrong(run, HANGS),
        "hidden": _wrong(run, 0.15),
    }  # fmt: skip


def _wrong(run: Run, height: float) -> Quantity:
    return share_changed(run, f"off{height}", f"on{height}", white=run.white(f"on{HANGS}"))


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Strip]:
    white, frames = 1.3 * run.white(f"on{HANGS}"), []
    for height in HEIGHTS:
        t = (P[1] - height) / P[1]
        where = "behind the light" if t > 1 else "at the light" if t == 1 else "between: a shadow"
        says = f"plane at {minus(f'{height:g}')} m: met at t = {t:.2f}, {where}"
        pictures = [
            run.picture(f"off{height}", f"Without the test, the plane at {height}: {_wrong(run, height):v} of the pixels are wrong.", white=white, colour=True, tones=128),
            run.picture(f"on{height}", f"With the test, the plane at {height}: the cylinder is {'lit' if t > 1 else 'dark'} below.", white=white, colour=True, tones=128),
        ]  # fmt: skip
        drawing = along_the_cylinder(P, height, AXIS, RADIUS)
        frames.append(Frame(f"{height:g}", says, pictures, f"t = {t:.2f}", drawing=drawing))
    label = "Height of the plane [m]; the light is at 0, the cylinder above it"
    return [Strip("plane", label, frames, HEIGHTS.index(HANGS), ("seen along the cylinder", "--distance-test off", "on"),
        note="Green: the part from p to the light, t from 0 to 1. Orange: what a ray without end goes on to find; with it the plane gets a shadow of what hangs above the light.")]  # fmt: skip


FIGURE = Figure(
    number=6, chapter=2, title="Between the plane and the cylinder", seconds=Pick(3, 60),
    question=Question(
        "A light hangs between a plane and a cylinder. A shadow ray that does not end at the light goes on until it meets something. "
        "What does the picture show?",
        ("no difference", "a shadow on the plane, and a dark cylinder", "all is dark"), 1,
    ),
    variants=[Variant(f"{test}{y}", builtin("plane-and-cylinder", plane=y), LOOK | {"distance_test": test}) for y in HEIGHTS for test in ("off", "on")],
    measure=_measure, stage=_stage, exr=[f"off{HANGS}", f"on{HANGS}"],
    answer=Number("width", "Half of the width of the false shadow [m]. The line from each point of it through the light meets the cylinder, at t\u00a0>\u00a01. "
        "{wrong} of all pixels are wrong."),
    equation=Equation([SEGMENT], "Marked: t ends at 1, the light. Without that end, all of the line behind the light counts too."),
    claims=[
        Claim("Similar triangles say how wide the false shadow is.", "width", near=-HANGS * TANGENT, within=0.005, main=True,
              measured="{width} m; a point light and a tangent say 0.522 m"),
        Claim("With the test, the plane gets all light there is.", "under", near=0.0, within=0.01,
              measured="{under} off from π L (r/d)² under the light"),
        Claim("Once the plane lies between, both pictures agree.", "hidden", below=0.001, measured="{hidden} of the pixels differ at 0.15 m"),
    ],
)  # fmt: skip
