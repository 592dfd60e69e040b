"""Many directions of a point decided together: `Occlusion`, and what `Scene` inherits to ask for it."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra._arrays import places
from antumbra._values import length, text
from antumbra.hit import Hit, Receivers

if TYPE_CHECKING:
    from antumbra import _core


class OcclusionWork(NamedTuple):
    """What masks of occlusion took, as `Scene.occlusion_masks` describes."""

    boxes: int
    """Boxes tested."""
    pairs: int
    """Pairs of a point and a triangle that were looked at."""
    in_range: int
    """Those of them in which the triangle may be met: within the radius, above the horizon."""
    between: int
    """Those of them whose triangle is so small that it lies between the directions."""
    tested: int
    """Directions of such pairs that the table of half-spaces left open."""
    law: int
    """Those of them that only exact arithmetic could decide."""
    rays: int
    """Rays that were cast instead."""


class Occlusion(NamedTuple):
    """Which directions are blocked over each point."""

    masks: NDArray[np.uint64]
    """(N, D/64): bit i % 64 of word i // 64 says that direction i is blocked."""
    directions: NDArray[np.float32]
    """(D, 3): unit vectors in the frame of each point, z along its normal; as many as the cosine has density."""
    lengths: NDArray[np.float32]
    """(D,): how far each ray goes; a fall-off lies in these lengths."""
    frames: NDArray[np.float32]
    """(N, 3, 3): two tangents and the normal of each point; `directions @ frames[i]` are its rays in the world."""
    work: OcclusionWork
    """What it took."""

    @property
    def blocked(self) -> NDArray[np.bool_]:
        """(N, D): the bits, one by one."""
        return np.unpackbits(self._octets, axis=1, bitorder="little").astype(bool)

    @property
    def openness(self) -> NDArray[np.float64]:
        """(N,): the open share (1/π)∫V cos θ dω, the mean over the directions; 1 = open."""
        ones = np.unpackbits(np.arange(256, dtype=np.uint8)[:, None], axis=1).sum(axis=1)
        share: NDArray[np.float64] = ones[self._octets].sum(axis=1) / len(self.directions)
        return 1.0 - share

    @property
    def _octets(self) -> NDArray[np.uint8]:
        return self.masks.astype("<u8").view(np.uint8)


class Openings:
    """The part of `Scene` that decides many directions together."""

    _core: _core.Scene

    def occlusion_masks(
        self,
        points: ArrayLike | Hit | Receivers,
        normals: ArrayLike | None = None,
        *,
        directions: int = 256,
        radius: float | None = None,
        falloff: str | None = None,
        method: str = "receivers",
        turned: bool = False,
    ) -> Occlusion:
        """Which of many directions over each point are blocked (Laine and Karras 2010).

        `points` (N, 3) with unit `normals` (N, 3), or receivers. `directions`: 64, 256, 512 or 1024, the same over
        every point in its own frame, or `turned` about its normal by a random angle. What lies beyond `radius` does
        not block; `falloff` "linear" or "quadratic" lets it weigh less toward the radius.

        `method` changes the time only, never a bit: "occluders" puts each triangle to all points of a tile that it may
        reach, "receivers" takes each point through the tree, "rays" casts every direction as a ray. Without a radius
        the first two look at nearly every triangle above the horizon: there rays are faster.

        Raises ValueError for another number of directions, a radius not above 0, or a fall-off without a radius.

        >>> import antumbra as am
        >>> found = am.builtin("pillars").occlusion_masks([[0.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]], radius=2.0)
        >>> found.masks.shape, found.blocked.shape, bool(found.openness[0] < 1)
        ((1, 4), (1, 256), True)
        """
        start, facing, _ = places(points, normals)
        reach = np.inf if radius is None else length("radius", radius)
        weight = "none" if falloff is None else text("falloff", falloff)
        if radius is None and weight != "none":
            raise ValueError(f'falloff = "{weight}" needs a radius')
        count = operator.index(directions)
        masks, along, lengths, frames, work = self._core.occlusion_masks(
            start, facing, count, reach, weight, text("method", method), bool(turned)
        )
        return Occlusion(masks, along, lengths, frames, OcclusionWork(*work))
