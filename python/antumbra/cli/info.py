"""`antumbra info`: what is in a scene."""

from __future__ import annotations

import json as json_module
import time
from pathlib import Path
from typing import Any

import click

from antumbra import _core
from antumbra.cli import _say, _scene
from antumbra.cli._command import Option, Verb
from antumbra.messages import Message

ORDER = 2
_COLUMN = 25


def run(
    scene: str | None,
    json: bool,
    list: bool,
    definitions: tuple[str, ...],
    up_axis: str | None,
    files_from: str | None,
    quiet: bool,
    verbose: bool,
) -> int:
    """Say what is in SCENE: counts, bounds, lights, cameras, memory, and what looks wrong."""
    if list:
        print(_as_json(_builtins()) if json else _list())
        return 0
    if scene is None:
        raise click.UsageError("SCENE is missing (or --list, for the built-in scenes)")
    began = time.perf_counter()
    opened = _scene.open_scene(scene, definitions, up_axis, files_from)
    found = _facts(opened, scene, time.perf_counter() - began)
    if json:
        print(_as_json(found))
    else:
        _scene.tell(opened, quiet)
        print(_text(found))
    return 0


VERB = Verb(
    "info",
    run,
    arguments=[("SCENE", False)],
    examples=[
        ("antumbra info room.glb", "a file"),
        ("antumbra info pillars", "a built-in scene, with its parameters"),
        ("antumbra info --list", "all built-in scenes"),
    ],
    options=[
        *_scene.options(),
        Option("--json", is_flag=True, group="Run", help="the same for programs: stable keys, SI units"),
        Option("--list", is_flag=True, group="Run", help="the built-in scenes with their parameters"),
    ],
)


def _builtins() -> list[dict[str, Any]]:
    keys = ("name", "default", "low", "high", "help")
    return [
        {
            "name": name,
            "shows": shows,
            "parameters": [dict(zip(keys, row, strict=True)) for row in parameters],
        }
        for name, shows, parameters in _core.builtins()
    ]


def _list() -> str:
    lines: list[str] = []
    for name, shows, parameters in _core.builtins():
        lines += [f"{name:<22}{shows}", *_parameters(parameters)]
    return "\n".join(lines)


def _parameters(rows: list[tuple[str, float, float, float, str]]) -> list[str]:
    return [
        f"  -D {f'{name}={default:g}':<18} {text} ({low:g} to {high:g})"
        for name, default, low, high, text in rows
    ]


def _facts(scene: _core.Scene, named: str, seconds: float) -> dict[str, Any]:
    path = Path(named)
    known = {name: parameters for name, _, parameters in _core.builtins()}
    return {
        "name": scene.name,
        "bytes": path.stat().st_size if path.is_file() else None,
        "seconds": seconds,
        **scene.info(),
        "parameters": [list(row) for row in known.get(scene.name, [])] if not path.is_file() else [],
        "messages": [Message(*said)._asdict() for said in scene.messages()],
    }


def _text(found: dict[str, Any]) -> str:
    size = f", {_say.size(found['bytes'])}" if found["bytes"] is not None else ""
    rows = [
        (found["name"], f"{found['source']}{size}"),
        ("geometry", _geometry(found)),
        ("lights", _lights(found["lights"])),
        (
            "cameras",
            ", ".join(_camera(c) for c in found["cameras"]) or "none (one is made that sees everything)",
        ),
        ("materials", _materials(found)),
        ("looks wrong", " · ".join(found["looks_wrong"])),
    ]
    lines = [f"{name:<{_COLUMN}}{text}" for name, text in rows if text]
    return "\n".join(lines + _parameters([tuple(row) for row in found["parameters"]]))


def _geometry(found: dict[str, Any]) -> str:
    parts = [f"{_say.some(found['triangles'], 'triangle')} in {_say.some(found['meshes'], 'mesh', 'meshes')}"]
    if found["shapes"]:
        parts[0] += f", {_say.some(found['shapes'], 'shape')}"
    if found["instances"]:
        parts[0] += f", {_say.some(found['instances'], 'instance')}"
    if found["bounds"]:
        low, high = found["bounds"]
        extent = " × ".join(_say.significant(top - bottom, 2) for bottom, top in zip(low, high, strict=True))
        parts.append(f"{extent} units")
    parts.append(f"tree {_say.size(found['tree_bytes'])}, {_say.seconds(found['seconds'])} to load and build")
    return " · ".join(parts)


def _lights(lights: list[dict[str, Any]]) -> str:
    kinds: dict[str, list[float]] = {}
    for light in lights:
        if light["kind"] != "environment":
            kinds.setdefault(light["kind"], []).append(light["power"])
    listed = [f"{len(powers):,} {kind} ({_powers(powers)} W)" for kind, powers in kinds.items()]
    listed += [f"environment {light['name']}".strip() for light in lights if light["kind"] == "environment"]
    return ", ".join(listed) or "none: the picture is black"


def _powers(powers: list[float]) -> str:
    most = [_say.significant(p) for p in sorted(powers, reverse=True)[:3]]
    return ", ".join(most) + (", …" if len(powers) > 3 else "")


def _camera(camera: dict[str, Any]) -> str:
    name = camera["name"] or "unnamed"
    if camera["vertical_fov"] is None:
        return f"{name} (parallel)"
    return f"{name} ({_say.significant(camera['vertical_fov'] * 57.29577951308232)}° vertical)"


def _materials(found: dict[str, Any]) -> str:
    masks = f" ({found['masked_materials']:,} with alpha masks)" if found["masked_materials"] else ""
    textures = found["textures"]
    decoded = (
        f" · {_say.some(textures, 'texture')}, {_say.size(found['texture_bytes'])} decoded"
        if textures
        else ""
    )
    return f"{found['materials']:,}{masks}{decoded}"


def _as_json(found: Any) -> str:
    return json_module.dumps(found, indent=1, ensure_ascii=False)
