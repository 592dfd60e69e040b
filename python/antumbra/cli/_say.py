"""What a person reads in the terminal: errors, warnings and notes."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterable

from antumbra._words import count as count
from antumbra._words import did_you_mean as did_you_mean
from antumbra._words import exact as exact
from antumbra._words import seconds as seconds
from antumbra._words import significant as significant
from antumbra._words import size as size
from antumbra._words import some as some
from antumbra.settings import as_typed

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
    for (level, text), n in counts.items():
        place = first[level, text]
        more = f" (and {n - 1:,} more like it)" if n > 1 else ""
        _line(level, ": ".join(part for part in (file, place, as_typed(text)) if part) + more)
