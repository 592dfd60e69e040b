"""SCENE on the command line: a file, or the name of a built-in scene, with `-D` and what a file is read with."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from antumbra import _core
from antumbra.cli import _say
from antumbra.cli._command import Option
from antumbra.errors import SceneError


def options() -> list[Option]:
    """What every verb that opens a scene takes."""
    return [
        Option("-D", "definitions", group="Files", metavar="NAME=VALUE", multiple=True,
               help="a parameter of a built-in scene or an XML file (may be repeated)"),
        Option("--up-axis", group="Files", metavar="NAME", reading=True,
               help="the axis that points up in the file: y, z (default: what the format says)"),
        Option("--files-from", group="Files", metavar="DIR", reading=True,
               help="the folder that the scene's own paths may reach (default: its own folder)"),
        Option("--variant", group="Files", metavar="NAME", reading=True,
               help="the variant of materials of a glTF file (default: the file's first look)"),
        Option("--at-time", group="Files", metavar="SECONDS", type=float, reading=True,
               help="the time that the animations of a glTF file stand at (default: at rest)"),
        Option("--animation", group="Files", metavar="NAME", reading=True,
               help="the animation of a glTF file that plays (default: all that can play together)"),
        Option("--max-memory", group="Files", metavar="SIZE", reading=True,
               help="a scene that would take more memory is refused early: 500M, 4G (default: none is)"),
    ]  # fmt: skip


def open_scene(
    scene: str, definitions: tuple[str, ...], reading: Mapping[str, Any], *, keep: bool = False
) -> _core.Scene:
    """Reads or builds it; `reading`: keywords of `load`; `keep`: with what it is made of."""
    given = [definition(text) for text in definitions]
    if is_file(scene, reading):
        if given and Path(scene).suffix.lower() != ".xml":
            raise click.UsageError(f"-D {definitions[0]}: {scene} has no parameters")
        try:
            return _core.Scene.load(scene, parameters=given, keep=keep, **reading)
        except SceneError as problem:
            if scene in (name for name, _, _ in _core.builtins()):
                here = f'What lies here under this name hides the built-in scene "{scene}": go to another folder.'
                problem.hint = f"{problem.hint}\n{here}".strip()
            raise
    known = [name for name, _, _ in _core.builtins()]
    if scene not in known:
        hint = _say.did_you_mean(scene, known)
        raise click.UsageError(f'there is no scene "{scene}"{hint} ({", ".join(known)}; a file has a dot)')
    return _core.Scene.builtin(scene, [(name, number(name, text)) for name, text in given], keep=keep)


def is_file(scene: str, reading: Mapping[str, Any]) -> bool:
    """A path that exists wins; a name with a dot or a slash is always a file. Refuses options of files for names."""
    if Path(scene).exists() or "." in scene or "/" in scene:
        return True
    for name in reading:
        raise click.UsageError(f'--{name.replace("_", "-")} is for files: "{scene}" is a built-in scene')
    return False


def tell(scene: _core.Scene, quiet: bool) -> None:
    """Its notes and warnings, on standard error."""
    if not quiet:
        _say.messages(file_of(scene), scene.messages())


def file_of(scene: _core.Scene) -> str:
    """The file that messages speak of; nothing for a built-in scene."""
    return scene.name if "." in scene.name else ""


def stem(scene: str) -> str:
    """NAME of SCENE, for files that are called after it."""
    return Path(scene).stem if "." in scene or "/" in scene else scene


def definition(text: str) -> tuple[str, str]:
    """NAME and VALUE of a `-D NAME=VALUE`."""
    name, equals, value = text.partition("=")
    if not equals or not name:
        raise click.UsageError(f"-D {text}: a name and its value are needed, as -D light-size=0.5")
    return name, value


def number(name: str, text: str) -> float:
    """The VALUE of a `-D` as a number."""
    try:
        return float(text)
    except ValueError:
        raise click.UsageError(f"-D {name}={text}: a number is needed") from None
