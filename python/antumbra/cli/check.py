"""`antumbra check`: is an estimator of one's own right?"""

from __future__ import annotations

import json as as_json
import sys
from contextlib import redirect_stdout
from pathlib import Path

import click

from antumbra.cli import _say
from antumbra.cli._command import Option, Verb

ORDER = 6


def run(file: str, function: str | None, seed: int, json: bool, quiet: bool, verbose: bool) -> int:
    """Check an estimator of your own: the function of (scene, at, u) in a Python file, as scene.render takes it.

    Runs the file's code. With KIND = "occlusion" in the file, the function returns openness. Exit code 0 if all agree,
    1 if not, with what is wrong.
    """
    from antumbra.checks import check
    from antumbra.checks.load import guarded, load

    if not quiet and Path(file).is_file():
        _say.messages(file, [("note", "", "its code is run as it stands")])
    show = sys.stderr.isatty() and not quiet
    try:
        # What the file prints is no part of the report.
        with redirect_stdout(sys.stderr):
            estimator, options = load(file, function)
            asked = guarded(file, estimator)
            report = check(asked, seed=seed, progress=_line if show else None, **options)
    finally:
        if show:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)
    print(as_json.dumps(report.as_dict(), indent=2, ensure_ascii=False) if json else report)
    return 0 if report.passed else 1


def _line(name: str) -> None:
    """The question that was just answered, over the one before."""
    print(f"\r\x1b[K  {name}", end="", file=sys.stderr, flush=True)


VERB = Verb(
    "check",
    run,
    arguments=[("FILE", True)],
    examples=[
        ("antumbra check mine.py", "its only estimator"),
        ("antumbra check mine.py --function area", "one of several"),
        ("antumbra check mine.py --json", "for programs"),
    ],
    options=[
        Option("--function", metavar="NAME", group="Run", help="which function of the file"),
        Option(
            "--seed",
            type=click.IntRange(0, 2**32 - 1),
            default=0,
            metavar="N",
            group="Run",
            help="another seed, other samples [0]",
        ),
        Option("--json", is_flag=True, group="Run", help="the report as JSON"),
    ],
)
