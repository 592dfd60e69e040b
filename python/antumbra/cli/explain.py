"""`antumbra explain`: one pixel taken apart."""

from __future__ import annotations

import json as json_module
from typing import Any

import click

from antumbra import effects
from antumbra.cli import _say, _scene
from antumbra.cli._command import GROUPS, Option, Verb

ORDER = 4


def run(
    scene: str,
    pixel: str,
    json: bool,
    definitions: tuple[str, ...],
    reading: dict[str, Any],
    settings: dict[str, str],
    quiet: bool,
    verbose: bool,
) -> int:
    """Take one pixel apart: its receivers, every ray to a light with every factor, and their sum."""
    from antumbra.scene import Scene

    opened = _scene.open_scene(scene, definitions, reading)
    found = Scene._of(opened).explain(_pixel(pixel), **{"estimator": "area", **settings})
    if json:
        print(json_module.dumps(found.as_dict(), indent=1, ensure_ascii=False))
        return 0
    _scene.tell(opened, quiet)
    if not quiet:
        _say.messages("", [("note", "", text) for text in effects.idle({"estimator": "area", **settings})])
        _say.messages("", found.messages)
    print(found)
    return 0


VERB = Verb(
    "explain",
    run,
    arguments=[("SCENE", True)],
    groups=GROUPS,
    own_words={"estimator": ("area", "hemisphere", "mis")},
    examples=[
        ("antumbra explain pillars --pixel 358,391 --viewing-rays 1 --shadow-rays 9", ""),
        ("antumbra explain corner --pixel 200,300 --estimator hemisphere", "by directions"),
        ("antumbra explain room.glb --pixel 10,20 --light Lamp --json", ""),
    ],
    options=[
        Option("--pixel", group="Camera", metavar="X,Y", required=True,
               help="column and row of the pixel, from 0, from the upper left"),
        *_scene.options(),
        Option("--json", is_flag=True, group="Run", help="the same for programs"),
    ],
)  # fmt: skip


def _pixel(text: str) -> tuple[int, int]:
    parts = text.split(",")
    if len(parts) != 2 or not all(part.strip().isdecimal() for part in parts):
        raise click.UsageError(f"--pixel {text}: column and row are needed, as 320,240")
    return int(parts[0]), int(parts[1])
