"""Figure 9: one light, cut up by directions and by area; dω = cos θ′ dA / r²."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra._words import minus
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question
from antumbra.lecture.measures.solid_angle import both_ways, sum_over_patches
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.lone_lights import ABOVE, LIGHTS, alone, omega_above
from antumbra.lecture.sketches.solid_angle import from_the_side, said, sky
from antumbra.lecture.stages import Frame, Part, Strip
from antumbra.lecture.stages.quantities import table_of

PLACES = [-3.0, -2.5, -2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]
SIDE, SHOWN, COUNT = 16, 1024, Pick(2**18, 2**22)


def _measure(run: Run) -> Mapping[str, Quantity]:
    found: dict[str, Quantity] = {}
    for n, (name, (_, exact)) in enumerate(LIGHTS.items()):
        found |= both_ways(run.scene(alone(name)), exact, run.pick(COUNT), run.seeded(n), name)
    off = [sum_over_patches(run.scene(alone(ABOVE)), (x, 0, 0), SIDE) / omega_above(x) - 1 for x in PLACES]
    worst = float(np.max(np.abs(off)))
    return found | {"worst": Quantity(worst, 0.0, "%", f"{SIDE}² patches, {len(PLACES)} receivers")}


def _frame(run: Run, x: float) -> Frame:
    seen = sky(run.scene(alone(ABOVE)), x, run.pick(Pick(320, 560)), SHOWN, SIDE, run.seeded(7))
    exact, name, part = omega_above(x), f"x{x:+.1f}".replace(".", "-"), f"{100 * seen.found / SHOWN:.1f} %"
    alts = said(seen, x, SHOWN, SIDE)
    pictures = [
        run.picture(shown, alt, name=f"{name}-{which}", white=1.0, colour=True, tones=48)
        for which, shown, alt in (("directions", seen.directions, alts[0]), ("area", seen.area, alts[1]))
    ]
    says = minus(f"x = {x:g} m: ") + f"{part} found, Ω = {exact:.3f} sr, sum {seen.total:.3f} sr"
    return Frame(f"{x:g}", says, pictures, minus(f"x = {x:g} m"), "", from_the_side(x, exact))


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    # The full numbers: Ω by patches for receivers all over the floor, x and z from −3 to 3.
    floor, scene = np.linspace(-3, 3, 49), run.scene(alone(ABOVE))
    run.exr([[sum_over_patches(scene, (x, 0, z), SIDE) for x in floor] for z in floor])
    strip = Strip(
        "x", "Receiver, x [m] to the side of the middle of the light", [_frame(run, x) for x in PLACES],
        ("From the side", "Directions", "Area points"),
        note=f"The receiver’s fisheye: straight up in the middle, the horizon as the rim, rings at 30° and 60°; equal areas are equal "
        f"solid angles. {SHOWN:,} random directions: dots find the light, crosses do not. {SIDE}² equal patches of the light: each dot is as large as its dω.", tells=PLACES.index(0.0),
    )  # fmt: skip
    rows = {
        n: (found[f"directions-{n}"], found[f"area-{n}"], f"{omega:.5f} sr")
        for n, (_, omega) in LIGHTS.items()
    }
    table = table_of(
        ("light", "2π · share of directions", "Σ cos θ′ dA / r²", "exact Ω"), rows, "Solid angle of six lights in two ways, and exactly.",
        fine=(2,), note=f"{run.pick(COUNT):,} random directions, as many random points. Three of four points of the sphere turn their back and count 0.",
    )  # fmt: skip
    return [strip, table]


FIGURE = Figure(
    number=9, chapter=3, title="How much of the sky is light", seconds=Pick(2, 20),
    question=Question("A square light of 2 × 2 m hangs 1 m above the receiver. Which share of all directions upward finds it?", ("1/6", "1/4", "1/3", "1/2"), 2, ("share-square above",)),
    variants=[], measure=_measure, stage=_stage,
    answer=Number("share-square above", "of the directions find it: Ω = 2π/3. Points of its area, each counted with cos θ′/r², say {area-square above}."),
    equation=Equation(
        [
            (r"\Omega = \int \text{d}\omega = \int_{A_L} \mark{\frac{\cos\theta'}{r^2}} \, \text{d}A", "Ω = ∫ dω = ∫ over the light of cos θ′ / r² dA"),
            (r"\Omega \approx \frac{A_L}{N} \sum_{j=1}^{N} \mark{\frac{\cos\theta'_j}{r_j^2}}", "Ω ≈ A / N · sum over N points of cos θ′ / r²"),
        ],
        "Marked: what a piece of area is worth as a piece of the hemisphere.",
    ),
    claims=[
        Claim("256 patches sum up to Ω, wherever the receiver lies.", "worst", below=0.003, main=True, measured="off by {worst} at most, 13 receivers"),
        Claim("A third of all directions find the square straight above.", "share-square above", near=1 / 3, within=0.01, measured="{share-square above}"),
        Claim("A sphere’s points sum up to its Ω too.", "over-sphere", near=1.0, within=0.03, measured="{over-sphere} of 2π (1 − √(1 − r²/d²))"),
    ],
)  # fmt: skip
