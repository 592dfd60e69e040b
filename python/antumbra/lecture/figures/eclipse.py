"""Figure 3: sun, moon and earth at true scale; the moon's distance decides between total and annular."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.geometry import Bodies
from antumbra.lecture.measures.points import fraction_at
from antumbra.lecture.measures.regions import Radii, crossing, radii
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.stages import Frame, Part, Strip
from antumbra.lecture.stages.regions import regions_key

SKY = Bodies(sun=695_700.0, moon=1_737.4, earth=6_371.0, unit=149_597_870.7)
TURNS = round(SKY.turns)
DISTANCES = [
    356_500,
    361_000,
    365_500,
    370_000,
    374_000,
    377_500,
    TURNS,
    382_500,
    386_000,
    390_000,
    395_000,
    401_000,
    406_700,
]
FAR, GROUND, EYE = DISTANCES[-1], 160.0, 20_000.0
LOOK = {
    "estimator": "area",
    "viewing_rays": Pick(4, 16),
    "shadow_rays": Pick(9, 8),
    "size": Pick((120, 120), (320, 320)),
}
ONE = {"viewing": "centre", "viewing_rays": 1, "shadow_rays": 1}
VIEWS = {
    "space": {},
    "ground": ONE | {"aov": "regions", "region_points": 64, "eye": (EYE, 0.0, 0.0), "look_at": (0.0, 0.0, 0.0),
                     "fov": 2 * np.arctan(GROUND / (EYE - SKY.earth))},
    "sky": ONE | {"aov": "emission,albedo", "eye": (SKY.earth + 0.002, 0.0, 0.0), "look_at": (1e6, 0.0, 0.0), "fov": 0.0124},
}  # fmt: skip


def _moon_at(distance: int) -> list[Variant]:
    scene = builtin("eclipse", distance=float(distance))
    return [Variant(f"{name}-{distance}", scene, LOOK | view) for name, view in VIEWS.items()]


def _radii(run: Run, distance: int) -> Radii:
    regions = run.aov(f"ground-{distance}", "regions").astype(int)
    return radii(regions, 2 * GROUND / len(regions))


def _hidden(run: Run, beside: float) -> Quantity:
    scene, at = run.scene(builtin("eclipse", distance=float(FAR))), SKY.on_ground(beside)
    seen = fraction_at(scene, at, run.pick(Pick(2**18, 2**22)), run.seeded(1), at / SKY.earth)
    return Quantity(1 - seen.value, seen.error, "%", seen.note)


def _measure(run: Run) -> Mapping[str, Quantity]:
    signed = {d: s for d in DISTANCES if (s := _radii(run, d).signed)}
    turns = crossing(list(signed), list(signed.values()), "km", f"fit over {len(signed)} frames")
    # In single precision the ends of segments stand 2⁻²¹ of the sun's distance above its surface, 71 km.
    rim = SKY.length(TURNS) * 2**-21 * SKY.unit / (SKY.sun - SKY.moon)
    turns = Quantity(
        turns.value, turns.error + rim, "km", turns.note + ", and the rim of the sun in single precision"
    )
    return {
        "turns": turns, "length": Quantity(turns.value - SKY.earth, turns.error, "km", "from the moon's centre"),
        "hidden": _hidden(run, 0.0), "beside": _hidden(run, 1500.0),
    }  # fmt: skip


def _says(at: Radii, distance: int) -> str:
    if distance == TURNS:
        return "the umbra just touches the ground"
    if distance < TURNS:
        return f"total, umbra {2 * at.umbra:.0f} km wide"
    return f"annular, antumbra {2 * at.antumbra:.0f} km wide"


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    frames, white = [], 1.7 * run.white(f"space-{FAR}")
    for d in DISTANCES:
        at, sky = _radii(run, d), run.image(f"sky-{d}").aov
        says, covered, true = _says(at, d), SKY.covered(d, 0.0), SKY.umbra(d)
        bodies = np.where(sky["emission"].max(2) > 0, 2, np.where(sky["albedo"].max(2) > 0, 1, 0))
        pictures = [
            run.picture(f"space-{d}", f"The earth with the moon's shadow, the moon at {d:,} km.", white=white, colour=True, tones=64),
            run.classes(run.aov(f"ground-{d}", "regions").astype(np.uint8), f"The ground at the axis of the shadow: {says}.", name=f"ground-{d}"),
            run.classes(bodies, f"The sun from the ground: {covered:.1%} of it is covered.", name=f"sky-{d}", colours=("#141a2e", "#555c69", "#f2b705")),
        ]  # fmt: skip
        facts = [
            f"radius {at.umbra:.1f} / {true:.1f} km" if true > 1 else "none here",
            f"out to {SKY.penumbra(d):,.0f} km",
            f"radius {at.antumbra:.1f} / {-true:.1f} km" if true < -1 else "none here",
        ]
        frames.append(
            Frame(
                f"{d}",
                f"{d:,} km: {says}",
                pictures,
                f"{d:,} km",
                f", {covered:.1%} of the sun covered",
                facts=facts,
            )
        )
    labels = (
        "The earth from space",
        f"The ground, {2 * GROUND:.0f} km across",
        "The sun from the ground, 0.7° across",
    )
    strip = Strip("moon", "Distance of the moon, from centre to centre", frames, 3, labels)
    note = "Radii on the ground, measured in the map / from similar triangles. In the view to the sky the moon is grey, where it is black."
    return [strip, regions_key("moon", (0, 1, 2, -1), note)]


FIGURE = Figure(
    number=3, chapter=1, title="Total or annular", seconds=Pick(6, 110),
    question=Question(
        "The moon's distance goes from 356,500 to 406,700 km. From which distance on does a ring of the sun stay visible?",
        ("370,000 km", "380,000 km", "400,000 km"), 1,
    ),
    variants=[variant for distance in DISTANCES for variant in _moon_at(distance)],
    measure=_measure, stage=_stage, exr=[f"space-{TURNS}"],
    answer=Number("turns", "There the tip of the umbra leaves the ground. Nearer, the eclipse is total on a path of some hundred "
        "kilometres; farther, it is annular."),
    equation=Equation(
        [(r"\ell = \frac{\mark{D} \, r}{R - r}", "ℓ = D r / (R − r)")],
        "Marked: D, from the sun to the moon. ℓ is the length of the umbra behind the moon, r and R the radii of moon and sun.",
    ),
    claims=[
        Claim("The umbra is 373,600 km long, as similar triangles say.", "length", near=SKY.length(TURNS), within=600.0, main=True,
              measured="measured {length} (95 %), D·r/(R − r) " + f"= {SKY.length(TURNS):,.0f} km"),
        Claim("At 406,700 km the moon covers 87.1 % of the sun.", "hidden", near=SKY.covered(FAR, 0.0), within=0.002,
              measured="measured {hidden}, " + f"lens formula {100 * SKY.covered(FAR, 0.0):.2f} %"),
        Claim("1,500 km beside the axis it covers 45.4 %.", "beside", near=SKY.covered(FAR, 1500.0), within=0.004,
              measured="measured {beside}, " + f"lens formula {100 * SKY.covered(FAR, 1500.0):.2f} %"),
    ],
)  # fmt: skip
