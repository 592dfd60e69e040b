"""A scene that is written for two programs is one scene: pbrt-v4 beside Mitsuba 3, by the same random numbers."""

from __future__ import annotations

import json

import numpy as np
import pytest

import antumbra as am

SAME = ("cornell-box", "veach-mis", "veach-bidir", "staircase2", "coffee", "veach-ajar")
# The sky of one file was made from that of the other by resampling: 3 % of the mean off from texel to texel, and what
# comes in through windows some percent (0.5 % measured for classroom, 0.1 % once its XML has our rows of the square).
SKIES = ("classroom", "living-room")
RESAMPLED = 0.02
SMALL = {"size": "64x48", "viewing_rays": 4, "filter": "box", "masks": "opaque", "seed": 1}


def both(data, name, **options):
    folder = data / "scenes" / "xml" / name
    return [am.load(folder / file).render(**options) for file in ("scene-v4.pbrt", "scene.xml")]


def same_pixels(pictures):
    """The share of pixels that are equal: numbers in the files have six digits, so rays that graze an edge may not."""
    ours, theirs = (p.pixels.astype(float).mean(-1) for p in pictures)
    return float((np.abs(ours - theirs) <= 1e-4 * np.maximum(theirs, 1e-3)).mean())


@pytest.mark.parametrize("name", SAME + SKIES)
def test_occlusion_is_the_same_picture(data, name):
    radius = json.loads((data / "references" / "manifest.json").read_text())[f"{name}.ao"]["radius"]
    pictures = both(data, name, **SMALL, estimator="ambient-occlusion", radius=radius)
    assert same_pixels(pictures) > 0.999


@pytest.mark.parametrize("name", SAME)
def test_clay_is_the_same_picture(data, name):
    assert same_pixels(both(data, name, **SMALL, estimator="mis", clay=0.8)) > 0.999


@pytest.mark.parametrize("name", SKIES)
def test_a_sky_of_an_equal_area_square_gives_what_its_latitudes_give(data, name):
    few = SMALL | {"size": "48x32", "viewing_rays": 64}
    pictures = both(data, name, **few, estimator="mis", clay=0.8)
    means = [picture.pixels.astype(float).mean() for picture in pictures]
    errors = [
        float(np.sqrt((np.asarray(p.standard_error, float) ** 2).sum()) / p.pixels.size) for p in pictures
    ]
    # α = 6·10⁻⁵ each, two-sided at 4 standard deviations; the channels of a pixel are drawn together: √3.
    noise = 4.0 * np.sqrt(3.0) * np.hypot(*errors) / means[1]
    assert abs(means[0] / means[1] - 1.0) < RESAMPLED + noise, (means, errors)
