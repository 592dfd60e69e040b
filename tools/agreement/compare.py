"""Two noisy pictures against each other: fireflies left out, means, tiles of 8 × 8 pixels.

What is left out: a pixel whose standard error, in either picture, is above 20 times the mean of those of its picture
that are not 0 (so fewer than one in twenty of each). Half floats of the references round by up to 2⁻¹¹ of a number.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Plane = NDArray[np.float64]
TILE = 8
FIREFLY = 20.0
# Differences below this share of the picture's mean are nobody's concern: tiles without light have no noise at all.
FLOOR = 1e-3


class Noisy(NamedTuple):
    """A grey picture and the standard error of each of its pixels, (H, W)."""

    value: Plane
    error: Plane


class Agreement(NamedTuple):
    """How two pictures differ. Shares, not per cent."""

    mean: float
    """Of ours over theirs, less 1."""
    mean_error: float
    """Its standard error."""
    tile: float
    """Median over the tiles of |ours − theirs| / theirs."""
    tile_noise: float
    """What noise alone would make of it."""
    far: float
    """Share of tiles more than 5 standard errors apart."""
    left_out: float
    """Share of pixels left out as fireflies."""

    @property
    def tile_beyond(self) -> float:
        """The median beyond the noise of both (noise adds in squares)."""
        return float(np.sqrt(max(0.0, self.tile**2 - self.tile_noise**2)))

    @property
    def holds(self) -> bool:
        """Mean within 1 %, median tile within 2 %, both beyond the noise."""
        return abs(self.mean) - 2.0 * self.mean_error <= 0.01 and self.tile_beyond <= 0.02


def compare(ours: Noisy, theirs: Noisy) -> Agreement:
    """Ours against theirs."""
    keep = ~(_fireflies(ours) | _fireflies(theirs))
    variance = ours.error**2 + theirs.error**2 + (theirs.value * 2.0**-11) ** 2 / 3.0
    a, b = ours.value[keep], theirs.value[keep]
    sigma = float(np.sqrt(variance[keep].sum())) / keep.sum()
    pairs = _tiles(ours.value, theirs.value, variance, keep)
    floor = FLOOR * b.mean()
    far = np.abs(pairs.a - pairs.b) / np.hypot(pairs.sigma, floor) > 5.0
    dark = np.maximum(pairs.b, 0.01 * b.mean())
    return Agreement(
        mean=a.mean() / b.mean() - 1.0,
        mean_error=sigma / b.mean(),
        tile=float(np.median(np.abs(pairs.a - pairs.b) / dark)),
        # Half of all normal numbers lie within 0.6745 standard deviations.
        tile_noise=float(np.median(0.6745 * pairs.sigma / dark)),
        far=float(far.mean()),
        left_out=1.0 - float(keep.mean()),
    )


class _Tiles(NamedTuple):
    a: Plane
    b: Plane
    sigma: Plane


def _fireflies(picture: Noisy) -> NDArray[np.bool_]:
    noisy = picture.error[picture.error > 0.0]
    return np.asarray(picture.error > FIREFLY * (noisy.mean() if noisy.size else 0.0))


def _tiles(a: Plane, b: Plane, variance: Plane, keep: NDArray[np.bool_]) -> _Tiles:
    """Means over tiles of what is kept; tiles without a kept pixel are left out."""

    def sums(plane: Plane) -> Plane:
        h, w = plane.shape[0] // TILE * TILE, plane.shape[1] // TILE * TILE
        cut = plane[:h, :w].reshape(h // TILE, TILE, w // TILE, TILE)
        return np.asarray(cut.sum((1, 3)), dtype=np.float64).ravel()

    n = sums(keep.astype(np.float64))
    some = n > 0
    n = n[some]
    mean = [sums(np.where(keep, plane, 0.0))[some] / n for plane in (a, b)]
    return _Tiles(mean[0], mean[1], np.sqrt(sums(np.where(keep, variance, 0.0))[some]) / n)


def counted(values: Plane, errors: Plane, n: int) -> Noisy:
    """A picture of shares (ambient occlusion) of `n` rays a pixel.

    Its error is never below that of the share that the pixels around have, which a pixel alone cannot know when all of
    its rays say the same.
    """
    around = _blurred(values)
    share = np.clip((around * n + 1.0) / (n + 2.0), 0.0, 1.0)
    return Noisy(values, np.maximum(errors, np.sqrt(share * (1.0 - share) / n)))


def _blurred(values: Plane) -> Plane:
    """The mean over 5 × 5 pixels."""
    padded = np.pad(values, 2, mode="edge")
    windows: Any = np.lib.stride_tricks.sliding_window_view(padded, (5, 5))
    return np.asarray(windows.mean((2, 3)), dtype=np.float64)
