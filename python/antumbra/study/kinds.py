"""Which estimator is to be the reference: one that shares no part with those that are varied, where there is one."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.study import renders
from antumbra.study.plan import ALL_LIGHT, KIND_PILOT, Plan, Variant
from antumbra.study.quantiles import t_quantile
from antumbra.study.renders import REFERENCE_SEEDS, Work

# What finds the light of each: an error in a part is an error of all that are made of it.
PARTS = {
    "area": {"area"},
    "hemisphere": {"hemisphere"},
    "surfaces": {"surfaces"},
    "mis": {"area", "hemisphere"},
    "path": {"area", "hemisphere"},
    "path-hemisphere": {"hemisphere"},
}
# A reference whose mean is known less well than this, as a part of itself, is too noisy: 95 %, of the whole picture.
# One that shares parts with the variants gives up more of what a reference is for, so it may be noisier.
_NOISY, _NOISY_SHARED = 0.01, 0.05
# What samples lights and directions both finds all light, also that which is small: pilots are held against it.
_TRUSTED = {"direct": "mis", "all": "path"}
# A pilot's seeds, and the part of the reference's rays that it has.
_SEEDS, _PART = 4, 16


class Choice(NamedTuple):
    """The estimator of the reference, and why those that share nothing with the variants are not it, by name."""

    kind: str
    refused: dict[str, str]


def any_other(plan: Plan) -> str:
    """An estimator of the same light that the plan does not vary, the least noisy one; nothing if there is none."""
    used, shown = renders.estimators(plan), {v.shows for v in plan.variants}
    if shown == {"ambient occlusion"}:
        return ""
    kinds = ("mis", "area", "hemisphere", "surfaces") if shown == {"direct"} else ALL_LIGHT
    return next((kind for kind in kinds if kind not in used), "")


def apart(plan: Plan) -> list[str]:
    """Estimators of the same light that share no part with those that the plan varies, the likeliest first."""
    if {v.shows for v in plan.variants} != {"direct"}:
        return []
    return [kind for kind in ("area", "hemisphere", "surfaces") if not shared(kind, plan)]


def shared(kind: str, plan: Plan) -> list[str]:
    """Estimators of the plan that have a part in common with this one."""
    own = PARTS.get(kind, {kind})
    return sorted(used for used in renders.estimators(plan) if own & PARTS.get(used, {used}))


def chosen(plan: Plan, work: Work, rays: int) -> Choice:
    """The first that sees all light and is not too noisy, as short pilots find: of `apart`, then of the others.

    Without one it is that which samples lights and directions both, though the plan varies it.
    """
    trusted = _TRUSTED[plan.variants[0].shows]
    truths = list({v.truth(): v for v in plan.variants}.values())
    refused: dict[str, str] = {}
    for kind in dict.fromkeys([*apart(plan), any_other(plan)]):
        most = _NOISY_SHARED if shared(kind, plan) else _NOISY
        why = ""
        # Light points miss no light; of the last choice that is enough.
        if kind != trusted and not kind == any_other(plan) == "area":
            wrong = (_wrong(plan, work, variant, kind, trusted, rays, most) for variant in truths)
            why = next(filter(None, wrong), "")
        if not why:
            return Choice(kind, refused)
        refused[kind] = why
    return Choice(trusted, refused)


def _wrong(plan: Plan, work: Work, variant: Variant, kind: str, other: str, rays: int, most: float) -> str:
    """What speaks against an estimator as the reference of a variant's truth; nothing if all is well."""
    work.scene(variant.parameters)
    said = dict(work.messages)
    try:
        means, part = _pilot(plan, work, variant, kind, rays)
        # The renderer itself says what an estimator is blind to.
        if any("does not see" in text for _, _, text in work.messages.keys() - said.keys()):
            return "does not see all lights here"
        mean, spread = float(means.mean()), float(means.std(ddof=1))
        noise = t_quantile(0.975, REFERENCE_SEEDS - 1) * spread * math.sqrt(part / REFERENCE_SEEDS)
        if mean == 0 or noise > most * mean:
            return "is too noisy here"
        against, _ = _pilot(plan, work, variant, other, rays)
    finally:
        work.messages = said
    # Light that few directions find is missing from a pilot without a trace in its spread.
    error = math.hypot(spread, float(against.std(ddof=1))) / math.sqrt(_SEEDS)
    if abs(mean - float(against.mean())) <= max(_NOISY * mean, t_quantile(0.975, _SEEDS - 1) * error):
        return ""
    return f"finds {100 * mean / float(against.mean()):.0f} % of the light of {other} in a pilot"


def _pilot(
    plan: Plan, work: Work, variant: Variant, kind: str, rays: int
) -> tuple[NDArray[np.float64], float]:
    """Means of pictures, one for each seed, and which part of the reference's rays they have."""
    words = renders.words_of(variant, renders.reference_words(plan, kind, rays))
    whole = int(words["viewing_rays"])
    words["viewing_rays"] = str(max(1, whole // _PART))
    pictures = (
        work.render(variant.parameters, words, plan.seed(KIND_PILOT + k), "a pilot") for k in range(_SEEDS)
    )
    means = [float(np.asarray(p.pixels, np.float64).mean()) for p in pictures]
    return np.array(means), int(words["viewing_rays"]) / whole
