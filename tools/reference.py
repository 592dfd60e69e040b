"""Writes docs/reference/: the pages that are made from the source, so that they cannot be out of date.

`--check` writes nothing and fails if a page is out of date.
"""

from __future__ import annotations

import dataclasses
import inspect
import sys
from pathlib import Path
from types import ModuleType

from antumbra import _core, lights, materials, shapes
from antumbra._words import exact
from antumbra.cli._run import _in_order, _overview

FOLDER = Path(__file__).resolve().parent.parent / "docs" / "reference"
MADE = "<!-- Made by `make docs` from the source; changes go there. -->\n\n"


def command_line() -> str:
    """The help of the command and of every verb."""
    parts = ["# The command line\n\n", MADE, f"```text\n{_overview()}\n```\n"]
    for verb in _in_order():
        parts.append(f"\n## antumbra {verb.name}\n\n```text\n{verb.page(100)}\n```\n")
    return "".join(parts)


def scenes() -> str:
    """The built-in scenes with their parameters."""
    parts = [
        "# Built-in scenes\n\n",
        MADE,
        '`antumbra render NAME`, or `antumbra.builtin("NAME")` in Python.\n',
    ]
    for name, shows, parameters in _core.builtins():
        parts.append(f"\n## {name}\n\n{shows}.\n")
        if parameters:
            parts.append("\n| parameter | default | from | to | |\n|---|---|---|---|---|\n")
            parts += [
                f"| `{n}` | {exact(d)} | {exact(low)} | {exact(high)} | {text} |\n"
                for n, d, low, high, text in parameters
            ]
    return "".join(parts)


def kinds() -> str:
    """Lights, materials and shapes as Python makes them."""
    parts = ["# Lights, materials and shapes\n\n", MADE]
    for module in (lights, materials, shapes):
        parts.append(f"## antumbra.{module.__name__.rsplit('.', 1)[1]}\n\n{inspect.getdoc(module)}\n")
        parts += [_kind(kind) for kind in _kinds(module)]
        parts.append("\n")
    return "".join(parts).rstrip() + "\n"


def _kinds(module: ModuleType) -> list[type]:
    found = [x for x in vars(module).values() if dataclasses.is_dataclass(x) and isinstance(x, type)]
    return [x for x in found if x.__module__ == module.__name__]


def _kind(kind: type) -> str:
    fields = [
        f.name if f.default is dataclasses.MISSING else f"{f.name}={f.default}"
        for f in dataclasses.fields(kind)
    ]
    return f"\n### {kind.__name__}({', '.join(fields)})\n\n{inspect.getdoc(kind)}\n"


PAGES = {"command-line.md": command_line, "scenes.md": scenes, "kinds.md": kinds}


def main() -> int:
    """Writes or checks the pages."""
    old = []
    for name, page in PAGES.items():
        file, text = FOLDER / name, page()
        if "--check" not in sys.argv[1:]:
            FOLDER.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        elif not file.is_file() or file.read_text(encoding="utf-8") != text:
            old.append(name)
    for name in old:
        print(f"error: docs/reference/{name} is out of date: run `make docs`", file=sys.stderr)
    return 1 if old else 0


if __name__ == "__main__":
    sys.exit(main())
