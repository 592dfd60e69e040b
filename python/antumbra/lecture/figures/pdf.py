"""Figure 12: four densities for the same light; three are right, one leaves out a part and is no noisier."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import SUM_OF_PDF
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.densities import against, drawn
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import CENTRED, PILLARS_LIGHT, builtin, pillars_with_strip
from antumbra.lecture.stages import Part
from antumbra.lecture.stages.quantities import table_of, tabs_of

DENSITIES = {
    "area": "uniform, 1/A", "skewed": "more to one side", "nearest": "about the nearest point", "hole": "with a hole",
}  # fmt: skip
SCENE = builtin("pillars", light_size=2.0)


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    truth, white, names = run.light("truth"), run.white("truth"), DENSITIES.items()
    off = [
        run.map((run.light(name) - truth) / white, f"{words}: error of the mean {found[name]:v} of the light.",
                f"{name}: {found[name]:1}", name=f"{name}-off", ramp="signed", low=-0.3, high=0.3, unit="%")
        for name, words in names
    ]  # fmt: skip
    pictures = [
        run.picture(run.image(name).pixels, f"{words}: noise {found[f'noise-{name}']:v} of the uniform one.", name,
                    name=name, white=white, noise=True)
        for name, words in names
    ]  # fmt: skip
    scene, densities = run.scene(SCENE), []
    for name, words in names:
        density = drawn(scene, PILLARS_LIGHT, 0.5, name)
        densities.append(run.map(density, f"Density on the light: {words}.", name, name=f"{name}-density",
                                 ramp="amber", high=3.0, unit="uniform = 1", noise=True))  # fmt: skip
    count = len(run.images("area"))
    tabs = tabs_of("show", "What is shown", {
        "picture": ("One picture", pictures), "mean": ("Mean − truth", off),
        "density": ("Density", densities),
    }, late=["mean"])  # fmt: skip
    rows = {f"{name}: {words}": (found[name], found[f"noise-{name}"]) for name, words in names}
    note = f"{count} independent pictures of 4 rays a pixel each; maps of the mean against MIS, in % of white; table against random directions (hemisphere), in % of the light. Densities for a point half a metre from the light; for the floor, metres away, nearest is nearly even."
    head = ("density", "mean − truth", "variance, uniform = 1")
    return [tabs, table_of(head, rows, "Error of the mean, and variance, of four densities", note=note)]


FIGURE = Figure(
    number=12, chapter=4, title="Four ways to draw a point", seconds=Pick(2, 60),
    question=Question("One of four densities never draws a quarter of the light. What does its picture show?",
                      ("more noise", "too little light, no more noise", "dark spots"), 1, ("hole", "noise-hole")),
    variants=[
        Variant("truth", SCENE, CENTRED | {"estimator": "mis", "shadow_rays": Pick(64, 512), "sampler": "owen"}, truth=True),
        # The means are judged by directions, which know nothing of points on lights.
        Variant("other", SCENE, CENTRED | {"estimator": "hemisphere", "shadow_rays": Pick(256, 2048)}, 4, truth=True),
        # The strip that the hole leaves out, as a light of its own.
        Variant("strip", pillars_with_strip(0.5, 0.75), CENTRED | {"light": "strip", "shadow_rays": Pick(64, 512)}, 2, truth=True),
        *(Variant(name, SCENE, CENTRED | {"light_points": name, "shadow_rays": 4, "sampler": "random"}, Pick(16, 64)) for name in DENSITIES),
    ],
    measure=lambda run: against(run, DENSITIES, "other", "strip"), stage=_stage, exr=["hole"],
    answer=Number("hole", "So much light is missing, and the variance is {noise-hole:1} of that of the uniform density. "
        "Where the pdf is 0 the light is lost: no noise says so."),
    equation=Equation([SUM_OF_PDF], "Marked: the density divides itself out wherever it is not 0, and there only."),
    claims=[
        Claim("With a hole just the light of the hole is missing.", "gap", near=0.0, within=0.02, main=True,
              measured="{hole}; the left-out quarter alone gives {missing}, the two differ by {gap}"),
        Claim("About a quarter of all light is missing.", "hole", near=-0.25, within=0.05, measured="{hole}"),
        Claim("Toward the nearest point the mean stays right.", "nearest", near=0.0, within=0.02, measured="{nearest}"),
        Claim("The noise of the hole does not warn.", "noise-hole", below=1.05, measured="variance {noise-hole} of the uniform one"),
    ],
)  # fmt: skip
