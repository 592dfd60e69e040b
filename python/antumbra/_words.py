"""Words for people: numbers, counts, durations, sizes, powers of ten; and the nearest right word for a wrong one."""

from __future__ import annotations

import math
from collections.abc import Sequence

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def count(n: float) -> str:
    """A count in three significant digits: 98, 1,234, 9.4 M, 4.53 G."""
    for limit, unit in ((1e9, " G"), (1e6, " M")):
        if n >= limit:
            return significant(n / limit) + unit
    return f"{round(n):,}"


def significant(x: float, digits: int = 3) -> str:
    """A number in so many significant digits, without an exponent between 10⁻⁴ and 10⁶: 0.8, 4.53, 12.4, 1,230."""
    if x == 0 or x != x or abs(x) == float("inf"):
        return "0" if x == 0 else str(x)
    if not 1e-4 <= abs(x) < 1e6:
        return f"{x:.{digits - 1}e}"
    rounded = float(f"{x:.{digits - 1}e}")
    decimals = (
        max(0, digits - len(str(int(abs(rounded)))))
        if abs(rounded) >= 1
        else _small_decimals(rounded, digits)
    )
    text = f"{rounded:,.{decimals}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def exact(x: float) -> str:
    """A number with all its digits, as people write it: 1,000,000, 0.00465, 12.5."""
    text = f"{x:,.12f}".rstrip("0").rstrip(".") if abs(x) >= 1e-6 or x == 0 else f"{x:g}"
    return text if abs(x) < 1e15 else f"{x:g}"


def _small_decimals(x: float, digits: int) -> int:
    return int(f"{x:e}".split("e")[1]) * -1 + digits - 1


def seconds(t: float) -> str:
    """A duration: 0.12 s, 2.1 s, 1 min 05 s."""
    if t >= 60:
        return f"{int(t // 60)} min {int(t % 60):02d} s"
    return f"{significant(t, 2)} s"


def size(n: float) -> str:
    """Bytes: 812 kB, 12.4 MB."""
    for limit, unit in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if n >= limit:
            return f"{significant(n / limit)} {unit}"
    return f"{round(n)} bytes"


def some(n: int, one: str, many: str = "") -> str:
    """`1 triangle`, `98 triangles`."""
    return f"{n:,} {one if n == 1 else many or one + 's'}"


def minus(text: str) -> str:
    """The same number with a minus sign in place of a hyphen; −0 is 0."""
    if text.startswith("-") and not text.strip("-0.,"):
        text = text[1:]
    return text.replace("-", "−")


def power_of_ten(power: int) -> str:
    """`10⁻⁷`."""
    return "10" + raised(power)


def raised(power: int) -> str:
    """`⁻⁷`."""
    return str(power).translate(_RAISED)


def written(x: float, digits: int = 3) -> str:
    """A number in so many significant digits, all of those before the point: 0.041, 4, 12.5, 1,234, 3.2 × 10⁻⁶."""
    if x == 0 or not math.isfinite(x):
        return "0" if x == 0 else minus(str(x))
    if not 1e-4 <= abs(x) < 1e6:
        mantissa, power = f"{x:.{digits - 1}e}".split("e")
        return f"{minus(mantissa)} × {power_of_ten(int(power))}"
    places = max(0, digits - 1 - math.floor(math.log10(abs(float(f"{x:.{digits - 1}e}")))))
    text = f"{x:,.{places}f}"
    return minus(text.rstrip("0").rstrip(".") if "." in text else text)


def did_you_mean(text: str, known: Sequence[str], form: str = '"{}"') -> str:
    """`; did you mean "area"?`, or nothing."""
    from antumbra import _core

    near = _core.nearest(text, list(known))
    return f"; did you mean {form.format(near)}?" if near else ""
