"""Figure 25: all directions of a point at once, triangle by triangle, beside rays."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import OCCLUSION
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question
from antumbra.lecture.measures.fast_occlusion import together
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.scenes.shards import COUNT as SHARDS
from antumbra.lecture.sketches.fast_occlusion import one_more, table_of_rates
from antumbra.lecture.stages import Part, Strip

SCENES = {
    "terrain": builtin("terrain"),
    "scan": builtin("scan", triangles=50_000),
    "pillars": builtin("pillars"),
}
RADII = {"terrain": (1.0, 3.0, 10.0, 30.0), "scan": (0.1, 0.3), "pillars": (3.0,)}
COUNTS, SIZE = (64, 256, 1024), Pick((24, 16), (48, 32))


def _measure(run: Run) -> Mapping[str, Quantity]:
    found: dict[str, Quantity] = {}
    differ = bits = 0
    for k, (name, build) in enumerate(SCENES.items()):
        run.at(k / len(SCENES), f"directions over {name}")
        of_scene, different, compared = together(
            run, run.scene(build), name, run.pick(SIZE), RADII[name], COUNTS
        )
        found |= of_scene
        differ, bits = differ + different, bits + compared
    near, far = (found[f"terrain-{radius}-256-faster"] for radius in (1, 30))
    return {**found, "differ": Quantity(differ, note=f"of {bits:,} bits"), "bits": Quantity(bits), "near": near, "far": far,
            "tests": found["terrain-1-256-tested"], "in_range": found["terrain-1-256-in_range"], "far_range": found["terrain-30-256-in_range"]}  # fmt: skip


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    run.exr(
        [[found[f"{name}-{r:g}-{n}-faster"].value for n in COUNTS] for name in SCENES for r in RADII[name]]
    )
    strip = Strip(
        "triangle", "Triangles, one after another", [one_more(run, k, run.pick(Pick(280, 480))) for k in range(SHARDS)],
        ("The newest alone", "All so far"),
        note="256 directions over a point, dense as the cosine: straight up in the middle, the horizon as the rim. Dots are free, crosses are taken.",
    )  # fmt: skip
    note = "Triangles in range of a point, above its horizon; tests: directions of such a triangle that the table leaves open, N = 256. " \
        "×: the faster of both methods over rays (in packets, as they come), medians of seven calls in turn on all cores."  # fmt: skip
    return [strip, table_of_rates(found, [(name, r) for name in SCENES for r in RADII[name]], COUNTS, note)]


FIGURE = Figure(
    number=25, chapter=6, title="All directions at once", seconds=Pick(7, 40),
    question=Question("256 directions over a point, a triangle within range. A table knows of every plane on which side each direction lies. "
                      "How many of the 256 still take a test?", ("all that are blocked", "about 20", "less than one"), 2, ("tests",)),
    variants=[], measure=_measure, stage=_stage,
    answer=Number("tests", "tests for a triangle, of 256 directions, over {in_range:v} triangles in range of a point: the table knows the rest. With so few, this is "
        "{near:v} times as fast as rays; with {far_range:v} in range, {far:v} times."),
    equation=Equation([OCCLUSION], "Marked: 0 where three half-spaces meet, the sides of a triangle’s edges as the point sees them: N bits, three looked up and joined by and."),
    claims=[
        Claim("Both methods give the bits of rays.", "differ", below=0.5, main=True, measured="{differ:v} of {bits:v} bits differ"),
        Claim("A triangle takes less than one test of 256 directions.", "tests", below=1.0, measured="{tests:v}, in terrain within 1 m"),
        Claim("With few triangles in range it is faster than rays.", "near", above=1.0, measured="{near:r} times, {in_range:v} in range"),
        Claim("With very many it is slower.", "far", below=1.0, measured="{far:r} times, {far_range:v} in range"),
    ],
)  # fmt: skip
