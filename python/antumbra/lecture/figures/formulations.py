"""Figure 10: directions, points of all surfaces, points of the lights: which of them is better, and where."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

import antumbra as am
from antumbra.lecture import low_room
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.maps import box_mean
from antumbra.lecture.measures.one_sample import Samples, moments_of_light_points, one_sample
from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.square_lights import square_light
from antumbra.lecture.stages import Frame, Panel, Part, Plot, Strip, Table, Tabs
from antumbra.study.plot import Curve, error_curves
from antumbra.study.statistics import Line

RATIOS = [0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.2, 1.3, 1.4, 1.5, 1.58]
# Between these both variances are the same; a line through their logarithms is 0.005 % off there.
CROSSING = [1.4, 1.5]
FORMS = {"hemisphere": "directions", "surfaces": "all surfaces", "area": "the light"}
ONE: dict[str, dict[str, Any]] = {
    "hemisphere": {"estimator": "hemisphere", "directions": "cosine"},
    "surfaces": {"estimator": "surfaces"},
    "area": {"estimator": "area", "light_points": "area"},
}
RAYS = Pick(32, 128)
LOOK = {
    "sampler": "random", "viewing": "centre", "viewing_rays": RAYS, "shadow_rays": 1, "size": Pick((72, 48), (240, 160)),
    "eye": (0.0, 0.62, 1.95), "look_at": (0.0, 0.5, -1.0), "up": (0.0, 1.0, 0.0), "fov": 1.15,
}  # fmt: skip
BETTER = ("#f2b705", "#4e70aa", "#15181f")


def _samples(run: Run, form: str, at: float) -> Samples:
    """At the middle of the floor."""
    close = at in CROSSING if form != "surfaces" else at == 1.0
    count = run.pick(Pick(2**17, 2**20) if close else Pick(2**14, 2**18))
    run.rays += count
    scene = run.scene(low_room.low_room(at))
    return one_sample(scene, (0.0, 0.0, 0.0), count, run.seeded(RATIOS.index(at)), **ONE[form])


def _crossing(samples: Mapping[tuple[str, float], Samples]) -> Quantity:
    """Where the variances are the same: the share of the hemisphere, by a line through ln of their ratio in each group."""
    over = np.log([samples["area", r].variances / samples["hemisphere", r].variances for r in CROSSING])
    slope, height = np.polyfit(np.log(CROSSING), over, 1)
    return mean_of(
        1 / (1 + np.exp(2 * height / slope)), "%", "R² / (R² + h²) where both variances are the same"
    )


def _corner(run: Run) -> Quantity:
    """Slope of the mean square of a light point against the distance from a corner that the light reaches."""
    scene, distances = am.Scene("corner"), [0.1, 0.2, 0.4, 0.8]
    scene.add_light(square_light(4.0, 0.0))
    moments = [
        moments_of_light_points(
            scene, (2.0, -d, 0.0), (-1.0, 0.0, 0.0), run.pick(Pick(128, 512)), run.seeded(1)
        )
        for d in distances
    ]
    return mean_of(np.polyfit(np.log(distances), np.log(moments), 1)[0])


def _measure(run: Run) -> Mapping[str, Quantity]:
    samples = {(form, at): _samples(run, form, at) for at in RATIOS for form in FORMS}
    light, everything = low_room.areas(1.0)
    found = {
        "even": _crossing(samples),
        "corner": _corner(run),
        "surfaces": ratio(samples["surfaces", 1.0].moment, samples["area", 1.0].moment),
        "areas": Quantity(everything / light),
    }
    for (form, at), each in samples.items():
        # Of E / L_e, in units of its square: the light has the radiance 1 / ratio².
        scale = (at**2 / (np.pi * low_room.filled(at))) ** 2
        found[f"{form}-{at}"] = mean_of(scale * each.variances)
        found[f"share-{form}-{at}"] = each.share
    for form in FORMS:
        cost = [samples[form, at].seconds / samples["area", at].seconds for at in RATIOS]
        found[f"time-{form}"] = Quantity(
            float(np.median(cost)), 0.0, "", "of the time of a point of the light"
        )
    return found


def _scatter(run: Run, form: str, at: float) -> NDArray[np.float64]:
    """Variance of one sample at each pixel, a mean over 5 × 5 of them."""
    error = run.image(f"{form}-{at}").standard_error
    assert error is not None
    return box_mean(error[..., 1].astype(np.float64) ** 2 * run.pick(RAYS), 2)


def _frames(run: Run, measured: Mapping[str, Quantity], at: float) -> tuple[Frame, ...]:
    lamp = run.aov(f"area-{at}", "emission")[..., 1] > 0
    light = box_mean(np.where(lamp, 0.0, run.light(f"area-{at}")), 2)
    dark = lamp | (light <= 0)
    scatter, white = (
        {form: _scatter(run, form, at) for form in FORMS},
        1.6 * run.white(f"area-{at}", share=90),
    )
    noise, maps, better = [], [], []
    for form, name in FORMS.items():
        share, relative = measured[f"share-{form}-{at}"], np.sqrt(scatter[form]) / np.maximum(light, 1e-9)
        noise.append(
            run.picture(
                f"{form}-{at}",
                f"{name}: {share:v} of the samples of the floor bring light.",
                white=white,
                noise=True,
            )
        )
        maps.append(run.map(np.where(dark, -1, np.log10(np.maximum(relative, 0.1))), f"One of the {name} scatters by {np.median(relative[~dark]):.2g} of the light.",
                            name=f"{form}-{at}-scatter", low=-1.0, high=1.5))  # fmt: skip
    for word, cost in (("rays", 1.0), ("time", measured["time-hemisphere"].value)):
        # Where no direction found the light, its scatter is not small but unknown.
        found = (scatter["hemisphere"] > 0) & (scatter["hemisphere"] * cost < scatter["area"])
        part = f"Directions are better in {100 * np.mean(found[~dark]):.0f} % of the pixels that get light, at equal {word}."
        better.append(run.classes(np.where(dark, 2, found), part, name=f"{at}-{word}", colours=BETTER))
    best = min(FORMS, key=lambda form: measured[f"{form}-{at}"].value)
    says = f"R/h = {at:g}: fills {100 * low_room.filled(at):.0f} %, best: {FORMS[best]}"
    return tuple(Frame(f"{at:g}", says, cells, f"R/h = {at:g}") for cells in (noise, maps, better))


def _stage(run: Run, measured: Mapping[str, Quantity]) -> list[Part]:
    frames = list(zip(*(_frames(run, measured, at) for at in RATIOS), strict=True))
    cost = {form: f"{measured[f'time-{form}'].value:.2f}" for form in FORMS}
    shown = [
        ("noise", "Pictures", "R", tuple(FORMS.values()), f"{run.pick(RAYS)} random samples a pixel, all through its centre."),
        ("variance", "Scatter", "radius", tuple(FORMS.values()), "Standard deviation of one sample over the light of the pixel: dark 0.1, white 30."),
        ("better", "Who is better", "size", ("at equal rays", "at equal time"), "Yellow: points of the light; blue: directions; black: the light, and what it does "
         f"not reach. In this run a direction took {cost['hemisphere']} and a point of all surfaces {cost['surfaces']} times as long as a point of the light."),
    ]  # fmt: skip
    label = "Radius R of the light over the height h of the room, at the same power"
    panels = [
        Panel(value, name, [Strip(key, label, each, 10 if value == "better" else 3, labels, note=note)])
        for (value, name, key, labels, note), each in zip(shown, frames, strict=True)
    ]
    return [Tabs("show", "What is shown", panels), _plot(measured)]


def _plot(measured: Mapping[str, Quantity]) -> Plot:
    x, curves = np.geomspace(RATIOS[0], RATIOS[-1], 40), []
    for (form, name), note in zip(
        FORMS.items(), ("p = cos θ / π", "p = 1/A of all", "p = 1/A of the light"), strict=True
    ):
        found = [measured[f"{form}-{at}"] for at in RATIOS]
        exact = np.array([_relative(form, at) for at in x])
        low, high = zip(*(quantity.interval for quantity in found), strict=True)
        curves.append(
            Curve(name, RATIOS, [q.value for q in found], low, high, Line(x, exact, exact, exact), note)
        )
    drawing = error_curves(
        curves, x_title="R/h", y_title="variance of one sample / E²", x_ticks=[0.1, 0.2, 0.4, 0.8, 1.45], chosen=FORMS["area"],
        label="Variance against the size of the light: points of the light are best until R/h = 1.45, directions above; all surfaces never.",
    )  # fmt: skip
    rows = [
        [f"{at:g}", *(f"{measured[f'share-{form}-{at}']:v}" for form in FORMS)]
        for at in (0.1, 0.2, 0.4, 0.8, 1.2, 1.58)
    ]
    table = Table(["R/h", *FORMS.values()], rows, "Share of samples with L_e ≠ 0.",
                  note="Share of samples with Lₑ ≠ 0, at the middle of the floor. Of the last two forms only these cost a shadow ray.")  # fmt: skip
    return Plot(
        drawing,
        "At the middle of the floor. Marks: measured, 95 % over 32 groups. Lines: closed forms.",
        table,
    )


def _relative(form: str, at: float) -> float:
    """The closed forms of the curves: variance over E²."""
    light, everything = low_room.areas(at)
    mean, points = np.pi * low_room.filled(at), low_room.variance_of_points(at)
    if form == "hemisphere":
        return low_room.variance_of_directions(at) / mean**2
    return (everything / light if form == "surfaces" else 1.0) * (points / mean**2 + 1) - 1


FIGURE = Figure(
    number=10, chapter=3, title="Three ways to sample one integral", seconds=Pick(6, 140),
    question=Question(
        "The light grows. Which share of the hemisphere, counted with cos θ, must it fill before random directions are better than random points of it?",
        ("10 %", "a third", "half", "two thirds"), 3,
    ),
    variants=[
        Variant(f"{form}-{at}", low_room.low_room(at), LOOK | ONE[form] | {"aov": "emission"}) for at in RATIOS for form in FORMS
    ],
    measure=_measure, stage=_stage, exr=["hemisphere-0.4", "surfaces-0.4", "area-0.4"],
    answer=Number("even", "of the hemisphere. Below, points of the light are better; above, directions: there near points count many times as much as far ones."),
    equation=Equation(
        [
            (r"L_o = \int_{\mark{\Omega}} f_r L_e \cos\theta \, \text{d}\omega", "L_o = ∫ over the hemisphere of f_r L_e cos θ dω"),
            (r"\phantom{L_o} = \int_{\mark{A}} f_r L_e V \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A", "= ∫ over all surfaces of f_r L_e V cos θ cos θ′ / r² dA"),
            (r"\phantom{L_o} = \int_{\mark{A_L}} f_r L_e V \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A", "= ∫ over the lights of f_r L_e V cos θ cos θ′ / r² dA"),
        ],
        "Marked: what is sampled. The value is the same; Lₑ is 0 for most directions and most surfaces, and 1/r² has no bound in corners.",
    ),
    claims=[
        Claim("Directions draw level at R/h = 1.45.", "even", near=low_room.filled(low_room.even_ratio()), within=0.01,
              main=True, measured="{even}; the closed form says 67.8 %"),
        Claim("All surfaces: the mean square times all areas over the light’s.", "surfaces", near="areas", within=0.8,
              measured="{surfaces} times at R/h = 1; the areas are as {areas:v} to 1"),
        Claim("In a corner with the light, points of it scatter as 1/distance².", "corner", near=-2.0, within=0.05,
              measured="slope of the mean square {corner}"),
    ],
)  # fmt: skip
