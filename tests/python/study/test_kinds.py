"""The reference that a study chooses: apart from what is varied where that can be had, else with a warning."""

from __future__ import annotations

import pytest

import antumbra as am
from antumbra.study import kinds, plan
from common import FACES, SQUARE

SMALL = {"viewing_rays": 1, "size": (16, 12), "seeds": 3}
# The floor alone in the picture.
DOWN = {"eye": (0, 1, 1), "look_at": (0, 0, 0), "fov": 0.6}


@pytest.fixture
def floor_under_sky():
    """A floor and a sky of radiance 1: E = π, and directions with the density cos θ/π find it without noise."""
    scene = am.Scene("floor")
    scene.add_mesh(SQUARE, FACES, material=am.materials.Diffuse(0.5))
    scene.add_light(am.lights.Environment(1.0))
    return scene


def made(*estimators, **fixed):
    return plan.plan({"estimator": estimators}, fixed, parameters={}, budget={}, seeds=3)


@pytest.mark.parametrize(
    ("varied", "apart", "else_"),
    [
        (["area"], ["hemisphere", "surfaces"], "mis"),
        (["hemisphere"], ["area", "surfaces"], "mis"),
        (["surfaces"], ["area", "hemisphere"], "mis"),
        (["mis"], ["surfaces"], "area"),
        (["area", "hemisphere"], ["surfaces"], "mis"),
        (["path"], [], "path-hemisphere"),
    ],
)
def test_what_shares_no_part_comes_first(varied, apart, else_):
    assert kinds.apart(made(*varied)) == apart
    assert kinds.any_other(made(*varied)) == else_


def warned(found):
    return [text for level, _, text in found.messages if level == "warning" and "would not show" in text]


def test_directions_judge_light_points_where_they_find_the_light_well(floor_under_sky):
    found = am.study.run(
        floor_under_sky, vary={"shadow_rays": [1, 4]}, estimator="area", reference_rays=8192, **SMALL, **DOWN
    )
    assert found.reference.startswith("hemisphere") and not warned(found) and not found.flagged()


def test_light_points_judge_directions():
    found = am.study.run(
        "pillars", vary={"shadow_rays": [1]}, estimator="hemisphere", reference_rays=512, **SMALL
    )
    assert found.reference.startswith("area") and not warned(found) and not found.flagged()


def test_mis_judges_its_own_parts_only_with_a_warning():
    found = am.study.run("pillars", vary={"shadow_rays": [1]}, estimator="area", reference_rays=64, **SMALL)
    assert found.reference.startswith("mis")
    (text,) = warned(found)
    assert (
        text.startswith("the reference, mis, finds light partly in the way of area") and "hemisphere" in text
    )
    assert text.count("is too noisy here") == 2
    named = am.study.run("pillars", vary={"shadow_rays": [1]}, estimator="area", reference="mis", **SMALL)
    assert len(warned(named)) == 1


def test_an_estimator_that_is_blind_to_a_light_is_not_chosen(floor_under_sky):
    floor_under_sky.add_light(am.lights.Point((0, 1, 0), intensity=1.0))
    found = am.study.run(
        floor_under_sky, vary={"shadow_rays": [1]}, estimator="area", reference_rays=8192, **SMALL, **DOWN
    )
    (text,) = warned(found)
    assert text.count("does not see all lights here") == 2 and not found.flagged()
    assert not any("does not see lights" in said for _, _, said in found.messages)


def test_a_small_light_that_directions_miss_accuses_nobody(floor_under_sky):
    # A quarter of the light comes from a disk that a direction in some 10⁵ hits.
    floor_under_sky.add_light(am.lights.Disk((0, 1, 0), (0, -1, 0), radius=0.003, radiance=4e4))
    found = am.study.run(
        floor_under_sky, vary={"shadow_rays": [4]}, estimator="area", reference_rays=8192, **SMALL, **DOWN
    )
    assert found.reference.startswith("mis") and not found.flagged()
    assert "of the light of mis in a pilot" in warned(found)[0] or "too noisy" in warned(found)[0]


# A clear sky low over the horizon with its sun, half a degree wide: a direction in some 10⁵ hits it.
SUNNY = {"environment": "sky:elevation=40:azimuth=120", "reference_rays": 2048}


def test_under_a_small_sun_paths_of_directions_judge_nobody():
    found = am.study.run("pillars", vary={"sampler": ["random", "owen"]}, **SUNNY, **SMALL)
    assert found.reference.startswith("path,") and not found.flagged() and found.tested()
    (text,) = [text for level, _, text in found.messages if level == "warning" and "so is a variant" in text]
    assert "path-hemisphere" in text and ("of the light of path" in text or "too noisy" in text)


def test_under_a_small_sun_directions_judge_neither_light_points_nor_both():
    found = am.study.run("pillars", vary={"estimator": ["area", "mis"]}, **SUNNY, **SMALL)
    assert found.reference.startswith("mis,") and not found.flagged() and found.tested()


def test_paths_of_directions_judge_paths_where_they_find_the_light(floor_under_sky):
    found = am.study.run(floor_under_sky, vary={"shadow_rays": [1, 4]}, reference_rays=2048, **SMALL, **DOWN)
    assert found.reference.startswith("path-hemisphere") and not found.flagged()
