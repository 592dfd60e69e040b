"""Figure 2: umbra, penumbra, antumbra, lit, from which points of the light are visible."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import DIRECT
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.geometry import Disks
from antumbra.lecture.measures.regions import crossing, ends_on_axis, radii_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.disks import from_above, receiver_behind
from antumbra.lecture.sketches.regions import receiver_moved
from antumbra.lecture.stages import Part
from antumbra.lecture.stages.regions import regions_key

DISKS, HALF = Disks(R=1.0, r=0.5, a=4.0), 4.0
DISTANCES = [0.5 * step for step in range(1, 17)]
LOOK = {
    "estimator": "area", "viewing": "centre", "viewing_rays": 1, "shadow_rays": Pick(36, 100), "sampler": "stratified",
    "aov": "regions,unshadowed-direct", "region_points": Pick(32, 64), "size": Pick((120, 120), (320, 320)),
}  # fmt: skip


def _measure(run: Run) -> Mapping[str, Quantity]:
    found = {g: radii_of(run, f"g{g}", 2 * HALF) for g in DISTANCES}
    pixel = 2 * HALF / len(run.light("g4.0"))
    seen = [g for g in DISTANCES if found[g].signed]
    wide = max(abs(found[g].outside - DISKS.penumbra(g)) for g in DISTANCES)
    return {
        "closes": crossing(seen, [found[g].signed for g in seen], note=f"spread about a line, {len(seen)} frames"),
        "frames": Quantity(len(seen)),
        "wide": Quantity(wide), "pixel": Quantity(pixel), "touches": Quantity(max(found[DISKS.length][:2])),
        "axis": ends_on_axis(run.scene(receiver_behind(DISKS, DISTANCES[-1])), DISTANCES[-1], DISKS.length, 0.01),
    }  # fmt: skip


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    note = (
        f"Radii measured in the map / from similar triangles; one pixel is {measured['pixel']} wide. {run.pick(LOOK['region_points'])} points inside "
        f"the light and as many on its outline decide each pixel. Each picture is exposed for its own unshadowed centre."
    )
    return [receiver_moved(run, DISKS, DISTANCES, 2 * HALF), regions_key("g", (0, 1, 2, -1), note)]


FIGURE = Figure(
    number=2, chapter=1, title="Where the umbra ends", seconds=Pick(6, 110),
    question=Question(
        "Move the receiver away from the occluder. How far behind it does the dark core vanish, and what is there afterwards?",
        ("g = 2, then only penumbra", "g = 4, then points that see a ring of the light", "never: it only shrinks"), 1, ("closes", "axis"),
    ),
    variants=[Variant(f"g{g}", receiver_behind(DISKS, g), LOOK | from_above(0.98 * g, HALF)) for g in DISTANCES],
    measure=_measure, stage=_stage, exr=["g6.0"],
    answer=Number("closes", "The umbra closes at g = a·r/(R − r) = 4. Farther on a ring of the light is seen around the occluder: the antumbra."),
    equation=Equation(
        [DIRECT, (r"u(\mark{g}) = r - (R - r) \frac{\mark{g}}{a} = 0 \quad \Longrightarrow \quad g = \frac{a \, r}{R - r}",
                  "u(g) = r − (R − r) g / a = 0, so g = a r / (R − r)")],
        "Marked: the term that this figure changes. Only V knows about the occluder. u is the radius of the umbra; where it is "
        "negative, −u is the radius of the antumbra.",
    ),
    claims=[
        Claim("The umbra closes at 4.00.", "closes", near=DISKS.length, within=0.1, main=True,
              measured="{closes} (spread, fit over {frames} frames)"),
        Claim("The penumbra is as wide as similar triangles say.", "wide", below="pixel",
              measured="largest difference {wide}, pixel {pixel}"),
        Claim("On its axis the umbra ends at g = 4.", "axis", near=DISKS.length, within=1e-3,
              measured="{axis}, where a ring is first seen"),
        Claim("At g = 4 neither umbra nor antumbra fills a pixel of the map.", "touches", below="pixel",
              measured="radius {touches}, pixel {pixel}"),
    ],
)  # fmt: skip
