"""The one table of settings as Python sees it: keyword arguments to the words that people type."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping
from functools import cache
from typing import Any, NamedTuple

from antumbra import _core
from antumbra._values import shown
from antumbra.errors import OptionError


class Setting(NamedTuple):
    """One entry of the table: `render(name=…)` here, `--name` (words joined by a dash) on the command line."""

    name: str
    group: str
    metavar: str
    choices: list[str]
    default: str
    help: str
    repeats: bool

    @property
    def option(self) -> str:
        """Its name on the command line."""
        return "--" + self.name.replace("_", "-")


@cache
def table() -> dict[str, Setting]:
    """Every setting by name, in the order of the help."""
    return {row[0]: Setting(*row) for row in _core.settings()}


# Angles are in radians here; the table, made for people who type, has degrees.
_ANGLES = {"fov"}


def words(keywords: Mapping[str, Any]) -> dict[str, str]:
    """Keyword arguments as the words of the table; None leaves a setting at its default.

    Raises OptionError (a ValueError) with the nearest right name or value, TypeError for a kind of value that no
    setting takes.
    """
    written = {name: _word(name, value) for name, value in keywords.items() if value is not None}
    _core.check_settings(list(written.items()))
    return written


def _word(name: str, value: Any) -> str:
    if getattr(value, "ndim", None) == 0 and hasattr(value, "item"):
        value = value.item()
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if name in _ANGLES:
        return _degrees(name, value)
    if isinstance(value, int):
        return str(value)
    if _is_sequence(value):
        return ("\n" if table().get(name, _NONE).repeats else ",").join(_word(name, v) for v in value)
    try:
        return repr(float(value)) if not hasattr(value, "__index__") else str(value.__index__())
    except (TypeError, ValueError):
        wanted = _WANTED.get(name, "a number, a word or a sequence of them is needed")
        raise TypeError(f"{name} is {shown(value)}: {wanted}") from None


# What is wanted where it is not just a value.
_WANTED = {
    "environment": 'a path, "sky", "sky:elevation=30", or "none" is needed (add_light takes an Environment or a Sky)'
}


def _degrees(name: str, radians: Any) -> str:
    """An angle in the unit of the table, as the table's own limits have it (0 to 179.9°)."""
    try:
        degrees = math.degrees(float(radians))
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {shown(radians)}: an angle in radians is needed") from None
    if not 1e-9 <= degrees <= 179.9:
        raise OptionError(
            f"{name} = {radians}: an angle above 0 and below π is needed, in radians (math.radians(40))"
        )
    return repr(degrees)


_NONE = Setting("", "", "", [], "", "", False)


def _is_sequence(value: Any) -> bool:
    return hasattr(value, "__len__") and hasattr(value, "__getitem__") and not isinstance(value, Mapping)


def as_typed(text: str) -> str:
    """A sentence about settings as the command line spells them: shadows = off → --shadows off, `up` → --up."""

    def option(found: re.Match[str]) -> str:
        name = found["given"] or found["named"]
        return table()[name].option + (" " if found["given"] else "") if name in table() else found[0]

    word = "[a-z]+(?:_[a-z]+)*"
    return re.sub(rf"(?<![-\w])`?(?P<given>{word})`? = |`(?P<named>{word})`", option, text)
