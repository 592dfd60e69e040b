"""A square under more and more lamps: one shadow ray, or one to each; and what noise costs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from antumbra._words import written
from antumbra.lecture.measures.many_lights import LAMPS, MOST, WAYS, forecast, lit, measured
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Strip, Table
from antumbra.lecture.stages.quantities import table_of
from antumbra.study.plot import Curve, error_curves

_NAMES = {"uniform": "alike", "power": "power", "contribution": "contribution", "all": "each"}


def lamps(run: Run, counts: Sequence[int]) -> Strip:
    """A slider over the number of lamps: one ray to a lamp drawn alike, one drawn by contribution, a ray to each."""
    frames = []
    for k in counts:
        white = float(np.percentile(lit(run, f"seen-all-{k}"), 97))
        pictures, rays = [], run.image(f"seen-all-{k}")
        each = run.light(f"seen-all-{k}")
        for way in ("uniform", "contribution", "all"):
            off = float(np.sqrt(((run.light(f"seen-{way}-{k}") - each) ** 2).mean()) / each.mean())
            alt = f"{k} lamps, {_NAMES[way]}: " + (
                f"off by {off:.0%} of the mean." if way != "all" else "a ray to each."
            )
            pictures.append(run.picture(f"seen-{way}-{k}", alt, white=white, colour=True, noise=True))
        to_each = rays.shadow_rays / (rays.width * rays.height)
        says = f"{k:,} lamp{'s' * (k > 1)}: 1 ray, 1 ray, {to_each:.0f} rays a pixel"
        frames.append(Frame(str(k), says, pictures, short=f"{k:,}"))
    labels = ("one ray, alike", "by contribution", "a ray to each")
    note = (
        "One ray in all goes to a lamp that is drawn: all alike, or by its contribution, the light that it would give "
        "unshadowed. A lamp below the horizon gets no ray."
    )
    label = "Lamps, their power together the same"
    return Strip("lamps", label, frames, labels, note=note, tells=counts.index(MOST), begins=counts.index(10))


def plot(run: Run, found: Mapping[str, Quantity]) -> str:
    """Time for a noise of 10 % against the number of lamps, by each way; what is forecast is hollow."""
    curves, counts = [], run.pick(LAMPS)
    for way in WAYS:
        known = measured(run, way)
        cost = [found[f"cost-{way}-{k}"] for k in known]
        beyond = [forecast(found, k) for k in counts if k not in known]
        low, high = ([q.interval[end] for q in cost] + beyond for end in (0, 1))
        y, hollow = [q.value for q in cost] + beyond, [k not in known for k in counts]
        curves.append(
            Curve(_NAMES[way], counts, y, low, high, note="hollow: forecast" if beyond else "", hollow=hollow)
        )
    least = _NAMES[min(WAYS, key=lambda way: found[f"cost-{way}-{MOST}"].value)]
    return error_curves(
        curves, x_title="lamps", y_title="time of a pixel for a noise of 10 % [µs]", chosen=_NAMES["uniform"],
        label=f"Time for a noise of 10 % against the number of lamps: with {MOST:,} of them “{least}” takes least.",
    )  # fmt: skip


def table(run: Run, found: Mapping[str, Quantity]) -> Table:
    """Noise of one ray by each way, and of one to each lamp, with the time of both."""
    rows: dict[str, list[Quantity | str]] = {}
    for k in run.pick(LAMPS):
        noise = [found.get(f"noise-{way}-{k}", "") for way in WAYS]
        ms = found[f"time-all-{min(k, MOST)}"].value * max(k / MOST, 1.0) / 1000
        rows[f"{k:,}"] = [*noise, written(ms, 2) if k <= MOST else f"≈ {written(ms, 2)}"]
    return table_of(
        ("lamps", *_NAMES.values(), "its ms"), rows,
        "Noise of one ray, by the way a lamp is drawn for it, and of one to each lamp, with its time", bare=True,
        note="Noise over the mean [%], of one ray, and of one to each lamp; the time of a pixel for that, ≈ forecast.",
    )  # fmt: skip
