"""Figure 13: 1, 9, 36, 100 shadow rays; what theory predicts for random ones, and what better samplers do."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.chapters import SUM_OF_N
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.noise import squared_errors
from antumbra.lecture.measures.replicates import of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.stages import Panel, Part, Plot, Row, Table, Tabs
from antumbra.study import statistics
from antumbra.study.plot import error_curves, measured

SHOWN, POWERS = [1, 9, 36, 100], [1, 4, 16, 64, 256]
# Owen points are balanced at powers of four: there the slope is fitted.
FITTED = {"random": SHOWN, "stratified": SHOWN, "regular": SHOWN, "owen": POWERS}
LOOK = {
    "estimator": "area", "viewing": "centre", "viewing_rays": 1, "size": Pick((96, 68), (240, 168)),
    "eye": (-7.4, 5.6, 5.4), "look_at": (0.3, 0.55, 0.3), "fov": 0.5,
}  # fmt: skip
TRUTH = {"estimator": "mis", "sampler": "owen", "shadow_rays": Pick(512, 2048)}


def _counts(sampler: str) -> list[int]:
    return sorted({*SHOWN, *FITTED[sampler]})


def _variant(sampler: str, n: int) -> Variant:
    options = LOOK | {"sampler": sampler, "shadow_rays": n, "light_points": "area"}
    return Variant(f"{sampler}-{n}", builtin("pillars"), options, 1 if sampler == "regular" else Pick(4, 8))


def _errors(run: Run, sampler: str) -> np.ndarray:
    """Squared errors (K, M), a column for each N."""
    return np.stack([squared_errors(run, f"{sampler}-{n}", "truth") for n in _counts(sampler)], axis=1)


def _measure(run: Run) -> Mapping[str, Quantity]:
    errors = {sampler: np.sqrt(_errors(run, sampler)) for sampler in FITTED}
    found = {}
    for sampler, n in FITTED.items():
        chosen = [_counts(sampler).index(k) for k in n]
        found[sampler] = of_interval(
            statistics.slope(n, errors[sampler][:, chosen]), note="slope of the RMSE"
        )
    rmse = {sampler: [statistics.mean(column) for column in e.T] for sampler, e in errors.items()}
    last = {sampler: rmse[sampler][_counts(sampler).index(100)] for sampler in FITTED}
    one = rmse["random"][0]
    return found | {
        "gain": of_interval(statistics.ratio(one, last["random"])),
        "better": of_interval(statistics.ratio(one, last["stratified"])),
        "alike": of_interval(statistics.ratio(rmse["stratified"][0], one)),
    }


def _table(run: Run) -> Table:
    unit = statistics.mean(np.sqrt(_errors(run, "random"))[:, 0]).value
    rows = []
    for n in SHOWN:
        cells = [str(n), f"1/{n**0.5:g}" if n > 1 else "1"]
        for sampler in FITTED:
            error = of_interval(
                statistics.mean(np.sqrt(_errors(run, sampler)[:, _counts(sampler).index(n)]) / unit)
            )
            cells.append(f"{error:1}" if sampler == "random" else f"{error.value:.3f}")
        rows.append(cells)
    return Table(
        ("N", "1/√N", *FITTED), rows, "RMSE against N, predicted and measured", fine=(1,),
        note=f"RMSE, one random ray being 1 ({unit:.3g} W·m⁻²·sr⁻¹). The truth is made by another estimator (mis, with points in "
        "solid angle); its own noise is taken off.",
    )  # fmt: skip


def _stage(run: Run, measured_: Mapping[str, Quantity]) -> list[Part]:
    white, panels = run.white("truth"), []
    reference = run.picture(
        "truth", "Reference: smooth soft shadows of three pillars and a ball.", "reference", white=white
    )
    unit = float(np.mean(_errors(run, "random")[:, 0]))
    curves = []
    for sampler in FITTED:
        errors = _errors(run, sampler) / unit
        row = [
            run.picture(run.images(f"{sampler}-{n}")[0].pixels,
                        f"{n} {sampler} shadow ray{'s' * (n > 1)} a pixel: noise of {np.sqrt(e):.3f}.",
                        f"{n} ray{'s' * (n > 1)}", name=f"{sampler}-{n}", white=white, noise=True)
            for n, e in zip(_counts(sampler), errors.mean(0), strict=True) if n in SHOWN
        ]  # fmt: skip
        panels.append(Panel(sampler, sampler, [Row([*row, reference])]))
        fit = [n in FITTED[sampler] for n in _counts(sampler)]
        curves.append(measured(sampler, _counts(sampler), errors, fit=fit))
    svg = error_curves(
        curves, x_title="shadow rays per pixel, N", y_title="RMSE, random at N = 1 is 1", chosen="random",
        x_ticks=[1, 9, 36, 100, 256], y_ticks=[1, 1 / 3, 1 / 6, 1 / 10, 1 / 30, 1 / 100],
        label="RMSE against the number of shadow rays for four samplers, with fitted slopes.",
    )  # fmt: skip
    count = len(run.images("random-1"))
    note = (
        f"Bars and band: 95 %, {count} independent replicates. Hollow: shown, not fitted (owen is balanced at powers "
        "of 4). The regular sampler has no replicates: its error is the same each time."
    )
    return [Tabs("sampler", "Sampler", panels), Plot(svg, note, _table(run))]


FIGURE = Figure(
    number=13, chapter=4, title="What a hundred shadow rays buy", seconds=Pick(8, 150),
    question=Question("One shadow ray leaves noise. By what factor is it smaller with 100, if they are random?",
                      ("100", "10", "about 3"), 1),
    variants=[Variant("truth", builtin("pillars"), LOOK | TRUTH, 2, truth=True)]
    + [_variant(sampler, n) for sampler in FITTED for n in _counts(sampler)],
    measure=_measure, stage=_stage, exr=["random-100"],
    answer=Number("gain", "Random rays follow 1/√N: the slope is {random}. The same 100 rays, stratified, divide the noise by "
        "{better:1}.", before="÷ "),
    equation=Equation([SUM_OF_N], "Marked: the number of shadow rays. One centred viewing ray per pixel, so all the noise comes from the light."),
    claims=[
        Claim("Random rays: the error falls as N to the −½.", "random", near=-0.5, within=0.03, main=True, measured="slope {random}"),
        Claim("Owen is steeper than stratified.", "owen", below="stratified", measured="slopes {owen} and {stratified}"),
        Claim("With one ray, stratified is no better than random.", "alike", near=1.0, within=0.05, measured="ratio {alike}"),
    ],
)  # fmt: skip
