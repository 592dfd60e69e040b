"""Which figures there are: every file of `figures/`."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from antumbra._words import did_you_mean
from antumbra.errors import OptionError
from antumbra.lecture.figure import Figure

# The folder of the whole package.
ROOT = Path(__file__).parents[1]
# Of it, what no figure's numbers depend on: the command line, the page, and the other figures.
_APART = ("cli/", "lecture/page/", "lecture/figures/")


def names() -> list[str]:
    """Names of all figures as people type them, without importing any."""
    from antumbra.lecture import figures

    return sorted(module.name.replace("_", "-") for module in pkgutil.iter_modules(figures.__path__))


def figure(name: str) -> Figure:
    """One figure, imported from its file."""
    module = importlib.import_module(f"antumbra.lecture.figures.{name.replace('-', '_')}")
    found: Figure = module.FIGURE
    return found


@cache
def ordered() -> dict[str, Figure]:
    """All figures by name, in the order of their numbers."""
    found = {name: figure(name) for name in names()}
    return dict(sorted(found.items(), key=lambda item: item[1].number))


def chosen(asked: Sequence[str]) -> dict[str, Figure]:
    """The figures of these names, or all without names.

    Raises OptionError with the nearest right name.
    """
    known = names()
    for name in asked:
        if name not in known:
            hint = did_you_mean(name, known)
            raise OptionError(f'there is no figure "{name}"{hint} ({", ".join(ordered())})')
    return {name: each for name, each in ordered().items() if not asked or name in asked}


def sources(name: str) -> list[Path]:
    """The files that decide what a figure finds: its own, and all of the package but command line, page and figures."""
    shared = [path for path in ROOT.rglob("*.py") if not path.relative_to(ROOT).as_posix().startswith(_APART)]
    own = ROOT / "lecture/figures" / f"{name.replace('-', '_')}.py"
    return [*sorted(shared), *([own] if own.is_file() else [])]
