"""`antumbra render`: a picture of a scene."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from antumbra import _core, effects, settings
from antumbra.cli import _frames, _say, _scene
from antumbra.cli._command import GROUPS, Verb, output_option
from antumbra.cli._progress import Bar
from antumbra.errors import RenderStopped

if TYPE_CHECKING:
    from antumbra.image import Image

ORDER = 1
STOPPED = 130


def run(
    scene: str,
    output: str | None,
    definitions: tuple[str, ...],
    reading: dict[str, Any],
    frames: str | None,
    fps: float | None,
    settings: dict[str, str],
    quiet: bool,
    verbose: bool,
) -> int:
    """Render SCENE to an EXR or PNG picture."""
    path = _output(output or f"{_scene.stem(scene)}.exr")
    sequence = _frames.wanted(frames, fps, scene, reading)
    _check(settings, path)
    if sequence is None:
        try:
            _picture(_scene.open_scene(scene, definitions, reading), path, settings, quiet)
        except RenderStopped as stopped:
            return _stopped(stopped.image, path)
        return 0

    def one(path: Path, time: float, first: bool) -> None:
        opened = _scene.open_scene(scene, definitions, {**reading, "at_time": time})
        _picture(opened, path, settings, quiet, again=not first)

    given = (definitions, sorted(reading.items()), sorted(settings.items()), sequence.fps)
    return _frames.run(sequence, path, _frames.identity(scene, *given), one)


def _picture(
    opened: _core.Scene, path: Path, settings: dict[str, str], quiet: bool, again: bool = False
) -> None:
    """Renders one picture and says so; `again`: the notes were told with an earlier one."""
    from antumbra.scene import Scene

    silent = quiet or again
    _scene.tell(opened, silent)
    asked = opened.suggested()
    told = effects.idle(settings, path.suffix.lower(), asked)
    if not silent:
        _say.messages("", [("note", "", text) for text in told])
    head = f"  {opened.name} · {_facts(opened)} · {_plan(opened, {**asked, **settings})}"
    watched = sys.stderr.isatty()
    if watched and not silent:
        print(head, file=sys.stderr, flush=True)
    with Bar(quiet) as bar:
        image = Scene._of(opened).render(progress=bar.show, **settings)
    image.save(path)
    if not silent:
        _say.messages(_scene.file_of(opened), [said for said in image.messages if said.text not in told])
        if not watched:
            print(head, file=sys.stderr)
    print(_ending(image, path))


VERB = Verb(
    "render",
    run,
    arguments=[("SCENE", True)],
    groups=GROUPS,
    examples=[
        ("antumbra render cornell-box", "a built-in scene"),
        ("antumbra render room.glb --viewing-rays 64 -o room.png", ""),
        ("antumbra render pillars --estimator area --shadow-rays 9 -D light-size=0.5", ""),
    ],
    options=[
        output_option("FILE", "the picture, .exr or .png [NAME.exr]"),
        *_scene.options(),
        *_frames.options(),
    ],
)


def _output(name: str) -> Path:
    path = Path(name)
    if path.suffix.lower() not in (".exr", ".png"):
        raise click.UsageError(f'"{name}": a picture ends in .exr or .png')
    return path


def _check(given: dict[str, str], path: Path) -> None:
    """Says at once what would go wrong at the end."""
    settings.words(given)
    try:
        _core.check_writable(str(path))
    except OSError as problem:
        raise click.UsageError(f"{problem}. Nothing was rendered.") from problem


def _facts(scene: _core.Scene) -> str:
    return " · ".join(_say.some(n, word) for word, n in scene.counts()) or "nothing"


# What `--shadow-rays` counts where it is no shadow ray.
_SAMPLES = {"hemisphere": "direction", "path-hemisphere": "direction"}


def _plan(scene: _core.Scene, given: dict[str, str]) -> str:
    value = {name: given.get(name, setting.default) for name, setting in settings.table().items()}
    width, height = scene.picture_size(list(given.items()))
    shadow = _say.some(int(value["shadow_rays"]), _SAMPLES.get(value["estimator"], "shadow ray"))
    return f"{width} × {height} · {value['estimator']}, {value['viewing_rays']} viewing × {shadow}, {value['sampler']}"


def _ending(image: Image, path: Path) -> str:
    parts = [_say.seconds(image.seconds), _rays(image), image.error_words, f"same bits: {image.hash}"]
    return f"{path}   {' · '.join(parts)}"


def _rays(image: Image) -> str:
    """Rays of all kinds, how many of them are shadow rays, and how many a second."""
    every = image.rays + image.shadow_rays
    shadow = f" ({_say.count(image.shadow_rays)} shadow rays)" if image.shadow_rays else ""
    rate = _say.significant(every / max(image.seconds, 1e-9) / 1e6)
    return f"{_say.count(every)} rays{shadow}, {rate} M/s"


def _stopped(image: Image | None, path: Path) -> int:
    if image is None:
        print(f"stopped before the first pass was done; {path} was not written", file=sys.stderr)
    else:
        image.save(path)
        done = f"stopped after {image.passes_done:,} of {image.passes:,} passes"
        print(f"{done}; {path} holds them, {image.error_words}", file=sys.stderr)
    return STOPPED
