"""Figure 9: one light, cut up by directions and by area; dω = cos θ′ dA / r²."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import numpy as np
from numpy.typing import NDArray

import antumbra as am
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question
from antumbra.lecture.fisheye import FOUND, LIGHT, MISSED, Fisheye
from antumbra.lecture.measures import solid_angle
from antumbra.lecture.measures.ratio import ratio, times
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import SceneOf
from antumbra.lecture.square_lights import square_light
from antumbra.lecture.stages import Drawing, Frame, Part, Sketch, Strip, Table
from antumbra.lecture.stages.drawing import INK, LIT, RIM
from antumbra.lights import Light

PLACES = [-3.0, -2.5, -2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]
SIDE, SHOWN, COUNT = 16, 1024, Pick(2**18, 2**22)
CORNERS = np.array([[1.0, 2.0, 0.5], [-1.5, 2.5, 1.0], [0.2, 1.8, -1.4]])
DOWN = (0.0, -1.0, 0.0)
# Lights seen from the origin, and their solid angles: closed forms, and a 1-D integral for the disk aside.
LIGHTS: dict[str, tuple[Light, float]] = {
    "square above": (square_light(2.0, 1.0), solid_angle.of_rectangle((-1, -1), (2, 2), 1.0)),
    "rectangle aside": (am.lights.Rectangle((2, 1, 1), (3, 0, 0), (0, 0, 3)), solid_angle.of_rectangle((2, 1), (3, 3), 1.0)),
    "triangle": (am.lights.Triangle(*(tuple(v) for v in CORNERS)), solid_angle.of_triangle(*CORNERS)),
    "sphere": (am.lights.Sphere((0, 2, 0), 1.0), 2 * np.pi * (1 - np.sqrt(0.75))),
    "disk above": (am.lights.Disk((0, 2, 0), DOWN, 1.0), 2 * np.pi * (1 - 2 / np.sqrt(5))),
    "disk aside": (am.lights.Disk((1.5, 2, 0), DOWN, 1.0), 0.3943787693890751),
}  # fmt: skip


@cache
def _alone(name: str) -> SceneOf:
    """A light and nothing else."""

    def build() -> am.Scene:
        scene = am.Scene("light")
        scene.add_light(LIGHTS[name][0], name="light")
        return scene

    return build


def _exact(x: float) -> float:
    return solid_angle.of_rectangle((-1 - x, -1), (2, 2), 1.0)


def _measure(run: Run) -> Mapping[str, Quantity]:
    found: dict[str, Quantity] = {}
    count, origin = run.pick(COUNT), np.zeros(3)
    for n, (name, (_, exact)) in enumerate(LIGHTS.items()):
        scene, omega = run.scene(_alone(name)), Quantity(exact)
        share = solid_angle.share_of_directions(scene, origin, count, run.seeded(n))
        area = solid_angle.sum_over_area(scene, origin, count, run.seeded(n))
        found |= {f"share-{name}": share, f"area-{name}": area, f"over-{name}": ratio(area, omega)}
        found[f"directions-{name}"] = times(Quantity(share.value, share.error), Quantity(2 * np.pi), "sr")
        run.rays += count
    scene = run.scene(_alone("square above"))
    off = [solid_angle.sum_over_patches(scene, (x, 0, 0), SIDE) / _exact(x) - 1 for x in PLACES]
    return found | {
        "worst": Quantity(float(np.max(np.abs(off))), 0.0, "%", f"{SIDE}² patches, {len(PLACES)} receivers")
    }


def _fisheyes(run: Run, x: float) -> tuple[Fisheye, Fisheye, int, float]:
    """Random directions, and patches of the light as dots of their dω; how many found it, and the sum."""
    scene, at, pixels = run.scene(_alone("square above")), (x, 0.0, 0.0), run.pick(Pick(320, 560))
    edge = np.linspace(-1, 1, 48)
    ones = np.ones_like(edge)
    ring = [(edge, -ones), (ones, edge), (-edge, ones), (-ones, -edge)]
    outline = np.concatenate([np.stack([u - x, ones, v], 1) for u, v in ring])
    first, second = Fisheye(pixels), Fisheye(pixels)
    along = solid_angle.directions(np.random.default_rng(run.seeded(7)).random((SHOWN, 2)))
    hits = solid_angle.found(scene, at, along)
    first.outline(outline)
    first.crosses(along[~hits], MISSED)
    first.dots(along[hits], np.full(hits.sum(), 8e-4), FOUND)
    toward, omega = solid_angle.pieces(scene, at, solid_angle.patches(SIDE))
    second.outline(outline, "#4a3f1c")
    second.dots(toward, omega / SIDE**2, LIGHT)
    for fisheye in (first, second):
        fisheye.rings(np.pi / 6, np.pi / 3)
    return first, second, int(hits.sum()), float(omega.mean())


def _over_floor(run: Run) -> NDArray[np.float64]:
    """Ω by patches for receivers all over the floor, x and z from −3 to 3: the figure's full numbers."""
    scene, places = run.scene(_alone("square above")), np.linspace(-3, 3, 49)
    return np.array([[solid_angle.sum_over_patches(scene, (x, 0, z), SIDE) for x in places] for z in places])


def _side(x: float, omega: float) -> Drawing:
    """The light, the receiver and its hemisphere of radius 1 from the side; 68 units are 1."""
    drawing, unit, middle, floor = Sketch(480, 240, ground=LIT), 68.0, 240.0, 186.0
    at, top = middle + unit * x, floor - unit

    def arc(first: float, last: float) -> list[tuple[float, float]]:
        turns = np.linspace(first, last, 48)
        points = [(at + unit * float(np.cos(t)), floor - unit * float(np.sin(t))) for t in turns]
        return [(u, v) for u, v in points if 0 <= u <= 480]

    ends = (middle - unit, middle + unit)
    drawing.line((0, floor), (480, floor), width=2).light((ends[0], top - 4), (ends[1], top - 4))
    drawing.curve(arc(0.0, np.pi), dash="3 3")
    drawing.curve(arc(*(float(np.arctan2(unit, end - at)) for end in ends[::-1])), colour=RIM, width=5)
    patch = middle + 0.5 * unit
    for end in ends:
        drawing.line((at, floor), (end, top), faint=True)
    drawing.line((at, floor), (patch, top), width=1.5).line((patch, top), (patch, top + 38), dash="2 3")
    drawing.line((patch - 6, top - 4), (patch + 6, top - 4), width=8)
    drawing.text((patch, top - 16), "dA", anchor="middle").text((patch + 5, top + 32), "θ′", fine=True)
    drawing.text(((at + patch) / 2 - 12, (floor + top) / 2 + 12), "r", fine=True).circle((at, floor), 5, INK)
    side = "middle" if abs(x) < 2.4 else "start" if x < 0 else "end"
    drawing.text((at, floor + 30), "receiver", anchor=side).text((16, 34), f"Ω = {omega:.3f} sr")
    return drawing.done(
        f"Side view: the receiver at x = {x:g} under the light, which fills {omega:.3f} sr of its hemisphere."
    )


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    frames = []
    for x in PLACES:
        first, second, hits, total = _fisheyes(run, x)
        exact, name = _exact(x), f"x{x:+.1f}".replace(".", "-")
        share = f"{hits:,} of {SHOWN:,} directions find the light, {100 * hits / SHOWN:.1f} %"
        pictures = [
            run.picture(first.radiance(), share, name=f"{name}-directions", white=1.0, colour=True, tones=48),
            run.picture(second.radiance(), f"{SIDE}² patches as dots as large as their dω; the sum is {total:.4f} sr.",
                        name=f"{name}-area", white=1.0, colour=True, tones=48),
        ]  # fmt: skip
        says = f"x = {x:g}: {100 * hits / SHOWN:.1f} % found, Ω = {exact:.3f}, sum {total:.3f}".replace(
            "-", "−"
        )
        frames.append(
            Frame(f"{x:g}", says, pictures, f"x = {x:g}".replace("-", "−"), f"{share}.", _side(x, exact))
        )
    run.exr(_over_floor(run))
    strip = Strip(
        "x", "Receiver, x to the side of the middle of the light", frames, PLACES.index(0.0), ("From the side", "Directions", "Area points"),
        note=f"The receiver’s fisheye: straight up in the middle, the horizon as the rim, rings at 30° and 60°; equal areas are equal solid angles. {SHOWN:,} "
        f"random directions: dots find the light, crosses do not. {SIDE}² equal patches of the light: each dot is as large as its dω.",
    )  # fmt: skip
    rows = [
        [name, f"{measured[f'directions-{name}'].number()[0]} ± {measured[f'directions-{name}'].number()[1]}",
         f"{measured[f'area-{name}'].number()[0]} ± {measured[f'area-{name}'].number()[1]}", f"{exact:.5f}"]
        for name, (_, exact) in LIGHTS.items()
    ]  # fmt: skip
    table = Table(
        ["light", "2π · share of directions", "Σ cos θ′ dA / r²", "exact Ω [sr]"], rows, "Solid angle of six lights in two ways, and exactly.",
        fine=(1,), note=f"{run.pick(COUNT):,} random directions, {run.pick(COUNT):,} random points. Three of four points of the sphere turn their back and count 0.",
    )  # fmt: skip
    return [strip, table]


FIGURE = Figure(
    number=9, chapter=3, title="How much of the sky is light", seconds=Pick(3, 20),
    question=Question("A square light of 2 × 2 hangs 1 above the receiver. Which share of all directions upward finds it?", ("1/6", "1/4", "1/3", "1/2"), 2),
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
