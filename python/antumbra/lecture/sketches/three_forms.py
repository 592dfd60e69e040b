"""What three forms of one integral look like at one size of the light: pictures, their scatter, which is better."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.maps import box_mean
from antumbra.lecture.measures.three_forms import DISTANCES, FORMS, exact, exact_near_a_corner, scatter
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import low_room
from antumbra.lecture.stages import Frame, Picture, Plot
from antumbra.lecture.stages.quantities import curve_of, table_of
from antumbra.study.plot import error_curves

Map = NDArray[np.float64]
_SAMPLED = {"hemisphere": "p = cos θ / π", "surfaces": "p = 1/A of all", "area": "p = 1/A of the light"}
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
    better = [
        _better(run, at, word, of_one["hemisphere"] * cost, of_one["area"], dark)
        for word, cost in costs.items()
    ]
    says = f"R/h = {at:g}: fills {100 * low_room.filled(at):.0f} %, {_best(found, at)}"
    first, second, third = (
        Frame(f"{at:g}", says, cells, f"R/h = {at:g}") for cells in (pictures, maps, better)
    )
    return first, second, third


def _best(found: Mapping[str, Quantity], at: float) -> str:
    """The form of the least variance at the middle of the floor, or the two whose intervals meet."""
    first, second, _ = sorted(FORMS, key=lambda form: found[f"{form}-{at}"].value)
    alike = found[f"{second}-{at}"].interval[0] <= found[f"{first}-{at}"].interval[1]
    return f"{FORMS[first]} and {FORMS[second]} alike" if alike else f"best: {FORMS[first]}"


def _scatter(run: Run, form: str, at: float, relative: Map, dark: NDArray[np.bool_]) -> Picture:
    alt = f"One of the {FORMS[form]} scatters by {np.median(relative[~dark]):.2g} of the light."
    shown = np.where(dark, -1, np.log10(np.maximum(relative, 0.1)))
    ticks = {-1.0: "0.1", 0.0: "1", 1.0: "10", 1.5: "32"}
    return run.map(
        shown, alt, name=f"{form}-{at}-scatter", low=-1.0, high=1.5, ticks=ticks, unit="of the light"
    )


def _better(run: Run, at: float, word: str, directions: Map, points: Map, dark: NDArray[np.bool_]) -> Picture:
    # Where no direction found the light, its scatter is not small but unknown.
    won = (directions > 0) & (directions < points)
    part = 100 * np.mean(won[~dark])
    alt = f"Directions are better in {part:.0f} % of the pixels that get light, at equal {word}."
    return run.classes(np.where(dark, 2, won), alt, name=f"{at}-{word}", colours=_BETTER)


def plot(found: Mapping[str, Quantity], ratios: Sequence[float], shown: Sequence[float]) -> Plot:
    """Variance at the middle of the floor against R/h, with closed forms; the share of samples that bring light."""
    curves = []
    for form, name in FORMS.items():
        marks = [found[f"{form}-{at}"] for at in ratios]
        curves.append(curve_of(name, ratios, marks, partial(exact, form), _SAMPLED[form]))
    best = sum(
        found[f"surfaces-{at}"].value <= min(found[f"{form}-{at}"].value for form in FORMS) for at in ratios
    )
    drawing = error_curves(
        curves,
        x_title="R/h",
        y_title="variance of one sample / E²",
        x_ticks=[0.1, 0.2, 0.4, 0.8, 1.45],
        chosen=FORMS["area"],
        label="Variance against the size of the light: points of the light are best until it fills "
        f"{found['even']} of the hemisphere, directions above; all surfaces at {best} of {len(ratios)} sizes.",
    )
    rows = {f"{at:g}": [found[f"share-{form}-{at}"] for form in FORMS] for at in shown}
    note = "Share of samples with Lₑ ≠ 0, at the middle of the floor. In the last two only these cost a shadow ray."
    table = table_of(("R/h", *FORMS.values()), rows, "Share of samples with L_e ≠ 0.", note=note)
    return Plot(
        drawing,
        "At the middle of the floor. Marks: measured, 95 % over 32 groups. Lines: closed forms.",
        table,
    )


def near_a_corner(found: Mapping[str, Quantity]) -> Plot:
    """Mean square of one point of a light, and of one direction, against the distance from the light."""
    of = {"area": "corner-", "hemisphere": "corner-directions-"}
    notes = {"area": "line: 2π / (3 d²)", "hemisphere": "line: closed form"}
    curves = [
        curve_of(
            FORMS[form],
            DISTANCES,
            [found[f"{name}{d}"] for d in DISTANCES],
            partial(exact_near_a_corner, form),
            notes[form],
        )
        for form, name in of.items()
    ]
    drawing = error_curves(
        curves,
        x_title="distance d from the light [m]",
        y_title="mean square of one sample [W² m⁻⁴]",
        label=f"Towards the corner the mean square of a point of the light grows as the power {found['corner']:1} "
        "of the distance, that of a direction stays below 5.",
    )
    rows = {f"{d:g}": [found[f"{name}{d}"] for name in of.values()] for d in DISTANCES}
    note = (
        "A wall meets a square light of 4 × 4 m and radiance 1 at a right angle; the receiver lies on the wall. One "
        "point of the light: (Lₑ cos θ cos θ′ / r² · A)². Half the distance, four times the square, while the "
        "irradiance stays below π/2. A direction brings π or nothing, wherever the receiver lies."
    )
    head = ("d [m]", *(FORMS[form] for form in of))
    table = table_of(head, rows, "Mean square of one sample near a corner.", note=note)
    return Plot(drawing, "Marks: measured, 95 % of 8 and of 32 groups.", table)
