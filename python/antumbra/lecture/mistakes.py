"""The classical wrong estimators of `--mistake`: what each spoils, and its equation with the broken term marked."""

from __future__ import annotations

from typing import NamedTuple


class Mistake(NamedTuple):
    """Its name in `--mistake`, the estimator that it spoils, the equation with the broken term marked, and `why`."""

    name: str
    estimator: str
    latex: str
    spoken: str
    why: str


def sum_with(
    cosine: str = r"\cos\theta'", pdf: str = r"\text{pdf}", distance: str = "r^2", count: str = r"\frac{1}{N}"
) -> str:
    """The sum over points of the light, with these terms in place of its own."""
    return rf"L_o \approx {count} \sum_j f_r L_e \frac{{V \cos\theta \, {cosine}}}{{{pdf} \, {distance}}}"


SPOKEN = "L_o ≈ 1/N · sum of f_r L_e V cos θ cos θ′ / (pdf r²)"
MISTAKES = [
    Mistake(
        "no-cos-light",
        "area",
        sum_with(cosine=r"\mark{\cos\theta'}"),
        SPOKEN,
        "cos θ′ is left out: the light seems to shine to the side as it does straight ahead.",
    ),
    Mistake(
        "no-distance",
        "area",
        sum_with(distance=r"\mark{r^2}"),
        SPOKEN,
        "r² is left out: far lights are as bright as near ones.",
    ),
    Mistake(
        "wrong-measure",
        "area",
        r"L_o \approx \frac{1}{N} \sum_j f_r L_e \frac{V \cos\theta}{\mark{\text{pdf}_\omega}}, \qquad "
        r"\text{pdf}_\omega = \mark{\frac{r^2}{\cos\theta'}} \, \frac{1}{A}",
        "L_o ≈ 1/N · sum of f_r L_e V cos θ / pdf_ω, with pdf_ω = r² / cos θ′ · 1/A",
        "1/A, a density per area, stands where a density per solid angle belongs.",
    ),
    Mistake(
        "counted-twice",
        "mis",
        r"L_o \approx \mark{w_A} \frac{f}{p_A} + \mark{w_\omega} \frac{f}{p_\omega}, \qquad "
        r"w_A = \frac{p_A}{p_A + p_\omega}",
        "L_o ≈ w_A f / p_A + w_ω f / p_ω, with w_A = p_A / (p_A + p_ω)",
        "Points of the light and directions both find it, and each counts in full.",
    ),
    Mistake(
        "no-count",
        "area",
        sum_with(count=r"\mark{\frac{1}{N}}"),
        SPOKEN,
        "The sum over N shadow rays is not divided by N.",
    ),
]
# Everything that is tested: a name, the estimator, the mistake.
TESTED = [
    ("right", "area", "none"),
    ("right (mis)", "mis", "none"),
    *((m.name, m.estimator, m.name) for m in MISTAKES),
]
