"""Runs a command line: finds the verb by its file, and turns whatever went wrong into one message and an exit code."""

from __future__ import annotations

import importlib
import os
import pkgutil
import sys
import traceback
from pathlib import Path

import click

from antumbra import __version__
from antumbra.cli import _say
from antumbra.cli._command import Verb, _first_paragraph
from antumbra.errors import OptionError, SceneError
from antumbra.settings import as_typed

DONE, OURS, BAD_INPUT, STOPPED = 0, 1, 2, 130


def run(arguments: list[str]) -> int:
    """Runs the command line and says how it ended."""
    try:
        return _dispatch(arguments)
    except click.UsageError as problem:
        _say.error(*_usage(problem))
    except (SceneError, OptionError) as problem:
        _say.error(*_told(problem))
    except BrokenPipeError:
        # The reader of our output went away (`| head`): nothing is wrong, and nobody is left to tell.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except OSError as problem:
        _say.error(str(problem))
        return OURS
    except (KeyboardInterrupt, click.Abort):
        print("stopped", file=sys.stderr)
        return STOPPED
    except BaseException as problem:
        return _ours(problem, "--verbose" in arguments)
    if "--verbose" in arguments:
        traceback.print_exc()
    return BAD_INPUT


def verbs() -> list[str]:
    """The verbs: every file of this folder whose name does not begin with `_`."""
    folder = str(Path(__file__).parent)
    return [module.name for module in pkgutil.iter_modules([folder]) if not module.name.startswith("_")]


def verb(name: str) -> Verb:
    """One verb, imported from its file."""
    found: Verb = importlib.import_module(f"antumbra.cli.{name}").VERB
    return found


def _dispatch(arguments: list[str]) -> int:
    first = arguments[0] if arguments else "--help"
    if first == "help":
        return _dispatch([*arguments[1:2], "--help"])
    if first in ("--help", "-h"):
        print(_overview())
        return DONE
    if first == "--version":
        print(f"antumbra {__version__}")
        return DONE
    if first not in verbs():
        kind = "option" if first.startswith("-") else "verb"
        hint = _say.did_you_mean(first, [*verbs(), "--help", "--version"])
        raise click.UsageError(
            f'there is no {kind} "{first}"{hint} ({", ".join(v.name or "" for v in _in_order())})'
        )
    result = verb(first).main(arguments[1:], prog_name=f"antumbra {first}", standalone_mode=False)
    return result if isinstance(result, int) else DONE


def _in_order() -> list[Verb]:
    found = [importlib.import_module(f"antumbra.cli.{name}") for name in verbs()]
    return [module.VERB for module in sorted(found, key=lambda module: module.ORDER)]


def _overview() -> str:
    lines = ["Usage: antumbra VERB … [OPTIONS]", "", "  Direct light and shadow of a scene.", ""]
    calls = {f"  antumbra {each.name} {each.places()}".rstrip(): each for each in _in_order()}
    column = max(map(len, calls)) + 2
    lines += [
        call.ljust(column) + _first_paragraph(each.help).split(":")[0].rstrip(".")
        for call, each in calls.items()
    ]
    lines += ["", "  antumbra VERB --help says more about each; antumbra --version, which one this is."]
    return "\n".join(lines)


def _usage(problem: click.UsageError) -> tuple[str, str]:
    ctx = problem.ctx
    hint = f"`{ctx.command_path} --help` lists what there is." if ctx else ""
    if isinstance(problem, click.NoSuchOption):
        known = [name for param in ctx.command.params for name in param.opts] if ctx else []
        near = _say.did_you_mean(problem.option_name, known, "{}")
        return f"there is no option {problem.option_name}{near}", hint
    if isinstance(problem, click.MissingParameter) and problem.param:
        own = problem.param.opts if isinstance(problem.param, click.Option) else []
        return f"{' '.join([*own[:1], problem.param.metavar or ''])} is missing", hint
    if isinstance(problem, click.BadOptionUsage):
        return f"{problem.option_name} needs a value", hint
    what, _, advice = problem.format_message().partition("\n")
    return what, advice


def _told(problem: SceneError | OptionError) -> tuple[str, str]:
    if isinstance(problem, SceneError):
        line = ": ".join(part for part in (problem.file, problem.place, as_typed(problem.what)) if part)
        return line, as_typed(problem.hint)
    return as_typed(str(problem)), ""


def _ours(problem: BaseException, verbose: bool) -> int:
    if isinstance(problem, (SystemExit, GeneratorExit)):
        raise problem
    if verbose:
        traceback.print_exc()
    what = f"{type(problem).__name__}: {problem}".splitlines()[0]
    _say.error(f"antumbra itself failed: {what}", "" if verbose else "--verbose shows where.")
    return OURS
