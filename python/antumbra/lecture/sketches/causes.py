"""Maps of the causes of noise, all on one scale."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from antumbra.lecture.measures.causes import PAIRS, SQUARES, parts
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Picture, Tabs
from antumbra.lecture.stages.quantities import tabs_of


def causes(run: Run, found: Mapping[str, Quantity], one: Picture) -> Tabs:
    """For each cause the picture `one`, the noise of all causes, and its own; covariances side by side."""
    first = parts(run)[0]
    high = float(np.quantile(np.sqrt(first.whole), 0.99))

    def shown(name: str, words: str, signed: bool = False) -> Picture:
        part, ramp, low = getattr(first, name), "signed" if signed else "amber", -high if signed else 0.0
        # An estimate of a variance may fall below 0, a covariance may be negative: its root with its sign.
        root = np.sign(part) * np.sqrt(np.abs(part)) if signed else np.sqrt(np.maximum(part, 0.0))
        share = f": {found[name]:1}" if name in found else ""
        return run.map(
            root,
            f"{'Root of the covariance, with its sign,' if signed else 'Standard deviation'} by pixel, {words}{share}.",
            f"{words}{share}",
            name=name.replace("_", "-"),
            ramp=ramp,
            low=low,
            high=high,
            unit="W·m⁻²·sr⁻¹" + (", signed root" if signed else ""),
            noise=True,
        )

    total = shown("whole", "all together")
    rows = {name: (words, [one, total, shown(name, words)]) for name, words in SQUARES.items()}
    pairs = [shown(name, words, signed=True) for name, words in PAIRS.items()]
    return tabs_of("cause", "Cause of the noise", {**rows, "covariances": ("covariances", pairs)})
