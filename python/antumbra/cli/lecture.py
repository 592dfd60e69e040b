"""`antumbra lecture`: the experiments of the lecture, rendered, measured, and put on one page."""

from __future__ import annotations

import sys
import time
import traceback
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

import click

from antumbra._files import why
from antumbra.cli import _say
from antumbra.cli._command import Option, Verb, output_option
from antumbra.lecture.variant import LARGEST_SEED

if TYPE_CHECKING:
    import rich.progress

    from antumbra.lecture.figure import Figure
    from antumbra.lecture.make import Lecture, Step

ORDER = 2
OURS, STOPPED = 1, 130


def run(
    figure: tuple[str, ...],
    output: str,
    quick: bool,
    single_file: bool,
    seed: int,
    quiet: bool,
    verbose: bool,
    list_: bool = False,
    exercises: bool = False,
) -> int:
    """Render the lecture: each FIGURE (all without names; --list names them) with its question, pictures, number and
    claims, on one page.

    What is finished is kept: the same command goes on where it was stopped.
    """
    from antumbra.lecture import catalog
    from antumbra.lecture.make import Lecture

    if exercises:
        if figure or list_:
            other = "--list" if list_ else figure[0]
            raise click.UsageError(f"--exercises writes all eight of them: {other} has no place beside it")
        return _exercises(Path(output))
    if list_:
        print(_listed(catalog.chosen(figure)))
        return 0
    lecture = Lecture(Path(output), catalog.chosen(figure), quick=quick, seed=seed, single=single_file)
    try:
        lecture.folder.check()
        lecture.folder.check_room(lecture.room())
    except OSError as problem:
        raise click.UsageError(
            f"{output} cannot be written ({why(problem)}). Nothing was rendered."
        ) from problem
    began = time.monotonic()
    try:
        if not quiet:
            print(_plan(lecture, lecture.waiting()), file=sys.stderr, flush=True)
        with _Bar(quiet) as bar:
            failed = _Failed(bar, verbose)
            lecture.run(bar.step, lambda result: None if quiet else bar.say(_line(result)), failed)
    except KeyboardInterrupt:
        return _stopped(lecture, output)
    except OSError as problem:
        return _unwritten(lecture, output, problem)
    if not quiet:
        _say.messages(output, _too_large(lecture))
    print(_ending(lecture, output, time.monotonic() - began))
    return OURS if failed.names else 0


VERB = Verb(
    "lecture",
    run,
    arguments=[("FIGURE", False)],
    examples=[
        ("antumbra lecture --quick -o lecture", "all figures, coarse"),
        ("antumbra lecture regions -o lecture", "one figure at full size"),
        ("antumbra lecture -o lecture --single-file", "one file to pass on"),
    ],
    options=[
        output_option(
            "FOLDER",
            "folder of the page: index.html, pictures/, exr/, lecture.json [lecture]",
            default="lecture",
        ),
        Option(
            "--single-file",
            group="Files",
            is_flag=True,
            help="index.html holds the pictures (at most 25 MB)",
        ),
        Option(
            "--list",
            "list_",
            group="Teaching",
            is_flag=True,
            help="only name the figures: number, title, seconds (coarse, full)",
        ),
        Option(
            "--exercises",
            group="Teaching",
            is_flag=True,
            help="instead of the page: eight files of Python, each with a gap to fill",
        ),
        Option(
            "--quick",
            group="Sampling",
            is_flag=True,
            help="coarse pictures and numbers, about two minutes in all",
        ),
        Option(
            "--seed",
            group="Sampling",
            metavar="N",
            type=click.IntRange(0, LARGEST_SEED),
            default=0,
            help="another seed, another noise [0]",
        ),
    ],
)
VERB.params[0].nargs = -1


class _Bar:
    """A bar on standard error for the whole lecture, with the time left, where standard error is a terminal."""

    def __init__(self, quiet: bool) -> None:
        self._wanted = not quiet and sys.stderr.isatty()
        self._bar: rich.progress.Progress | None = None

    def __enter__(self) -> Self:
        if self._wanted:
            import rich.console
            import rich.progress as r

            self._bar = r.Progress(
                r.TextColumn("  {task.description}"),
                r.BarColumn(),
                r.TextColumn("{task.fields[left]}"),
                r.TimeElapsedColumn(),
                console=rich.console.Console(stderr=True),
            )
            self._bar.add_task("lecture", total=1.0, left="")
            self._bar.start()
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        if self._bar:
            self._bar.stop()

    def step(self, at: Step) -> None:
        if self._bar:
            task = self._bar.task_ids[0]
            words = " · ".join(filter(None, (f"{at.done + 1} of {at.all}", at.name, at.doing)))
            share = (at.done + at.share) / at.all
            self._bar.update(task, completed=share, description=words, left=f"{_about(at.left)} left")

    def say(self, line: str) -> None:
        if not line:
            return
        if self._bar:
            self._bar.console.print(line, highlight=False, markup=False, soft_wrap=True)
        else:
            print(line, file=sys.stderr, flush=True)


class _Failed:
    """Says which figures raised and what, each in a line (`verbose`: with the whole chain)."""

    def __init__(self, bar: _Bar, verbose: bool) -> None:
        self._bar, self._verbose = bar, verbose
        self.names: list[str] = []

    def __call__(self, name: str, problem: Exception) -> None:
        self.names.append(name)
        what = " ".join(f"{type(problem).__name__}: {problem}".split())
        self._bar.say(f"error: {name} failed and is left out ({what})")
        if self._verbose:
            self._bar.say("".join(traceback.format_exception(problem)).rstrip())


def _exercises(folder: Path) -> int:
    from antumbra.lecture import exercises

    try:
        written = exercises.write(folder)
    except OSError as problem:
        raise click.UsageError(f"{folder} cannot be written ({why(problem)})") from problem
    first, kept = exercises.names()[0], len(exercises.names()) - len(written)
    left = f" · {kept} were there and are kept" if kept else ""
    print(f"{folder}/   {_say.some(len(written), 'exercise')}{left} · next: antumbra check {folder}/{first}")
    return 0


def _listed(figures: Mapping[str, Figure]) -> str:
    """One line a figure, seconds as on two cores."""
    rows = [
        (str(each.number), name, each.title, f"{each.seconds.quick:g} s", f"{each.seconds.full:g} s")
        for name, each in figures.items()
    ]
    rows.insert(0, ("", "FIGURE", "title", "--quick", "full"))
    wide = [max(len(row[column]) for row in rows) for column in range(5)]
    return "\n".join(
        f"{n:>{wide[0]}}  {name:<{wide[1]}}  {title:<{wide[2]}}  {quick:>{wide[3]}}  {full:>{wide[4]}}"
        for n, name, title, quick, full in rows
    )


def _plan(lecture: Lecture, waiting: Sequence[str]) -> str:
    figures = [name for name in waiting if name in lecture.figures]
    kept, older = len(lecture.figures) - len(figures), sum(lecture.kept(name) is not None for name in figures)
    parts = [_say.some(len(lecture.figures), "figure"), *([f"{kept} of them finished"] if kept else [])]
    if older:
        parts.append(f"{older} made by older code, to be replaced")
    if waiting:
        parts.append(f"about {_about(lecture.seconds(waiting))} on two cores")
    return "  lecture · " + " · ".join(parts)


def _about(seconds: float) -> str:
    if seconds < 90:
        return f"{max(1, round(seconds))} s"
    return f"{round(seconds / 60)} min"


def _line(result: Mapping[str, Any]) -> str:
    if "claims" not in result:
        return ""
    answer = result["answer"]
    error = f" ± {answer['error']}" if answer["error"] else ""
    unit = f" {answer['unit']}" if answer["unit"] else ""
    parts = [f"{answer['value']}{error}{unit}", _verdicts([result]), _say.seconds(result["seconds"])]
    return f"  {result['name']:<18}{' · '.join(parts)}"


def _verdicts(results: Sequence[Mapping[str, Any]]) -> str:
    found = [claim["verdict"] for result in results for claim in result["claims"]]
    counts = [(found.count(word), word) for word in ("supported", "undecided", "not supported")]
    return "claims: " + ", ".join(f"{n} {word}" for n, word in counts if n)


def _results(lecture: Lecture) -> list[Mapping[str, Any]]:
    return [found for name in lecture.figures if (found := lecture.kept(name))]


def _ending(lecture: Lecture, output: str, seconds: float) -> str:
    done = _results(lecture)
    page = Path(output) / "index.html"
    return f"{page}   {_say.some(len(done), 'figure')} · {_verdicts(done)} · {_say.seconds(seconds)}"


def _too_large(lecture: Lecture) -> list[tuple[str, str, str]]:
    """A warning if a page of one file is larger than it was to be."""
    from antumbra.lecture.page import LARGEST

    size = (lecture.folder.path / "index.html").stat().st_size
    if not lecture.single or size <= LARGEST:
        return []
    what = f"{size / 1e6:.3g} MB, more than {LARGEST / 1e6:.3g}, though its pictures are as small as can be"
    return [("warning", "index.html", what)]


def _stopped(lecture: Lecture, output: str) -> int:
    done = len(lecture.figures) - sum(name in lecture.figures for name in lecture.waiting())
    kept = f"{done} of {_say.some(len(lecture.figures), 'figure')} finished and kept in {output}"
    said = f"{kept}; the same command goes on" if done else "no figure is finished"
    print(f"stopped: {said}", file=sys.stderr)
    return STOPPED


def _unwritten(lecture: Lecture, output: str, problem: OSError) -> int:
    done = len(lecture.figures) - sum(name in lecture.figures for name in lecture.waiting())
    _say.error(
        f"{output} cannot be written any more ({why(problem)})",
        f"{done} of {_say.some(len(lecture.figures), 'figure')} are finished and kept; the same command goes on.",
    )
    return OURS
