"""`antumbra study`: error against rays and seconds, on the user's own scene."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from antumbra.cli import _say, _scene
from antumbra.cli._command import GROUPS, Option, Verb, output_option
from antumbra.cli._progress import Bar

if TYPE_CHECKING:
    from antumbra.study import Study
    from antumbra.study.sources import Source

ORDER = 5
OURS, STOPPED = 1, 130


def run(
    scene: str,
    vary: tuple[str, ...],
    reference: str | None,
    reference_error: str | None,
    reference_rays: int | None,
    budget: str | None,
    seeds: int,
    output: str | None,
    definitions: tuple[str, ...],
    reading: dict[str, Any],
    settings: dict[str, str],
    quiet: bool,
    verbose: bool,
) -> int:
    """Measure the error of several ways of rendering SCENE: against rays and seconds, as a page with plots."""
    from antumbra import study

    if not vary:
        raise click.UsageError("--vary is missing: name what is to be compared, as --vary shadow-rays=1,9,36")
    folder = Path(output or f"{_scene.stem(scene)}-study")
    source, parameters = _source(scene, definitions, reading)
    asked: dict[str, Any] = {
        "vary": dict(_varied(text) for text in vary), "reference": reference, "seeds": seeds, "folder": folder,
        "reference_error": reference_error, "reference_rays": reference_rays, "budget": _budget(budget),
        "parameters": parameters, "command": shlex.join(["antumbra", *sys.argv[1:]]),
    }  # fmt: skip
    if len(asked["vary"]) < len(vary):
        raise click.UsageError("--vary: a name is there twice; give all its values at once, joined by commas")
    try:
        with Bar(quiet) as bar:
            found = study.run(source, progress=_shown(bar), **{**settings, **asked})
    except study.FolderError as problem:
        raise click.UsageError(f"{problem}. Nothing was rendered.") from problem
    except OSError as problem:
        _say.error(
            f"{folder}: {problem}", "The rows that results.json holds are kept; the same command goes on."
        )
        return OURS
    except study.StudyStopped as stopped:
        return _stopped(stopped.study, folder)
    if not quiet:
        _say.messages("", found.messages)
    print(_told(found, folder))
    return 0


VERB = Verb(
    "study",
    run,
    arguments=[("SCENE", True)],
    groups=GROUPS,
    examples=[
        ("antumbra study pillars --vary shadow-rays=1,9,36 --vary sampler=random,owen", ""),
        ("antumbra study room.glb --vary estimator=area,mis --budget rays=16,64 -o room", ""),
        ("antumbra study pillars --vary D.light-size=0.1,0.5,2", "a light's size"),
    ],
    options=[
        Option("--vary", "vary", group="Study", metavar="NAME=A,B,…", multiple=True,
               help="a setting, or D.NAME of the scene, and its values; all combinations are rendered"),
        Option("--reference", group="Study", metavar="FILE|NAME",
               help="a picture, or the estimator that renders it (default: one of another kind)"),
        Option("--reference-error", group="Study", metavar="FILE",
               help="the standard errors of a reference that is a file"),
        Option("--reference-rays", group="Study", metavar="N", type=click.IntRange(min=1),
               help="viewing rays of a rendered reference, over 8 seeds (default: until its own error is small)"),
        Option("--budget", group="Study", metavar="rays=N|seconds=T",
               help="let all variants spend the same, per pixel or per picture; more than one, joined by commas"),
        Option("--seeds", group="Study", metavar="K", type=int, default=8, help="renders of each variant [8]"),
        output_option("FOLDER", "where index.html, results.csv and results.json go [NAME-study]"),
        *_scene.options(),
    ],
)  # fmt: skip


def _source(
    scene: str, definitions: tuple[str, ...], reading: dict[str, Any]
) -> tuple[Source, dict[str, float]]:
    """The scene, and what -D says of it."""
    from antumbra.study.plan import is_number
    from antumbra.study.sources import file, source

    given = dict(_scene.definition(text) for text in definitions)
    is_file = _scene.is_file(scene, reading)
    texts = {name: text for name, text in given.items() if is_file and not is_number(text)}
    parameters = {name: _scene.number(name, text) for name, text in given.items() if name not in texts}
    if is_file:
        return file(scene, texts, **reading), parameters
    return source(scene), parameters


def _varied(text: str) -> tuple[str, list[str]]:
    """`sampler=random,owen`; values that have commas themselves (`eye`) are joined by semicolons."""
    name, equals, values = text.partition("=")
    if not equals or not name or not values:
        raise click.UsageError(
            f"--vary {text}: a name and its values are needed, as --vary shadow-rays=1,9,36"
        )
    return name, [v.strip() for v in values.split(";" if ";" in values else ",")]


def _budget(text: str | None) -> dict[str, list[float]] | None:
    if text is None:
        return None
    counted, equals, amounts = text.partition("=")
    try:
        if not equals:
            raise ValueError
        return {counted: [float(a) for a in amounts.split(",")]}
    except ValueError:
        raise click.UsageError(f"--budget {text}: as --budget rays=64 or --budget seconds=0.5,2") from None


def _shown(bar: Bar) -> Any:
    from antumbra.messages import Progress

    show = bar.show
    return None if show is None else lambda step: show(Progress(0, 0, step.done))


def _told(found: Study, folder: Path) -> str:
    """One line per curve, then where the page is."""
    from antumbra.study.page import short_table

    flagged = found.flagged()
    said = f"{_say.some(len(flagged), 'row')} of {len(found.rows)} biased" if flagged else "no bias found"
    black = found.black()
    if not found.tested():
        said = "bias was not tested"
    elif black:
        untested = f"{len(black)} of {len(found.rows)} rows not tested: black, or the reference is"
        said = f"{said}, {untested}" if flagged else untested
    elif not flagged and (hidden := found.untestable()):
        size = f"below {100 * hidden:.0f} % of the mean" if hidden < 1 else "even as large as the mean"
        said = f"a bias {size} was not testable"
    elif (share := 100 * found.untested()) >= 0.5:
        said += f", {share:.0f} % of the tiles not tested"
    return "\n".join(
        [
            *short_table(found),
            f"{folder / 'index.html'}   {len(found.rows)} rows × {found.seeds} seeds · {said}",
        ]
    )


def _stopped(found: Study, folder: Path) -> int:
    if found.rows:
        print(
            f"stopped; {folder} holds the {_say.some(len(found.rows), 'row')} that were done", file=sys.stderr
        )
        print("the same command goes on from there", file=sys.stderr)
    else:
        print("stopped before the first row was done; nothing was written", file=sys.stderr)
    return STOPPED
