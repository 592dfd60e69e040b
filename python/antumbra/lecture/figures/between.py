"""Figure 6: a light between a plane and a cylinder; what lies behind the light must not shadow."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.chapters import SEGMENT
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.false_shadow import (
    half_width,
    light_without_end,
    width_of_false_shadow,
    wrong_pixels,
)
from antumbra.lecture.measures.points import irradiance_at
from antumbra.lecture.measures.ratio import excess, ratio
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.sketches.between import plane_moved
from antumbra.lecture.stages import Strip

HEIGHTS = [-2.0, -1.7, -1.4, -1.1, -0.8, -0.5, -0.3, -0.15, 0.0, 0.05, 0.15, 0.3, 0.5]
HANGS = -1.1
# The cylinder: height of its axis over the light, its radius; the tangent from the light to it.
AXIS, RADIUS = 1.05, 0.45
TANGENT = RADIUS / (AXIS**2 - RADIUS**2) ** 0.5
# A receiver on its underside, (z, y) where the light is (0, 0).
P = (RADIUS * float(np.sin(0.5)), AXIS - RADIUS * float(np.cos(0.5)))
HIDDEN, LIGHT = 0.15, 0.05
# A sphere of radius 0.05 and radiance 720 that is 1.1 away: E = π L (r/d)².
UNDER = np.pi * 720.0 * (LIGHT / HANGS) ** 2
# What the tangents from all points of the light say of the false shadow, not from its centre alone.
WIDTH = half_width(HANGS, LIGHT, AXIS, RADIUS)
LOOK = {
    "estimator": "area", "viewing_rays": Pick(4, 16), "shadow_rays": Pick(1, 2), "size": Pick((240, 192), (480, 384)),
    "eye": (2.4, 1.0, 6.9), "look_at": (0.0, -0.08, 0.0),
}  # fmt: skip


def _measure(run: Run) -> Mapping[str, Quantity]:
    scene, rays = run.scene(builtin("plane-and-cylinder", plane=HANGS)), run.pick(Pick(2**16, 2**20))
    under = irradiance_at(scene, (0.0, HANGS, 0.0), rays, run.seeded(8), light="light", light_points="area")
    return {
        "width": width_of_false_shadow(run, scene, HANGS, run.pick(Pick(512, 4096))),
        "under": excess(ratio(under, Quantity(UNDER))),
        "dark": light_without_end(run, scene, (0.0, AXIS - RADIUS - 1e-3, 0.0), rays),
        "wrong": wrong_pixels(run, HANGS, HANGS),
        "hidden": wrong_pixels(run, HIDDEN, HANGS),
    }  # fmt: skip


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Strip]:
    return [plane_moved(run, HEIGHTS, HANGS, P, (AXIS, RADIUS))]


FIGURE = Figure(
    number=6, chapter=2, title="Between the plane and the cylinder", seconds=Pick(3, 60),
    question=Question(
        "A plane falls until the light hangs between it and a cylinder. A shadow ray that does not end at the light goes on until it "
        "meets something. What does the picture show then?",
        ("no difference", "a shadow on the plane, and a dark cylinder", "all is dark"), 1, ("width", "dark"),
    ),
    variants=[
        Variant(f"{test}{y}", builtin("plane-and-cylinder", plane=y), LOOK | {"distance_test": test}, 4 if y in (HANGS, HIDDEN) else 1)
        for y in HEIGHTS for test in ("off", "on")
    ],
    measure=_measure, stage=_stage, exr=[f"off{HANGS}", f"on{HANGS}"],
    answer=Number("width", "Half of the width of the false shadow. The line from each point of it through the light meets the cylinder, at t\u00a0>\u00a01. "
        "{wrong} of all pixels are wrong."),
    equation=Equation([SEGMENT], "Marked: t ends at 1, the light. Without that end, all of the line behind the light counts too."),
    claims=[
        Claim("Tangents through all points of the light say how wide the false shadow is.", "width", near=WIDTH, within=0.002, main=True,
              measured="{width}; through its centre alone " + f"{-HANGS * TANGENT:.3f} m"),
        Claim("Without it, the cylinder gets no light below.", "dark", near=0.0, within=0.001, measured="{dark} of its light, straight above the light"),
        Claim("With the test, the plane gets all light there is.", "under", near=0.0, within=0.01,
              measured="{under} off from π L (r/d)² under the light"),
        Claim("Once the plane lies between, both pictures agree.", "hidden", below=0.001, measured="{hidden} of the pixels differ at 0.15 m"),
    ],
)  # fmt: skip
