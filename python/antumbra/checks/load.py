"""Functions of a person's own file: finds the estimator in it, and says where its code fails."""

from __future__ import annotations

import functools
import importlib.util
import inspect
import sys
import traceback
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

from antumbra.checks.run import check_options
from antumbra.errors import SceneError
from antumbra.own import Estimator


def load(path: str, name: str | None = None) -> tuple[Estimator, dict[str, Any]]:
    """The estimator of a Python file, and what the file's `KIND` and `NOISE` say: options of `check`.

    The function called `name`, or `estimator`, or the only one of the file that takes (scene, at, u) and whose name
    does not begin with `_`. Runs the file.

    Raises SceneError with the line where the file fails, or with what it has instead of an estimator.
    """
    module = _run(path)
    known = {
        key: value
        for key, value in vars(module).items()
        if isinstance(value, FunctionType) and value.__module__ == module.__name__ and _takes_three(value)
    }
    public = [key for key in known if not key.startswith("_")]
    chosen = name or ("estimator" if "estimator" in known else public[0] if len(public) == 1 else None)
    if chosen not in known:
        listed = ", ".join(f'"{key}"' for key in public) or "none"
        what = f'has no estimator "{chosen}"' if chosen else f"has {len(public)} functions of (scene, at, u)"
        hint = (
            f"{listed}. Name one with --function." if public else "def estimator(scene, at, u): … is needed."
        )
        raise SceneError(what, file=path, hint=hint)
    options = {key.lower(): getattr(module, key) for key in ("KIND", "NOISE") if hasattr(module, key)}
    try:
        check_options(**options)
    except Exception as problem:
        raise failed(path, problem) from problem
    return known[chosen], options


def guarded(path: str, function: Estimator) -> Estimator:
    """The same function, but what it raises is a SceneError that says where in its file: all else is not its fault."""

    @functools.wraps(function)
    def asked(*given: Any) -> Any:
        try:
            return function(*given)
        except (Exception, SystemExit) as problem:
            raise failed(path, problem) from problem

    return asked


def _run(path: str) -> ModuleType:
    if not Path(path).is_file():
        raise SceneError("there is no such file" if not Path(path).exists() else "is no file", file=path)
    spec = importlib.util.spec_from_file_location("antumbra_checked", path)
    if spec is None or spec.loader is None:
        raise SceneError("is no Python file", file=path, hint="Its name ends in .py.")
    module = importlib.util.module_from_spec(spec)
    # As `python FILE.py` has it: modules beside the file are found, also later.
    sys.modules[module.__name__] = module
    sys.path.insert(0, str(Path(path).parent.resolve()))
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as problem:
        raise failed(path, problem) from problem
    return module


def _takes_three(function: FunctionType) -> bool:
    """It can be called with three arguments by position."""
    try:
        inspect.signature(function).bind(None, None, None)
    except TypeError:
        return False
    return True


def failed(path: str, problem: BaseException) -> SceneError:
    """What a person's code raised, at its own last line."""
    if (
        isinstance(problem, SyntaxError)
        and problem.filename
        and Path(problem.filename).name == Path(path).name
    ):
        place, what = f"line {problem.lineno}", f"{type(problem).__name__}: {problem.msg}"
        return SceneError(what, file=path, place=place)
    here = Path(path).resolve()
    frames: list[Any] = [
        frame
        for frame in traceback.extract_tb(problem.__traceback__)
        if Path(frame.filename).resolve() == here
    ]
    place = f"line {frames[-1].lineno}" if frames else ""
    inside = f"in {frames[-1].name}: " if frames and frames[-1].name != "<module>" else ""
    hint = frames[-1].line or "" if frames else ""
    return SceneError(f"{inside}{type(problem).__name__}: {problem}", file=path, place=place, hint=hint)
