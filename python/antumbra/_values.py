"""Numbers that people give to materials, shapes and lights, checked once: colours, vectors, lengths."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from os import PathLike, fspath
from typing import Any

Color = float | Sequence[float]
Vector = Sequence[float]
Fields = dict[str, list[float]]


class Described(ABC):
    """Something that is described by numbers with names; they are checked when it is made."""

    def __post_init__(self) -> None:
        """Raises ValueError or TypeError for a number that makes no sense."""
        self.fields()

    @abstractmethod
    def fields(self) -> Fields:
        """Its numbers by name."""


def color(name: str, value: Color) -> list[float]:
    """One number or three, finite and not negative, as three."""
    numbers = _numbers(name, value)
    if len(numbers) not in (1, 3):
        raise ValueError(f"{name} has {_how_many(numbers)}: one is needed, or three (red, green, blue)")
    if any(n < 0 for n in numbers):
        raise ValueError(f"{name} = {value}: light is not negative")
    return numbers * 3 if len(numbers) == 1 else numbers


def number(name: str, value: float) -> float:
    """One finite number."""
    return _one(name, value)


def text(name: str, value: str | PathLike[str]) -> str:
    """A word or a path."""
    if isinstance(value, (str, PathLike)):
        return fspath(value)
    raise TypeError(
        f"{name} is {shown(value)}: a {'path' if name in ('path', 'files_from') else 'word'} is needed"
    )


def vector(name: str, value: Vector) -> list[float]:
    """Three finite numbers."""
    numbers = _numbers(name, value)
    if len(numbers) != 3:
        raise ValueError(f"{name} has {_how_many(numbers)}: three are needed (x, y, z)")
    return numbers


def direction(name: str, value: Vector) -> list[float]:
    """Three finite numbers, not all zero; any length."""
    numbers = vector(name, value)
    if not any(numbers):
        raise ValueError(f"{name} = (0, 0, 0) points nowhere")
    return numbers


def length(name: str, value: float) -> float:
    """A finite number above 0."""
    number = _one(name, value)
    if number <= 0:
        raise ValueError(f"{name} = {value}: a length above 0 is needed")
    return number


def fraction(name: str, value: float) -> float:
    """A number from 0 to 1."""
    return within(name, value, 0.0, 1.0)


def within(name: str, value: float, low: float, high: float) -> float:
    """A number from `low` to `high`."""
    number = _one(name, value)
    if not low <= number <= high:
        raise ValueError(f"{name} = {value}: a number from {low:g} to {high:g} is needed")
    return number


def shown(value: Any) -> str:
    """What was given, for an error: short values as they are, else their type."""
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if isinstance(value, (str, int, float, bool)) or value is None:
        return repr(value)
    kind = type(value)
    return (
        f"of type {kind.__name__ if kind.__module__ == 'builtins' else f'{kind.__module__}.{kind.__name__}'}"
    )


def _one(name: str, value: float) -> float:
    numbers = _numbers(name, value)
    if len(numbers) != 1:
        raise ValueError(f"{name} has {_how_many(numbers)}: one is needed")
    return numbers[0]


def _how_many(numbers: list[float]) -> str:
    return "1 number" if len(numbers) == 1 else f"{len(numbers)} numbers"


def _numbers(name: str, value: Any) -> list[float]:
    flat = value.tolist() if hasattr(value, "tolist") else value
    try:
        numbers = [float(n) for n in flat] if isinstance(flat, (list, tuple)) else [float(flat)]
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {shown(value)}: a number or numbers are needed") from None
    if not all(math.isfinite(n) for n in numbers):
        raise ValueError(f"{name} = {value}: finite numbers are needed")
    return numbers
