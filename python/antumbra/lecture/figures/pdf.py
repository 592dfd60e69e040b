"""Figure 12: four densities for the same light; three are right, one leaves out a part and looks as clean."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.chapters import SUM_OF_PDF
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.measures.replicates import mean_of, of_interval
from antumbra.lecture.pictures import luminance
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import PILLARS_LIGHT, builtin, pillars_with_strip
from antumbra.lecture.stages import Panel, Part, Row, Table, Tabs
from antumbra.study import statistics

DENSITIES = {
    "area": "uniform, 1/A", "skewed": "skewed to one side", "nearest": "about the nearest point", "hole": "with a hole",
}  # fmt: skip
LOOK = {
    "estimator": "area", "viewing": "centre", "viewing_rays": 1, "size": Pick((96, 68), (240, 168)),
    "eye": (-7.4, 5.6, 5.4), "look_at": (0.3, 0.55, 0.3), "fov": 0.5,
}  # fmt: skip
SCENE = builtin("pillars", light_size=2.0)


def _luminances(run: Run, key: str) -> NDArray[np.float64]:
    return np.array([luminance(image.pixels) for image in run.images(key)])


def _measure(run: Run) -> Mapping[str, Quantity]:
    truth, strip = (mean_of(_luminances(run, key).mean((1, 2))) for key in ("other", "strip"))
    means = {name: mean_of(_luminances(run, name).mean((1, 2))) for name in DENSITIES}
    noise = {name: of_interval(statistics.variance(_luminances(run, name))) for name in DENSITIES}
    off = {name: ratio(mean, truth) for name, mean in means.items()}
    missing = ratio(strip, truth)
    return {
        **{name: Quantity(q.value - 1, q.error, "%") for name, q in off.items()},
        **{f"noise-{name}": ratio(noise[name], noise["area"]) for name in DENSITIES},
        "missing": Quantity(-missing.value, missing.error, "%"),
    }


def _density(run: Run, how: str) -> NDArray[np.float64]:
    """How densely points of the light are drawn from one place on the floor: (16, 16), 1 = uniform."""
    corner, u, v = PILLARS_LIGHT
    grid = (np.stack(np.meshgrid(*[np.arange(256)] * 2), -1).reshape(-1, 2) + 0.5) / 256
    points = np.tile([1.5, 0.0, 1.5], (len(grid), 1))
    numbers = np.column_stack([np.full(len(grid), 0.1), grid])
    drawn = run.scene(SCENE).sample_light(points, (0.0, 1.0, 0.0), numbers, light_points=how)
    at = [(drawn.target - corner) @ side / (side @ side) for side in (u, v)]
    counts = np.histogram2d(at[1], at[0], bins=16, range=[[0, 1], [0, 1]])[0]
    density: NDArray[np.float64] = counts * 256 / len(grid)
    return density


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    truth, white, panels = run.light("truth"), run.white("truth"), []
    for name, words in DENSITIES.items():
        off = run.light(name) - truth
        alt = f"Error of the mean: {measured[name]:v} of the light."
        panels.append(Panel(name, words, [Row([
            run.map(_density(run, name), f"Density on the light, {words}.", "density on the light", name=f"{name}-density",
                    ramp="amber", high=2.0, noise=True),
            run.picture(run.image(name).pixels, f"A picture with it: noise {measured[f'noise-{name}']:v} of the uniform one.",
                        "picture, 4 rays", name=name, white=white, noise=True),
            run.map(off / white, alt, f"mean − truth: {measured[name]:1}", name=f"{name}-off", ramp="signed", low=-0.3, high=0.3),
        ])]))  # fmt: skip
    rows = [
        [words, f"{measured[name]:1}", f"{measured[f'noise-{name}']:1}"] for name, words in DENSITIES.items()
    ]
    count = len(run.images("area"))
    table = Table(("density", "mean less truth", "variance, uniform = 1"), rows, "Error of the mean, and variance, of four densities",
        note=f"{count} independent pictures each. The truth is made by random directions (hemisphere).")  # fmt: skip
    return [Tabs("density", "Density on the light", panels), table]


FIGURE = Figure(
    number=12, chapter=4, title="Four ways to draw a point", seconds=Pick(5, 60),
    question=Question("One of four densities never draws a quarter of the light. What does its picture show?",
                      ("more noise", "a clean picture, too dark", "dark spots"), 1),
    variants=[
        Variant("truth", SCENE, LOOK | {"estimator": "mis", "shadow_rays": Pick(64, 512), "sampler": "owen"}, truth=True),
        # The means are judged by directions, which know nothing of points on lights.
        Variant("other", SCENE, LOOK | {"estimator": "hemisphere", "shadow_rays": Pick(256, 4096)}, 4, truth=True),
        # The strip that the hole leaves out, as a light of its own.
        Variant("strip", pillars_with_strip(0.5, 0.75), LOOK | {"light": "strip", "shadow_rays": Pick(64, 512)}, 2, truth=True),
        *(Variant(name, SCENE, LOOK | {"light_points": name, "shadow_rays": 4, "sampler": "random"}, Pick(16, 64)) for name in DENSITIES),
    ],
    measure=_measure, stage=_stage, exr=["hole"],
    answer=Number("hole", "So much light is missing, and the variance is {noise-hole:1} of that of the uniform density. "
        "Where the pdf is 0 the light is lost: no noise says so."),
    equation=Equation([SUM_OF_PDF], "Marked: the density divides itself out wherever it is not 0, and there only."),
    claims=[
        Claim("With a hole just the light of the hole is missing.", "hole", near="missing", within=0.02, main=True,
              measured="{hole}; the left-out quarter alone gives {missing}"),
        Claim("Toward the nearest point the mean stays right.", "nearest", near=0.0, within=0.02, measured="{nearest}"),
        Claim("The noise of the hole does not warn.", "noise-hole", below=1.05, measured="variance {noise-hole} of the uniform one"),
    ],
)  # fmt: skip
