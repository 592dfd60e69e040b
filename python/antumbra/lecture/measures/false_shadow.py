"""The shadow that rays throw which do not end at the light."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.compare import share_changed
from antumbra.lecture.measures.points import UP, irradiance_at
from antumbra.lecture.measures.ratio import scaled
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.scene import Scene


def width_of_false_shadow(run: Run, scene: Scene, height: float, count: int) -> Quantity:
    """Half of its width [m] on the plane at `height`: what is lost along a line of 1 m across the cylinder.

    8 replicates of 16 shadow rays from each of `count` points.
    """
    z = (np.arange(count) + 0.5) / count
    line = np.stack([0 * z, 0 * z + height, z], 1)

    def light(test: str, seed: int) -> NDArray[np.float64]:
        found = scene.irradiance(line, UP, shadow_rays=16, light="light", distance_test=test, seed=seed)
        return np.asarray(found, np.float64)[:, 0]

    widths = [np.mean(1 - light("off", run.seeded(n)) / light("on", run.seeded(n))) for n in range(8)]
    return mean_of(widths, "m", f"8 replicates, {16 * count:,} shadow rays each")


def light_without_end(run: Run, scene: Scene, under: tuple[float, float, float], rays: int) -> Quantity:
    """Share of the light at a place that looks down which rays without end still find there."""
    off, on = (
        irradiance_at(
            scene, under, rays, run.seeded(9 + n), (0.0, -1.0, 0.0), light="light", distance_test=test
        )
        for n, test in enumerate(("off", "on"))
    )
    return scaled(off, 1 / on.value, "%")


def half_width(height: float, light: float, axis: float, radius: float) -> float:
    """The same in closed form [m]: the light is a sphere of radius `light` at 0, the cylinder has its axis above it.

    Of the directions d = (sin a, cos a cos φ, cos a sin φ) to the light, those between the tangents in φ are lost; one
    φ holds ∫ cos a cos φ · cos a da of them, |a| ≤ A with cos A = cos α / cos(φ − φ₀), α half of the light's angle.
    """
    z = (np.arange(1000) + 0.5)[:, None] / 1000
    away, toward = np.hypot(z, height), np.arctan2(z, -height)
    alpha = np.arcsin(light / away)
    off = alpha * np.sin(np.linspace(-np.pi / 2, np.pi / 2, 401))
    # φ = φ₀ + α sin s: dφ = α cos s ds, so that the ends of the light need no care.
    step = np.cos(np.linspace(-np.pi / 2, np.pi / 2, 401))
    a = np.arccos(np.clip(np.cos(alpha) / np.cos(off), -1.0, 1.0))
    weight = step * np.cos(off - toward) * (a + np.sin(a) * np.cos(a))
    middle, half = np.arctan2(z, axis - height), np.arcsin(radius / np.hypot(z, axis - height))
    lost = np.abs(toward - off - middle) < half
    return float(np.mean((weight * lost).sum(1) / weight.sum(1)))


def wrong_pixels(run: Run, height: float, exposed: float) -> Quantity:
    """Share of the pixels that differ with the plane at `height`, exposed as the picture of the plane at `exposed`."""
    return share_changed(run, f"off{height}", f"on{height}", white=run.white(f"on{exposed}"))
