"""What a person reads in the terminal: errors, warnings, notes, and numbers as people write them."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterable, Sequence

INDENT = "       "


def error(what: str, hint: str = "") -> None:
    """`error: what`, the hint indented under it."""
    _line("error", what, hint)


def _line(level: str, what: str, hint: str = "") -> None:
    lines = [f"{level}: {what}", *(INDENT + line for line in hint.splitlines())]
    print("\n".join(lines), file=sys.stderr, flush=True)


def messages(file: str, said: Iterable[tuple[str, str, str]]) -> None:
    """Notes and warnings (level, place, text) of a scene: each once, with how many more there are like it."""
    counts: Counter[tuple[str, str]] = Counter()
    first: dict[tuple[str, str], str] = {}
    for level, place, text in said:
        counts[level, text] += 1
        first.setdefault((level, text), place)
    for (level, text), count in counts.items():
        place = first[level, text]
        more = f" (and {count - 1:,} more like it)" if count > 1 else ""
        _line(level, ": ".join(part for part in (file, place, text) if part) + more)


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


def nearest_hint(text: str, known: Sequence[str], form: str = '"{}"') -> str:
    """`; did you mean "area"?`, or nothing."""
    from antumbra import _core

    near = _core.nearest(text, list(known))
    return f"; did you mean {form.format(near)}?" if near else ""
