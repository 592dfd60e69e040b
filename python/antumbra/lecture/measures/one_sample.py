"""An estimator taken one sample at a time: how its single samples scatter at a point."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.points import UP
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.scene import Scene

GROUPS = 32


class Samples(NamedTuple):
    """Irradiance by one sample each, in `GROUPS` independent groups (GROUPS, n); what one took, in seconds."""

    values: NDArray[np.float64]
    seconds: float

    @property
    def variances(self) -> NDArray[np.float64]:
        """Of a single sample, group by group."""
        found: NDArray[np.float64] = self.values.var(1, ddof=1)
        return found

    @property
    def moment(self) -> Quantity:
        """Mean square of a single sample."""
        return mean_of((self.values**2).mean(1))

    @property
    def share(self) -> Quantity:
        """Share of the samples that are not 0."""
        return mean_of((self.values > 0).mean(1), "%")


def one_sample(scene: Scene, point: Any, count: int, seed: int, normal: Any = UP, **options: Any) -> Samples:
    """`count` random samples at a point that faces up, or along its `normal`."""
    points = np.tile(np.asarray(point, np.float64), (count, 1))
    found = scene.irradiance(points, normal, shadow_rays=1, sampler="random", seed=seed, **options)
    values = np.asarray(found, np.float64)[:, 0].reshape(GROUPS, -1)
    return Samples(values, found.seconds / count)


def moments_of_light_points(
    scene: Scene, point: Any, normal: Any, side: int, seed: int, replicates: int = 8
) -> NDArray[np.float64]:
    """Mean square of one unshadowed light point's L_e cos θ / p(ω), by side² jittered numbers; one per replicate."""
    points = np.tile(np.asarray(point, np.float64), (side * side, 1))
    corner = np.stack(np.meshgrid(*[np.arange(side)] * 2), -1).reshape(-1, 2)
    found = []
    for replicate in range(replicates):
        u = np.random.default_rng((seed, replicate)).random((side * side, 3))
        u[:, 1:] = np.minimum((corner + u[:, 1:]) / side, np.nextafter(1.0, 0.0))
        drawn = scene.sample_light(points, normal, u, light_points="area")
        cosine = np.maximum(drawn.direction @ np.asarray(normal, np.float64), 0.0)
        found.append(np.mean((drawn.radiance[:, 0] * cosine / drawn.pdf) ** 2, dtype=np.float64))
    return np.asarray(found)
