"""Five tests of an estimator, by closed forms, by scale, by the number of rays, and by another estimator."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from antumbra.lecture.measures.points import irradiance_at
from antumbra.lecture.measures.ratio import excess, farthest_from_one, ratio
from antumbra.lecture.measures.seen import irradiance_seen
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import SceneOf
from antumbra.lecture.scenes.square_lights import floor_under_square, irradiance_under
from antumbra.lecture.variant import Pick
from antumbra.study.statistics import Interval, verdict

# By name, as the page heads them.
TESTS = {
    "below": "below, r = 1",
    "side": "side",
    "twice": "size × 2",
    "count": "N = 16 : 1",
    "other": "directions",
}
RAYS, WITHIN = 16, 0.02
# What an estimator finds: supported, undecided or not that it is right.
SIGNS = {"supported": "✓", "undecided": "?", "not supported": "✗"}
_SIDE, _TWICE, _BELOW = (
    floor_under_square(1.0, 1.25),
    floor_under_square(2.0, 2.5),
    floor_under_square(0.2, 1.0),
)
_AT, _TWICE_AT = (0.9, 0.0, 0.4), (1.8, 0.0, 0.8)


def passed(found: Quantity) -> str:
    """Whether the number over the one that it should be is 1 within `WITHIN`: a word of `SIGNS`."""
    low, high = found.interval
    return verdict(Interval(found.value, low, high), near=1.0, within=WITHIN)


def all_tests(run: Run, tested: Sequence[tuple[str, str, str]]) -> dict[str, Quantity]:
    """`name`-`test` for each name, estimator, mistake; the first two are right, the others wrong.

    found: how many of the wrong ones some test finds; below: how many of them pass straight below; worst: that of the
    right ones which may be farthest from 1; more: what the first wrong one gives too much at the side.
    """
    other = irradiance_at(run.scene(_SIDE), _AT, 2**18, run.seeded(1), estimator="hemisphere")
    each = {name: _five(run, row, e, m, other) for row, (name, e, m) in enumerate(tested)}
    names = list(each)
    right = [quantity for name in names[:2] for quantity in each[name].values()]
    words = [[passed(quantity) for quantity in each[name].values()] for name in names[2:]]
    return {
        **{f"{name}-{test}": quantity for name, all_of in each.items() for test, quantity in all_of.items()},
        "more": excess(each[names[2]]["side"]),
        "found": Quantity(sum("not supported" in row for row in words)),
        "below": Quantity(sum(row[0] == "supported" for row in words)),
        "worst": farthest_from_one(right),
    }


def _five(run: Run, row: int, estimator: str, mistake: str, other: Quantity) -> dict[str, Quantity]:
    """What each of `TESTS` finds of an estimator: the number over the one that it should be."""
    light = partial(_seen, run, estimator, mistake)
    first = run.seeded(8 * row)
    side = light(_SIDE, _AT, first + 2)
    return {
        "below": ratio(light(_BELOW, (0.0, 0.0, 0.0), first + 3), Quantity(irradiance_under(0.2, 1.0))),
        "side": ratio(side, Quantity(irradiance_under(1.0, 1.25, 0.9, 0.4))),
        "twice": ratio(light(_TWICE, _TWICE_AT, first + 4), side),
        "count": ratio(side, light(_SIDE, _AT, first + 5, rays=1)),
        "other": ratio(side, other),
    }


def _seen(
    run: Run,
    estimator: str,
    mistake: str,
    build: SceneOf,
    point: tuple[float, float, float],
    seed: int,
    rays: int = RAYS,
) -> Quantity:
    """Irradiance by an estimator, with as many shadow rays in all whatever the number per viewing ray."""
    viewing_rays = (16 if estimator == "area" else run.pick(Pick(64, 1024))) * (RAYS // rays)
    options = {"estimator": estimator, "mistake": mistake, "light_points": "area", "shadow_rays": rays}
    return irradiance_seen(run.scene(build), point, 0.5, viewing_rays, seed, **options)
