"""What rays met: `Hit`, and `Receivers`, the points of a hit as every query takes them."""

from __future__ import annotations

from functools import cached_property
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from antumbra import _core

MISS = 0xFFFF_FFFF


class Receivers:
    """Points on surfaces, with what a safe start of a segment needs to know: goes into queries instead of points.

    `positions` (N, 3) float64; `normals` (N, 3) float64, on the side that was looked at; both NaN where the ray
    missed: such receivers get no light, see nothing as blocked and have an openness of 1.
    Index them like an array: `hit.receivers[hit.t < 10]`.
    """

    def __init__(self, core: _core.Receivers) -> None:
        """Wraps what the core returned."""
        self._core = core

    @property
    def positions(self) -> NDArray[np.float64]:
        """(N, 3) float64."""
        return self._core.positions()

    @property
    def normals(self) -> NDArray[np.float64]:
        """(N, 3) float64, unit length."""
        return self._core.normals()

    def __len__(self) -> int:
        """How many there are."""
        return len(self._core)

    def __getitem__(self, key: Any) -> Receivers:
        """Some of them, by a mask, a slice or indices."""
        return Receivers(self._core.take(np.atleast_1d(np.arange(len(self))[key]).astype(np.uint64)))

    def __reduce__(self) -> NoReturn:
        """Receivers belong to their scene, which does not pickle."""
        raise TypeError("receivers do not pickle: they belong to their scene. Keep .positions and .normals")

    def __repr__(self) -> str:
        """How many there are."""
        return f"<Receivers ({len(self):,})>"


class Hit:
    """The closest hit of each of N rays.

    `t` (N,) float64: the ray parameter, inf for a miss; `primitive` (N,) uint32 within its mesh and `mesh` (N,)
    uint32, the number of the object in the scene, both 2³²−1 for a miss; `uv` (N, 2) float32: barycentric weights of
    the second and third corner; `position` (N, 3) float64 and geometric `normal` (N, 3) float64 on the ray's side,
    NaN for a miss; `receivers`: the same points for further queries.

    A hit goes into every query instead of points. It pickles, but its receivers stay with the scene.
    """

    def __init__(self, core: _core.Hits) -> None:
        """Wraps what the core returned."""
        self.t, self.primitive, self.mesh, self.uv = core.t(), core.primitive(), core.mesh(), core.uv()
        self._receivers: Receivers | None = Receivers(core.receivers())

    @property
    def receivers(self) -> Receivers:
        """The points that were hit, with a safe start for further segments."""
        if self._receivers is None:
            raise ValueError(
                "this hit was pickled, and its receivers stayed with the scene: ask closest_hit again, or give "
                ".position and .normal"
            )
        return self._receivers

    @cached_property
    def position(self) -> NDArray[np.float64]:
        """Where it was hit, (N, 3) float64."""
        return self.receivers.positions

    @cached_property
    def normal(self) -> NDArray[np.float64]:
        """Geometric unit normal on the ray's side, (N, 3) float64."""
        return self.receivers.normals

    @cached_property
    def shading_normal(self) -> NDArray[np.float64]:
        """The unit normal n of cos θ = n · ω, (N, 3) float64: interpolated and bent as the material says."""
        return self.receivers._core.shading_normals()

    @cached_property
    def wo(self) -> NDArray[np.float64]:
        """ω_o: unit vectors back along the rays, (N, 3) float64."""
        return self.receivers._core.toward_viewer()

    def __getstate__(self) -> dict[str, Any]:
        """The arrays."""
        names = ("t", "primitive", "mesh", "uv", "position", "normal", "shading_normal", "wo")
        return {name: getattr(self, name) for name in names} | {"_receivers": None}

    def __len__(self) -> int:
        """Number of rays."""
        return len(self.t)

    def __repr__(self) -> str:
        """How many rays, how many of them hit."""
        return f"<Hit ({len(self):,}): {int(np.isfinite(self.t).sum()):,} hit>"
