"""Skies: the sun's place, the light of a scene, the verb."""

from __future__ import annotations

import math
from datetime import datetime

import numpy as np
import pytest

import antumbra as am

NREL = datetime.fromisoformat("2003-10-17T12:30:30-07:00")


def test_the_sun_stands_where_the_almanac_says():
    """NREL TP-560-34302, appendix A.5: zenith 50.11162°, azimuth 194.34024°, refraction included; to 0.01°."""
    sky = am.lights.Sky.at(NREL, math.radians(39.742476), math.radians(-105.1786))
    assert math.degrees(sky.elevation) == pytest.approx(90 - 50.11162, abs=0.01)
    assert math.degrees(sky.azimuth) == pytest.approx(194.34024, abs=0.01)
    assert sky.distance == pytest.approx(0.9965423, abs=1e-4)


def test_times_need_an_offset_and_a_sun():
    with pytest.raises(ValueError, match="no offset from UTC"):
        am.lights.Sky.at(NREL.replace(tzinfo=None), 0.7, -1.8)
    with pytest.raises(ValueError, match="below the horizon"):
        am.lights.Sky.at(NREL, 0.7, math.pi - 1.8)
    with pytest.raises(ValueError, match="turbidity"):
        am.lights.Sky(0.5, turbidity=20)


def test_a_sky_lights_a_scene():
    """Irradiance of level ground under the two lights is that of the picture with its sun drawn in.

    Five standard errors, and 1 % for the dome's texels, drawn coarser here than in the scene.
    """
    sky = am.lights.Sky(math.radians(50), turbidity=4)
    scene = am.Scene()
    scene.add_light(sky)
    up = [[0.0, 1.0, 0.0]]
    two = scene.irradiance([[0.0, 0.0, 0.0]], up, shadow_rays=4096)
    pixels = sky.picture(256).astype(float)
    theta = np.linspace(0, math.pi, len(pixels) + 1)
    borders = np.clip(np.cos(theta), 0, None) ** 2
    each = (borders[:-1] - borders[1:]) * math.pi / pixels.shape[1]
    drawn = (pixels * each[:, None, None]).sum(axis=(0, 1))
    assert np.all(np.abs(two[0] - drawn) <= 5 * two.standard_error[0] + 0.01 * drawn)
    assert scene.visible_fraction([[0.0, 1.0, 0.0]], up, light="sun")[0] == pytest.approx(1.0)


def test_the_words_are_the_light():
    """`environment="sky:…"` and the light give the same picture; without an environment the sun goes too."""
    ground = am.Scene()
    ground.add_mesh([[-9, 0, -9], [9, 0, -9], [9, 0, 9.0], [-9, 0, 9]], [[0, 2, 1], [0, 3, 2]])
    look = {"eye": (0, 1, 3), "look_at": (0, 0, 0), "size": (8, 6), "viewing_rays": 4}
    words = ground.render(environment="sky:elevation=50:turbidity=4", **look).pixels
    ground.add_light(am.lights.Sky(math.radians(50), turbidity=4))
    assert np.array_equal(words, ground.render(**look).pixels)
    assert not ground.render(environment="none", **look).pixels.any()
    with pytest.raises(am.OptionError, match='no "height"'):
        ground.render(environment="sky:height=3", **look)


def test_the_verb(antumbra):
    place = ["--place", "39.742476,-105.1786", "--time", "2003-10-17T12:30:30-07:00"]
    done = antumbra("sky", *place, "--width", "64", "-o", "a.exr")
    assert done.code == 0, done.err
    assert "64 × 32 · sun 39.89° high at 194.34° (south-south-west)" in done.out
    assert "--environment sky:elevation=39.89" in done.out
    again = antumbra("render", "a.exr", "--size", "8x6", "--viewing-rays", "1")
    assert again.code == 0, again.err


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--elevation", "-3"], "elevation"),
        (["--place", "48,2"], "--place and --time belong together"),
        (["--place", "48", "--time", "2026-06-21T12:00Z"], "two numbers are needed"),
        (["--place", "48,2", "--time", "noon"], "a time is needed"),
        (["--place", "48,2", "--time", "2026-06-21T12:00Z", "--azimuth", "3"], "not both"),
        (["-o", "sky.jpg"], "ends in .exr or .png"),
    ],
)
def test_what_the_verb_refuses(options, said, antumbra, tmp_path):
    done = antumbra("sky", *options)
    assert (done.code, said in done.err) == (2, True), done.err
    assert not list(tmp_path.iterdir())


def test_blends_of_materials():
    """Under an even sky a blend of two albedos shows their weighted mean; five standard errors."""
    scene = am.Scene()
    two = am.materials.Blend(
        am.materials.Diffuse((1.0, 0.0, 0.5)), am.materials.Diffuse((0.0, 1.0, 0.5)), 0.25
    )
    scene.add_mesh([[-9, 0, -9], [9, 0, -9], [9, 0, 9.0], [-9, 0, 9]], [[0, 2, 1], [0, 3, 2]], material=two)
    scene.add_light(am.lights.Environment(1.0))
    image = scene.render(eye=(0, 2, 0.1), look_at=(0, 0, 0), size=(16, 12), viewing_rays=64, bounces=1)
    mean, error = image.pixels.mean((0, 1)), np.sqrt((image.standard_error**2).mean((0, 1)) / (16 * 12))
    assert np.all(np.abs(mean - [0.75, 0.25, 0.5]) <= 5 * error + 1e-5)
    with pytest.raises(ValueError, match="weight"):
        am.materials.Blend(am.materials.Diffuse(), am.materials.Mirror(), 2.0)
