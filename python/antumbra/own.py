"""Estimators of your own: a function of arrays, rendered as a built-in one is.

The area form of the rendering equation, L = ∫ f_r L_e V cos θ dω with ω drawn toward a light point, in six lines:

>>> import antumbra as am
>>> import numpy as np
>>> def area(scene, at, u):
...     s = scene.sample_light(at, u=u(3))
...     f = scene.brdf(at, at.wo, s.direction)
...     cos = np.maximum((at.shading_normal * s.direction).sum(axis=1), 0)
...     free = ~scene.occluded(at, s.target)
...     return f * s.radiance * (cos * free / s.pdf)[:, None]
>>> image = am.builtin("pillars").render(estimator=area, viewing_rays=4, size=(32, 24))
>>> image.pixels.shape
(24, 32, 3)

The function is asked once a pass, for all viewing rays that meet a surface together: `scene`; `at`, their `Hit` (N
rows: position, normal, shading_normal, wo; it goes into every query); `u`, its random numbers. It returns the light
that each surface reflects to the viewer, (N, 3) or (N,). What a viewing ray sees of the lights themselves is added.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra import _core, settings
from antumbra.errors import OptionError, RenderStopped
from antumbra.hit import Hit
from antumbra.image import Image
from antumbra.messages import Progress

# Viewing rays that the function is asked for at once.
RUN = 1 << 18


class Numbers:
    """Random numbers of one pass: `u(n)` gives (N, n) float32 in [0, 1), other ones at each call.

    They are those of the sampler that the render was asked for, so a pixel's samples are stratified as a built-in
    estimator's are. `u(3)` is one number, then a pair that is even over the square: which light, where on it.
    """

    def __init__(self, pair: Callable[[int, bool], NDArray[np.float32]]) -> None:
        """`pair(nth, paired)` gives (N, 2): the nth pair, or the nth of the numbers that stand alone."""
        self._pair, self._pairs, self._singles = pair, 0, 0

    def __call__(self, n: int) -> NDArray[np.float32]:
        """The next `n` numbers of every receiver."""
        return np.concatenate([*self._columns(n)], axis=1)

    def _columns(self, n: int) -> Iterator[NDArray[np.float32]]:
        if n < 1:
            raise ValueError(f"u({n}): at least one number is needed")
        if n % 2:
            yield self._pair(self._singles, False)[:, :1]
            self._singles += 1
        for _ in range(n // 2):
            yield self._pair(self._pairs, True)
            self._pairs += 1


class AnswerError(ValueError):
    """What a function of one's own returned is no light: another shape, or numbers that are not finite."""


Estimator = Callable[[Any, Hit, Numbers], ArrayLike]
Watch = Callable[[Progress], object]

# Settings that a render heeds whatever estimator it has; the others are what the function itself decides.
_HEEDED = {
    "viewing_rays",
    "sampler",
    "rotate",
    "pairing",
    "viewing",
    "filter",
    "seed",
    "exposure",
    "tone",
    "exr",
}


def render(
    core: _core.Scene,
    name: str,
    reflected: Callable[[Hit, Numbers], ArrayLike],
    options: dict[str, Any],
    progress: Watch | None,
) -> Image:
    """A picture by the function `reflected` called `name`; `Scene.render(estimator=function)` comes here.

    Raises OptionError for settings that only built-in estimators heed, AnswerError (a ValueError) for what is
    no (N, 3) or (N,) of finite numbers.
    """
    table = settings.table()
    for option in options:
        if option in table and table[option].group != "Camera" and option not in _HEEDED:
            raise OptionError(f"{option} is not heeded with a function as estimator ({name})")
    began = time.perf_counter()
    suggested = {key: word for key, word in core.suggested().items() if key in _HEEDED | {"size"}}
    words = {**suggested, **settings.words(options)}
    sums = _Sums(core, words, name)
    try:
        for number in range(sums.passes):
            sums.add(number, _one_pass(core, name, reflected, [*words.items()], number))
            told = Progress(number + 1, sums.passes, (number + 1) / sums.passes)
            if progress is not None and progress(told) is False:
                break
    except KeyboardInterrupt:
        raise RenderStopped(sums.image(core.name, began) if sums.done else None) from None
    return sums.image(core.name, began)


def _one_pass(
    core: _core.Scene,
    name: str,
    reflected: Callable[[Hit, Numbers], ArrayLike],
    words: list[tuple[str, str]],
    number: int,
) -> NDArray[np.float64]:
    """What viewing rays see of the lights in one pass, and what the surfaces reflect, (H·W, 3)."""
    origins, directions = core.camera_rays(words, number)
    light = np.zeros((len(origins), 3))
    asked = cache(lambda nth, paired: core.pass_numbers(words, number, nth, paired))
    for start in range(0, len(origins), RUN):
        run = slice(start, start + RUN)
        met = core.closest_hit(origins[run], directions[run], np.broadcast_to(np.inf, len(origins[run])))
        light[run] = met.emitted()
        (rows,) = np.isfinite(met.t()).nonzero()
        if len(rows):
            at, numbers = Hit(met.take(rows.astype(np.uint64))), Numbers(_Rows(asked, rows + start))
            light[rows + start] += checked(name, reflected(at, numbers), len(rows))
    return light


class _Rows:
    """The numbers of some pixels of a pass."""

    def __init__(self, asked: Callable[[int, bool], NDArray[np.float32]], rows: NDArray[np.intp]) -> None:
        self._asked, self._rows = asked, rows

    def __call__(self, nth: int, paired: bool) -> NDArray[np.float32]:
        return self._asked(nth, paired)[self._rows]


def checked(name: str, answer: ArrayLike, count: int) -> NDArray[np.float64]:
    """What a function of one's own returned, as (N, 3); AnswerError says what is wrong with it."""
    try:
        values = np.asarray(answer)
    except (ValueError, TypeError) as problem:
        raise AnswerError(f"{name} returned {type(answer).__name__}, no array ({problem})") from problem
    if values.dtype.kind not in "fiub":
        raise AnswerError(f"{name} returned {values.dtype}: numbers are needed")
    if values.shape == (count,):
        values = np.repeat(values[:, None], 3, axis=1)
    if values.shape != (count, 3):
        raise AnswerError(f"{name} returned shape {values.shape}: ({count}, 3) or ({count},) is needed")
    wrong = ~np.isfinite(values).all(axis=1)
    if wrong.any():
        row = int(wrong.argmax())
        raise AnswerError(
            f"{name} returned {values[row]} for receiver {row} of {count} ({wrong.sum()} such rows): finite numbers "
            "are needed"
        )
    return values.astype(np.float64)


class _Sums:
    """Passes summed by replicate, as the film of a built-in estimator sums them."""

    def __init__(self, core: _core.Scene, words: dict[str, str], name: str) -> None:
        # The shortest render of the same settings tells what a picture's metadata say of them.
        told, _ = core.render([*words.items(), ("bounces", "0"), ("passes", "1")], None)
        if told is None:
            raise RenderStopped(None)
        pixels, _, _, metadata, (_, _, _, _, self.window) = told.parts()
        self.shape, self.metadata = pixels.shape, dict(metadata)
        self.metadata["antumbra.estimator"] = f"{name} (a function of Python)"
        self.metadata.pop("antumbra.bounces", None)
        self.replicate_of = core.pass_replicates([*words.items()])
        self.passes, self.lengths = len(self.replicate_of), np.bincount(self.replicate_of)
        # Of each replicate, how many passes, and their sum.
        nothing = np.zeros((self.shape[0] * self.shape[1], 3))
        self.sums: list[tuple[int, NDArray[np.float64]]] = [(0, nothing)] * len(self.lengths)

    @property
    def done(self) -> int:
        """Passes that are summed."""
        return sum(count for count, _ in self.sums)

    def add(self, number: int, light: NDArray[np.float64]) -> None:
        """One pass more; Ctrl-C comes before it or after it, because one assignment counts and sums it."""
        place = int(self.replicate_of[number])
        count, total = self.sums[place]
        self.sums[place] = (count + 1, total + light)

    def image(self, scene: str, began: float) -> Image:
        mean = np.sum([total for _, total in self.sums], axis=0) / self.done
        error = self._standard_error()
        told = {**self.metadata, "antumbra.passes": f"{self.done} of {self.passes}"}
        rays = self.done * self.shape[0] * self.shape[1]
        picture = _core.Picture.from_parts(
            mean.reshape(self.shape).astype(np.float32),
            None if error is None else error.reshape(self.shape).astype(np.float32),
            [],
            [*told.items()],
            (self.done, self.passes, 0, rays, self.window),
        )
        return Image(picture, name=scene, seconds=time.perf_counter() - began)

    def _standard_error(self) -> NDArray[np.float64] | None:
        """√(Σ w_r (m_r − m)² / ((R − 1) Σ w_r)) over the R replicates that are complete, w_r their passes."""
        whole = zip(self.sums, self.lengths, strict=True)
        closed = [(count, total / count) for (count, total), length in whole if count == length]
        if len(closed) < 2:
            return None
        weights = np.array([count for count, _ in closed], np.float64)[:, None, None]
        means = np.array([mean for _, mean in closed])
        mean = (weights * means).sum(axis=0) / weights.sum()
        scatter = (weights * (means - mean) ** 2).sum(axis=0)
        return np.asarray(np.sqrt(scatter / ((len(closed) - 1) * weights.sum())), np.float64)
