"""Misses and false hits that users reported of ray engines: ours has none of them (docs/bridges.md has theirs)."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import antumbra as am
from reported import CASES


@pytest.fixture(scope="module", params=CASES, ids=lambda make: make.__name__)
def case(request):
    return request.param()


def test_the_answer_is_right(case):
    ray = am.trimesh_ray(SimpleNamespace(vertices=case.vertices, faces=case.faces))
    if case.question == "inside":
        answer = ray.contains_points(case.origins)
    elif case.question == "blocked":
        answer = ray.intersects_any(case.origins, case.directions)
    else:
        _, index_ray = ray.intersects_id(case.origins, case.directions)
        answer = np.bincount(index_ray, minlength=len(case.origins))
    np.testing.assert_array_equal(answer, case.answer)


def test_all_methods_agree(case):
    ray = am.trimesh_ray(SimpleNamespace(vertices=case.vertices, faces=case.faces))
    asked = case.origins, case.directions
    met = np.flatnonzero(ray.intersects_first(*asked) >= 0)
    np.testing.assert_array_equal(np.flatnonzero(ray.intersects_any(*asked)), met)
    first, which, _ = ray.intersects_location(*asked, multiple_hits=False)
    every, rays, _ = ray.intersects_location(*asked)
    np.testing.assert_array_equal(which, met)
    assert np.all(np.diff(rays) >= 0)
    rays, at = np.unique(rays, return_index=True)
    np.testing.assert_array_equal(rays, met)
    # Each distance is right to 2⁻²⁹ of itself, and a place to the rounding of the mesh and the ray about it.
    far = np.linalg.norm(first - case.origins[met], axis=1, keepdims=True)
    assert np.all(np.abs(first - every[at]) <= 2.0**-28 * far + 2.0**-20 * np.ptp(case.vertices))
