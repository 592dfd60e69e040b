"""Meshes of trimesh, Open3D and PyVista go into `add_mesh` as they are; what does not fit says why."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest

import antumbra as am
from antumbra._meshes import mesh_of, triangulated
from common import FACES, SQUARE
from stand_ins import Legacy, Surface, Tensors, Trimesh, cells

TILTED = np.tile([0.6, 0.8, 0.0], (4, 1))
FOUR = [0, 3, 2, 1]


def kinds(normals):
    return {
        "trimesh": Trimesh(SQUARE, FACES, normals),
        "open3d": Legacy(SQUARE, FACES, () if normals is None else normals),
        "open3d tensors": Tensors(SQUARE.astype(np.float32), FACES, normals),
        "pyvista": Surface(SQUARE, cells(*FACES), normals),
        "pyvista quads": Surface(SQUARE, cells(FOUR), normals),
    }


@pytest.mark.parametrize("kind", kinds(None))
def test_a_mesh_goes_in_as_it_is(kind):
    up, down = [[0.3, 1.0, 0.2]], [[0.0, -1, 0]]
    for normals, shown in ((None, [0.0, 1, 0]), (TILTED, TILTED[0])):
        scene = am.Scene()
        scene.add_mesh(kinds(normals)[kind])
        hit = scene.closest_hit(up, down)
        assert hit.t[0] == 1 and scene.info()["triangles"] == 2
        np.testing.assert_allclose(hit.shading_normal[0], shown, atol=1e-6)
    given = am.Scene()
    given.add_mesh(kinds(TILTED)[kind], normals=np.tile([0.0, 1, 0], (4, 1)))
    np.testing.assert_allclose(given.closest_hit(up, down).shading_normal[0], [0, 1, 0], atol=1e-6)


def area(points, faces):
    a, b, c = points[faces].transpose(1, 0, 2)
    return np.cross(b - a, c - a).sum(axis=0) / 2


def test_polygons_become_triangles_of_the_same_side_and_area():
    # An arrow's head (concave at 1), a star of five points seen whole from its first corner only, an L.
    head = [[0, 0], [2, 1], [4, 0], [2, 4]]
    fan = [[0, 0], [4, 0], [4, 1], [2, 1], [3, 3]]
    corner = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]
    for shape in (head, fan, corner):
        flat = np.array(shape, float)
        exact = area2(flat)
        for turn in range(len(flat)):
            for way in (1, -1):
                points = np.roll(flat, turn, axis=0)[::way]
                raised = np.column_stack([points, points[:, 0]])
                faces = triangulated(raised, np.array(cells(range(len(points)))))
                sides = np.array([area(raised, face[None])[2] for face in faces]) * way
                assert len(faces) == len(points) - 2 and np.all(sides >= 0)
                assert np.isclose(sides.sum(), exact, rtol=1e-12)


def area2(points):
    x, y = points.T
    return abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


def test_polygons_keep_their_order():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0], [3, 0.5, 0]])
    faces = triangulated(points, np.array(cells([0, 1, 2, 3], [1, 4, 5], [1, 4, 6, 5, 2])))
    owners = [set(face) for face in faces.tolist()]
    assert [o <= {0, 1, 2, 3} for o in owners[:2]] == [True, True]
    assert owners[2] == {1, 4, 5} and all(o <= {1, 4, 6, 5, 2} for o in owners[3:]) and len(owners) == 6


NONE = np.zeros((0, 3))
# A comb with two teeth: no corner sees all of it.
COMB = [[0, 0], [7, 0], [7, 4], [6, 1], [4, 1], [3.5, 4], [3, 1], [1, 1], [0, 4]]


@pytest.mark.parametrize(
    ("mesh", "error", "said"),
    [
        (Trimesh(NONE, np.zeros((0, 3), int)), ValueError, "is empty: it has no vertices"),
        (Legacy(SQUARE, []), ValueError, "is empty: it has no faces"),
        (Tensors(), ValueError, "is empty: it has no vertices"),
        (Tensors(SQUARE), ValueError, "is empty: it has no faces"),
        (Surface(SQUARE), ValueError, "is empty: it has no faces"),
        (Surface(SQUARE, verts=[1, 0]), ValueError, "has vertex cells, which are no surface"),
        (Surface(SQUARE, cells(*FACES), lines=[2, 0, 1]), ValueError, "has line cells, which are no surface"),
        (
            Surface(SQUARE, strips=[4, 0, 1, 2, 3]),
            ValueError,
            "has triangle strips: .triangulate() makes faces",
        ),
        (Surface(SQUARE, [2, 0, 1]), ValueError, "faces has a cell of 2 corners: 3 or more are needed"),
        (Surface(SQUARE, [4, 0, 1, 2]), ValueError, "faces ends within its last cell: 1 indices are missing"),
        (Surface(SQUARE, cells([0, 1, 2, 4])), ValueError, "faces asks for vertex 4, but there are 4"),
        (Surface(SQUARE, cells([0, 1, 7])), ValueError, "faces asks for vertex 7, but there are 4"),
        (
            Surface(np.column_stack([COMB, np.zeros(9)]), cells([0, 1, 2], range(9))),
            ValueError,
            "face 1 has 9 corners and is seen whole from none of them: .triangulate() the mesh first",
        ),
        (SimpleNamespace(points=SQUARE), TypeError, "has no faces: points and lines cast no shadow"),
        (SimpleNamespace(vertices=SQUARE), TypeError, "has no faces: points and lines cast no shadow"),
        (
            SimpleNamespace(points=SQUARE, extract_surface=None),
            TypeError,
            "is no surface: give .extract_surface()",
        ),
        (SimpleNamespace(geometry={}, to_mesh=None), TypeError, "holds several meshes: give .to_mesh()"),
        (
            SQUARE,
            TypeError,
            "faces are missing: give (F, 3) whole numbers, or a mesh of trimesh, Open3D or PyVista",
        ),
    ],
)
def test_what_does_not_fit_is_named(mesh, error, said):
    with pytest.raises(error, match=re.escape(said)):
        am.Scene().add_mesh(mesh)


def test_triangles_of_a_long_run_are_not_cut():
    faces = np.arange(3000).reshape(-1, 3)
    found = mesh_of(Surface(np.zeros((3000, 3)), cells(*faces)))
    np.testing.assert_array_equal(found.faces, faces)
