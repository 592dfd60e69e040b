"""Figure 13: 1, 9, 36, 100 shadow rays; what theory predicts for random ones, and what better samplers do."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import SUM_OF_N
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.noise import noise_over
from antumbra.lecture.measures.slopes import Errors
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import CENTRED, builtin
from antumbra.lecture.sketches.samplers import counts, reference
from antumbra.lecture.stages import Part, Plot
from antumbra.lecture.stages.quantities import table_of, tabs_of
from antumbra.study.plot import error_curves

SHOWN, POWERS = [1, 9, 36, 100], [1, 4, 16, 64, 256]
# Owen points are balanced at powers of four: there the slope is fitted, and that of stratified ones to compare.
FITTED = {"random": SHOWN, "stratified": POWERS, "regular": SHOWN, "owen": POWERS}
COUNTS = {sampler: sorted({*SHOWN, *fitted}) for sampler, fitted in FITTED.items()}
TRUTH = CENTRED | {"estimator": "mis", "sampler": "owen", "shadow_rays": Pick(256, 1024)}


def _errors(run: Run) -> Errors:
    errors: Errors = run.once("errors", lambda: Errors(run, COUNTS))
    return errors


def _measure(run: Run) -> Mapping[str, Quantity]:
    errors = _errors(run)
    return errors.slopes(FITTED) | {
        "gain": errors.divided("random", 1, "random", 100),
        "better": errors.divided("random", 1, "stratified", 100),
        "lead": noise_over(run, "owen-256", "stratified-256"),
        "alike": noise_over(run, "one-stratified", "one-random"),
    }


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    white, errors = run.white("truth"), _errors(run)
    smooth = reference(run, "smooth soft shadows of three pillars and a ball", white)
    tabs = tabs_of(
        "sampler", "Sampler", {s: (s, [*counts(run, errors, s, SHOWN, white), smooth]) for s in FITTED}
    )
    svg = error_curves(
        [errors.curve(sampler, FITTED) for sampler in FITTED], x_title="shadow rays per pixel, N", y_title="RMSE, random at N = 1 is 1",
        chosen="random", x_ticks=[1, 9, 36, 100, 256], y_ticks=[1, 1 / 3, 1 / 6, 1 / 10, 1 / 30, 1 / 100],
        label="RMSE against the number of shadow rays for four samplers, with fitted slopes.",
    )  # fmt: skip
    note = (
        f"Bars and band: 95 %, {len(run.images('random-1'))} independent replicates. Slopes are fitted to the filled marks of the chosen "
        "curve. An empty mark on it is measured and left out: owen is balanced at powers of 4, so 9, 36 and 100 do not count, "
        "nor for stratified, which is compared with it. The regular sampler has no replicates: its error is the same each time."
    )  # fmt: skip
    every = sorted({*SHOWN, *POWERS})
    rows = {str(n): [Quantity(n**-0.5, unit="%"), *(errors.cell(s, n) for s in FITTED)] for n in every}
    table = table_of(
        ("N", "1/√N", *FITTED), rows, "RMSE against N, predicted and measured [%]", fine=(1,), bare=True,
        note=f"RMSE in % of that of one random ray ({errors.unit:1}). The truth is made by another estimator (mis, with points in "
        "solid angle); its own noise is taken off, and what that leaves open is in each ± here and of the slopes.",
    )  # fmt: skip
    return [tabs, Plot(svg, note, table)]


FIGURE = Figure(
    number=13, chapter=4, title="What a hundred shadow rays buy", seconds=Pick(5, 150),
    question=Question("One shadow ray leaves noise. By what factor is it smaller with 100, if they are random?",
                      ("100", "10", "about 3"), 1, ("gain",)),
    variants=[
        Variant("truth", builtin("pillars"), TRUTH, 4, truth=True),
        *(Variant(f"{sampler}-{n}", builtin("pillars"), CENTRED | {"sampler": sampler, "shadow_rays": n, "light_points": "area"},
                  1 if sampler == "regular" else Pick(4, 8)) for sampler in FITTED for n in COUNTS[sampler]),
        *(Variant(f"one-{sampler}", builtin("pillars"), CENTRED | {"sampler": sampler, "light_points": "area"}, 32)
          for sampler in ("random", "stratified")),
    ],
    measure=_measure, stage=_stage, exr=["random-100"],
    answer=Number("gain", "Random rays follow 1/√N: the slope is {random}. The same 100 rays, stratified, divide the noise by "
        "{better:1}.", before="÷ "),
    equation=Equation([SUM_OF_N], "Marked: the number of shadow rays. One centred viewing ray per pixel, so all the noise comes from the light."),
    claims=[
        Claim("Random rays: the error falls as N to the −½.", "random", near=-0.5, within=0.03, main=True, measured="slope {random}"),
        # A tenth of it: far from the next choices, and twice what four replicates of a coarse run leave open.
        Claim("A hundred random rays divide it by ten.", "gain", near=10.0, within=1.0, measured="÷ {gain}"),
        Claim("With 256 rays owen leaves less noise than stratified.", "lead", below=1.0,
              measured="{lead} of it; slopes {owen} and {stratified}"),
        Claim("With one ray, stratified is no better than random.", "alike", near=1.0, within=0.05, measured="{alike} of its noise"),
    ],
)  # fmt: skip
