"""Light bounce by bounce, and error maps at equal work for three ways to end a path: two sliders and a plot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from antumbra._words import raised
from antumbra.lecture.measures.bounces import light_of
from antumbra.lecture.measures.ends import End, rmse
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Picture, Row, Strip
from antumbra.lecture.stages.quantities import curve_of
from antumbra.study.plot import error_curves

# Decades of the maps of errors.
_TICKS = {-2.5: "0.3 %", -2: "1 %", -1: "10 %", 0: "100 %"}


def bounce(run: Run, found: Mapping[str, Quantity], k: int, white: float) -> Frame:
    """The light of exactly k reflections beside that of up to k."""
    what = "emitted light" if k == 0 else "direct light" if k == 1 else f"light after {k} reflections"
    # Its term of the sum.
    term = "Lₑ" if k == 0 else "T Lₑ" if k == 1 else f"T{raised(k)} Lₑ"
    says = f"{term}, k = {k}: {what}, {found[f'share-{k}']:1} of all" if k else "Lₑ, k = 0: the lamp alone"
    alone, up_to = f"Only {what}.", f"All light of up to {k} reflections."
    pictures = [
        run.picture(light_of(run, k), alone, name=f"only-{k}", white=white, colour=True),
        run.picture(f"depth-{k}", up_to, name=f"sum-{k}", white=white, colour=True),
    ]
    return Frame(str(k), says, pictures, short=str(k), term=min(k, 3))


def parts_of_light(run: Run, last: int, white: float) -> Row:
    """Direct light, indirect light and their sum, at one scale."""
    lights = {
        "direct": ("direct: T Lₑ", light_of(run, 1)),
        "indirect": ("+ indirect: T² Lₑ + …", run.pixels(f"depth-{last}") - run.pixels("depth-1")),
        "reflected": ("= reflected", run.pixels(f"depth-{last}") - run.pixels("depth-0")),
    }
    return Row([
        run.picture(
            np.maximum(light, 0.0), f"The {name} light of the box.", caption, name=f"light-{name}", white=white,
            colour=True,
        )
        for name, (caption, light) in lights.items()
    ])  # fmt: skip


def shares_plot(found: Mapping[str, Quantity], last: int) -> str:
    """Shares of 1 … `last` reflections, and the line of the mean rate."""
    own, rate = [found[f"share-{k}"] for k in range(1, last + 1)], found["rate"].value
    bounces = [float(k) for k in range(1, last + 1)]
    curve = curve_of(
        "light of k", bounces, own, lambda k: own[5].value * rate ** (k - 6), f"× {rate:.2f} each"
    )
    label = "Share of the reflected light by number of reflections: a straight line on a logarithmic scale."
    return error_curves(
        [curve], x_title="reflections k", y_title="share of the reflected light", logarithmic=(False, True),
        x_ticks=[1, 2, 4, 6, 8, 10, 12], y_ticks=[1, 0.1, 0.01, 0.001], label=label,
    )  # fmt: skip


def ends_compared(
    run: Run, ends: Mapping[str, End], names: Sequence[str], light: float, work: Sequence[int]
) -> Strip:
    """Maps of the RMSE with so much `work` [rays a pixel] for the ways to end a path, over the mean `light`."""
    frames = [_frame(run, ends, names, light, n) for n in work]
    label = "Work: rays a pixel, viewing and shadow rays together"
    note = (
        "RMSE of each pixel over the mean light: √(bias² + variance of one path · its rays / work), all terms "
        "measured; bias and variances are means over 5 × 5 pixels."
    )
    return Strip("rays", label, frames, names, note, 6)


def _frame(run: Run, ends: Mapping[str, End], names: Sequence[str], light: float, work: int) -> Frame:
    errors = rmse(list(ends.values()), work, light)

    def shown(way: str, name: str, error: float) -> Picture:
        alt = f"{name}: RMSE {100 * error:.1f} % of the mean light with {work:,} rays a pixel."
        values = np.log10(np.maximum(ends[way].error(work) / light, 1e-9))
        return run.map(
            values, alt, name=f"error-{way}-{work}", ramp="amber", low=-2.5, high=0.0, unit="RMSE", ticks=_TICKS,
            noise=True,
        )  # fmt: skip

    pictures = [shown(*each) for each in zip(ends, names, errors, strict=True)]
    said = ", ".join(f"{100 * error:.1f}" for error in errors)
    return Frame(f"{work}", f"{work:,} rays a pixel: RMSE {said} %", pictures, short=f"{work:,}")
