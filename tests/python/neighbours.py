"""How the errors of neighbouring pixels go together: `python neighbours.py` prints the table of docs/visibility.md.

Receivers are asked in tiles of 8 × 8 pixels of 4 × 4 blocks, many rays at once. Which rays go together must not be
seen: the errors of two pixels are as independent as if each were asked alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import antumbra as am

SIZE, RUNS = (160, 112), 16
# Right, down, along a diagonal; within a block, to the next block, to the next tile [pixels].
LAGS = [(1, 0), (0, 1), (1, 1), (2, 0), (0, 2), (3, 0), (0, 3), (4, 0), (0, 4), (8, 0), (0, 8)]


def regions(scene: am.Scene) -> dict[str, NDArray[np.bool_]]:
    """Pixels (H, W) of the floor of `pillars`: wholly lit, and in a penumbra."""
    aov = scene.render(
        size=SIZE,
        viewing="centre",
        viewing_rays=1,
        estimator="area",
        shadow_rays=64,
        aov="visible-fraction,normal",
    ).aov
    seen, floor = aov["visible-fraction"], aov["normal"][..., 1] > 0.999
    return {"flat": floor & (seen > 0.995), "penumbra": floor & (seen > 0.1) & (seen < 0.9)}


def correlations(estimator: str, sampler: str, rays: int) -> dict[str, NDArray[np.float64]]:
    """For each region (len(LAGS), 2): the correlation of errors that far apart, and the standard error of none.

    Errors are those of 16 pictures about their mean, over the standard deviation of each pixel: a bright pixel
    counts as much as a dark one. The products of N pairs of independent errors have the mean 0 ± 1/√N.
    """
    scene = am.builtin("pillars")
    look = {
        "size": SIZE,
        "viewing": "centre",
        "estimator": estimator,
        "sampler": sampler,
        "shadow_rays": rays,
    }
    pictures = np.stack([scene.render(**look, seed=k).pixels.mean(-1, dtype=np.float64) for k in range(RUNS)])
    error = pictures - pictures.mean(0)
    deviation = error.std(0) * np.sqrt(RUNS / (RUNS - 1))
    found = {}
    for name, region in regions(scene).items():
        asked = region & (deviation > 0)
        unit = np.where(asked, error / np.where(deviation > 0, deviation, 1.0), 0.0)
        rows = []
        for right, down in LAGS:
            of, to = np.s_[..., down:, right:], np.s_[..., : SIZE[1] - down, : SIZE[0] - right]
            pairs = (asked[of] & asked[to]).sum() * (RUNS - 1)
            rows.append(((unit[of] * unit[to]).sum() / pairs, 1 / np.sqrt(pairs)))
        found[name] = np.array(rows)
    return found


def main() -> None:
    """Prints the table."""
    print(f"| estimator, sampler, rays | region | {' | '.join(f'{x}, {y}' for x, y in LAGS)} | farthest |")
    print("|" + "---|" * (len(LAGS) + 3))
    for estimator, sampler, rays in [
        ("area", "random", 16),
        ("area", "owen", 1),
        ("area", "owen", 16),
        ("ambient-occlusion", "owen", 16),
    ]:
        for region, rows in correlations(estimator, sampler, rays).items():
            cells = " | ".join(f"{1e3 * rho:.1f}" for rho in rows[:, 0])
            far = np.abs(rows[:, 0] / rows[:, 1]).max()
            print(f"| {estimator}, {sampler}, {rays} | {region} | {cells} | {far:.1f} |")


if __name__ == "__main__":
    main()
