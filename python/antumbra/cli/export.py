"""`antumbra export`: a scene for other programs."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import click

from antumbra import _core
from antumbra.cli import _say, _scene
from antumbra.cli._command import Verb, output_option

ORDER = 7


def run(
    scene: str,
    output: str | None,
    definitions: tuple[str, ...],
    reading: dict[str, Any],
    quiet: bool,
    verbose: bool,
) -> int:
    """Write SCENE for other programs: glTF 2.0 or Mitsuba 3."""
    path = Path(output or f"{_scene.stem(scene)}.glb")
    _check(path, scene)
    began = time.perf_counter()
    opened = _scene.open_scene(scene, definitions, reading, keep=True)
    _scene.tell(opened, quiet)
    files, said = opened.export(str(path))
    if not quiet:
        _say.messages(_scene.file_of(opened), said)
    print(_ending(files, time.perf_counter() - began))
    return 0


VERB = Verb(
    "export",
    run,
    arguments=[("SCENE", True)],
    examples=[
        ("antumbra export pillars", "pillars.glb, glTF 2.0"),
        ("antumbra export room.pbrt -o room.xml", "Mitsuba 3, its meshes in room-files/"),
        ("antumbra export hall -D boxes=100 -o hall.gltf", ""),
    ],
    options=[
        output_option("FILE", "the scene, .glb, .gltf or .xml [NAME.glb]"),
        *_scene.options(),
    ],
)


def _check(path: Path, scene: str) -> None:
    """Says at once what would go wrong at the end."""
    if path.exists() and Path(scene).exists() and path.samefile(scene):
        raise click.UsageError(f"{path} is the scene itself: -o names another file. Nothing was written.")
    try:
        _core.check_scene_path(str(path))
    except OSError as problem:
        raise click.UsageError(f"{problem}. Nothing was written.") from problem


def _ending(files: list[tuple[str, int]], seconds: float) -> str:
    (path, bytes_), *beside = files
    parts = [_say.seconds(seconds), _say.size(bytes_)]
    if beside:
        folders = sorted({str(Path(name).parent) for name, _ in beside})
        inside = str(Path(path).parent)
        where = "beside it" if folders == [inside] else f"in {', '.join(f for f in folders if f != inside)}"
        parts.append(
            f"{_say.some(len(beside), 'file')} {where}, {_say.size(sum(size for _, size in beside))}"
        )
    return f"{path}   {' · '.join(parts)}"
