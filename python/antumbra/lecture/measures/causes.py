"""The causes of the noise of a picture of one shadow ray a pixel, each as a share of the variance and as a map."""

from __future__ import annotations

import math

from antumbra.lecture.measures import decompose
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.replicates import mean_of, of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import PILLARS_VIEW, half_hidden_disk, two_windows
from antumbra.lecture.variant import Pick
from antumbra.study import statistics

# Parts of the variance that are squares, and 2 Cov of each two of V, g and V with g.
SQUARES = {
    "light": "which light",
    "visibility": "visibility",
    "geometry": "geometry",
    "interaction": "V with g",
    "place": "pixel",
}
PAIRS = {
    "visibility_geometry": "2 Cov(V, g)",
    "visibility_interaction": "2 Cov(V, V with g)",
    "geometry_interaction": "2 Cov(g, V with g)",
}
# Under a disk of radius 1 and radiance 1 at height 1, half hidden (CF35e): g = π/(1 + ρ²)², ρ² even in (0, 1), and V
# apart from it 1 or 0 with ½ each. ḡ = π/2, Var g = π²/24, Var V = ¼; covariances are 0.
KNOWN = {
    "visibility": math.pi**2 / 16, "geometry": math.pi**2 / 96, "interaction": math.pi**2 / 96,
    "whole": math.pi**2 / 12,
}  # fmt: skip
SIZE, ESTIMATES, PLACES = Pick((60, 42), (240, 168)), 4, 4


def parts(run: Run) -> list[decompose.Parts]:
    """Independent estimates of the parts of each pixel under the two windows, from `PLACES`² places in it."""
    scene, count, size = run.scene(two_windows()), run.pick(Pick(8, 16)), run.pick(SIZE)

    def estimate(n: int) -> decompose.Parts:
        return decompose.of_picture(scene, size, PLACES, count, run.seeded(n), **PILLARS_VIEW)

    found: list[decompose.Parts] = run.once("parts", lambda: [estimate(n) for n in range(ESTIMATES)])
    return found


def shares(run: Run) -> dict[str, Quantity]:
    """The share of each part in the variance; adds: variance of the rendered pictures "one" over the sum of the parts.

    half-…: the parts of `KNOWN` under a half-hidden disk.
    """
    names = [*SQUARES, *PAIRS, "covariances"]
    whole = statistics.mean([each.whole.mean() for each in parts(run)])
    rendered = statistics.variance(luminances(run, "one"))
    count, scene = run.pick(Pick(2**17, 2**21)), run.scene(half_hidden_disk())
    half = decompose.of_point(scene, (0, 0, 0), (0, 1, 0), count, run.seeded(9))
    return {
        **{n: mean_of([getattr(p, n).mean() / p.whole.mean() for p in parts(run)], "%") for n in names},
        "adds": of_interval(statistics.ratio(rendered, whole)),
        **{f"half-{name}": mean_of(getattr(half, name)) for name in KNOWN},
    }
