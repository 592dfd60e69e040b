"""Settings that a person gave and that change nothing, because another setting does not heed them: the one table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from antumbra.settings import table


class Rule(NamedTuple):
    """These `settings` have an effect only where the setting `of` has one of `values`; `unless` they have this one."""

    settings: Sequence[str]
    of: str
    values: Sequence[str]
    unless: str = ""


_PATHS = ("path", "path-hemisphere")
_SEES_LIGHT = ("path", "area", "hemisphere", "surfaces", "mis", "path-hemisphere")

# `output` is no setting of the table: the ending of the picture's file.
RULES = (
    Rule(("radius", "falloff"), "estimator", ("ambient-occlusion",)),
    Rule(("bounces",), "estimator", _PATHS, unless="0"),
    Rule(("roulette",), "estimator", _PATHS),
    Rule(("lights", "light_points"), "estimator", ("area", "mis", "path")),
    Rule(("directions",), "estimator", ("hemisphere", "mis", *_PATHS)),
    Rule(("distance_test",), "estimator", ("area", "surfaces", "mis", "path")),
    Rule(("light", "environment"), "estimator", _SEES_LIGHT),
    Rule(("rotate",), "sampler", ("regular",)),
    Rule(("pairing",), "sampler", ("owen",)),
    Rule(("filter", "aperture", "focus"), "viewing", ("filter",)),
    Rule(("aov", "exr"), "output", (".exr",)),
    Rule(("exposure", "tone"), "output", (".png",)),
    Rule(("region_points",), "aov", ("regions", "all")),
)


def idle(
    given: Mapping[str, str], output: str | None = None, asked: Mapping[str, str] | None = None
) -> list[str]:
    """What to say about settings of `given` (words by name) that change nothing.

    `output`: the picture's ending; `asked`: what the scene's file asks for where nothing is given.
    """
    value = {name: setting.default for name, setting in table().items()} | dict(asked or {}) | dict(given)
    if output is not None:
        value["output"] = output
    said = []
    for rule in RULES:
        listed = [name for name in rule.settings if name in given and given[name] != rule.unless]
        words = value[rule.of].split(",") if rule.of in value else rule.values
        if listed and not set(words) & set(rule.values):
            said.append(
                _sentence([f"{name} = {_one_line(given[name])}" for name in listed], rule, value[rule.of])
            )
    return said


def _sentence(listed: list[str], rule: Rule, value: str) -> str:
    has = f"{' and '.join(listed)} {'has' if len(listed) == 1 else 'have'} no effect"
    *others, last = rule.values
    heeding = " or ".join([", ".join(others), last] if others else [last])
    if rule.of == "output":
        return f"{has} on a {value} (only on {heeding})"
    if rule.values == _SEES_LIGHT:
        return f"{has} with {rule.of} = {value}, which looks at no light"
    if not value:
        return f"{has} without {rule.of} = {heeding}"
    return f"{has} with {rule.of} = {value} (only with {heeding})"


def _one_line(word: str) -> str:
    return ", ".join(word.splitlines())
