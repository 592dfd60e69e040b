"""Shadows taken apart: regions of lights, what segments visit, a pixel with every ray."""

from __future__ import annotations

import json

import numpy as np
import pytest

import antumbra as am
from antumbra import Region


def test_regions_under_a_ball():
    """A disk of light (radius 1, height 4) and a ball (radius 0.5, height 3): similar triangles say where what is.

    On the axis the light fills atan(1/4) = 14.0° and the ball asin(0.5/3) = 9.6°: antumbra. With the ball at height 1
    it fills 30°: umbra.
    """
    for height, middle in ((3.0, Region.ANTUMBRA), (1.0, Region.UMBRA)):
        scene = am.Scene()
        scene.add_shape(am.shapes.Sphere((0, height, 0), 0.5))
        scene.add_light(am.lights.Disk((0, 4, 0), (0, -1, 0), 1.0, radiance=1.0), name="lamp")
        points = [[0.0, 0, 0], [0.9, 0, 0], [50.0, 0, 0], [0.0, 5, 0]]
        found = scene.regions(points, (0.0, 1, 0), light="lamp")
        assert found.dtype == np.int8
        assert [Region(code) for code in found] == [middle, Region.PENUMBRA, Region.LIT, Region.NONE]


def test_the_map_of_a_picture_is_the_answer_at_its_points():
    scene = am.builtin("antumbra")
    size = (60, 36)
    image = scene.render(size=size, viewing_rays=1, estimator="area", aov="regions,depth")
    assert set(image.aov) == {"depth", "regions.key", "regions.fill"}
    assert image.metadata["antumbra.region-points"] == "64"
    hit = scene.closest_hit(*scene.camera_rays(size))
    for light in ("key", "fill"):
        asked = scene.regions(hit.receivers, light=light)
        np.testing.assert_array_equal(image.aov[f"regions.{light}"], asked.reshape(36, 60))
    few = scene.render(size=size, viewing_rays=1, aov="regions", light="key", region_points=8)
    assert list(few.aov) == ["regions"] and few.metadata["antumbra.region-points"] == "8"
    # Eight points know the borders only roughly: nearly all pixels lie beside them.
    assert np.mean(few.aov["regions"] == image.aov["regions.key"]) > 0.9
    with pytest.raises(am.OptionError, match="from 4 to 65536"):
        scene.regions(hit.receivers, n=1)


def test_visits_have_the_answers_of_occluded():
    scene = am.builtin("corner")
    rng = np.random.default_rng(4)
    a, b = rng.uniform(0.01, 2.5, (2, 500, 3))
    found = scene.visits(a, b)
    np.testing.assert_array_equal(found.blocked, scene.occluded(a, b))
    free = ~found.blocked
    assert free.any() and found.blocked.any()
    # A free segment asks the same of every box and triangle on its way, whatever the question.
    np.testing.assert_array_equal(found.any_boxes[free], found.closest_boxes[free])
    np.testing.assert_array_equal(found.any_primitives[free], found.closest_primitives[free])
    assert found.any_primitives.sum() < found.closest_primitives.sum()
    along = scene.visits(a, directions=b - a, max_distance=1.0)
    # The same segments but for the rounding of b − a.
    assert np.mean(along.blocked == found.blocked) > 0.99
    with pytest.raises(ValueError, match="one of targets and directions"):
        scene.visits(a)


@pytest.mark.parametrize("estimator", ["area", "hemisphere", "mis"])
def test_a_pixel_taken_apart_is_the_pixel(estimator):
    scene = am.builtin("cornell-box")
    options = {"estimator": estimator, "viewing_rays": 5, "shadow_rays": 3, "seed": 2, "size": (40, 40)}
    image = scene.render(bounces=1, **options)
    for pixel in ((8, 34), (20, 36), (20, 3), (39, 0)):
        found = scene.explain(pixel, **options)
        # The same terms, summed in double precision, rounded once to single.
        np.testing.assert_allclose(found.value, image.pixels[pixel[1], pixel[0]], rtol=2.5e-7)
        np.testing.assert_allclose(np.sum([ray.brings for ray in found.viewing_rays], axis=0), found.value)
        assert len(found.viewing_rays) == 5 and found.size == (40, 40)
    row = next(row for row in scene.explain((8, 34), viewing_rays=2, size=(40, 40)).light_rays if row.visible)
    formula = np.array(row.radiance) * row.brdf * row.cos / (row.pdf * 2)
    np.testing.assert_allclose(row.brings, formula, rtol=1e-6)
    assert row.distance2 == row.distance**2


def test_explain_in_the_terminal(antumbra):
    words = ("explain", "cornell-box", "--pixel", "8,34", "--size", "40x40", "--viewing-rays", "2")
    ended = antumbra(*words, "--shadow-rays", "3", "--estimator", "mis")
    assert ended.code == 0 and ended.err == ""
    assert max(map(len, ended.out.splitlines())) <= 80
    assert ended.out.startswith("cornell-box, pixel 8,34 of 40 × 40 · mis, 2 viewing × 3 shadow rays")
    assert ended.out.count("lamp ") >= 6 and ended.out.count("its sum") == 2
    told = json.loads(antumbra(*words, "--json").out)
    assert len(told["viewing_rays"]) == 2 and told["lights"] == ["lamp"]
    assert told["viewing_rays"][0]["receiver"]["object"] == "floor"
    np.testing.assert_allclose(
        np.sum([row["brings"] for ray in told["viewing_rays"] for row in ray["light_rays"]], axis=0),
        told["value"],
    )


def test_what_cannot_be_taken_apart_is_told(antumbra):
    ended = antumbra("explain", "pillars", "--pixel", "5,5", "--estimator", "path")
    assert ended.code == 2 and "Choose estimator area" in ended.err and ended.out == ""
    assert "pixel 700,5 does not lie in 640 × 480" in antumbra("explain", "pillars", "--pixel", "700,5").err
    assert "--pixel 5: column and row" in antumbra("explain", "pillars", "--pixel", "5").err
    assert "--pixel X,Y is missing" in antumbra("explain", "pillars").err
    with pytest.raises(ValueError, match="count from 0"):
        am.builtin("pillars").explain((-1, 0))
