"""The same with trimesh itself: its meshes, and its own methods with our rays."""

from __future__ import annotations

import importlib
import os
from types import SimpleNamespace

import numpy as np
import pytest

import antumbra as am
from reported import CASES
from solids import sphere


@pytest.fixture(scope="module")
def trimesh():
    """The library, a dependency of the tests. Without it: skipped, but a failure under CI=true."""
    try:
        return importlib.import_module("trimesh")
    except ImportError:
        if os.environ.get("CI") == "true":
            pytest.fail("trimesh is missing: `make setup` installs it")
        pytest.skip("trimesh is not installed")


def test_its_meshes_go_in_flat_or_with_the_normals_that_they_hold(trimesh):
    box = trimesh.creation.box()
    flat, smooth = am.Scene(), am.Scene()
    flat.add_mesh(box)
    _ = box.vertex_normals
    smooth.add_mesh(box)
    rays = [[0.4, 0.3, 3.0]], [[0.0, 0, -1]]
    np.testing.assert_allclose(flat.closest_hit(*rays).shading_normal, [[0, 0, 1]], atol=1e-6)
    assert smooth.closest_hit(*rays).shading_normal[0, 2] < 0.99
    with pytest.raises(TypeError, match=r"holds several meshes: give \.to_mesh\(\)"):
        flat.add_mesh(trimesh.Scene([box]))
    with pytest.raises(TypeError, match="has no faces: points and lines cast no shadow"):
        flat.add_mesh(trimesh.PointCloud([[0, 0, 0], [1, 0, 0]]))


@pytest.mark.parametrize(
    "make", [c for c in CASES if c().question == "inside"], ids=lambda make: make.__name__
)
def test_its_own_methods_ask_our_rays(trimesh, make):
    case = make()
    mesh = trimesh.Trimesh(case.vertices, case.faces, process=False)
    mesh.ray = am.trimesh_ray(mesh)
    np.testing.assert_array_equal(mesh.contains(case.origins), case.answer)


def test_it_answers_as_the_engine_of_trimesh_where_nothing_is_close(trimesh):
    mesh = trimesh.Trimesh(*sphere(1.0))
    # In place of the tree, for which it needs rtree: every triangle for every ray.
    every = SimpleNamespace(bounds=mesh.bounds.reshape(-1), intersection=lambda _: range(len(mesh.faces)))
    mesh._cache["triangles_tree"] = every
    theirs = importlib.import_module("trimesh.ray.ray_triangle").RayMeshIntersector(mesh)
    ours = am.trimesh_ray(mesh)
    rng = np.random.default_rng(5)
    o, d = rng.normal(size=(2, 100, 3)) * [[[1.5]], [[1.0]]]
    for name in ("intersects_any", "intersects_first", "contains_points"):
        asked = (o,) if name == "contains_points" else (o, d)
        mine, other = getattr(ours, name)(*asked), getattr(theirs, name)(*asked)
        assert mine.dtype == other.dtype and mine.shape == other.shape
        np.testing.assert_array_equal(mine, other)
    mine, other = ours.intersects_location(o, d), theirs.intersects_location(o, d)
    assert [(part.dtype, part.shape) for part in mine] == [(part.dtype, part.shape) for part in other]
    a, b = (np.lexsort((part[0] @ [1, 2, 3], part[1])) for part in (mine, other))
    np.testing.assert_array_equal(mine[2][a], other[2][b])
    # Both in double precision, with a few roundings each of numbers about 1.
    np.testing.assert_allclose(mine[0][a], other[0][b], rtol=0, atol=1e-12)


def test_a_mesh_that_moves_is_followed(trimesh):
    mesh = trimesh.creation.box()
    mesh.ray = am.trimesh_ray(mesh)
    assert mesh.contains([[0, 0, 0]])[0]
    mesh.apply_translation([5, 0, 0])
    assert not mesh.contains([[0, 0, 0]])[0] and mesh.contains([[5, 0, 0]])[0]
