"""Figure 20: paths that must find the lamp by chance, beside direct and indirect light computed apart."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import BOUNCES
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.noise import luminances, noise_over
from antumbra.lecture.measures.ratio import ratio, squared
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.measures.slopes import Errors
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.sketches.samplers import reference
from antumbra.lecture.stages import Part, Picture, Plot
from antumbra.lecture.stages.quantities import table_of, tabs_of
from antumbra.study.plot import error_curves

COUNTS = [1, 4, 16, 64, 256]
# Whether the lamp is met by chance, or asked at each bounce.
WAYS = {"chance": "path-hemisphere", "asked": "path"}
FITTED = dict.fromkeys(WAYS, COUNTS)
LOOK = {"size": Pick((44, 44), (144, 144)), "viewing": "centre", "sampler": "random"}
TRUTH = LOOK | {"estimator": "path", "sampler": "owen", "viewing_rays": Pick(128, 512)}


def _errors(run: Run) -> Errors:
    errors: Errors = run.once("errors", lambda: Errors(run, FITTED))
    return errors


def _measure(run: Run) -> Mapping[str, Quantity]:
    errors = _errors(run)
    # From the scatter of replicates: a truth by paths would be judge in its own cause.
    gain = noise_over(run, "chance-16", "asked-16")
    chance, asked = (mean_of(luminances(run, f"{way}-256").mean((1, 2))) for way in WAYS)
    return errors.slopes(FITTED) | {"paths": squared(gain), "same": ratio(chance, asked)}


def _pictures(run: Run, way: str, white: float) -> list[Picture]:
    shown = []
    for n in COUNTS:
        caption, key = f"{n} path{'s' * (n > 1)}", f"{way}-{n}"
        alt = f"{caption} a pixel, lamp {way}: error {_errors(run).relative(way, n):v} of that of one path by chance."
        shown.append(
            run.picture(run.image(key).pixels, alt, caption, name=key, white=white, colour=True, noise=True)
        )
    return [*shown, reference(run, "the box with all of its light", white, colour=True)]


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    errors, white = _errors(run), run.white("truth", share=95)
    tabs = tabs_of("lamp", "The lamp is", {
        "chance": ("met by chance", _pictures(run, "chance", white)), "asked": ("asked at each bounce", _pictures(run, "asked", white)),
    })  # fmt: skip
    svg = error_curves(
        [errors.curve(way, FITTED) for way in WAYS], x_title="paths per pixel, N", y_title="RMSE, one path by chance is 1",
        chosen="chance", x_ticks=COUNTS, y_ticks=[1, 1 / 3, 1 / 10, 1 / 30, 1 / 100],
        label="RMSE against the number of paths, without and with light sampling: two parallel lines.",
    )  # fmt: skip
    rows = {str(n): [errors.relative(way, n) for way in WAYS] for n in COUNTS}
    table = table_of(("N", *WAYS), rows, "RMSE against the number of paths [%]", bare=True,
                     note="In % of that of one path by chance. The truth: many paths that ask. The number is of scatter alone.")  # fmt: skip
    note = f"Bars and band: 95 %, {len(run.images('asked-1'))} independent replicates. The slopes are the same, the heights are not."
    return [tabs, Plot(svg, note, table)]


FIGURE = Figure(
    number=20, chapter=5, title="By chance, or on purpose", seconds=Pick(6, 170),
    question=Question("Paths bounce until they meet the small lamp by chance. How many of them are worth one path that also asks the lamp at each bounce?",
                      ("about 3", "about 10", "about 100"), 2, ("paths",)),
    variants=[
        Variant("truth", builtin("cornell-box"), TRUTH, 4, truth=True),
        *(Variant(f"{way}-{n}", builtin("cornell-box"), LOOK | {"estimator": estimator, "viewing_rays": n}, 4)
          for way, estimator in WAYS.items() for n in COUNTS),
    ],
    measure=_measure, stage=_stage, exr=["truth", "chance-256", "asked-256"],
    answer=Number("paths", "So many paths by chance have the error of one that computes direct and indirect light apart. Both errors fall with "
        "slopes of {chance} and {asked}: more paths help both alike.", before="× "),
    equation=Equation([BOUNCES], "Marked: the direct light. Asked for on purpose, it is not left to chance; where the next bounce meets "
        "the lamp, it must not count again."),
    claims=[
        Claim("One path that asks the lamp is worth more than 50 that do not.", "paths", above=50, main=True, measured="× {paths}"),
        Claim("The error of paths by chance falls as N to the −½.", "chance", near=-0.5, within=0.05, measured="slope {chance}"),
        Claim("So does that of paths that ask.", "asked", near=-0.5, within=0.05, measured="slope {asked}"),
        Claim("Both have the same mean.", "same", near=1.0, within=0.02, measured="ratio {same} with 256 paths"),
    ],
)  # fmt: skip
