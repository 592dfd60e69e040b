"""A measured number with its uncertainty, and how it is written."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from antumbra._words import minus, written


@dataclass(frozen=True)
class Quantity:
    """`value` ± `error` (95 %; 0: exact, infinite: not known).

    `unit` "%" writes per cent, "thousand" a thousand times the number.

    `low` and `high`: the ends of its interval where they are not equally far; `error` is then the larger distance.
    In the sentences of a figure `{name}` writes the error with two digits, `{name:1}` with one, `{name:v}` without it,
    `{name:r}` the ends of the interval in its place.

    >>> f"{Quantity(3.999, 0.014)} {Quantity(3.999, 0.014):1} {Quantity(0.5, unit='%'):v}"
    '3.999 ± 0.014 4.00 ± 0.01 50 %'
    """

    value: float
    error: float = 0.0
    unit: str = ""
    note: str = ""
    low: float | None = None
    high: float | None = None

    @property
    def interval(self) -> tuple[float, float]:
        """The ends of its 95 % interval."""
        low = self.value - self.error if self.low is None else self.low
        return low, self.value + self.error if self.high is None else self.high

    @property
    def _scale(self) -> float:
        return {"%": 100.0, "thousand": 1000.0}.get(self.unit, 1.0)

    @property
    def sign(self) -> str:
        """What stands behind the number."""
        return "" if self.unit == "thousand" else self.unit

    def number(self, digits: int = 2) -> tuple[str, str]:
        """The value and its error as text, the error in so many digits; "" for no error."""
        value, error = self._scale * self.value, self._scale * self.error
        if not math.isfinite(error):
            return written(value) if math.isfinite(value) else "?", "?"
        if not error > 0:
            return written(value), ""
        # A value far below its own error needs no more digits than the error has.
        places = digits - 1 - math.floor(math.log10(float(f"{error:.{digits - 1}e}")))
        shown, spread = (f"{round(x, places):,.{max(places, 0)}f}" for x in (value, error))
        return minus(shown), spread

    def __format__(self, spec: str) -> str:
        """`value ± error unit`; spec "1", "2": digits of the error, "v": the value alone, "r": with both ends."""
        if spec == "r":
            middle, low, high = (written(self._scale * x) for x in (self.value, *self.interval))
            return f"{middle} ({low} … {high})" + (f" {self.sign}" if self.sign else "")
        digits = int(spec) if spec.isdigit() else 2
        value, error = self.number(digits)
        if spec == "v":
            exact = not error.strip("?") and math.isfinite(self.value)
            value, error = written(self._scale * self.value) if exact else value, ""
        tail = f" {self.sign}" if self.sign else ""
        return f"{value} ± {error}{tail}" if error else f"{value}{tail}"

    def __str__(self) -> str:
        """The same with two digits of the error."""
        return format(self, "")

    def facts(self) -> dict[str, Any]:
        """For JSON: its fields and its text; numbers as they are written, 12.5 with the unit "%".

        >>> Quantity(0.125, 0.01, "%").facts()["value"]
        12.5
        """
        ends = zip(("value", "error", "low", "high"), (self.value, self.error, *self.interval), strict=True)
        known = {name: self._scale * end if math.isfinite(end) else None for name, end in ends}
        return {**asdict(self), **known, "unit": self.sign, "text": str(self)}
