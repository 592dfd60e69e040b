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
DISTANCES = [356_500, 361_000, 365_500, 370_000, 374_500, 379_000, 379_900, 384_400, 389_000, 393_500, 398_000, 402_500, 406_700]
# Half the width of the inset on the ground [km], and of the view to the sky [rad].
GROUND, FIELD, EYE = 160.0, 0.0062, 20_000.0
LOOK = {"estimator": "area", "size": Pick((120, 120), (320, 320)), "viewing_rays": Pick(4, 16), "shadow_rays": Pick(4, 16)}
MAP = {"aov": "regions", "viewing": "centre", "viewing_rays": 1, "region_points": Pick(32, 256)}
INSET = {"eye": (EYE, 0.0, 0.0), "look_at": (0.0, 0.0, 0.0), "fov": 2 * np.arctan(GROUND / (EYE - SKY.earth))}
UP_THERE = {"eye": (SKY.earth + 0.002, 0.0, 0.0), "look_at": (1e6, 0.0, 0.0), "fov": 2 * FIELD, "viewing_rays": Pick(4, 16)}


def _variants(distance: int) -> list[Variant]:
    scene = builtin("eclipse", distance=float(distance))
    looks = {"earth": {}, "ground": MAP | INSET, "sky": UP_THERE}
    return [Variant(f"{name}-{distance}", scene, LOOK | look) for name, look in looks.items()]


def _radii(run: Run, distance: int) -> Radii:
    regions = run.aov(f"ground-{distance}", "regions").astype(int)
    return radii(regions, 2 * GROUND / len(regions))


def _measure(run: Run) -> Mapping[str, Quantity]:
    signed = {d: _radii(run, d).signed for d in DISTANCES}
    seen = [d for d in DISTANCES if signed[d]]
    far = DISTANCES[-1]
    rays, place = run.pick(Pick(2**18, 2**22)), SKY.on_ground(1500.0)
    covered = {
        name: fraction_at(run.scene(builtin("eclipse", distance=float(far))), at, rays, run.seeded(1), at / SKY.earth)
        for name, at in (("centre", SKY.on_ground(0.0)), ("beside", place))
    }
    hidden = {n: Quantity(1 - q.value, q.error, "%") for n, q in covered.items()}
    return hidden | {
        "turns": crossing(seen, [signed[d] for d in seen], "km", f"fit over {len(seen)} frames"),
        "says": Quantity(SKY.turns, 0.0, "km"),
        "lens": Quantity(SKY.covered(far, 0.0), 0.0, "%"), "lens_beside": Quantity(SKY.covered(far, 1500.0), 0.0, "%"),
    }  # fmt: skip
