"""Figure 3: sun, moon and earth at true scale; the moon's distance decides between total and annular."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.geometry import Bodies
from antumbra.lecture.measures.eclipse import hidden_share, tip_in_map, tip_on_ground
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import SceneOf, builtin
from antumbra.lecture.sketches.eclipse import ACROSS, moon_moved
from antumbra.lecture.stages import Part
from antumbra.lecture.stages.regions import regions_key

SKY = Bodies(sun=695_700.0, moon=1_737.4, earth=6_371.0, unit=149_597_870.7)
TURNS = round(SKY.turns)
DISTANCES = [
    356_500, 361_000, 365_500, 370_000, 374_000, 377_500, TURNS, 382_500, 386_000, 390_000, 395_000, 401_000, 406_700,
]  # fmt: skip
FAR, GROUND, EYE = DISTANCES[-1], 160.0, 20_000.0
LOOK = {
    "estimator": "area", "viewing_rays": Pick(4, 16), "shadow_rays": Pick(9, 8), "size": Pick((96, 96), (320, 320)),
}  # fmt: skip
ONE = {"viewing": "centre", "viewing_rays": 1, "shadow_rays": 1}
VIEWS: dict[str, dict[str, Any]] = {
    # Near the line to the sun: from farther aside the night side, black on black, takes a piece of the disk away.
    "space": {"eye": (41_400.0, 3_600.0, 6_000.0), "look_at": (0.0, 0.0, 0.0), "fov": 0.34},
    "ground": ONE | {"aov": "regions", "region_points": 64, "eye": (EYE, 0.0, 0.0), "look_at": (0.0, 0.0, 0.0),
                     "fov": 2 * np.arctan(GROUND / (EYE - SKY.earth))},
    "sky": ONE | {"aov": "emission,albedo", "eye": (SKY.earth + 0.002, 0.0, 0.0), "look_at": (1e6, 0.0, 0.0), "fov": ACROSS},
}  # fmt: skip


def _sky(distance: int) -> SceneOf:
    return builtin("eclipse", distance=float(distance))


def _measure(run: Run) -> Mapping[str, Quantity]:
    turns, far = tip_on_ground(run, SKY, DISTANCES, 2 * GROUND), run.scene(_sky(FAR))
    hidden, beside = (hidden_share(run, far, SKY, km, run.pick(Pick(2**18, 2**22))) for km in (0.0, 1500.0))
    touches, pixel = tip_in_map(run, f"ground-{TURNS}", 2 * GROUND)
    length = Quantity(turns.value - SKY.earth, turns.error, "km", "from the moon's centre")
    return {"turns": turns, "length": length, "touches": touches, "pixel": pixel, "hidden": hidden, "beside": beside}  # fmt: skip


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    note = (
        "Radii on the ground, measured in the map / from similar triangles. In the right picture the moon is drawn grey and the sky dark blue: "
        "in nature both are as dark as each other."
    )
    moved = moon_moved(run, SKY, DISTANCES, 2 * GROUND, VIEWS["space"], tells=DISTANCES.index(390_000))
    return [moved, regions_key("moon", (0, 1, 2, -1), note)]


FIGURE = Figure(
    number=3, chapter=1, title="Total or annular", seconds=Pick(5, 110),
    question=Question(
        "The moon's distance goes from 356,500 to 406,700 km. From which distance on does a ring of the sun stay visible?",
        ("370,000 km", "380,000 km", "400,000 km"), 1, ("length", "touches"),
    ),
    variants=[Variant(f"{name}-{d}", _sky(d), LOOK | view) for d in DISTANCES for name, view in VIEWS.items()],
    measure=_measure, stage=_stage, exr=[f"space-{TURNS}"],
    answer=Number("turns", "There the tip of the umbra leaves the ground. Nearer, the eclipse is total on a path of some hundred "
        "kilometres; farther, it is annular."),
    equation=Equation(
        [(r"\mark{d} - R_\oplus < \ell \; \text{total}, \quad \mark{d} - R_\oplus > \ell \; \text{annular}, \quad \ell = \frac{D \, r}{R - r}",
          "total where d − R⊕ < ℓ, annular where d − R⊕ > ℓ, with ℓ = D r / (R − r)")],
        "Marked: d, the moon's distance; less the earth's radius R⊕ = 6,371 km it is the way to the ground. ℓ, the length of the umbra, hardly changes: "
        "D, from the sun to the moon, does by 0.03 %. r and R are the radii of moon and sun.",
    ),
    claims=[
        Claim("The umbra is D·r/(R − r) long.", "length", near=SKY.length(TURNS), within=600.0, main=True,
              measured="{length} (spread about a line)"),
        Claim(f"At {TURNS:,} km neither umbra nor antumbra fills a pixel.", "touches", below="pixel",
              measured="radius {touches}, pixel {pixel}"),
        Claim("At 406,700 km the moon covers 87.1 % of the sun.", "hidden", near=SKY.covered(FAR, 0.0), within=0.002,
              measured="{hidden}, " + f"lens formula {100 * SKY.covered(FAR, 0.0):.2f} %"),
        Claim("1,500 km beside the axis it covers 45.4 %.", "beside", near=SKY.covered(FAR, 1500.0), within=0.004,
              measured="{beside}, " + f"lens formula {100 * SKY.covered(FAR, 1500.0):.2f} %"),
    ],
)  # fmt: skip
