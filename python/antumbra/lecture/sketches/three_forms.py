"""What three forms of one integral look like at one size of the light: pictures, their scatter, which is better."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture import low_room
from antumbra.lecture.measures.maps import box_mean
from antumbra.lecture.measures.three_forms import FORMS, scatter
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Picture

Map = NDArray[np.float64]
# Points of the light, directions, no light.
_BETTER = ("#f2b705", "#4e70aa", "#15181f")


def frames(run: Run, found: Mapping[str, Quantity], at: float, rays: int) -> tuple[Frame, Frame, Frame]:
    """The frames of three sliders at R/h = `at`, of pictures by `rays` samples a pixel."""
    lamp = run.aov(f"area-{at}", "emission")[..., 1] > 0
    light = box_mean(np.where(lamp, 0.0, run.light(f"area-{at}")), 2)
    dark = lamp | (light <= 0)
    of_one = {form: scatter(run, form, at, rays) for form in FORMS}
    white = 1.6 * run.white(f"area-{at}", share=90)
    pictures = [
        run.picture(f"{form}-{at}", f"{name}: {found[f'share-{form}-{at}']:v} of the samples of the floor bring light.",
                    white=white, noise=True)
        for form, name in FORMS.items()
    ]  # fmt: skip
    maps = [_scatter(run, form, at, np.sqrt(of_one[form]) / np.maximum(light, 1e-9), dark) for form in FORMS]
    costs = {"rays": 1.0, "time": found["time-hemisphere"].value}
    better = [_better(run, at, word, of_one["hemisphere"] * cost, of_one["area"], dark) for word, cost in costs.items()]
    best = min(FORMS, key=lambda form: found[f"{form}-{at}"].value)
    says = f"R/h = {at:g}: fills {100 * low_room.filled(at):.0f} %, best: {FORMS[best]}"
    first, second, third = (Frame(f"{at:g}", says, cells, f"R/h = {at:g}") for cells in (pictures, maps, better))
    return first, second, third


def _scatter(run: Run, form: str, at: float, relative: Map, dark: NDArray[np.bool_]) -> Picture:
    alt = f"One of the {FORMS[form]} scatters by {np.median(relative[~dark]):.2g} of the light."
    shown = np.where(dark, -1, np.log10(np.maximum(relative, 0.1)))
    return run.map(shown, alt, name=f"{form}-{at}-scatter", low=-1.0, high=1.5)


def _better(run: Run, at: float, word: str, directions: Map, points: Map, dark: NDArray[np.bool_]) -> Picture:
    # Where no direction found the light, its scatter is not small but unknown.
    won = (directions > 0) & (directions < points)
    part = f"Directions are better in {100 * np.mean(won[~dark]):.0f} % of the pixels that get light, at equal {word}."
    return run.classes(np.where(dark, 2, won), part, name=f"{at}-{word}", colours=_BETTER)
