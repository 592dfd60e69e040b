"""Directions drawn from the BRDF, from the map, and from both: their errors under several skies."""

from __future__ import annotations

import hashlib
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.hit import Hit
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.measures.replicates import mean_of, of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.skies import GOLD, MIRROR, SKIES, SUNS, lights_of, under_skies
from antumbra.lecture.variant import Pick
from antumbra.study import statistics

WAYS = ("brdf", "map", "mis")
PARTS = ("all", "gold")
# An open place on the table, in the sun at midday.
OPEN = (0.6, 0.0, 2.4)
# Half of the sun's angle in the sky [rad].
_SUN = 0.533 / 2 * math.pi / 180
SIZE = Pick((72, 48), (240, 160))
# Near enough that the things fill the picture.
VIEW = {"eye": (0.9, 1.75, 7.0), "look_at": (0.0, 0.8, 0.0), "fov": 0.43}
# Of the query that asks the open place: independent estimates, and directions in each.
_ESTIMATES, _DIRECTIONS = 4096, Pick(1000, 8000)


def seen(run: Run) -> Hit:
    """What the viewing ray of each pixel meets."""
    scene = run.scene(under_skies)
    found: Hit = run.once("seen", lambda: scene.closest_hit(*scene.camera_rays(run.pick(SIZE), **VIEW)))
    return found


def _mask(run: Run, part: str) -> NDArray[np.bool_]:
    """The pixels (H, W) of the gold ball, or of all that is no background and no mirror."""

    def on(ball: tuple[Any, float]) -> NDArray[np.bool_]:
        found: NDArray[np.bool_] = np.linalg.norm(seen(run).position - ball[0], axis=1) < 1.01 * ball[1]
        return found

    width, height = run.pick(SIZE)
    pixels = on(GOLD) if part == "gold" else np.isfinite(seen(run).t) & ~on(MIRROR)
    return pixels.reshape(height, width)


def noise(run: Run, sky: str, way: str, part: str) -> Quantity:
    """Standard deviation of a pixel, mean over those of a part, over their mean light: from replicates alone."""
    mask = _mask(run, part)
    found = statistics.root(statistics.variance(luminances(run, f"{way}-{sky}")[:, mask]))
    light = luminances(run, f"mis-{sky}")[:, mask].mean()
    return of_interval(statistics.Interval(*(end / light for end in found)), "%")


def noises(run: Run) -> dict[str, Quantity]:
    """`way-sky-part` for all of them, and how they compare.

    `insured`: the noise of MIS over that of the better of the others, where it is worst; `gilded`: that of the map
    over that of the BRDF on the gold ball under the painted sky; `same`: mean light by the BRDF over that by both, in
    the studio. A BRDF direction hardly ever meets a sun, so that what its pictures show of their noise is too little:
    there the map is the better one.
    """
    found = {
        f"{way}-{sky}-{part}": noise(run, sky, way, part) for sky in SKIES for way in WAYS for part in PARTS
    }

    def over_better(sky: str, part: str) -> Quantity:
        others = [found[f"{way}-{sky}-{part}"] for way in (("map",) if sky in SUNS else ("map", "brdf"))]
        return ratio(found[f"mis-{sky}-{part}"], min(others, key=lambda q: q.value))

    worst = max((over_better(sky, part) for sky in SKIES for part in PARTS), key=lambda q: q.interval[1])
    mask = _mask(run, "all")
    brdf, both = (mean_of(luminances(run, f"{way}-studio")[:, mask].mean(1)) for way in ("brdf", "mis"))
    gilded = ratio(found["map-painted-gold"], found["brdf-painted-gold"])
    return found | {"insured": worst, "gilded": gilded, "same": ratio(brdf, both)}


def _asked(run: Run, seed: int, n: int, light: list[str], **options: Any) -> NDArray[np.float64]:
    """Irradiance at the open place by some lights [W/m²], by many estimates of `n` directions each."""
    found = run.scene(under_skies).irradiance(
        np.tile(OPEN, (_ESTIMATES, 1)), (0.0, 1.0, 0.0), shadow_rays=n, seed=run.seeded(seed),
        sampler="random", light=light, **options,
    )  # fmt: skip
    return np.asarray(found, np.float64)[:, 1]


def _variance(estimates: NDArray[np.float64], n: int) -> NDArray[np.float64]:
    """Variance of one direction of `n` [W² m⁻⁴], from each of 16 groups of estimates."""
    return np.asarray(n * estimates.reshape(16, -1).var(1, ddof=1), np.float64)


def met_sun(run: Run) -> dict[str, Quantity]:
    """`rare`: directions of density cos θ/π until one meets the midday sun; `worth`: how many of them one of the map's
    has the variance of, sky and sun together. `disc`: the first by the closed form 1 / (sin² α cos θ). In thousands.
    `hits`, `expected`: of the sun, and by that form; `off`: their difference in standard errors, √`expected`.
    """
    n, sky = run.pick(_DIRECTIONS), lights_of("midday")
    by_brdf = _asked(run, 1, n, sky, estimator="hemisphere", directions="cosine")
    by_map = _asked(run, 2, 16, sky, estimator="area", lights="contribution")
    # Of the sun alone each direction that meets it brings π L / n, the others nothing.
    by_sun = _asked(run, 1, n, sky[-1:], estimator="hemisphere", directions="cosine")
    hits = float(np.round(by_sun / by_sun[by_sun > 0].min()).sum())
    tried, spread = _ESTIMATES * n, 1.96 / math.sqrt(hits)
    once = tried / hits / 1000
    rare = of_interval(statistics.Interval(once, once / (1 + spread), once * (1 + spread)), "thousand")
    closed = Quantity(1e-3 / (math.sin(_SUN) ** 2 * math.sin(SUNS["midday"].elevation)), unit="thousand")
    worth = ratio(mean_of(_variance(by_brdf, n) / 1000), mean_of(_variance(by_map, 16)), "thousand")
    # Rare hits scatter by the root of their number.
    expected = tried / (1000 * closed.value)
    said = {"hits": hits, "expected": expected, "off": (hits - expected) / math.sqrt(expected)}
    return {"rare": rare, "disc": closed, "worth": worth} | {key: Quantity(n) for key, n in said.items()}


def surfaces(run: Run) -> list[str]:
    """Hashes of the scene without its lights, one if it is the same under all skies, bit by bit.

    Of its triangles, and of position, normal, albedo and depth of what each sky's pictures show.
    """
    layers = ("position", "normal", "albedo", "depth")
    triangles = run.scene(under_skies).triangles()

    def seen_under(sky: str) -> str:
        found = hashlib.sha256()
        for part in (*triangles, *(run.aov(f"mis-{sky}", name) for name in layers)):
            found.update(np.ascontiguousarray(part).tobytes())
        return found.hexdigest()[:16]

    return sorted({seen_under(sky) for sky in SKIES})


def of_sphere(run: Run, radii: float) -> Quantity:
    """Mean light of the things in a sphere of light over that under the environment, less 1; by the same directions."""
    mask = _mask(run, "all")
    sphere, sky = (luminances(run, f"sphere-{which}")[:, mask].mean(1) for which in (f"{radii:g}", "none"))
    return mean_of(sphere / sky - 1, "%")
