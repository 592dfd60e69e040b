"""Visible fraction, unshadowed light, their product and the truth, for lights of growing size."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antumbra._words import minus
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Strip


def seen_times_unshadowed(run: Run, radii: Sequence[float], start: int) -> Strip:
    """A frame of five pictures for each radius of the light: variants `r{radius}` with both layers."""
    label = "Radius R of the light, 2 above the floor; the occluder, of radius 0.2, hangs halfway"
    labels = ("V, seen", "E, unshaded", "V · E", "true", "true / V·E − 1")
    note = (
        "In V · E and in the true picture white is the brightest unshadowed light. "
        "The last map is white where both agree, orange where there is more light than V · E, blue where less."
    )
    return Strip("R", label, [_frame(run, radius) for radius in radii], start, labels, note=note)


def _frame(run: Run, radius: float) -> Frame:
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
    return Frame(f"{radius:g}", f"R = {radius:g}: off by {span}", pictures, short=f"R = {radius:g}")
