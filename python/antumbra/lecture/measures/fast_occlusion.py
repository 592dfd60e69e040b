"""Directions that are decided together, beside rays: the same bits, what it takes, how fast."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from antumbra.hit import Receivers
from antumbra.lecture.measures.alone_and_together import Asked, in_turn, rays_of, starts
from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.occlusion import Occlusion
from antumbra.scene import Scene

# Rays alone and as they come; triangles to all points of a tile; points through the tree.
WAYS = ("single", "packets", "occluders", "receivers")
# Corners of the middle of the picture are asked about: as many points a side as this.
_TILE = 8


def seen(run: Run, scene: Scene, size: tuple[int, int]) -> Receivers:
    """Points of tiles of 8 × 8 pixels that are spread over a picture of 16 times `size`, and meet something."""
    width, height = size
    rows, columns = (np.arange(n) for n in (height, width))
    origins, along = scene.camera_rays((16 * width, 16 * height))
    # Every sixteenth tile on both axes.
    at = [(n // _TILE) * _TILE * 16 + n % _TILE for n in (rows, columns)]
    picked = (at[0][:, None] * 16 * width + at[1]).ravel()
    hit = scene.closest_hit(origins[picked], along[picked])
    return hit.receivers[np.isfinite(hit.t)]


def asked(
    run: Run, scene: Scene, receivers: Receivers, radius: float, count: int
) -> tuple[dict[str, Quantity], int, int]:
    """`in_range`, `tested`, the rate of each of `WAYS`, and `times-…`: those of both methods over that of packets. And
    how many bits differ from those of packets, of how many.
    """
    points, normals = receivers.positions, receivers.normals

    def masks(method: str, last: int | None = None) -> Occlusion:
        return scene.occlusion_masks(
            points[:last], normals[:last], directions=count, radius=radius, method=method, turned=True
        )

    origins, along, reach = rays_of(masks("receivers"), starts(points, normals))
    rays = Asked(run, scene, origins, directions=along, max_distance=reach)
    ways: dict[str, Callable[[], Any]] = {"single": rays.single, "packets": rays.together}
    ways |= {method: partial(masks, method) for method in WAYS[2:]}
    found, rates = in_turn(ways, len(origins), partial(masks, "receivers", 1))
    right = found["packets"]
    others = [rays.back(found["single"]), *(found[method].blocked.ravel() for method in WAYS[2:])]
    differ, work = sum(int(np.sum(bits != right)) for bits in others), found["receivers"].work
    said = {
        "in_range": Quantity(work.in_range / len(receivers)),
        "tested": Quantity(work.tested / max(work.in_range, 1)),
    }
    over = {f"times-{method}": ratio(rates[method], rates["packets"]) for method in WAYS[2:]}
    return said | rates | over, differ, len(others) * right.size


def together(
    run: Run, scene: Scene, name: str, size: tuple[int, int], radii: Sequence[float], counts: Sequence[int]
) -> tuple[dict[str, Quantity], int, int]:
    """What `asked` finds, by radius and number of directions, named `name-radius-count-…`; bits that differ, of all."""
    found: dict[str, Quantity] = {}
    differ = bits = 0
    receivers = seen(run, scene, size)
    for radius in radii:
        for count in counts:
            one, different, compared = asked(run, scene, receivers, radius, count)
            found |= {f"{name}-{radius:g}-{count}-{what}": q for what, q in one.items()}
            differ, bits = differ + different, bits + compared
    return found, differ, bits
