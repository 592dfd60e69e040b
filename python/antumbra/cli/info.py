"""`antumbra info`: what is in a scene."""

from __future__ import annotations

import json as json_module
import re
import shutil
import textwrap
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
    reading: dict[str, Any],
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
    opened = _scene.open_scene(scene, definitions, reading)
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
        f"  -D {name + '=' + _typed(default):<18} {text} ({_say.exact(low)} to {_say.exact(high)})"
        for name, default, low, high, text in rows
    ]


def _typed(number: float) -> str:
    """As people type it: without commas."""
    return _say.exact(number).replace(",", "")


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
        ("", _bounds(found)),
        ("surfaces", _surfaces(found)),
        ("lights", _lights(found["lights"])),
        (
            "cameras",
            _listed([_camera(c) for c in found["cameras"]]) or "none (one is made that sees everything)",
        ),
        ("materials", _materials(found)),
        ("looks wrong", " · ".join(found["looks_wrong"])),
    ]
    lines = [line for name, text in rows if text for line in _wrapped(name, text)]
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


def _bounds(found: dict[str, Any]) -> str:
    if not found["bounds"]:
        return ""
    low, high = found["bounds"]
    # What rounding leaves of a zero is a zero.
    least = 1e-6 * max(top - bottom for bottom, top in zip(low, high, strict=True))

    def place(x: float) -> str:
        return _say.significant(x if abs(x) > least else 0)

    span = (
        f"{axis} {place(bottom)} to {place(top)}" for axis, bottom, top in zip("xyz", low, high, strict=True)
    )
    return "from " + ", ".join(span).replace("-", "−")


def _surfaces(found: dict[str, Any]) -> str:
    """How many meshes are closed; of the others, how many edges are open."""
    meshes = found["surfaces"]
    closed, open_ = meshes["closed_meshes"], meshes["open_meshes"]
    parts = [f"{closed:,} closed"] if closed else []
    if open_:
        parts.append(f"{open_:,} open ({_say.some(meshes['open_edges'], 'open edge')})")
    return " · ".join(parts)


def _lights(lights: list[dict[str, Any]]) -> str:
    """By kind, the strongest first, by the names that `--light` takes."""
    kinds: dict[str, list[dict[str, Any]]] = {}
    for light in lights:
        kinds.setdefault(light["kind"], []).append(light)
    return " · ".join(_kind(kind, some) for kind, some in kinds.items()) or "none: the picture is black"


def _kind(kind: str, lights: list[dict[str, Any]]) -> str:
    if kind == "environment":
        return f"environment {_listed([_sky(light) for light in lights])}"
    named: dict[str, list[float]] = {}
    for light in lights:
        named.setdefault(_quoted(light), []).append(light["power"])
    ordered = sorted(named.items(), key=lambda entry: -sum(entry[1]))
    listed = [f"{_times(name, len(each))} {_say.significant(sum(each))} W" for name, each in ordered]
    return f"{len(lights):,} {kind}: {_listed(listed)}"


def _sky(light: dict[str, Any]) -> str:
    size = "{} × {}, ".format(*light["size"]) if light["size"] else ""
    return f"{_quoted(light)} ({size}mean radiance {_say.significant(light['mean_radiance'])} W/m²sr)"


def _times(name: str, n: int) -> str:
    return name if n == 1 else f"{n:,} × {name}"


def _camera(camera: dict[str, Any]) -> str:
    if camera["vertical_fov"] is None:
        return f"{_quoted(camera)} (parallel)"
    lens = ""
    if camera["aperture"]:
        aperture, focus = _say.significant(camera["aperture"]), _say.significant(camera["focus"])
        lens = f", a lens of radius {aperture} in focus at {focus}"
    return (
        f"{_quoted(camera)} ({_say.significant(camera['vertical_fov'] * 57.29577951308232)}° vertical{lens})"
    )


def _quoted(named: dict[str, Any]) -> str:
    return f'"{named["name"]}"'


def _listed(parts: list[str], most: int = 6) -> str:
    more = [f"{len(parts) - most:,} more (--json has all)"] if len(parts) > most else []
    return ", ".join(parts[:most] + more)


def _wrapped(name: str, text: str) -> list[str]:
    width = min(max(shutil.get_terminal_size((100, 24)).columns, 60), 120)
    # A number stays on the line of its unit.
    joined = re.sub(r"(?<=[\d×]) (?=[A-Za-z×\d\"])", "\N{NO-BREAK SPACE}", text)
    lines = textwrap.wrap(
        joined,
        width,
        initial_indent=name.ljust(_COLUMN - 1) + " ",
        subsequent_indent=" " * _COLUMN,
        break_on_hyphens=False,
    )
    return [line.replace("\N{NO-BREAK SPACE}", " ") for line in lines]


def _materials(found: dict[str, Any]) -> str:
    masks = f" ({found['masked_materials']:,} with alpha masks)" if found["masked_materials"] else ""
    textures = found["textures"]
    decoded = (
        f" · {_say.some(textures, 'texture')}, {_say.size(found['texture_bytes'])} decoded, "
        + "the largest {} × {}".format(*found["largest_texture"])
        if textures
        else ""
    )
    most_first = sorted(found["material_kinds"].items(), key=lambda kind: (-kind[1], kind[0]))
    kinds = ", ".join(f"{n:,} {word}" for word, n in most_first)
    return f"{kinds or 'none'}{masks}{decoded}"


def _as_json(found: Any) -> str:
    return json_module.dumps(found, indent=1, ensure_ascii=False)
