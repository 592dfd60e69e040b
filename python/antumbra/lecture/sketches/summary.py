"""Every technique on one scene: its picture, where it is off, and a table of all, to sort."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra._words import written
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.summary import BEST, COUNTS, FIRST, SAMPLES, WAYS, compared
from antumbra.lecture.pictures import RAMPS, linear, ramp_colours
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Plot, Strip
from antumbra.lecture.stages.quantities import table_of
from antumbra.study.plot import error_curves, measured

# Techniques that have a curve in the plot.
_DRAWN = ("surfaces", "even", "cosine", "mis", "chosen", "stratified", "best")
# In the maps, an error of so much of white is as bright as can be.
_HIGH = 0.3


def one_by_one(run: Run, found: Mapping[str, Quantity]) -> Strip:
    """A slider over the techniques: the picture of each, and beside it its RMS error by pixel, in parts of white."""
    white, truth, frames = run.white("truth", share=99), run.light("truth"), []
    for way, (name, *_) in WAYS.items():
        key, error = f"{way}-{SAMPLES}", found[f"error-{way}"]
        off = np.sqrt(((luminances(run, key) - truth) ** 2).mean(0)) / white
        both = _side_by_side(run.image(key).pixels / white, off / _HIGH)
        alt = f"{name}: error {error:v} of the mean light; beside the picture where it is off."
        shown = run.picture(both, alt, name=way, white=1.0, colour=True, tones=224, noise=True)
        frames.append(Frame(way, f"{name}: off by {error:1}", [shown], short=name))
    label = f"Technique: {SAMPLES} samples a pixel; right, where they are off"
    return Strip("way", label, frames, tells=[*WAYS].index(BEST))


def _side_by_side(picture: ArrayLike, share: NDArray[np.float64]) -> NDArray[np.float64]:
    """A picture (H, W, 3), white 1, and right of it shares 0 to 1 along the amber ramp, as linear colours."""
    stops = [[int(c[i : i + 2], 16) / 255 for i in (1, 3, 5)] for c in ramp_colours(RAMPS["amber"], 128)]
    right = linear(stops)[np.round(127 * np.clip(share, 0, 1)).astype(int)]
    return np.concatenate([np.asarray(picture, np.float64), right], axis=1)


def by_efficiency(run: Run, found: Mapping[str, Quantity]) -> Plot:
    """Curves of some techniques, and the table of all; a reader may sort it by another column."""
    scatter = max(q.error / q.value for name, q in found.items() if name.startswith("time-"))
    note = (
        f"{SAMPLES} samples a pixel: rays that are traced (none where a direction meets no light), time, scatter over "
        "the mean (regular: off the truth); 1/scatter² per sample and per second, the first technique being 1. "
        "Times are medians, sure to "
        f"{100 * scatter:.0f} % in this run. Beside each picture its RMSE, brightest from {_HIGH:.0%} of white."
    )
    rows: dict[str, list[Quantity | str]] = {}
    for way in sorted(WAYS, key=lambda way: -found[f"second-{way}"].value):
        each = [found[f"{what}-{way}"] for what in ("rays", "time", "sample", "second")]
        rays, time, sample, second = (written(q.value, 2) for q in each)
        rows[WAYS[way].name] = [rays, time, found[f"error-{way}"], sample, second]
    head = ("technique", "rays", "µs", "error [%]", "per N", "per s")
    caption = "Rays, time, error and efficiency of each technique"
    return Plot(
        _curves(run),
        note,
        table_of(head, rows, caption, bare=True, fine=(1, 2), sorted_by=head.index("per s")),
    )


def _curves(run: Run) -> str:
    """RMSE against the number of samples."""
    errors = compared(run)
    unit = float(errors.squares[FIRST][:, 0].mean())
    curves = [measured(WAYS[way].name, COUNTS, 1e4 * errors.squares[way] / unit) for way in _DRAWN]
    return error_curves(
        curves, x_title="samples of a pixel", y_title="RMSE, 4 directions = 100", chosen=WAYS[BEST].name,
        x_ticks=COUNTS, y_ticks=[100, 10, 1],
        label="RMSE against the number of samples: each light asked with owen points is best.",
    )  # fmt: skip
