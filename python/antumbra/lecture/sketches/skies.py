"""Skies as lat-long maps with the directions that are drawn in them, and the pictures of each sky."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from antumbra.hit import Hit
from antumbra.lecture.measures.skies import WAYS, of_sphere, seen
from antumbra.lecture.pictures import linear, luminance
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.skies import GOLD, TURNS, alone, under_skies
from antumbra.lecture.stages import Frame, Picture, Row, Strip

# Of a map on the page, and of what it is drawn from.
_WIDE, _HIGH, _FINER = 320, 160, 2
_DRAWN, _TRIED = 60, 40_000
_CAPTIONS = {"brdf": "by the BRDF", "map": "by the map", "mis": "by both (MIS)"}


def _gold(run: Run) -> tuple[Hit, int]:
    """What is seen, and the pixel that looks at the middle of the gold ball."""
    hit = seen(run)
    up = np.array(GOLD[0]) + GOLD[1] * np.array([0.0, 0.5, 0.87])
    return hit, int(np.nanargmin(np.linalg.norm(hit.position - up, axis=1)))


def _ring(run: Run, width: int, height: int) -> tuple[float, float]:
    row, column = divmod(_gold(run)[1], width)
    return (column + 0.5) / width, (row + 0.5) / height


def _by_brdf(run: Run) -> NDArray[np.float64]:
    """Directions of density f cos θ at the ringed place (N, 3): even ones, of which weights choose."""
    hit, pixel = _gold(run)
    draw = np.random.default_rng(run.seeded(0))
    even = draw.normal(size=(_TRIED, 3))
    even /= np.linalg.norm(even, axis=1, keepdims=True)
    at = hit.receivers[np.full(_TRIED, pixel)]
    cos = np.maximum(even @ hit.shading_normal[pixel], 0.0)
    weight = (
        luminance(run.scene(under_skies).brdf(at, np.tile(hit.wo[pixel], (_TRIED, 1)), even)[None])[0] * cos
    )
    chosen = draw.choice(_TRIED, _DRAWN, replace=False, p=weight / weight.sum())
    found: NDArray[np.float64] = even[chosen]
    return found


def _by_map(run: Run, sky: str) -> NDArray[np.float64]:
    """Directions that light sampling draws at the ringed place (N, 3)."""
    hit, pixel = _gold(run)
    at = np.tile([hit.position[pixel], hit.shading_normal[pixel]], (_DRAWN, 1, 1))
    u = np.random.default_rng(run.seeded(1)).random((_DRAWN, 3))
    drawn = run.scene(alone(sky)).sample_light(at[:, 0], at[:, 1], u, lights="contribution")
    return drawn.direction.astype(np.float64)


def _radiance(run: Run, sky: str) -> NDArray[np.float64]:
    """The map itself, (H, W, 3), as rays from far outside find it."""
    theta, phi = np.pi * (np.arange(_HIGH) + 0.5) / _HIGH, 2 * np.pi * (np.arange(_WIDE) + 0.5) / _WIDE
    t, p = (x.ravel() for x in np.meshgrid(theta, phi, indexing="ij"))
    along = np.stack([np.sin(p) * np.sin(t), np.cos(t), -np.cos(p) * np.sin(t)], 1)
    far = np.tile([0.0, -1e4, 0.0], (len(t), 1))
    found = run.scene(alone(sky)).find_light(
        far, np.where(along[:, 1:2] >= 0, [[0.0, 1, 0]], [[0.0, -1, 0]]), along
    )
    return found.radiance.astype(np.float64).reshape(_HIGH, _WIDE, 3)


def _places(along: NDArray[np.float64], turn: float) -> NDArray[np.float64]:
    """Columns and rows of directions in a map that is turned eastward by a part of a full turn."""
    phi = np.arctan2(along[:, 0], -along[:, 2]) / (2 * math.pi) + turn
    theta = np.arccos(np.clip(along[:, 1], -1, 1)) / math.pi
    return np.stack([phi % 1.0 * _WIDE, theta * _HIGH], 1)


def _marked(
    of: NDArray[np.float64], white: float, dots: NDArray[np.float64], crosses: NDArray[np.float64]
) -> NDArray[np.float64]:
    """A map, its colours up to `white`, with a dot at each of some places and a cross at each of others."""
    from PIL import Image, ImageDraw

    small = np.round(255 * np.clip(of / white, 0, 1) ** (1 / 2.2)).astype(np.uint8)
    image = Image.fromarray(small, "RGB").resize((_WIDE * _FINER, _HIGH * _FINER), Image.Resampling.NEAREST)
    pen, arm = ImageDraw.Draw(image), 2.2 * _FINER
    for colour, wide in (("#ffffff", 1.8 * _FINER), ("#c33a05", 0.9 * _FINER)):
        for x, y in crosses * _FINER:
            for slope in (1, -1):
                pen.line((x - arm, y - slope * arm, x + arm, y + slope * arm), fill=colour, width=round(wide))
    for x, y in dots * _FINER:
        r = 2.2 * _FINER
        pen.ellipse((x - r, y - r, x + r, y + r), fill="#1b4f8f", outline="#ffffff", width=2)
    return linear(np.asarray(image.resize((_WIDE, _HIGH), Image.Resampling.BOX), np.float64) / 255)


def _map(run: Run, sky: str, white: float, turn: int = 0) -> Picture:
    crosses, dots = run.once("crosses", lambda: _by_brdf(run)), _by_map(run, sky)
    part = turn / TURNS
    of = run.once(("map", sky), lambda: _radiance(run, sky))
    shown = _marked(
        np.roll(of, round(part * _WIDE), axis=1), white, _places(dots, part), _places(crosses, 0.0)
    )
    alt = f"The {sky} sky as a map: dots where it is bright, crosses about the mirror direction of the gold ball."
    name = f"drawn-{sky}" + (f"-{turn}" if turn else "")
    return run.picture(shown, alt, "● map, × BRDF", name=name, white=1.0, colour=True)


def under(run: Run, found: Mapping[str, Quantity], sky: str) -> Row:
    """The map of a sky, and the scene under it by each of the three ways and as it is."""
    white = run.white(f"mis-{sky}", share=97)
    shown: list[Picture] = [_map(run, sky, white)]
    for way in WAYS:
        all_of_it, gold = (found[f"{way}-{sky}-{part}"] for part in ("all", "gold"))
        alt = (
            f"Directions {_CAPTIONS[way]}, {sky}: noise {all_of_it:v} of the mean, {gold:v} on the gold ball."
        )
        shown.append(
            run.picture(
                run.image(f"{way}-{sky}").pixels,
                alt,
                _CAPTIONS[way],
                name=f"{way}-{sky}",
                white=white,
                colour=True,
                noise=True,
            )
        )
    last = shown.pop()
    return Row([*shown, replace(last, ring=_ring(run, last.width, last.height))])


def turned(run: Run) -> Strip:
    """The studio's map turned step by step, and what it does to the picture."""
    white, first = run.white("turn-4", share=97), run.light("turn-0").mean()
    frames = []
    for turn in range(TURNS):
        share = run.light(f"turn-{turn}").mean() / first
        degrees = f"{360 * turn / TURNS:g}°"
        picture = run.picture(
            f"turn-{turn}",
            f"The map turned by {degrees}: shadows turn with it.",
            name=f"turn-{turn}",
            white=white,
            colour=True,
        )
        frames.append(
            Frame(
                f"{360 * turn / TURNS:g}",
                f"{degrees}: {share:.2f} of the first picture's light",
                [_map(run, "studio", white, turn), picture],
                short=degrees,
            )
        )
    return Strip(
        "turn", "The studio turns about the vertical", frames, ("the map", "the same scene under it")
    )


def spheres(run: Run, radii: list[float]) -> Row:
    """The scene in spheres of light, and under the environment, by the same directions."""
    white, shown = run.white("mis-studio", share=97), []
    for r in radii:
        off = of_sphere(run, r)
        words = f"{r:,.0f} scene radii"
        shown.append(
            run.picture(
                f"sphere-{r:g}",
                f"A sphere of light, {words}: {off:1} off in the mean.",
                f"{words}: {off:1}",
                white=white,
                colour=True,
            )
        )
    return Row(
        [
            *shown,
            run.picture(
                "sphere-none",
                "Under the environment: as in the widest sphere.",
                "environment",
                white=white,
                colour=True,
            ),
        ]
    )
