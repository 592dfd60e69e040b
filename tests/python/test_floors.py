"""Rooms of the package import only from floors below, and no module reaches itself again (docs/architecture.md)."""

from __future__ import annotations

import ast
from pathlib import Path

import antumbra

ROOT = Path(antumbra.__file__).parent
# From the lowest floor up; everything that lies in no folder is the API.
FLOORS = ("api", "checks", "study", "lecture", "cli")
# The same within the lecture, whose other modules are on no floor; what draws is above what measures.
INNER = {"scenes": 0, "measures": 0, "stages": 1, "fisheye": 1, "sketches": 2, "figures": 3, "page": 4}


def modules() -> dict[str, Path]:
    """Every module of the package by its name."""
    named = {}
    for path in ROOT.rglob("*.py"):
        parts = path.relative_to(ROOT.parent).with_suffix("").parts
        named[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return named


def imports(name: str, path: Path, known: dict[str, Path]) -> set[str]:
    """The modules of the package that a module names, wherever in it: also those that are only for types."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        assert not getattr(node, "level", 0), f"{name}: imports are written out, none is relative"
        if isinstance(node, ast.ImportFrom) and node.module:
            asked = [f"{node.module}.{alias.name}" for alias in node.names]
            found |= {each if each in known else node.module for each in asked}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return {each for each in found if each in known and each != name}


def room(name: str) -> str:
    parts = name.split(".")
    return parts[1] if len(parts) > 1 and parts[1] in FLOORS else "api"


def graph() -> dict[str, set[str]]:
    known = modules()
    # The front door names everything and is imported by everyone.
    return {
        name: imports(name, path, known) - {"antumbra"} for name, path in known.items() if name != "antumbra"
    }


def test_rooms_import_only_from_below():
    upward = [
        f"{name} imports {other}"
        for name, others in graph().items()
        for other in others
        if FLOORS.index(room(other)) > FLOORS.index(room(name)) and name != "antumbra.__main__"
    ]
    assert not upward, upward


def inner(name: str) -> int | None:
    """The floor of a room of the lecture."""
    parts = name.split(".")
    return INNER.get(parts[2]) if parts[1:2] == ["lecture"] and len(parts) > 2 else None


def test_rooms_of_the_lecture_import_only_from_below():
    floors = {name: floor for name in modules() if (floor := inner(name)) is not None}
    assert {floors[name] for name in floors} == set(INNER.values())
    upward = [
        f"{name} imports {other}"
        for name, others in graph().items()
        for other in others
        if name in floors and other in floors and floors[other] > floors[name]
    ]
    assert not upward, upward


def test_no_circles():
    edges = graph()

    def reached(start: str) -> set[str]:
        seen, todo = set(), list(edges[start])
        while todo:
            at = todo.pop()
            if at not in seen:
                seen.add(at)
                todo += edges[at]
        return seen

    circles = sorted(name for name in edges if name in reached(name))
    assert not circles, circles


def test_a_figure_knows_no_other_figure():
    figures = "antumbra.lecture.figures."
    tied = [
        (name, other)
        for name, others in graph().items()
        for other in others
        if name.startswith(figures) and other.startswith(figures)
    ]
    assert not tied, tied
