"""Maps of numbers: means over neighbours."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def box_mean(values: ArrayLike, reach: int) -> NDArray[np.float64]:
    """Mean of each pixel of (H, W) and its neighbours up to `reach` away; the rim is repeated."""
    width = 2 * reach + 1
    wide = np.pad(np.asarray(values, np.float64), reach, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(wide, (width, width))
    found: NDArray[np.float64] = windows.mean((2, 3))
    return found
