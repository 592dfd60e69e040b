"""Renders for a study: one picture at a time with progress, budgets met by pilots, the reference."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from os import PathLike
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from antumbra import settings
from antumbra.errors import OptionError
from antumbra.study.plan import (
    ALL_LIGHT,
    COST_PILOT,
    DIRECT,
    METHOD,
    REFERENCE,
    Plan,
    Variant,
    shows,
)
from antumbra.study.rows import Pictures, Reference

if TYPE_CHECKING:
    from antumbra.image import Image
    from antumbra.scene import Scene

REFERENCE_SEEDS = 8
# The least viewing rays of one seed of a reference.
_LEAST = 16
# Pilots of a time budget grow until they take so long [s], so that their start-up does not count.
_PILOT_SECONDS = 0.05


class Step(NamedTuple):
    """How far a study is: the share `done` of its rays, 0 to 1, and `what` it renders, in words."""

    done: float
    what: str


class Work:
    """Keeps the scene that is open, and counts the rays done of those that were planned."""

    def __init__(
        self,
        open_scene: Callable[[Mapping[str, float]], Scene],
        watch: Callable[[Step], object] | None,
    ) -> None:
        """`open_scene` makes the scene of given parameters; the last one made is kept."""
        self._open_scene, self._watch = open_scene, watch
        self._key: tuple[tuple[str, float], ...] | None = None
        self._scene: Scene | None = None
        self.messages: dict[tuple[str, str, str], None] = {}
        self.planned, self._done = 0.0, 0.0
        self._ahead: dict[str, Image] = {}

    def scene(self, parameters: Mapping[str, float]) -> Scene:
        """The scene with these parameters."""
        key = tuple(sorted(parameters.items()))
        if self._scene is None or key != self._key:
            self._scene, self._key = None, key
            self._scene = self._open_scene(parameters)
            file = self._scene.name if "." in self._scene.name else ""
            self._say(
                (level, ": ".join(filter(None, (file, place))), text)
                for level, place, text in self._scene.messages
            )
        return self._scene

    def render(
        self, parameters: Mapping[str, float], words: Mapping[str, str], seed: int, what: str
    ) -> Image:
        """One picture, or that which was made `ahead`. Raises RenderStopped on Ctrl-C."""
        cost = _rays(words)
        if (made := self._ahead.pop(_name(parameters, words, seed), None)) is not None:
            self._done += cost
            return made

        def show(state: Any) -> None:
            if self._watch:
                # Pilots come before it is known how much is ahead.
                share = (self._done + cost * state.done) / self.planned if self.planned else 0.0
                self._watch(Step(min(1.0, share), what))

        image = self.scene(parameters).render(
            progress=show if self._watch else None, **{**words, "seed": str(seed)}
        )
        self._done += cost
        self._say(image.messages)
        return image

    def ahead(self, parameters: Mapping[str, float], words: Mapping[str, str], seed: int) -> Image:
        """A picture that a pilot needs before its row does: it is rendered once."""
        image = self.render(parameters, words, seed, "a pilot")
        self._ahead[_name(parameters, words, seed)] = image
        return image

    def plan(self, costs: float) -> None:
        """Begins to count: so many rays per pixel are ahead."""
        self.planned, self._done = costs, 0.0

    def _say(self, messages: Any) -> None:
        self.messages.update(dict.fromkeys(tuple(m) for m in messages))


def _name(parameters: Mapping[str, float], words: Mapping[str, str], seed: int) -> str:
    return json.dumps([sorted(parameters.items()), sorted(words.items()), seed])


def _rays(words: Mapping[str, str]) -> float:
    """About how much a picture costs, before it is known: viewing × (1 + shadow) rays."""
    viewing, shadow = numbers_of_rays(words)
    return float(viewing * (1 + shadow))


def numbers_of_rays(words: Mapping[str, str]) -> tuple[int, int]:
    """Viewing rays per pixel, and shadow rays of each."""
    table = settings.table()
    viewing, shadow = (int(words.get(n, table[n].default)) for n in ("viewing_rays", "shadow_rays"))
    return viewing, shadow


def cost(variants: Sequence[Variant], seeds: int, reference: Mapping[str, str] | None) -> float:
    """Of all renders of the variants, and of one reference for each truth."""
    truths = len({v.truth() for v in variants})
    long = _rays(reference) * REFERENCE_SEEDS * truths if reference else 0.0
    return sum(_rays(v.words) for v in variants) * seeds + long


def within_budget(plan: Plan, work: Work, pilots: dict[str, tuple[float, float]]) -> Plan:
    """The plan with the number of rays of each variant chosen so that all spend the same.

    `pilots`: what each kind of picture costs; those that are missing are found out.
    """
    if not plan.budget:
        return plan
    found = []
    for variant in plan.variants:
        words = {k: v for k, v in variant.words.items() if k != plan.chosen}
        key = json.dumps([sorted(words.items()), sorted(variant.parameters.items())])
        if key not in pilots:
            pilots[key] = _pilot(plan, variant, work)
        base, each = pilots[key]
        number = _number(plan, variant, base, each)
        found.append(replace(variant, words={**variant.words, plan.chosen: str(number)}))
    return replace(plan, variants=found)


def _number(plan: Plan, variant: Variant, base: float, each: float) -> int:
    budget = variant.budget or 0.0
    number = max(1, round((budget - base) / each))
    if number == 1 and base + each > 1.1 * budget:
        what = " ".join(variant.values.values())
        unit = "rays per pixel" if plan.budget == "rays" else "s"
        raise OptionError(
            f"budget of {budget:g} {unit}: {what} needs at least {base + each:.3g} for one ray of each kind"
        )
    return number


def _pilot(plan: Plan, variant: Variant, work: Work) -> tuple[float, float]:
    """What a picture costs as a + b·N: from two short renders, counted in rays per pixel or timed."""
    low, high = 1, 5

    def spent(number: int) -> float:
        words = {**variant.words, plan.chosen: str(number)}
        image = work.render(variant.parameters, words, plan.seed(COST_PILOT + number), "a pilot")
        return rays_per_pixel(image) if plan.budget == "rays" else image.seconds

    first, second = spent(low), spent(high)
    while plan.budget == "seconds" and second - first < _PILOT_SECONDS and high < 1 << 16:
        low, high, first = high, 4 * high, second
        second = spent(high)
    each = max((second - first) / (high - low), 1e-12)
    return max(first - each * low, 0.0), each


def rays_per_pixel(image: Image) -> float:
    """Viewing rays, bounces and shadow rays that were traced, per pixel."""
    return (image.rays + image.shadow_rays) / (image.width * image.height)


def reference_words(plan: Plan, estimator: str, rays: int) -> dict[str, str]:
    """Settings of a reference: those that decide what is shown, the estimator, its rays (0: a fair number)."""
    number = _LEAST if rays == 0 else 1
    # A power of four, for which Owen's points are balanced: at least what is asked, or at most what is fair.
    while number * REFERENCE_SEEDS < rays or (rays == 0 and 4 * number * REFERENCE_SEEDS <= _fair(plan)):
        number *= 4
    kept = {k: v for k, v in plan.fixed.items() if k not in METHOD or k == "threads"}
    return {**kept, "estimator": estimator, "viewing_rays": str(number)}


def _fair(plan: Plan) -> float:
    """As many samples as all variants of a truth take together: then half of the time goes into the reference."""
    samples = sum(viewing * shadow for viewing, shadow in (numbers_of_rays(v.words) for v in plan.variants))
    return samples * plan.seeds / len({v.truth() for v in plan.variants})


def reference_name(estimator: str, viewing_rays: str) -> str:
    """What a reference is, in words."""
    return f"{estimator}, {REFERENCE_SEEDS} seeds of {int(viewing_rays):,} viewing rays"


def estimators(plan: Plan) -> set[str]:
    """The estimators of the variants."""
    default = settings.table()["estimator"].default
    return {v.words.get("estimator", default) for v in plan.variants}


def check_shows(plan: Plan, estimator: str) -> None:
    """Raises OptionError if the variants, or a reference by this estimator, do not show the same light."""
    shown = {v.shows for v in plan.variants}
    if len(shown) > 1:
        raise OptionError(
            f"the estimators find different light ({', '.join(sorted(shown))}): no reference fits all of them"
            " (--bounces 1 keeps direct light)"
        )
    if estimator and shows(estimator, plan.fixed) not in shown:
        fit = DIRECT if shown == {"direct"} else ALL_LIGHT if shown == {"all"} else ("ambient-occlusion",)
        raise OptionError(
            f'reference "{estimator}" finds {shows(estimator, plan.fixed)} light, the variants'
            f" {', '.join(shown)} light: take {' or '.join(fit)}"
        )


def words_of(variant: Variant, words: Mapping[str, str]) -> dict[str, str]:
    """Settings of the reference of one truth: the reference's own, and what decides what this variant shows."""
    return {**words, **{k: v for k, v in variant.words.items() if k not in METHOD}}


def reference_by(plan: Plan, variant: Variant, words: Mapping[str, str], work: Work) -> Reference:
    """Renders the reference of a variant's truth."""
    own = words_of(variant, words)
    pictures = []
    for k in range(REFERENCE_SEEDS):
        what = f"reference, seed {k + 1} of {REFERENCE_SEEDS}"
        pictures.append(work.render(variant.parameters, own, plan.seed(REFERENCE + k), what).pixels)
    return Reference(reference_name(own["estimator"], own["viewing_rays"]), stacked(pictures))


def reference_of(
    path: str | PathLike[str], error: str | PathLike[str] | None, size: tuple[int, int]
) -> Reference:
    """A picture of a file as the reference, with its standard errors if another file has them."""
    from antumbra.image import load_image

    picture = _fitting(load_image(path), str(path), size)
    own = None if error is None else _fitting(load_image(error), str(error), size)
    said = (
        f"its own error from {error}" if error is not None else "taken as exact: its own error is not known"
    )
    return Reference(f"{path} ({said})", picture[None], own)


def _fitting(picture: Any, name: str, size: tuple[int, int]) -> Pictures:
    height, width = picture.shape[:2]
    if (width, height) != size:
        raise OptionError(
            f"{name} is {width} × {height}, the pictures of this study {size[0]} × {size[1]}: the same size is needed"
        )
    return np.asarray(picture, np.float64)


def stacked(pictures: list[Any]) -> Pictures:
    """Pictures of different seeds as one array in double precision, (K, H, W, 3)."""
    return np.stack([np.asarray(p, np.float64) for p in pictures])
