"""Where a study's scenes come from: a name, a file, a Scene, or a function of parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from antumbra import _core
from antumbra._words import did_you_mean
from antumbra.errors import OptionError
from antumbra.study.content import content

if TYPE_CHECKING:
    from antumbra.scene import Scene

Parameters = Mapping[str, float]


class Source(NamedTuple):
    """`open` makes the scene of given parameters; `name` for people; `identity`: equal = the same scene, if not empty.

    `builtin`: the name whose parameters can be checked beforehand; `fixed`: it has no parameters; `verbatim`: their
    names are a file's own, which may have dashes and underscores both.
    """

    open: Callable[[Parameters], Scene]
    name: str
    identity: str = ""
    builtin: str = ""
    fixed: bool = False
    verbatim: bool = False

    def check(self, parameters: Iterable[Parameters]) -> None:
        """Raises OptionError if a parameter is unknown or out of its range."""
        for each in parameters:
            if self.fixed and each:
                raise OptionError(f"D.{next(iter(each))}: {self.name} has no parameters")
            if self.builtin:
                _check(self.builtin, each)


def source(scene: Any) -> Source:
    """Of what `antumbra.study.run` takes."""
    from antumbra.scene import Scene

    if isinstance(scene, Scene):
        return Source(lambda _: scene, scene.name, fixed=True)
    if callable(scene):
        return Source(scene, getattr(scene, "__name__", "scene").strip("<>"))
    if Path(scene).exists() or "." in scene or "/" in scene:
        return file(str(scene))
    known = [name for name, _, _ in _core.builtins()]
    if scene not in known:
        hint = did_you_mean(scene, known)
        raise OptionError(f'there is no scene "{scene}"{hint} ({", ".join(known)}; a file has a dot)')
    return Source(lambda given: _built_in(scene, given), scene, f"built-in {scene}", builtin=scene)


def file(path: str, texts: Mapping[str, str] | None = None, **reading: Any) -> Source:
    """A scene of a file; `texts`: values of a Mitsuba file's parameters that are no numbers; `reading`: as `load`."""
    from antumbra.scene import load

    at, texts = Path(path), dict(texts or {})
    identity = f"{at.resolve()} {content(at)} {sorted(reading.items())} {sorted(texts.items())}"

    def opened(given: Parameters) -> Scene:
        for name in given.keys() & texts.keys():
            raise OptionError(f"D.{name} is varied and also given a fixed value: one of the two")
        values = {**texts, **{name: _written(value) for name, value in given.items()}}
        return load(path, parameters=values, **reading)

    has_parameters = at.suffix.lower() == ".xml"
    if texts and not has_parameters:
        raise OptionError(f"D.{next(iter(texts))}: {at.name} has no parameters")
    return Source(opened, at.name, identity, fixed=not has_parameters, verbatim=True)


def _written(value: float) -> str:
    """With all its digits, and a whole number without a point."""
    short = f"{value:g}"
    return short if float(short) == value else repr(float(value))


def _built_in(name: str, parameters: Parameters) -> Scene:
    from antumbra.scene import builtin

    return builtin(name, **{key.replace("-", "_"): value for key, value in parameters.items()})


def _check(scene: str, given: Parameters) -> None:
    (known,) = (parameters for name, _, parameters in _core.builtins() if name == scene)
    ranges = {name: (low, high) for name, _, low, high, _ in known}
    for name, value in given.items():
        if name not in ranges:
            hint = did_you_mean(name, list(ranges))
            listed = ", ".join(ranges) or "none"
            raise OptionError(f'{scene} has no parameter "{name}"{hint} (it has: {listed})')
        low, high = ranges[name]
        if not low <= value <= high:
            raise OptionError(f"D.{name}={value:g}: {scene} takes {low:g} to {high:g}")
