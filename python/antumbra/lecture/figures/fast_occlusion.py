"""Figure 25: all directions of a point at once, triangle by triangle, beside rays."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.chapters import OCCLUSION
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question
from antumbra.lecture.measures.alone_and_together import of_light as lit_by
from antumbra.lecture.measures.fast_occlusion import together
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import PILLARS_LIGHT, builtin
from antumbra.lecture.scenes.shards import COUNT as SHARDS
from antumbra.lecture.sketches.fast_occlusion import by_count, by_radius, of_light, one_more
from antumbra.lecture.stages import Panel, Part, Strip, Tabs

# Each with the corner and the sides of a square of light over it.
SCENES = {
    "terrain": builtin("terrain"),
    "scan": builtin("scan", triangles=50_000),
    "pillars": builtin("pillars"),
}
RADII = {"terrain": (1.0, 10.0, 30.0), "scan": (0.1, 0.3), "pillars": (3.0,)}
LIGHTS = {
    "terrain": ((16.0, 40.0, 16.0), ((8.0, 0.0, 0.0), (0.0, 0.0, 8.0))),
    "scan": ((1.0, 3.0, 1.0), ((0.8, 0.0, 0.0), (0.0, 0.0, 0.8))),
    "pillars": (PILLARS_LIGHT[0], PILLARS_LIGHT[1:]),
}
COUNTS, SIZE = (64, 256, 1024), Pick((30, 20), (64, 48))


def _measure(run: Run) -> Mapping[str, Quantity]:
    found: dict[str, Quantity] = {}
    bits = np.zeros(2, int)
    for k, (name, build) in enumerate(SCENES.items()):
        run.at(k / len(SCENES), f"directions over {name}")
        scene = run.scene(build)
        of_scene, *sky = together(run, scene, name, run.pick(SIZE), RADII[name], COUNTS)
        lit, *light = lit_by(run, scene, name, *(np.array(part) for part in LIGHTS[name]))
        found |= of_scene | lit
        bits += np.add(sky, light)
    differ = {what: Quantity(int(n)) for what, n in zip(("differ", "bits"), bits, strict=True)}
    names = {"near": "terrain-1-256-times-receivers", "far": "terrain-30-256-times-receivers", "tests": "terrain-1-256-tested",
             "in_range": "terrain-1-256-in_range", "far_range": "terrain-30-256-in_range"}  # fmt: skip
    return found | differ | {name: found[of] for name, of in names.items()}


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    rows = [(name, r) for name in SCENES for r in RADII[name]]
    run.exr([[found[f"{name}-{r:g}-{n}-times-receivers"].value for n in COUNTS] for name, r in rows])
    strip = Strip(
        "triangle", "Triangles, one after another", [one_more(run, k, run.pick(Pick(280, 480))) for k in range(SHARDS)],
        ("The newest alone", "All so far"),
        note="256 directions over a point, dense as the cosine: straight up in the middle, the horizon as the rim. Dots are free, crosses are taken.",
    )  # fmt: skip
    clock = "Medians of 7 calls in turn, by processor time; the table of half-spaces is made before."
    radius = "M directions/s. In range: triangles of a point; tests: directions of one left open. Single: the rays of packets in random order. Tiles: " \
        f"each triangle to all points of a tile; points: each through the tree. {clock}"  # fmt: skip
    count = f"Over rays in packets, at N = 64, 256, 1024. {clock}"
    light = "Singly → together. N points of a square of light for each receiver: in random order, no two neighbours alike; and receiver by receiver, where " \
        f"packets and shafts find what they share. {clock}"  # fmt: skip
    shown = [Panel("triangles", "Triangles", [strip]), Panel("count", "Rates by N", [by_count(found, rows, COUNTS, count)], late=True),
             Panel("light", "An area light", [of_light(found, list(SCENES), light)], late=True)]  # fmt: skip
    return [Tabs("show", "What is shown", shown), by_radius(found, rows, radius)]


FIGURE = Figure(
    number=25, chapter=6, title="All directions at once", seconds=Pick(12, 60),
    question=Question("256 directions over a point, a triangle within range. A table knows of every plane on which side each direction lies. "
                      "How many of the 256 still take a test?", ("all that are blocked", "about 20", "less than one"), 2, ("tests",)),
    variants=[], measure=_measure, stage=_stage,
    answer=Number("tests", "tests for a triangle, of 256 directions, over {in_range:v} triangles in range of a point: the table knows the rest. With so few, this is "
        "{near:v} times as fast as rays in packets; with {far_range:v} in range, {far:v} times."),
    equation=Equation([OCCLUSION], "Marked: 0 where three half-spaces meet, the sides of a triangle’s edges as the point sees them: N bits, three looked up and joined by and."),
    claims=[
        Claim("All ways give the same bits, of the sky and of a light.", "differ", below=0.5, main=True, measured="{differ:v} of {bits:v} differ"),
        Claim("A triangle takes less than one test of 256 directions.", "tests", below=1.0, measured="{tests:v}, in terrain within 1 m"),
        Claim("With few triangles in range, points are faster than packets.", "near", above=1.0, measured="{near:r} times, {in_range:v} in range"),
        Claim("With very many they are slower.", "far", below=1.0, measured="{far:r} times, {far_range:v} in range"),
    ],
)  # fmt: skip
