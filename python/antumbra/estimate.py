"""An estimated quantity that knows its own error: `Estimate`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import NDArray

from antumbra._words import seconds, significant


class Estimate(NDArrayOperatorsMixin):
    """Values with their standard error. Acts as the array of its values; arithmetic gives plain arrays.

    `values`: float array; `standard_error`: the same shape and unit; `quantity`: what it is, in words; `rays` per
    receiver; `seconds` that it took.

    The standard error is the scatter of R independent replicates of the whole estimate, √(Σ(m_r − m)² / (R(R − 1))):
    R = 4 below 256 rays, 16 from there (fewer rays than 4: as many as rays). An interval is value ± t · standard error
    with Student's t of R − 1 degrees of freedom: for 95 %, t = 3.18 with R = 4 and 2.13 with R = 16. It is NaN where
    R < 2: with one ray, or a fixed grid (`sampler="regular"` without `rotate=True`). Where few rays all agree by
    chance (a penumbra, a small light) it is too small: ask for 256 or more.

    >>> import numpy as np, antumbra as am
    >>> scene = am.builtin("corner")
    >>> point, up = np.array([[0.5, 0.0, 0.5]]), np.array([[0.0, 1.0, 0.0]])
    >>> openness = scene.ambient_occlusion(point, up, rays=64)
    >>> bool(abs(openness[0] - np.mean(openness)) == 0)
    True
    """

    def __init__(
        self,
        values: NDArray[Any],
        standard_error: NDArray[Any],
        quantity: str = "",
        rays: int = 0,
        seconds: float = 0.0,
    ) -> None:
        """Joins values and standard errors of the same shape."""
        if values.shape != standard_error.shape:
            raise ValueError(
                f"values have shape {values.shape}, their standard errors {standard_error.shape}: the same is needed"
            )
        self.values, self.standard_error = values, standard_error
        self.quantity, self.rays, self.seconds = quantity, rays, seconds

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the values."""
        return self.values.shape

    @property
    def dtype(self) -> np.dtype[Any]:
        """Kind of number of the values."""
        return self.values.dtype

    @property
    def ndim(self) -> int:
        """Number of axes."""
        return self.values.ndim

    @property
    def size(self) -> int:
        """Number of values."""
        return self.values.size

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """The values, for NumPy."""
        return np.array(self.values, dtype=dtype, copy=copy)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        """Every ufunc works on the values and gives plain arrays."""
        plain = [x.values if isinstance(x, Estimate) else x for x in inputs]
        if any(isinstance(x, Estimate) for x in options.get("out", ())):
            return NotImplemented
        return getattr(ufunc, method)(*plain, **options)

    def __getattr__(self, name: str) -> Any:
        """Everything else an array has (`mean()`, `reshape()`, …), of the values."""
        if name.startswith("__") or name == "values":
            raise AttributeError(name)
        return getattr(self.values, name)

    def __getitem__(self, key: Any) -> Any:
        """Some of the values."""
        return self.values[key]

    def __len__(self) -> int:
        """Length of the first axis."""
        return len(self.values)

    def __iter__(self) -> Any:
        """Over the first axis."""
        return iter(self.values)

    def __float__(self) -> float:
        """The value, if there is one alone."""
        return float(self.values)

    def __repr__(self) -> str:
        """What it is, how large, how sure, how long it took."""
        facts = [f"mean {significant(self.values.mean())}" if self.size else "empty"]
        worst = np.max(self.standard_error, initial=0.0)
        if self.size:
            known = f"≤ {significant(worst, 2)}" if np.isfinite(worst) else "not known"
            facts.append(f"standard error {known}")
        if self.rays:
            facts.append(f"{self.rays:,} rays each")
        if self.seconds:
            facts.append(seconds(self.seconds))
        of = f" of {self.quantity}" if self.quantity else ""
        return f"<Estimate {self.shape}{of}: {', '.join(facts)}>"

    def _repr_html_(self) -> str:
        """The same for a notebook."""
        from antumbra.notebook import estimate_html

        return estimate_html(repr(self).strip("<>"), self.values)
