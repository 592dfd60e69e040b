"""How often `antumbra check` calls a right estimator wrong, and finds each planted fault: `python check_rates.py`.

A check is repeated thousands of times with answers that are drawn again, with replacement, from many stored ones of the
same function: all of the check runs but the function itself.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import numpy as np

import antumbra as am
from antumbra.checks import Report
from antumbra.checks import run as asked
from own_estimators import RIGHT, WRONG

# Answers that are stored for each receiver of a question, and for each pixel of a picture.
STORED = {"question": 16 * asked.RUNS, "picture": 20 * asked._RAYS}
# Pictures of the built-in estimator, in turn.
PICTURES = 40


def repeated(
    estimator: Any, count: int, *, pictures: bool, about_itself: bool, share: float = 1
) -> Iterator[Report]:
    """`count` checks; `about_itself`: against the mean of what is stored, so that nothing but chance can be wrong.

    `share`: of what is stored, for a coarse run.
    """
    kind = asked.KINDS["light"]
    if not pictures:
        kind = kind._replace(scenes=())
    random, answers = np.random.default_rng(7), asked._answers
    stored, cases = [], []
    for case in kind.cases:
        scene = case.scene()
        at = scene.closest_hit(*case.rays(asked.RUN))
        values = answers(estimator, "", scene, at, round(STORED["question"] * share), random).ravel()
        truth = float(values.mean()) if about_itself else case.truth
        cases.append(case._replace(scene=cache(case.scene), truth=truth))
        stored.append(values)
    shown = {name: _Shown(name, estimator, share, random) for name in kind.scenes}
    turn = iter(())

    def again(*_: Any) -> Any:
        return next(turn)(random)

    with _replaced(kind._replace(cases=cases), shown, again):
        for seed in range(count):
            turn = iter([*map(_redrawn, stored), *(each.redrawn for each in shown.values())])
            yield am.check(estimator, seed=seed)


def _redrawn(values: Any) -> Callable[[Any], Any]:
    shape = (asked.RUNS, asked.RUN)
    return lambda random: values[random.integers(0, len(values), shape)]


@contextmanager
def _replaced(kind: Any, shown: dict[str, _Shown], again: Callable[..., Any]) -> Iterator[None]:
    kinds = {**asked.KINDS, "light": kind}
    with (
        patch.object(asked, "KINDS", kinds),
        patch.object(asked, "builtin", shown.__getitem__),
        patch.object(asked, "_answers", again),
    ):
        yield


class _Shown:
    """A built-in scene whose pictures are rendered beforehand, about the mean of the stored answers."""

    def __init__(self, name: str, estimator: Any, share: float, random: Any) -> None:
        self._scene = scene = am.builtin(name)
        self.camera_rays, self.closest_hit = scene.camera_rays, scene.closest_hit
        look = {"size": asked._SIZE, "viewing_rays": asked._RAYS, "viewing": "centre", "sampler": "random"}
        times, pictures = round(STORED["picture"] * share), round(PICTURES * share)
        made = [scene.render(**look, estimator="mis", seed=s, aov="emission") for s in range(pictures)]
        dark = ~made[0].aov["emission"].any(axis=2).ravel()
        origins, directions = scene.camera_rays(asked._SIZE)
        (rows,) = (np.isfinite(scene.closest_hit(origins, directions).t) & dark).nonzero()
        at = scene.closest_hit(origins[rows], directions[rows])
        self._values = asked._answers(estimator, name, scene, at, times, random).T.astype(np.float32)
        shift = np.zeros((len(dark), 3))
        mean = np.mean([image.pixels.reshape(-1, 3).mean(axis=1) for image in made], axis=0)
        shift[rows] = (self._values.mean(axis=1, dtype=float) - mean[rows])[:, None]
        self._made = [
            SimpleNamespace(
                pixels=image.pixels + shift.reshape(image.pixels.shape),
                standard_error=image.standard_error,
                aov=image.aov,
            )
            for image in made
        ]

    def render(self, *, seed: int, **_: Any) -> Any:
        return self._made[seed % len(self._made)]

    def redrawn(self, random: Any) -> Any:
        chosen = random.integers(0, self._values.shape[1], (len(self._values), asked._RAYS))
        return np.take_along_axis(self._values, chosen, 1).T.astype(np.float64)


def false_alarms(estimator: Any, count: int, share: float = 1) -> int:
    """How many of `count` checks call a right estimator wrong."""
    checks = repeated(estimator, count, pictures=True, about_itself=True, share=share)
    return sum(not report.passed for report in checks)


def caught(fault: str, count: int) -> tuple[int, int]:
    """How many of `count` checks, without the pictures, find a planted fault, and how many name it rightly."""
    estimator, words = WRONG[fault]
    reports = [*repeated(estimator, count, pictures=False, about_itself=False, share=0.25)]
    return sum(not r.passed for r in reports), sum(
        len(r.faults) == 1 and words in r.faults[0] for r in reports
    )


def main(rights: int, wrongs: int) -> None:
    """Prints both tables."""
    began = time.monotonic()
    print("| right estimator | checks | called wrong |\n|---|---|---|")
    for estimator in RIGHT:
        print(f"| `{estimator.__name__}` | {rights} | {false_alarms(estimator, rights)} |", flush=True)
    print("\n| planted fault | checks | caught | and named |\n|---|---|---|---|")
    for fault in WRONG:
        found, named = caught(fault, wrongs)
        print(f"| {fault} | {wrongs} | {found} | {named} |", flush=True)
    print(f"\n{time.monotonic() - began:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
