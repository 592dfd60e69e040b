"""Asks a function every question of `cases`, compares, and names what is wrong: `check`."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.checks.cases import KINDS, Case, Kind
from antumbra.checks.law import followed, in_words
from antumbra.checks.report import Report, Row
from antumbra.own import AnswerError, Estimator, Numbers, checked
from antumbra.scene import builtin

# False alarms of a whole check, shared among its rows. Where few samples find a lamp their mean is not quite normal: a
# few hundred of 32,768 make it five times what the normal law says, which 10⁻³ leaves room for.
ALPHA = 2e-4
# Answers are sums of single-precision numbers: 10 of their roundings.
ROUNDING = 1e-6
# Below this share of the truth an answer is none.
DARK = 1e-3
# Answers at a time, and how often.
RUN, RUNS = 1 << 13, 4


def check(
    function: Estimator,
    *,
    kind: str = "light",
    noise: Mapping[str, float] | None = None,
    seed: int = 0,
    progress: Callable[[str], object] | None = None,
) -> Report:
    """Whether an estimator of your own is right: closed forms, a furnace, and agreement with the built-in ones.

    `function(scene, at, u)` as `Scene.render(estimator=function)` takes it. `kind`: "light"; "lamps" for one that sees
    surfaces that shine, but no light from infinity; "occlusion" for one that returns openness (1 = open). `noise`: for
    questions by name, the largest standard deviation that one answer may have.
    The function is asked for each receiver by itself: numbers that receivers share would be taken for an error.
    Each answer is a mean of 32,768 samples, compared with the truth at z standard errors, where z makes a false alarm
    in the whole check rarer than 10⁻³. `progress` hears the name of each question that was answered. An answer that is
    no light (another shape, not finite) ends the check and is one of its faults.

    What the function itself raises goes through.

    >>> import antumbra as am
    >>> def black(scene, at, u):
    ...     return at.t * 0
    >>> am.check(black).passed
    False
    """
    if kind not in KINDS:
        raise ValueError(f'kind is "{kind}": one of {", ".join(KINDS)} is needed')
    for question, limit in (noise or {}).items():
        if question not in {case.name for case in KINDS[kind].cases} or not limit > 0:
            raise ValueError(
                f'noise: "{question}" up to {limit}: the name of a question and a number above 0 are needed'
            )
    began = time.perf_counter()
    asked, limits, name = KINDS[kind], noise or {}, getattr(function, "__name__", type(function).__name__)
    tests = len(asked.cases) + len(asked.scenes) * (1 + _TILES)
    z = NormalDist().inv_cdf(1 - ALPHA / tests / 2)
    rows, faults = [], []
    try:
        for row in _rows(function, name, asked, limits, seed, z):
            rows.append(row)
            if progress is not None:
                progress(row.name)
    except AnswerError as problem:
        faults = [str(problem)]
    if not all(row.agrees for row in rows):
        faults = [*_faults(asked, rows), *faults]
    return Report(name, rows, faults, time.perf_counter() - began)


def _rows(
    function: Estimator, name: str, asked: Kind, limits: Mapping[str, float], seed: int, z: float
) -> Iterator[Row]:
    for number, case in enumerate(asked.cases):
        mean, error = _ask(function, name, case, np.random.default_rng((seed, number)))
        agrees = abs(mean - case.truth) <= z * error + ROUNDING * max(case.truth, abs(mean))
        yield Row(case.name, mean, error, case.truth, bool(agrees))
        if case.name in limits:
            deviation, limit = error * np.sqrt(RUN * RUNS), limits[case.name]
            yield Row(f"noise, {case.name}", deviation, 0.0, limit, bool(deviation <= limit))
    for scene in asked.scenes:
        yield _agreement(function, scene, asked.estimator, seed, z)


def _ask(function: Estimator, name: str, case: Case, random: np.random.Generator) -> tuple[float, float]:
    """Mean and standard error of independent answers, the mean of their colours each."""
    scene, values = case.scene(), []
    at = scene.closest_hit(*case.rays(RUN))

    def pair(nth: int, paired: bool) -> NDArray[np.float32]:
        return random.random((RUN, 2), dtype=np.float32)

    for _ in range(RUNS):
        values.append(checked(name, function(scene, at, Numbers(pair)), RUN).mean(axis=1))
    all_values = np.concatenate(values)
    return float(all_values.mean()), float(all_values.std(ddof=1) / np.sqrt(len(all_values)))


# The pictures that are compared: their size, and the tiles of 12 × 12 pixels that are compared beside their means.
_SIZE, _TILE, _RAYS = (48, 36), 12, 64
_TILES = (_SIZE[0] // _TILE) * (_SIZE[1] // _TILE)


def _agreement(function: Estimator, name: str, estimator: str, seed: int, z: float) -> Row:
    """The whole picture and its tiles against those of an estimator of the program."""
    scene = builtin(name)
    how: dict[str, Any] = {"size": _SIZE, "viewing_rays": _RAYS, "viewing": "centre", "sampler": "random"}
    mine = scene.render(estimator=function, seed=seed, **how)
    theirs = scene.render(estimator=estimator, seed=seed + 1, **how)
    values = [image.pixels.astype(np.float64).mean(axis=2) for image in (mine, theirs)]
    errors = [_error(image.standard_error) for image in (mine, theirs)]
    difference, variance = values[0] - values[1], errors[0] ** 2 + errors[1] ** 2
    error = float(np.sqrt(variance.sum()) / variance.size)
    # A tile without any noise at all (its lights are hidden from every pixel) agrees to rounding.
    off = np.abs(_tiles(difference)) > z * np.sqrt(_tiles(variance) / _TILE**2) + ROUNDING * values[1].max()
    agrees = abs(difference.mean()) <= z * error + ROUNDING * values[1].mean() and not off.any()
    return Row(
        f"{name}, against {estimator}", float(values[0].mean()), error, float(values[1].mean()), bool(agrees)
    )


def _error(standard_error: NDArray[np.float32] | None) -> NDArray[np.float64]:
    """Of the mean of three colours, which share their samples: at most the mean of their errors."""
    assert standard_error is not None  # 64 viewing rays make 4 replicates
    return np.asarray(standard_error.mean(axis=2), np.float64)


def _tiles(values: NDArray[np.float64]) -> NDArray[np.float64]:
    width, height = _SIZE
    tiles = values.reshape(height // _TILE, _TILE, width // _TILE, _TILE)
    return np.asarray(tiles.mean(axis=(1, 3)), np.float64)


def _faults(asked: Kind, rows: Sequence[Row]) -> list[str]:
    """What the wrong answers have in common, in words."""
    answered = {row.name: row for row in rows}
    under = [(case.lamp, answered[case.name]) for case in asked.cases if case.lamp and case.name in answered]
    if under and all(abs(row.answer) < DARK * row.truth for _, row in under):
        return [asked.dark]
    if len(under) < sum(case.lamp is not None for case in asked.cases):
        return []
    law = followed(
        [lamp for lamp, _ in under],
        [row.answer / row.truth for _, row in under],
        [row.error / row.truth for _, row in under],
    )
    said = in_words(law, asked.albedo) if law else []
    return said or [_hint(asked, rows)]


def _hint(asked: Kind, rows: Sequence[Row]) -> str:
    """What the first wrong answer betrays: each question is there to find a fault of its own."""
    # Where one lamp alone is wrong already, what more there is to see tells nothing of its own.
    alone = {case.name for case in asked.cases if case.lamp}
    right = all(row.agrees for row in rows if row.name in alone)
    hints = {case.name: case.hints for case in asked.cases if right}
    for row in rows:
        share = row.answer / row.truth
        for (low, high), text in () if row.agrees else hints.get(row.name, ()):
            if low <= share <= high:
                return text
        if row.name.startswith("noise") and not row.agrees:
            return f"right, but too noisy: one answer deviates by {row.answer:.2g}, {row.truth:.2g} is asked"
    return "no single term explains this: compare the rows that are wrong with those that agree"
