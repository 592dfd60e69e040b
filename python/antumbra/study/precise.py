"""How many rays a rendered reference needs: its own noise has to be small against the noise that is measured."""

from __future__ import annotations

from antumbra.study import renders, statistics
from antumbra.study.plan import LEAST_SEEDS, RAYS_PILOT, Plan, Variant
from antumbra.study.renders import REFERENCE_SEEDS, Work

# The reference's own error over the least noise of a variant, at most: a sixteenth of its square. For that a
# reference may take so many times a fair number of rays, in steps of 4.
_SMALL, _MOST = 0.25, 64
# A pilot's seeds, and the part of the rays of a fair reference that it has.
_SEEDS, _PART = 4, 16


def rays_needed(plan: Plan, work: Work, by: str) -> int:
    """Viewing rays of a reference by this estimator, over all of its seeds: a fair number, or more if pilots say so."""
    number = int(renders.reference_words(plan, by, 0)["viewing_rays"])
    truths: dict[object, list[Variant]] = {}
    for variant in plan.variants:
        truths.setdefault(variant.truth(), []).append(variant)
    needed = max(_needed(plan, work, by, number, variants) for variants in truths.values())
    most = number * _MOST
    while number < min(needed, most):
        number *= 4
    return number * REFERENCE_SEEDS


def _needed(plan: Plan, work: Work, by: str, fair: int, variants: list[Variant]) -> float:
    """Viewing rays of each seed, for the truth that these variants share."""
    least = min(
        (v for v in (_variance(plan, work, each) for each in _finest(variants)) if v > 0), default=0.0
    )
    words = renders.words_of(variants[0], renders.reference_words(plan, by, 0))
    words["viewing_rays"] = str(max(1, fair // _PART))
    pictures = [
        work.render(variants[0].parameters, words, plan.seed(RAYS_PILOT + k), "a pilot").pixels
        for k in range(_SEEDS)
    ]
    one = statistics.variance(renders.stacked(pictures)).value * int(words["viewing_rays"])
    return one / (REFERENCE_SEEDS * _SMALL**2 * least) if least else 0.0


def _finest(variants: list[Variant]) -> list[Variant]:
    """Those of the most samples: the least noise is among them."""
    samples = [viewing * shadow for viewing, shadow in (renders.numbers_of_rays(v.words) for v in variants)]
    return [v for v, count in zip(variants, samples, strict=True) if count == max(samples)]


def _variance(plan: Plan, work: Work, variant: Variant) -> float:
    """Of the first pictures of its row, which are kept for it."""
    seeds = map(plan.seed, range(LEAST_SEEDS))
    pictures = [work.ahead(variant.parameters, variant.words, seed) for seed in seeds]
    return statistics.variance(renders.stacked([picture.pixels for picture in pictures])).value
