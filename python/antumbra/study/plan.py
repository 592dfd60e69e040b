"""What a study will render: its variants, what is on the axis, and all that can be wrong before a ray is traced."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Any

from antumbra import settings
from antumbra._words import did_you_mean
from antumbra.errors import OptionError

RAYS = ("shadow_rays", "viewing_rays")
LEAST_SEEDS = 3
# Seeds are whole numbers below this, and those of a study count round. The places where pilots and the reference begin,
# counted from its first seed, lie so far apart that none meets another.
_ALL_SEEDS, _MOST_SEEDS = 1 << 32, 1 << 20
RAYS_PILOT, KIND_PILOT, COST_PILOT, REFERENCE = 1 << 27, 1 << 28, 1 << 29, 1 << 30
# Settings that change how a picture is found; all others change what it shows: each value has a truth of its own.
METHOD = {
    *RAYS, "estimator", "lights", "light_points", "directions", "roulette", "sampler", "rotate", "pairing",
    "self_intersection", "distance_test", "mistake", "threads",
}  # fmt: skip
_REFUSED = {
    "seed": "the replicates are the seeds: --seeds K says how many",
    "passes": "--viewing-rays says how many",
    "aov": "a study looks at the picture alone",
    "exposure": "a study looks at linear light",
    "exr": "a study writes no pictures of the variants",
    "tone": "a study looks at linear light",
    "threads": "the answers are the same bits",
}
DIRECT = ("area", "hemisphere", "surfaces", "mis")
ALL_LIGHT = ("path", "path-hemisphere")


@dataclass(frozen=True)
class Variant:
    """One row to be: the values varied, the settings that make it, and the value on the axis."""

    values: dict[str, str]
    words: dict[str, str]
    parameters: dict[str, float]
    budget: float | None = None

    def truth(self) -> tuple[tuple[str, str], ...]:
        """What it shows, without how: variants with the same share a reference."""
        shown = {k: v for k, v in self.words.items() if k not in METHOD and k != "seed"}
        shown |= {f"D.{k}": repr(v) for k, v in self.parameters.items()}
        return (*sorted(shown.items()), ("shows", self.shows))

    @property
    def shows(self) -> str:
        """Which light its estimator finds: direct, all, or ambient occlusion."""
        return shows(self.words.get("estimator", settings.table()["estimator"].default), self.words)


@dataclass(frozen=True)
class Plan:
    """Everything that is decided before the first render."""

    variants: list[Variant]
    varied: dict[str, list[str]]
    # Name of what is on the axis of the plots: a setting of rays, `budget`, a number that is varied, or nothing.
    axis: str
    fixed: dict[str, str]
    seeds: int
    first_seed: int
    # What a budget counts ("rays" per pixel, "seconds" per picture), and which number of rays is chosen to meet it.
    budget: str = ""
    chosen: str = ""
    messages: list[str] = field(default_factory=list)

    def seed(self, place: int) -> int:
        """The seed at a place counted from its first: replicate k at k, others from where they begin."""
        return (self.first_seed + place) % _ALL_SEEDS

    def suggested(self, asked: Mapping[str, str]) -> Plan:
        """The plan of a scene whose file asks for these settings: they hold where nothing else is said."""
        out = {*self.varied, *self.fixed, *_REFUSED, self.chosen}
        kept = {name: value for name, value in asked.items() if name not in out}
        variants = [replace(v, words={**kept, **v.words}) for v in self.variants]
        return replace(self, variants=variants, fixed={**kept, **self.fixed})


def shows(estimator: str, words: Mapping[str, str]) -> str:
    """Which light an estimator finds: `direct`, `all` or `ambient occlusion`."""
    if estimator == "ambient-occlusion":
        return "ambient occlusion"
    bounces = int(words.get("bounces", settings.table()["bounces"].default))
    return "all" if estimator in ALL_LIGHT and bounces > 1 else "direct"


def plan(
    vary: Mapping[str, Sequence[Any]],
    fixed: Mapping[str, Any],
    *,
    parameters: Mapping[str, float],
    budget: Mapping[str, Sequence[float]],
    seeds: int,
    verbatim: bool = False,
) -> Plan:
    """Checks everything and lays out the variants. Raises OptionError with the nearest right word.

    `verbatim`: names of the scene's parameters stay as they are given; else `_` is `-` in them.
    """
    names = {name: name if verbatim and name.startswith("D.") else _name(name) for name in vary}
    if len(set(names.values())) < len(names):
        raise OptionError("the same thing is varied twice: give all its values at once")
    varied = {names[name]: _values(names[name], list(values)) for name, values in vary.items()}
    words = settings.words(fixed)
    first = int(words.pop("seed", "0"))
    _check_fixed(varied, words, parameters)
    if seeds < LEAST_SEEDS:
        raise OptionError(
            f"{seeds} seeds: at least {LEAST_SEEDS} are needed to know a variance and its error"
        )
    if seeds > _MOST_SEEDS:
        raise OptionError(f"{seeds} seeds: at most {_MOST_SEEDS:,} have seeds of their own")
    counted, amounts = _budget(budget)
    chosen = _chosen(varied, words) if counted else ""
    variants = [
        _variant(dict(zip(varied, values, strict=True)), words, parameters, amount)
        for values in product(*varied.values())
        for amount in amounts
    ]
    # Stable: variants that share a truth come together, and with it their reference and their scene.
    order = {truth: i for i, truth in reversed(list(enumerate(v.truth() for v in variants)))}
    variants.sort(key=lambda v: order[v.truth()])
    axis = "budget" if len(amounts) > 1 else _axis(varied)
    return Plan(variants, varied, axis, words, seeds, first, counted, chosen)


def _name(given: str) -> str:
    """`shadow-rays` → `shadow_rays`; `D.light_size` → `D.light-size`; for a wrong one, the nearest right one."""
    if given.startswith("D."):
        return "D." + given[2:].replace("_", "-")
    name = given.replace("-", "_")
    table = settings.table()
    if name in _REFUSED:
        raise OptionError(f"{table[name].option[2:]} cannot be varied: {_REFUSED[name]}")
    if name not in table:
        hint = did_you_mean(name, [n for n in table if n not in _REFUSED]).replace("_", "-")
        raise OptionError(
            f'there is no setting "{given}" to vary{hint} (D.NAME varies a parameter of the scene)'
        )
    return name


def _values(name: str, values: list[Any]) -> list[str]:
    if not values:
        raise OptionError(f"{name.replace('_', '-')} has no values to take")
    if name.startswith("D."):
        found = [_number(name, v) for v in values]
    else:
        found = [settings.words({name: v})[name] for v in values]
    if len(set(found)) < len(found):
        raise OptionError(f"{name.replace('_', '-')}: a value is there twice")
    return found


def _number(name: str, value: Any) -> str:
    try:
        return f"{float(value):.17g}"
    except (TypeError, ValueError):
        raise OptionError(f"{name}={value}: a number is needed") from None


def _check_fixed(
    varied: dict[str, list[str]], words: dict[str, str], parameters: Mapping[str, float]
) -> None:
    for name in varied:
        if name in words or name.removeprefix("D.") in parameters:
            raise OptionError(
                f"{name.replace('_', '-')} is varied and also given a fixed value: one of the two"
            )
    for name in ("passes", "aov", "exposure", "exr", "tone"):
        if name in words:
            raise OptionError(f"{name.replace('_', '-')} has no place in a study: {_REFUSED[name]}")


def _budget(budget: Mapping[str, Sequence[float]]) -> tuple[str, list[float | None]]:
    if not budget:
        return "", [None]
    if len(budget) > 1:
        raise OptionError("a budget is of rays or of seconds, not of both")
    ((counted, amounts),) = budget.items()
    if counted not in ("rays", "seconds"):
        hint = did_you_mean(counted, ["rays", "seconds"])
        raise OptionError(f'there is no budget of "{counted}"{hint} (rays per pixel, seconds per picture)')
    if not amounts or not all(0 < a < float("inf") for a in amounts):
        raise OptionError(f"budget {counted}: numbers above 0 are needed")
    return counted, [*sorted(set(amounts))]


def _chosen(varied: dict[str, list[str]], words: dict[str, str]) -> str:
    """The number of rays that a budget leaves open: viewing rays, unless those are given and shadow rays are not."""
    free = [name for name in ("viewing_rays", "shadow_rays") if name not in varied and name not in words]
    if not free:
        raise OptionError(
            "a budget chooses shadow-rays or viewing-rays, but both are given: leave one of them out"
        )
    return free[0]


def _variant(
    values: dict[str, str], words: dict[str, str], parameters: Mapping[str, float], budget: float | None
) -> Variant:
    own = {k: v for k, v in values.items() if not k.startswith("D.")}
    scene = {k[2:]: float(v) for k, v in values.items() if k.startswith("D.")}
    whole = words | own
    settings.words(whole)
    return Variant(values, whole, {**parameters, **scene}, budget)


def _axis(varied: dict[str, list[str]]) -> str:
    """The last varied number of rays; without one, the first varied number; else nothing."""
    several = [name for name, values in varied.items() if len(values) > 1]
    rays = [name for name in several if name in RAYS]
    if rays:
        return rays[-1]
    return next((name for name in several if all(map(is_number, varied[name]))), "")


def is_number(text: str) -> bool:
    """Whether a value of a variant is a number: the others are words."""
    try:
        float(text)
    except ValueError:
        return False
    return True
