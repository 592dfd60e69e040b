"""Visible fraction, unshadowed light, their product and the truth, for lights of growing size."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from antumbra._words import minus
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Strip

# Of the floor in the pictures [m].
WIDTH = 2.4


def seen_times_unshadowed(run: Run, radii: Sequence[float], tells: float, x: float) -> Strip:
    """A frame of five pictures for each radius of the light: variants `r{radius}` with both layers.

    `tells`: the radius that the numbers are of; `x`: the point of the floor that they are of, ringed [m].
    """
    label = "Radius R of the light, 2 m above the floor; the occluder, of radius 0.2 m, hangs halfway"
    labels = ("V", "E", "V · E", "true", "true / VE")
    note = (
        "In V · E and in the true picture white is the brightest unshadowed light. "
        f"The ring: x = {x:g} m, to the right of the middle; each picture is {WIDTH:g} m wide. "
        "The last map is white where both agree, orange where there is more light than V · E, blue where less."
    )
    frames = [_frame(run, radius, (0.5 + x / WIDTH, 0.5)) for radius in radii]
    return Strip("R", label, frames, labels, note=note, tells=radii.index(tells))


def _frame(run: Run, radius: float, ring: tuple[float, float]) -> Frame:
    key = f"r{radius:g}"
    seen, light, true = run.aov(key, "visible-fraction"), run.aov(key, "unshadowed-direct"), run.pixels(key)
    product, white = seen[..., None] * light, float(light.max())
    # Where hardly any light is left a quotient says nothing.
    off = np.where(product > 0.1 * white, true / np.maximum(product, 1e-9) - 1, 0.0).mean(2)
    span = minus(f"{100 * off.min():+.0f}") + " to " + minus(f"{100 * off.max():+.0f}") + " %"
    pictures = [
        run.map(seen, f"Visible fraction, from {seen.min():.2f} to 1.", name=f"{key}-seen", unit="%"),
        run.picture(light, "Unshadowed light, brightest in the middle.", name=f"{key}-light", white=white),
        run.picture(product, "The product: a shadow.", name=f"{key}-product", white=white),
        run.picture(true, "The true picture: a shadow of another shape.", name=f"{key}-true", white=white),
        run.map(
            off, f"True over product less 1: {span}.", name=f"{key}-off", ramp="signed", low=-0.15, high=0.15, unit="%"
        ),
    ]  # fmt: skip
    ringed = [replace(picture, ring=ring) for picture in pictures]
    return Frame(f"{radius:g}", f"R = {radius:g} m: off by {span}", ringed, short=f"R = {radius:g} m")
