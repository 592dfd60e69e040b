"""Figure 16: five classical wrong estimators beside the right one, the term that each breaks, the tests that find it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

import antumbra as am
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.low_room import low_room
from antumbra.lecture.measures.points import irradiance_at
from antumbra.lecture.measures.ratio import excess, ratio
from antumbra.lecture.measures.seen import irradiance_seen
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import SceneOf, square
from antumbra.lecture.square_lights import irradiance_under, square_light
from antumbra.lecture.stages import Panel, Part, Picture, Row, Table, Tabs
from antumbra.lecture.stages.formula import Formula
from antumbra.study.statistics import Interval, verdict


class Mistake(NamedTuple):
    """Its name in `--mistake`, the estimator that it spoils, the equation with the broken term marked, what happened."""

    name: str
    estimator: str
    latex: str
    spoken: str
    why: str


def _sum(
    cosine: str = r"\cos\theta'", pdf: str = r"\text{pdf}", distance: str = "r^2", count: str = r"\frac{1}{N}"
) -> str:
    return rf"L_o \approx {count} \sum_j f_r L_e \frac{{V \cos\theta \, {cosine}}}{{{pdf} \, {distance}}}"


_SPOKEN = "L_o ≈ 1/N · sum of f_r L_e V cos θ cos θ′ / (pdf r²)"
MISTAKES = [
    Mistake("no-cos-light", "area", _sum(cosine=r"\mark{\cos\theta'}"), _SPOKEN,
            "cos θ′ is left out: the light seems to shine to the side as it does straight ahead."),
    Mistake("no-distance", "area", _sum(distance=r"\mark{r^2}"), _SPOKEN, "r² is left out: far lights are as bright as near ones."),
    Mistake("wrong-measure", "area", r"L_o \approx \frac{1}{N} \sum_j f_r L_e \frac{V \cos\theta}{\mark{\text{pdf}_\omega}}, \qquad "
            r"\text{pdf}_\omega = \mark{\frac{r^2}{\cos\theta'}} \, \frac{1}{A}", "L_o ≈ 1/N · sum of f_r L_e V cos θ / pdf_ω, with pdf_ω = r² / cos θ′ · 1/A",
            "1/A, a density per area, stands where a density per solid angle belongs."),
    Mistake("counted-twice", "mis", r"L_o \approx \mark{w_A} \frac{f}{p_A} + \mark{w_\omega} \frac{f}{p_\omega}, \qquad w_A = \frac{p_A}{p_A + p_\omega}",
            "L_o ≈ w_A f / p_A + w_ω f / p_ω, with w_A = p_A / (p_A + p_ω)", "Points of the light and directions both find it, and each counts in full."),
    Mistake("no-count", "area", _sum(count=r"\mark{\frac{1}{N}}"), _SPOKEN, "The sum over N shadow rays is not divided by N."),
]  # fmt: skip
ROWS = [
    ("right", "area", "none"),
    ("right (mis)", "mis", "none"),
    *((m.name, m.estimator, m.name) for m in MISTAKES),
]
TESTS = {
    "below": "below, r = 1",
    "side": "side",
    "twice": "size × 2",
    "count": "N = 16 : 1",
    "other": "directions",
}
GUESS = ("no-distance", "area", "no-cos-light")
RAYS, WITHIN = 16, 0.02
LOOK = {
    "light_points": "area", "viewing_rays": Pick(4, 32), "shadow_rays": RAYS, "size": Pick((120, 80), (360, 240)),
    "eye": (0.0, 0.62, 1.95), "look_at": (0.0, 0.5, -1.0), "up": (0.0, 1.0, 0.0), "fov": 1.15, "aov": "emission",
}  # fmt: skip


def _under(size: float, height: float) -> SceneOf:
    def build() -> am.Scene:
        scene = am.Scene("square-light")
        square(scene, 0.0, 4.0, am.materials.Diffuse(0.5))
        scene.add_light(square_light(size, height), name="light")
        return scene

    return build


SIDE, TWICE, BELOW = _under(1.0, 1.25), _under(2.0, 2.5), _under(0.2, 1.0)
AT, TWICE_AT = (0.9, 0.0, 0.4), (1.8, 0.0, 0.8)


def _tested(run: Run, row: int, estimator: str, mistake: str, other: Quantity) -> dict[str, Quantity]:
    """What each of `TESTS` finds of an estimator: the number over the one that it should be."""

    def light(build: SceneOf, point: tuple[float, float, float], nth: int, rays: int = RAYS) -> Quantity:
        viewing_rays = (16 if estimator == "area" else run.pick(Pick(64, 1024))) * (RAYS // rays)
        seed = run.seeded(8 * row + nth)
        run.rays += 64 * viewing_rays * rays
        options = {"estimator": estimator, "mistake": mistake, "light_points": "area", "shadow_rays": rays}
        return irradiance_seen(run.scene(build), point, 0.5, viewing_rays, seed, **options)

    side = light(SIDE, AT, 2)
    return {
        "below": ratio(light(BELOW, (0.0, 0.0, 0.0), 3), Quantity(irradiance_under(0.2, 1.0))),
        "side": ratio(side, Quantity(irradiance_under(1.0, 1.25, 0.9, 0.4))),
        "twice": ratio(light(TWICE, TWICE_AT, 4), side),
        "count": ratio(side, light(SIDE, AT, 5, 1)),
        "other": ratio(side, other),
    }


def _measure(run: Run) -> Mapping[str, Quantity]:
    other = irradiance_at(run.scene(SIDE), AT, 2**18, run.seeded(1), estimator="hemisphere")
    found: dict[str, Quantity] = {}
    for row, (name, estimator, mistake) in enumerate(ROWS):
        tested = _tested(run, row, estimator, mistake, other)
        found |= {f"{name}-{test}": quantity for test, quantity in tested.items()}
    failed = {name: [_word(found[f"{name}-{test}"]) for test in TESTS] for name, _, _ in ROWS}
    right = [found[f"{name}-{test}"] for name in ("right", "right (mis)") for test in TESTS]
    worst = max(right, key=lambda q: abs(q.value - 1))
    names = [m.name for m in MISTAKES]
    return found | {
        "more": excess(found["no-cos-light-side"]),
        "found": Quantity(sum("not supported" in failed[name] for name in names)),
        "below": Quantity(sum(failed[name][0] == "supported" for name in names)),
        "worst": Quantity(abs(worst.value - 1), worst.error, "%"),
    }


def _word(quantity: Quantity) -> str:
    low, high = quantity.interval
    return verdict(Interval(quantity.value, low, high), near=1.0, within=WITHIN)


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    def own(key: str, letter: str) -> Picture:
        name = f"which-{letter}" if len(letter) == 1 else f"own-{key}"
        return run.picture(
            key,
            f"The room under its light: picture {letter}.",
            letter,
            name=name,
            white=run.white(key, share=85) * 1.7,
        )

    panels = [
        Panel(
            "which",
            "Which is right?",
            [Row([own(key, letter) for key, letter in zip(GUESS, "ABC", strict=True)])],
        )
    ]
    for mistake in MISTAKES:
        right, wrong = run.light(mistake.estimator), run.light(mistake.name)
        share = np.where(
            run.aov(mistake.estimator, "emission")[..., 1] > 0,
            1.0,
            np.maximum(wrong, 1e-9) / np.maximum(right, 1e-9),
        )
        low, high = np.quantile(share[right > 0.01 * right.max()], [0.02, 0.98])
        span = f"{low:.2g} to {high:.2g} times" if high > 1.02 * low else f"{high:.3g} times"
        white = run.white(mistake.estimator, share=85) * 1.7
        row = Row([
            run.picture(mistake.estimator, "The right picture.", "right", name=f"{mistake.name}-right", white=white),
            run.picture(mistake.name, "The wrong picture at the same exposure.", f"{mistake.name}, at the same exposure", white=white),
            run.map(np.log2(share), f"The wrong picture has {span} the light.", f"wrong over right: {span}", name=f"{mistake.name}-share",
                    ramp="signed", low=-4.0, high=4.0),
        ])  # fmt: skip
        panels.append(
            Panel(mistake.name, mistake.name, [row, Formula([(mistake.latex, mistake.spoken)], mistake.why)])
        )
    return [Tabs("mistake", "Which mistake is shown", panels), _table(measured)]


def _table(measured: Mapping[str, Quantity]) -> Table:
    sign = {"supported": "✓", "undecided": "?", "not supported": "✗"}
    rows = [
        [
            name,
            *(
                f"{sign[_word(measured[f'{name}-{test}'])]} {measured[f'{name}-{test}'].value:.2f}"
                for test in TESTS
            ),
        ]
        for name, _, _ in ROWS
    ]
    return Table(
        ["estimator", *TESTS.values()], rows, "Five tests of the right estimators and the wrong ones.",
        note=f"What came out over what should, N = {RAYS}: ✗ where the 95 % interval lies outside of 1 ± {WITHIN}. Straight below a small light at r = 1, and to the "
        "side of a larger one, against the closed form; there against twice the size of everything, one ray in place of 16, and random directions.",
    )  # fmt: skip


FIGURE = Figure(
    number=16, chapter=4, title="One of three is right", seconds=Pick(5, 90),
    question=Question("The same room three times, each picture exposed for itself. Two of the estimators lack a term. Which picture is right?", "ABC", 1, looks=True),
    variants=[
        Variant("area", low_room(0.4), LOOK | {"estimator": "area"}), Variant("mis", low_room(0.4), LOOK | {"estimator": "mis"}),
        *(Variant(m.name, low_room(0.4), LOOK | {"estimator": m.estimator, "mistake": m.name}) for m in MISTAKES),
    ],
    measure=_measure, stage=_stage, exr=["area", "no-cos-light"],
    answer=Number("more", "too much light at the side in C, which lacks cos θ′: no noise, nothing to see. A lacks 1/r², B is right.", before="+"),
    equation=Equation(
        [(_sum(r"\mark{\cos\theta'}", r"\mark{\text{pdf}}", r"\mark{r^2}", r"\mark{\frac{1}{N}}"), _SPOKEN)],
        "Marked: what is left out or mistaken. Only a second way to the same number finds it.",
    ),
    claims=[
        Claim("Together the five tests find all five mistakes.", "found", near=5.0, within=0.5, main=True, measured="{found} of 5 found"),
        Claim("The right estimators pass all of them.", "worst", below=WITHIN, measured="off by {worst} at most"),
        Claim("Straight below at r = 1, three mistakes are not found.", "below", near=3.0, within=0.5, measured="{below} of 5 pass there"),
    ],
)  # fmt: skip
