"""Figure 15: the noise of one shadow ray against the size of the light, fully lit pixels and penumbra apart."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.chapters import SUM
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.replicates import of_interval
from antumbra.lecture.pictures import luminance
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.stages import Frame, Part, Plot, Strip
from antumbra.study import statistics
from antumbra.study.plot import error_curves, measured

SIZES = [0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0]
LOOK = {
    "estimator": "area", "viewing": "centre", "viewing_rays": 1, "light_points": "area", "size": Pick((96, 68), (240, 168)),
    "eye": (-7.4, 5.6, 5.4), "look_at": (0.3, 0.55, 0.3), "fov": 0.5,
}  # fmt: skip
ONE = LOOK | {"sampler": "random", "shadow_rays": 1}
TRUTH = LOOK | {"sampler": "owen", "shadow_rays": Pick(64, 256), "aov": "visible-fraction,unshadowed-direct"}


def _lit(run: Run) -> NDArray[np.bool_]:
    """Pixels that see all of the light at every size: the same pixels, so that only the light changes."""
    each = [run.aov(f"truth-{size}", "visible-fraction") > 0.999 for size in SIZES]
    bright = _unshadowed(run, 1.0) > 0.02 * _unshadowed(run, 1.0).max()
    found: NDArray[np.bool_] = np.logical_and.reduce([*each, bright])
    return found


def _penumbra(run: Run, size: float) -> NDArray[np.bool_]:
    """Pixels that see between 5 and 95 % of the light."""
    seen, unshadowed = run.aov(f"truth-{size}", "visible-fraction"), _unshadowed(run, size)
    found: NDArray[np.bool_] = (unshadowed > 0.02 * unshadowed.max()) & (seen > 0.05) & (seen < 0.95)
    return found


def _unshadowed(run: Run, size: float) -> NDArray[np.float64]:
    return luminance(run.aov(f"truth-{size}", "unshadowed-direct"))


def _squares(run: Run, name: str) -> NDArray[np.float64]:
    """Variance of a class of pixels for each size, relative to the unshadowed light squared: (K, sizes)."""
    columns = []
    for size in SIZES:
        of = _lit(run) if name == "lit" else _penumbra(run, size)
        each = np.array([luminance(image.pixels)[of] for image in run.images(f"one-{size}")])
        columns.append(statistics.variance_by_replicate(each / _unshadowed(run, size)[of]))
    return np.stack(columns, axis=1)


def _all_squares(run: Run) -> dict[str, NDArray[np.float64]]:
    return {name: run.once(name, partial(_squares, run, name)) for name in ("lit", "penumbra")}


def _measure(run: Run) -> Mapping[str, Quantity]:
    squares = _all_squares(run)
    noise = {
        (n, s): statistics.root(statistics.mean(squares[n][:, SIZES.index(s)]))
        for n in squares
        for s in (1.0, 2.0)
    }
    small = slice(0, SIZES.index(1.0) + 1)
    return {
        "lit": of_interval(statistics.slope(SIZES[small], np.sqrt(squares["lit"][:, small]))),
        "doubled": of_interval(statistics.ratio(noise["penumbra", 2.0], noise["penumbra", 1.0])),
        "lit-doubled": of_interval(statistics.ratio(noise["lit", 2.0], noise["lit", 1.0])),
        "one": of_interval(noise["penumbra", 1.0]),
        "lit-one": of_interval(noise["lit", 1.0]),
    }


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    frames, white = [], run.white("truth-0.25")
    squares = _all_squares(run)
    for i, size in enumerate(SIZES):
        key = f"one-{size}"
        noise = np.array([luminance(image.pixels) for image in run.images(key)]).std(0, ddof=1)
        lit, penumbra = (float(np.sqrt(squares[name][:, i].mean())) for name in ("lit", "penumbra"))
        says = f"{size:g} m: lit pixels {lit:.3f}, penumbra {penumbra:.2f}"
        pictures = [
            run.picture(run.image(key).pixels, f"One shadow ray a pixel, light of {says}.", name=key, white=white, noise=True),
            run.picture(f"truth-{size}", f"The same without noise, light of {size:g} m.", white=white),
            run.map(noise / white, f"Noise of one ray: {says}.", name=f"noise-{size}", ramp="amber", high=0.5, noise=True),
        ]  # fmt: skip
        frames.append(Frame(f"{size:g}", says, pictures, short=f"{size:g} m"))
    labels = ("one shadow ray", "many", "noise of one")
    curves = [
        measured(name, SIZES, squares[name], fit=[name == "lit" and s <= 1 for s in SIZES])
        for name in squares
    ]
    svg = error_curves(
        curves, x_title="edge of the light [m], its power constant", y_title="noise of one ray, unshadowed light = 1",
        chosen="penumbra", x_ticks=[0.25, 0.5, 1, 2, 4], y_ticks=[1, 1 / 3, 1 / 10, 1 / 30, 1 / 100],
        label="Noise of one shadow ray against the size of the light: lit pixels and penumbra pixels.",
    )  # fmt: skip
    note = f"Bars: 95 %, {len(run.images('one-1.0'))} independent pictures. The line is fitted to lit pixels up to 1 m."
    return [
        Strip("size", "Edge of the square light, at constant power", frames, SIZES.index(1.0), labels),
        Plot(svg, note),
    ]


FIGURE = Figure(
    number=15, chapter=4, title="How large a light", seconds=Pick(8, 90),
    question=Question("One shadow ray per pixel. The light is made twice as large at the same power. What happens to the noise of a penumbra pixel?",
                      ("it doubles", "it stays", "it halves"), 1),
    variants=[Variant(f"{kind}-{s}", builtin("pillars", light_size=s), options, count)
              for s in SIZES for kind, options, count in (("one", ONE, Pick(16, 48)), ("truth", TRUTH, 1))],
    measure=_measure, stage=_stage, exr=["one-1.0"],
    answer=Number("doubled", "So many times as noisy is a penumbra pixel under 2 m as under 1 m, and {lit-doubled:1} times a fully lit one. The penumbra "
        "only grows wider.", before="× "),
    equation=Equation([SUM], "Marked: one shadow ray. In the penumbra V jumps between 0 and 1, whatever the size; in the light only the "
        "cosines and r vary, and the less the smaller the light."),
    claims=[
        Claim("Fully lit: the noise grows with the edge of the light.", "lit", near=1.0, within=0.05, main=True, measured="slope {lit}, edges up to 1 m"),
        Claim("In the penumbra a light twice as large changes little.", "doubled", near=1.0, within=0.2, measured="× {doubled} from 1 to 2 m"),
        Claim("There it is less than that of a fair coin, 1/2, and more than 1/3.", "one", near=5 / 12, within=1 / 12, measured="{one} of the unshadowed light"),
    ],
)  # fmt: skip
