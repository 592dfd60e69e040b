"""Asks a function every question of `cases`, compares, and names what is wrong: `check`."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.checks.cases import KINDS, Case, Kind
from antumbra.checks.law import followed, in_words
from antumbra.checks.report import Report, Row
from antumbra.hit import Hit
from antumbra.image import Image
from antumbra.own import AnswerError, Estimator, Numbers, checked
from antumbra.scene import Scene, builtin

Values = NDArray[np.float64]

# False alarms of a whole check, shared among its rows and tiles. Means of few hits are not quite normal: the whole may
# be five times that, and stays below 10⁻³.
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
    check_options(kind, noise)
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


def check_options(kind: str = "light", noise: Mapping[str, float] | None = None) -> None:
    """Raises ValueError if these are no `kind` and `noise` of `check`."""
    if kind not in KINDS:
        raise ValueError(f'kind is "{kind}": one of {", ".join(KINDS)} is needed')
    for question, limit in (noise or {}).items():
        if question not in {case.name for case in KINDS[kind].cases} or not limit > 0:
            raise ValueError(
                f'noise: "{question}" up to {limit}: the name of a question and a number above 0 are needed'
            )


def _rows(
    function: Estimator, name: str, asked: Kind, limits: Mapping[str, float], seed: int, z: float
) -> Iterator[Row]:
    for number, case in enumerate(asked.cases):
        found = _ask(function, name, case, np.random.default_rng((seed, number)))
        mean, error = float(found.mean), float(found.variance**0.5)
        yield Row(case.name, mean, error, case.truth, not off(found, case.truth, found.weight, z).any())
        if case.name in limits:
            deviation, limit = error * np.sqrt(RUN * RUNS), limits[case.name]
            yield Row(f"noise, {case.name}", deviation, 0.0, limit, bool(deviation <= limit))
    for number, scene in enumerate(asked.scenes):
        random = np.random.default_rng((seed, number, 1))
        yield _agreement(function, name, scene, asked.estimator, seed, random, z)


class Found(NamedTuple):
    """Means of `answers` independent ones each, the variance of these means, and the `weight` of a hit, Σx²/Σx."""

    mean: Values
    variance: Values
    weight: Values
    answers: int


def _ask(function: Estimator, name: str, case: Case, random: np.random.Generator) -> Found:
    """The mean of independent answers, the mean of their colours each."""
    scene = case.scene()
    values = _answers(function, name, scene, scene.closest_hit(*case.rays(RUN)), RUNS, random)
    return Found(values.mean(), values.var(ddof=1) / values.size, _weight(values, None), values.size)


def _answers(
    function: Estimator, name: str, scene: Scene, at: Hit, times: int, random: np.random.Generator
) -> Values:
    """What the function answers, again and again for the same receivers, (times, N)."""

    def pair(nth: int, paired: bool) -> NDArray[np.float32]:
        return random.random((len(at), 2), dtype=np.float32)

    answers = (checked(name, function(scene, at, Numbers(pair)), len(at)) for _ in range(times))
    return np.array([answer.mean(axis=1) for answer in answers])


def _weight(values: Values, axis: tuple[int, ...] | None) -> Values:
    """Σx²/Σ|x|: the mean light of answers that find some, each as often as it counts; 0 where none does."""
    size = np.abs(values).sum(axis=axis)
    return np.asarray((values**2).sum(axis=axis) / np.where(size > 0, size, 1))


def off(found: Found, truth: Values | float, weight: Values | float, z: float) -> NDArray[np.bool_]:
    """Which means are off by more than z standard errors.

    Where few answers find the light, a mean that lacks some also looks less noisy than it is. So what it lacks counts
    as hits of this `weight` that did not come: for equal hits the variance is then Poisson's under the truth.
    """
    lacking = np.maximum(truth - found.mean, 0) * weight / found.answers
    rounding = ROUNDING * np.maximum(truth, np.abs(found.mean))
    return np.asarray(np.abs(found.mean - truth) > z * np.sqrt(found.variance + lacking) + rounding)


# The pictures that are compared: their size, and the tiles of 12 × 12 pixels that are compared beside their means.
_SIZE, _TILE, _RAYS, _TIMES = (48, 36), 12, 64, 16
_TILES = (_SIZE[0] // _TILE) * (_SIZE[1] // _TILE)


def _agreement(
    function: Estimator,
    name: str,
    scene: str,
    estimator: str,
    seed: int,
    random: np.random.Generator,
    z: float,
) -> Row:
    """The whole picture and its tiles against those of an estimator of the program, where no light itself is seen."""
    made = builtin(scene)
    theirs = made.render(
        size=_SIZE,
        viewing_rays=_RAYS,
        viewing="centre",
        sampler="random",
        estimator=estimator,
        seed=seed,
        aov="emission",
    )
    rays = made.camera_rays(_SIZE)
    dark = ~theirs.aov["emission"].any(axis=2).ravel()
    (rows,) = (np.isfinite(made.closest_hit(*rays).t) & dark).nonzero()
    many = np.tile(rows, _RAYS // _TIMES)
    at = made.closest_hit(rays[0][many], rays[1][many])
    values = np.zeros((_RAYS, _SIZE[0] * _SIZE[1]))
    values[:, rows] = _answers(function, name, made, at, _TIMES, random).reshape(_RAYS, len(rows))
    return _compared(f"{scene}, against {estimator}", values, rows, theirs, z)


def _compared(name: str, values: Values, rows: NDArray[np.intp], theirs: Image, z: float) -> Row:
    """A picture's answers, (times, H·W), against a picture at the pixels `rows`; the others are black."""
    truth, variance = np.zeros(values.shape[1]), np.zeros(values.shape[1])
    truth[rows] = theirs.pixels.astype(np.float64).mean(axis=2).ravel()[rows]
    variance[rows] = _error(theirs.standard_error).ravel()[rows] ** 2
    variance += values.var(axis=0, ddof=1) / len(values)
    mean = values.mean(axis=0)
    weights = _weight(_in_tiles(values), (0, 2, 4))
    tiles = Found(_tiles(mean), _tiles(variance) / _TILE**2, weights, len(values) * _TILE**2)
    whole = Found(mean.mean(), variance.mean() / mean.size, _weight(values, None), values.size)
    # A tile of few hits does not know how much light they bring: no less than where they bring most.
    wrong = off(whole, truth.mean(), whole.weight, z) | off(tiles, _tiles(truth), weights.max(), z).any()
    return Row(name, float(mean.mean()), float(whole.variance**0.5), float(truth.mean()), not wrong)


def _error(standard_error: NDArray[np.float32] | None) -> Values:
    """Of the mean of three colours, which share their samples: at most the mean of their errors."""
    assert standard_error is not None  # 64 viewing rays make 4 replicates
    return np.asarray(standard_error.mean(axis=2), np.float64)


def _in_tiles(values: Values) -> Values:
    """(…, H·W) as (…, tiles down, 12, tiles across, 12)."""
    (width, height), ahead = _SIZE, values.shape[:-1]
    return values.reshape(*ahead, height // _TILE, _TILE, width // _TILE, _TILE)


def _tiles(values: Values) -> Values:
    return np.asarray(_in_tiles(values).mean(axis=(-3, -1)), np.float64)


def _faults(asked: Kind, rows: Sequence[Row]) -> list[str]:
    """What the wrong answers have in common, in words."""
    answered = {row.name: row for row in rows}
    under = [(case.lamp, answered[case.name]) for case in asked.cases if case.lamp and case.name in answered]
    if under and all(_is_dark(row) for _, row in under):
        return [asked.dark]
    # Nothing has too much light: a wrong law would give some lamps more.
    if any(_is_dark(row) for _, row in under) and all(row.agrees or row.answer < row.truth for row in rows):
        return [asked.darkened]
    if len(under) < sum(case.lamp is not None for case in asked.cases):
        return []
    law = followed(
        [lamp for lamp, _ in under],
        [row.answer / row.truth for _, row in under],
        [row.error / row.truth for _, row in under],
        asked.laws,
    )
    said = in_words(law, asked.albedo) if law else []
    return said or [_hint(asked, rows)]


_DARKER = (
    "false shadow in a whole picture alone: for its large coordinates, which are rounded more, the offset of shadow "
    "rays is too small; give `at`, which knows a safe start"
)


def _is_dark(row: Row) -> bool:
    return abs(row.answer) < DARK * row.truth


def _hint(asked: Kind, rows: Sequence[Row]) -> str:
    """What the first wrong answer betrays: each question is there to find a fault of its own."""
    # Where one lamp alone is wrong already, what more there is to see tells nothing of its own.
    alone = {case.name for case in asked.cases if case.lamp}
    right = all(row.agrees or _is_dark(row) for row in rows if row.name in alone)
    hints = {case.name: case.hints for case in asked.cases if right}
    for row in rows:
        share = row.answer / row.truth
        for (low, high), text in () if row.agrees else hints.get(row.name, ()):
            if low <= share <= high:
                return text
        if row.name.startswith("noise") and not row.agrees:
            return f"right, but too noisy: one answer deviates by {row.answer:.2g}, {row.truth:.2g} is asked"
    closed = {case.name for case in asked.cases}
    if all(row.agrees or (row.name not in closed and row.answer < row.truth) for row in rows):
        return _DARKER
    return "no single term explains this: compare the rows that are wrong with those that agree"
