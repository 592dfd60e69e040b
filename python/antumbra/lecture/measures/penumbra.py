"""How wide a penumbra is, by the shadow rays to the two ends of a light."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.points import irradiance_at
from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.square_lights import BOARDS, DISTANCE_RATIOS, LIGHT_HEIGHT, boards_under_square
from antumbra.lecture.variant import Pick
from antumbra.scene import Scene

Place = tuple[float, float, float]
# Points of the line on which the widths of the boards' penumbras are counted.
_COUNT = Pick(1024, 16384)


def penumbra_widths(
    run: Run, scene: Scene, line: tuple[Place, Place], ends: Sequence[Place], count: int, stream: int
) -> NDArray[np.float64]:
    """Length of the part of `line` that sees one of the `ends` of a light and not the other, (16,).

    16 replicates of `count` evenly spaced points, each with a random offset; `stream` gives them numbers of their own.
    """
    a, b = np.asarray(line, np.float64)
    step = float(np.linalg.norm(b - a)) / count
    widths = []
    for replicate in range(16):
        offset = np.random.default_rng((run.seeded(replicate), stream)).random()
        points = a + (b - a) * ((np.arange(count) + offset) / count)[:, None]
        blocked = [scene.occluded(points, np.array(end)) for end in ends]
        widths.append(step * np.count_nonzero(blocked[0] != blocked[1]))
    return np.array(widths)


def board_widths(
    run: Run, sizes: Sequence[float], doubled: Sequence[tuple[float, float]]
) -> dict[str, Quantity]:
    """Widths of the penumbra of each of the three boards, w`size`-`board` [m], for edges `sizes` of the light.

    share: over the prediction s d₂/d₁, of all of them; doubled: over the width at half the edge; boards: the last
    board over the first, at the largest; below-`size`: the light straight below, over that of the point light.
    """
    ratios = list(DISTANCE_RATIOS.values())
    width = {(s, b): _board_widths(run, s, b, ratios[b]) for s in sizes for b in range(len(BOARDS))}
    twice = [width[b, n] / width[a, n] for a, b in doubled for n in range(len(BOARDS))]
    most, point = sizes[-1], _unshadowed(run, 0.0)
    below = {s: ratio(_unshadowed(run, s), point) for s in sizes}
    return {
        **{f"w{s:g}-{b}": _width(w, 2 * _half(ratios[b]) / run.pick(_COUNT)) for (s, b), w in width.items()},
        "doubled": mean_of(np.mean(twice, axis=0)),
        "widths": Quantity(len(width)),
        "share": mean_of(np.mean([w / (s * ratios[b]) for (s, b), w in width.items()], axis=0)),
        "boards": mean_of(width[most, len(BOARDS) - 1] / width[most, 0]),
        **{f"below-{s:g}": share for s, share in below.items()},
    }


def _board_widths(run: Run, size: float, board: int, distances: float) -> NDArray[np.float64]:
    """16 replicates, on the line across the edge that lies in the middle of a board's shadow."""
    height, middle, _ = BOARDS[board]
    ends = [(side * size / 2, LIGHT_HEIGHT, 0.0) for side in (-1, 1)]
    half, row = _half(distances), middle / (1 - height / LIGHT_HEIGHT)
    line = ((-half, 0.0, row), (half, 0.0, row))
    return penumbra_widths(run, run.scene(boards_under_square(size)), line, ends, run.pick(_COUNT), board)


def _half(distances: float) -> float:
    """Half of the line on which a penumbra is looked for [m]."""
    return 0.75 * distances


def _width(widths: NDArray[np.float64], step: float) -> Quantity:
    """The mean; replicates that count alike leave 3/16 of a step open (none of 16: less than 3/16 at 95 %)."""
    mean = mean_of(widths, "m")
    return Quantity(mean.value, max(mean.error, 3 / len(widths) * step), mean.unit)


def _unshadowed(run: Run, size: float) -> Quantity:
    """Irradiance of the floor straight below the light, as if there were no boards."""
    scene, options = run.scene(boards_under_square(size)), {"shadows": "off", "light_points": "area"}
    return irradiance_at(scene, (0, 0, 0), 2**18, run.seeded(1), **options)
