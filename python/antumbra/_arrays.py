"""Arrays that people give: checked for shape and kind here, read by the core as they lie, whatever their stride."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from antumbra import _core
from antumbra.hit import Hit, Receivers

Array = NDArray[np.float32] | NDArray[np.float64]


def rows(name: str, value: Any, columns: int = 3) -> Array:
    """An (N, `columns`) array of float32 or float64, as it lies; whole numbers and lists become float64.

    Raises TypeError for what is no number, ValueError for another shape.
    """
    array = numbers(name, value)
    if array.ndim == 1 and array.size == 0:
        array = array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name} has shape {array.shape}: (N, {columns}) is needed")
    return array


def numbers(name: str, value: Any) -> Array:
    """An array of float32 or float64 of any shape."""
    array = np.asarray(value)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} has dtype {array.dtype}: float32 or float64 is needed")
    readable = array.dtype in (np.float32, np.float64) and array.dtype.isnative and array.flags.aligned
    return cast("Array", array if readable else array.astype(np.float64))


def finite(name: str, value: Any) -> NDArray[np.float64]:
    """(N, 3) float64, all finite."""
    array = rows(name, value).astype(np.float64, copy=False)
    # One sum instead of a look at each number; a sum may overflow without a number that is wrong.
    with np.errstate(over="ignore"):
        sound = np.isfinite(array.sum())
    if not sound and not np.isfinite(array).all():
        row = int(np.argmin(np.isfinite(array).all(axis=1)))
        raise ValueError(f"{name}[{row}] is {array[row].tolist()}: finite numbers are needed")
    return array


def matching(name: str, value: Any, other: str, count: int, columns: int = 3) -> Array:
    """Rows, one for each of the `count` rows of `other`; a single vector stands for all."""
    array = numbers(name, value)
    if array.shape == (columns,):
        return cast("Array", np.broadcast_to(array, (count, columns)))
    array = rows(name, array, columns)
    if len(array) != count:
        raise ValueError(
            f"{other} has shape ({count}, 3), {name} has shape {array.shape}: one {_singular(name)} per "
            f"{_singular(other)} is needed"
        )
    return array


def indices(name: str, value: Any, columns: int, below: int, of: str) -> NDArray[np.uint32]:
    """An (N, `columns`) array of whole numbers in [0, below)."""
    array = np.asarray(value)
    if array.size == 0:
        return np.zeros((0, columns), np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} has dtype {array.dtype}: whole numbers are needed")
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name} has shape {array.shape}: (N, {columns}) is needed")
    low, high = array.min(), array.max()
    if low < 0 or high >= below:
        raise ValueError(f"{name} asks for {of} {low if low < 0 else high}, but there are {below}")
    return np.ascontiguousarray(array, np.uint32)


def starts(origins: Any) -> tuple[Array | _core.Receivers, int]:
    """Where rays start, and how many: a hit, its receivers, or an (N, 3) array."""
    if isinstance(origins, (Hit, Receivers)):
        receivers = origins.receivers if isinstance(origins, Hit) else origins
        return receivers._core, len(receivers)
    array = rows("origins", origins)
    return array, len(array)


def places(points: Any, normals: Any) -> tuple[Array | _core.Receivers, Array | None, int]:
    """What a query starts from, and how many: a hit, its receivers, or points with one normal each."""
    if isinstance(points, (Hit, Receivers)):
        if normals is not None:
            raise ValueError("the receivers of a hit have their own normals: leave normals out")
        return starts(points)[0], None, len(points)
    if normals is None:
        raise ValueError("normals are missing: one per point is needed (or a hit, which has its own)")
    points = rows("points", points)
    return points, matching("normals", normals, "points", len(points)), len(points)


def per_row(name: str, value: Any, count: int) -> NDArray[np.float64]:
    """One number for each of `count` rows; a single one stands for all."""
    array = numbers(name, value).astype(np.float64, copy=False)
    if array.ndim == 0:
        return np.broadcast_to(array, count)
    if array.shape != (count,):
        raise ValueError(f"{name} has shape {array.shape}: one number, or ({count},) is needed")
    return array


def _singular(name: str) -> str:
    return {"vertices": "vertex"}.get(name, name.removesuffix("s"))
