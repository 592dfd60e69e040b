"""What people add to a scene, checked: one of our kinds, a transform, a lat-long picture."""

from __future__ import annotations

from types import UnionType
from typing import Any, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra._arrays import numbers
from antumbra._values import shown


def one_of(name: str, value: Any, kinds: UnionType) -> str:
    """The word for the kind of `value`, if it is one of `kinds`.

    Raises TypeError naming what was given and what is wanted.
    """
    known = get_args(kinds)
    if isinstance(value, known):
        return type(value).__name__
    home = known[0].__module__
    wanted = f"one of {home} is needed ({', '.join(kind.__name__ for kind in known)})"
    if isinstance(value, type) and issubclass(value, known):
        kind = f"{home}.{value.__name__}"
        raise TypeError(f"{name} is the class {kind}: one of its kind is needed, as {kind}(…)")
    raise TypeError(f"{name} is {shown(value)}: {wanted}")


def matrix(transform: ArrayLike) -> NDArray[np.float64]:
    """A (4, 4) matrix object → world."""
    found = np.ascontiguousarray(numbers("transform", transform), np.float64)
    if found.shape != (4, 4):
        raise ValueError(f"transform has shape {found.shape}: (4, 4) is needed")
    if not np.array_equal(found[3], [0, 0, 0, 1]):
        raise ValueError(f"transform has the last row {found[3]}: (0, 0, 0, 1) is needed")
    return found


def lat_long(picture: Any) -> NDArray[np.float32]:
    """An (H, W, 3) picture of radiance."""
    array = np.ascontiguousarray(numbers("radiance", picture), np.float32)
    if array.ndim != 3 or array.shape[2] != 3 or 0 in array.shape:
        raise ValueError(f"radiance has shape {array.shape}: (H, W, 3) is needed")
    return array
