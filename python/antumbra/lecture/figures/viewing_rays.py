"""Figure 17: viewing rays with one shadow ray each; where they go in the pixel, and which light point goes with which."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import PIXEL_AND_LIGHT
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.noise import noise_over
from antumbra.lecture.measures.pairs import EXPECTED, different_pairs
from antumbra.lecture.measures.slopes import Errors
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import PILLARS_VIEW, builtin
from antumbra.lecture.sketches.pairs import linked
from antumbra.lecture.sketches.samplers import counts, reference
from antumbra.lecture.stages import Panel, Part, Plot, Row, Tabs
from antumbra.lecture.stages.quantities import table_of
from antumbra.study.plot import error_curves

# Owen points are balanced at powers of four: there slopes are fitted, for all to compare.
SHOWN, POWERS, PAIRED = [1, 10, 100], [1, 4, 16, 64], 64
COUNTS = sorted({*SHOWN, *POWERS})
FITTED = dict.fromkeys(("random", "stratified", "owen"), POWERS)
ONE = PILLARS_VIEW | {
    "estimator": "area", "light_points": "area", "filter": "box", "shadow_rays": 1, "size": Pick((64, 45), (240, 168)),
}  # fmt: skip
# By directions and light points both, which are drawn in solid angle.
TRUTH = ONE | {
    "estimator": "mis",
    "light_points": "solid-angle",
    "sampler": "owen",
    "viewing_rays": Pick(128, 256),
}


def _errors(run: Run) -> Errors:
    errors: Errors = run.once("errors", lambda: Errors(run, dict.fromkeys(FITTED, COUNTS)))
    return errors


def _measure(run: Run) -> Mapping[str, Quantity]:
    lead = noise_over(run, f"one-{PAIRED}", f"two-{PAIRED}")
    return {**_errors(run).slopes(FITTED), **different_pairs(run), "lead": lead}


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    white, errors = run.white("truth"), _errors(run)
    smooth = reference(run, "pillars with soft shadows and smooth edges", white)
    tabs = Tabs("sampler", "Sampler", [
        Panel("two", "two 2-D points", [linked(run, "two", "pixel and light point drawn on their own")]),
        Panel("one", "one 4-D point", [linked(run, "one", "pixel and light point halves of one 4-D point")], late=True),
        *(Panel(s, s, [Row([*counts(run, errors, s, SHOWN, white), smooth])]) for s in FITTED),
    ])  # fmt: skip
    svg = error_curves(
        [errors.curve(s, FITTED) for s in FITTED], x_title="viewing rays per pixel, N", y_title="RMSE, random at N = 1 is 1", chosen="random",
        x_ticks=[1, 4, 16, 100], y_ticks=[1, 1 / 3, 1 / 10, 1 / 30], label="RMSE against the number of viewing rays for three samplers, with fitted slopes.",
    )  # fmt: skip
    rows = {str(n): [errors.relative(s, n) for s in FITTED] for n in SHOWN}
    table = table_of(("N", *FITTED), rows, "RMSE against N viewing rays, each with one shadow ray [%]", bare=True,
                     note="RMSE in % of that of one random ray. The owen curve has 4-D points.")  # fmt: skip
    note = f"Bars and band: 95 %, {len(run.images('owen-1'))} independent replicates. Slopes are fitted at powers of 4, where owen is balanced; 10 and 100, hollow, are left out."
    return [tabs, Plot(svg, note, table)]


FIGURE = Figure(
    number=17, chapter=5, title="A pixel and a light", seconds=Pick(6, 80),
    question=Question(
        "16 viewing rays fall evenly on the quarters of a pixel, their shadow rays on those of the light, drawn apart. How many of the 16 pairs of quarters occur?",
        ("all 16", "about 11", "about 4"), 1, ("pairs-two",),
    ),
    variants=[
        Variant("truth", builtin("pillars"), TRUTH, 4, truth=True),
        *(Variant(f"{s}-{n}", builtin("pillars"), ONE | {"sampler": s, "viewing_rays": n}, 4) for s in FITTED for n in COUNTS),
        *(Variant(f"{way}-{PAIRED}", builtin("pillars"), ONE | {"size": (64, 45), "sampler": "owen", "pairing": how, "viewing_rays": PAIRED}, Pick(4, 32))
          for way, how in (("one", "4d"), ("two", "2d"))),
    ],
    measure=_measure, stage=_stage, exr=["truth", "owen-100"],
    answer=Number("pairs-two", "of the 16 pairs; the others are not looked at. A point in four dimensions has all 16."),
    equation=Equation([PIXEL_AND_LIGHT], "Marked: one sample is a place in the pixel and a place on the light, together a point in four dimensions."),
    claims=[
        Claim("Two 2-D points: about 11 of 16 pairs, 16 (1 − (3/4)⁴).", "pairs-two", near=EXPECTED["two"], within=0.5, main=True,
              measured="{pairs-two:1}; random points {pairs-random:1}"),
        Claim("One 4-D point: all 16.", "pairs-one", near=16.0, within=0.01, measured="{pairs-one}"),
        Claim(f"With {PAIRED} viewing rays in large pixels (64 × 45) it leaves less noise.", "lead", below=1.0, measured="{lead} of that of two 2-D points"),
        Claim("Random viewing rays: the error falls as N to the −½.", "random", near=-0.5, within=0.05,
              measured="slope {random:1}, owen {owen:1}"),
    ],
)  # fmt: skip
