"""By which law the light of a function falls: the exponents of cos θ, cos θ′ and r that its answers follow."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from antumbra.checks.lamps import Lamp, falls_as

# Beside the noise of an answer: how far sums over a lamp's area, under a wrong law against the right one, are off. At
# most 3.95·10⁻⁴ of all laws and lamps, measured against sums of 1,024 points a side.
_SUM = 4e-4


Exponents = tuple[int, int, int]
# Of cos θ, cos θ′ and 1/r.
EXPONENTS: Sequence[Exponents] = list(itertools.product(range(5), range(3), range(5)))


class Law(NamedTuple):
    """L = k · ∫ f L_e cos^a θ cos^b θ′ / r^c dA; right: k = a = b = 1, c = 2."""

    cos: int
    cos_light: int
    distance: int
    factor: float
    factor_error: float

    def is_about(self, factor: float) -> bool:
        """Its factor is this one, as far as its error tells."""
        return abs(self.factor - factor) < 5 * self.factor_error + 2e-3 * factor


def followed(
    lamps: Sequence[Lamp],
    shares: Sequence[float],
    errors: Sequence[float],
    exponents: Sequence[Exponents] = EXPONENTS,
) -> Law | None:
    """The law that answers follow, given as shares of the true ones with their errors; None if they follow none.

    Least squares for k under each choice of `exponents`; the best of them, if all answers are within 5 of their errors.
    """
    right = np.array([falls_as(lamp, 1, 1, 2) for lamp in lamps])
    share = np.asarray(shares)
    best: tuple[float, Law] | None = None
    for a, b, c in exponents:
        law = np.array([falls_as(lamp, a, b, c) for lamp in lamps]) / right
        error = np.hypot(np.asarray(errors), _SUM * np.maximum(share, law))
        weight = law**2 / error**2
        factor = float((weight * share / law).sum() / weight.sum())
        worst = float(np.abs((share - factor * law) / np.hypot(error, _SUM * factor * law)).max())
        if best is None or worst < best[0]:
            best = worst, Law(a, b, c, factor, 1 / math.sqrt(weight.sum()))
    return best[1] if best and best[0] < 5 else None


def in_words(law: Law, albedo: float) -> list[str]:
    """What is wrong with a law, term by term; nothing if it is right."""
    exponents = law[:3]
    for known, factor, text in _JOINED:
        if exponents == known and law.is_about(factor):
            return [text]
    said = [_TERMS[place, power] for place, power in enumerate(exponents) if (place, power) in _TERMS]
    if exponents[1:] == (0, 0):
        said = [*said[:-2], _AREA]
    if exponents[1:] == (2, 4):
        said = [*said[:-2], _SOLID_ANGLE]
    return said + _factor(law, albedo)


_AREA = "cos θ′/r² is missing: a density over the light's area is taken for one over solid angle (dω = cos θ′ dA/r²)"
_SOLID_ANGLE = "cos θ′/r² comes twice: a density in solid angle is taken for one over the light's area"
_TERMS = {
    (0, 0): "cos θ at the receiver is missing",
    (0, 2): "cos θ at the receiver comes twice",
    (0, 3): "cos θ at the receiver comes three times",
    (0, 4): "cos θ at the receiver comes four times",
    (1, 0): "cos θ′ at the light is missing",
    (1, 2): "cos θ′ at the light comes twice",
    (2, 0): "1/r² is missing",
    (2, 1): "1/r stands where 1/r² should",
    (2, 3): "1/r³ stands where 1/r² should",
    (2, 4): "1/r² comes twice",
}
_JOINED = [
    ((2, 1, 2), 2.0, "directions drawn with density cos θ/π are divided by the density 1/(2π) of even ones"),
    ((0, 1, 2), 0.5, "directions drawn evenly are divided by the density cos θ/π of cosine-weighted ones"),
]


def _factor(law: Law, albedo: float) -> list[str]:
    """What a factor in front of everything may be."""
    if law.is_about(1):
        return []
    count = round(law.factor)
    known = [
        (math.pi, "f_r = ρ/π of a diffuse surface: the π is missing"),
        (1 / math.pi, "light is divided by π twice: f_r = ρ/π has it already"),
        (1 / albedo, "the surface's albedo ρ is missing: f_r comes from scene.brdf"),
        (albedo, "the surface's albedo ρ comes twice: scene.brdf has it already"),
        (
            2,
            "all light counts twice: two samples are added up, not averaged, or two strategies each count it fully",
        ),
        (
            0.5,
            "all light counts half: samples are divided by their number twice, or one of two strategies is left out",
        ),
    ]
    for value, text in known:
        if law.is_about(value):
            return [text]
    if count > 2 and law.is_about(count):
        return [f"{count} samples are added up, not averaged: divide by N = {count}"]
    return [f"all light is {law.factor:.3g} times what it should be"]
