"""The noise of one shadow ray in fully lit pixels and in penumbra pixels, for lights of several sizes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.replicates import of_interval
from antumbra.lecture.pictures import luminance
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.study import statistics

Classes = dict[str, NDArray[np.float64]]


def squares(run: Run, sizes: Sequence[float]) -> Classes:
    """Variance of one ray over the unshadowed light squared, as K numbers (K, sizes) for "lit" and "penumbra".

    They are the jackknife's pseudo-values, whose t-interval is that of `statistics.variance`: those of
    `variance_by_replicate` hang together through their mean, and theirs would be too narrow by (K − 2)/(K − 1).
    Of the variants one-`size`; truth-`size` has the layers visible-fraction and unshadowed-direct. Lit pixels see all
    of the light at every size, so that only the light changes; penumbra pixels between 5 and 95 % of it.
    """
    seen = {s: run.aov(f"truth-{s}", "visible-fraction") for s in sizes}
    unshadowed = {s: luminance(run.aov(f"truth-{s}", "unshadowed-direct")) for s in sizes}
    bright = {s: light > 0.02 * light.max() for s, light in unshadowed.items()}
    lit = np.logical_and.reduce([*(each > 0.999 for each in seen.values()), bright[1.0]])
    columns: dict[str, list[NDArray[np.float64]]] = {"lit": [], "penumbra": []}
    for s in sizes:
        one = luminances(run, f"one-{s}")
        for name, of in (("lit", lit), ("penumbra", bright[s] & (seen[s] > 0.05) & (seen[s] < 0.95))):
            each = statistics.variance_pseudo_values(one[:, of] / unshadowed[s][of])
            columns[name].append(each.mean(axis=1))
    return {name: np.stack(each, axis=1) for name, each in columns.items()}


def noises(found: Classes, sizes: Sequence[float]) -> dict[str, Quantity]:
    """Noise of one ray over the unshadowed light, `class`-`size`; …-doubled: at 2 over at 1; lit: its slope up to 1."""
    intervals = {
        (name, s): statistics.root(statistics.mean(columns[:, n]))
        for name, columns in found.items()
        for n, s in enumerate(sizes)
    }
    small = [n for n, s in enumerate(sizes) if s <= 1.0]
    slope = statistics.slope([sizes[n] for n in small], np.sqrt(found["lit"][:, small]))
    return {
        **{f"{name}-{s:g}": of_interval(each) for (name, s), each in intervals.items()},
        **{
            f"{c}-doubled": of_interval(statistics.ratio(intervals[c, 2.0], intervals[c, 1.0])) for c in found
        },
        "lit": of_interval(slope),
    }
