"""`trimesh_ray`: every hit against the law in rational numbers, each place once; inside against closed forms."""

from __future__ import annotations

import copy
import pickle
import re
from types import SimpleNamespace

import numpy as np
import pytest

import antumbra as am
from solids import box, joined, lattice, meets


def mesh_of(vertices, faces):
    return SimpleNamespace(vertices=np.asarray(vertices), faces=np.asarray(faces))


@pytest.fixture(scope="module")
def soup():
    """Triangles and rays between places of a small lattice, where edges, corners and planes are met all the time.

    With (t, lowest face) of every place that each ray hits, in rational numbers.
    """
    rng = np.random.default_rng(7)
    corners = rng.integers(-3, 4, (28, 3, 3)).astype(float)
    corners[:4] = corners[-4:][:, [1, 2, 0]]
    origins, directions = rng.integers(-4, 5, (2, 120, 3)).astype(float)
    places = []
    for origin, direction in zip(origins, directions, strict=True):
        found = {}
        for number, triangle in enumerate(corners):
            t = meets(origin, direction, triangle)
            if t is not None:
                found.setdefault(t, number)
        places.append(sorted(found.items()))
    return corners, origins, directions, places


@pytest.mark.parametrize("scale", [1.0, 2.0**-40, 2.0**60])
def test_every_place_is_found_once_and_in_order(soup, scale):
    corners, origins, directions, places = soup
    ray = am.trimesh_ray(mesh_of(scale * corners.reshape(-1, 3), np.arange(84).reshape(-1, 3)))
    index_tri, index_ray, locations = ray.intersects_id(origins * scale, directions, return_locations=True)
    assert max(map(len, places)) > 4
    for number, wanted in enumerate(places):
        chosen = index_ray == number
        assert index_tri[chosen].tolist() == [face for _, face in wanted]
        # The place in double precision: a few roundings of numbers up to 8.
        where = [origins[number] + float(t) * directions[number] for t, _ in wanted]
        np.testing.assert_allclose(locations[chosen] / scale, np.reshape(where, (-1, 3)), rtol=0, atol=1e-13)


def test_the_law_of_pairs_is_that_of_rational_numbers_where_it_is_close():
    from antumbra._law import Pairs, hits, vectors

    rng = np.random.default_rng(11)
    n = 600
    corners = rng.normal(size=(n, 3, 3))
    # Aimed at corners, edges and points inside, then moved by a rounding or not at all; a third is all but flat.
    corners[::3, 2] = (corners[::3, 0] + corners[::3, 1]) / 2 + rng.normal(size=(len(corners[::3]), 3)) * 1e-9
    weights = (
        np.eye(3)[rng.integers(0, 3, n)] * rng.integers(0, 2, (n, 1)) + rng.integers(0, 2, (n, 3)) + 1e-300
    )
    aims = np.einsum("nk,nkj->nj", weights / weights.sum(axis=1)[:, None], corners)
    origins = rng.normal(size=(n, 3)) * 10.0 ** rng.integers(-3, 4, (n, 1))
    directions = aims - origins
    a, b, c = (vectors(corners[:, k]) for k in range(3))
    met, t = hits(Pairs(vectors(origins), vectors(directions), a, b, c))
    truth = [meets(o, d, tri) for o, d, tri in zip(origins, directions, corners, strict=True)]
    assert met.tolist() == [i for i, one in enumerate(truth) if one is not None]
    # LAW: the parameter of a hit is right to 2⁻²⁹ relatively.
    np.testing.assert_allclose(t, [float(one) for one in truth if one is not None], rtol=2.0**-29)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("scale", [1.0, 2.0**-100, 2.0**90])
def test_no_box_hides_a_triangle(kind, scale):
    from antumbra._boxes import Boxes
    from antumbra._crossings import pairs_of
    from antumbra._law import hits

    rng = np.random.default_rng(13)
    # Flat boxes, slivers and points; rays along axes, and aimed at corners from near and far.
    corners = (
        rng.normal(size=(90, 3, 3)) * rng.choice([0, 1e-6, 1], (90, 1, 3)) + rng.normal(size=(90, 1, 3))
    ).astype(kind)
    aims = corners[rng.integers(0, 90, 600), rng.integers(0, 3, 600)]
    directions = (rng.normal(size=(600, 3)) * rng.choice([0, 1e-3, 1], (600, 3))).astype(kind)
    directions[~directions.any(axis=1), 0] = 1
    origins = (aims - directions * rng.choice([0.5, 4, 1e6], (600, 1)).astype(kind)).astype(kind)
    corners, origins = (corners * kind(scale)), (origins * kind(scale))
    rays, faces = (x.reshape(-1) for x in np.meshgrid(np.arange(600), np.arange(90), indexing="ij"))
    doubles = (x.astype(np.float64) for x in (origins, directions, corners))
    met, _ = hits(pairs_of(*doubles, rays, faces))
    near = {
        (int(r), int(f))
        for part in Boxes(corners).near(origins, directions)
        for r, f in zip(*part, strict=True)
    }
    missing = {(int(rays[i]), int(faces[i])) for i in met} - near
    assert len(met) > 300 and not missing


def test_shapes_and_kinds_of_numbers():
    ray = am.trimesh_ray(mesh_of(*box(1, 2)))
    up, out = [[0.25, 0.25, -1.0]], [[5.0, 5, 5]]
    for origins, hits in ((up, 2), (out, 0)):
        directions = [[0, 0, 1]]
        index_tri, index_ray = ray.intersects_id(origins, directions)
        locations, rays, faces = ray.intersects_location(origins, directions)
        assert (index_tri.shape, index_ray.shape, locations.shape) == ((hits,), (hits,), (hits, 3))
        assert (index_tri.dtype, index_ray.dtype, locations.dtype) == (np.int64, np.int64, np.float64)
        assert (rays.tolist(), faces.tolist()) == (index_ray.tolist(), index_tri.tolist())
        first, any_ = ray.intersects_first(origins, directions), ray.intersects_any(origins, directions)
        assert (first.dtype, any_.dtype, any_.tolist()) == (np.int64, bool, [hits > 0])
        assert first.tolist() == (index_tri[:1].tolist() or [-1])
    none = np.zeros((0, 3))
    assert ray.intersects_any(none, none).shape == ray.contains_points([]).shape == (0,)
    assert [part.shape for part in ray.intersects_location([], [])] == [(0, 3), (0,), (0,)]
    assert repr(ray) == "<TrimeshRay: 48 faces>"


@pytest.mark.parametrize("size", [1e-300, 1e-30, 1e30, 1e300])
def test_no_size_and_no_distance_is_too_large(size):
    vertices, faces = box(1, 2)
    ray = am.trimesh_ray(mesh_of(vertices * size, faces))
    starts = np.array([[0.25, 0.375, -1], [0.25, 0.375, -1e6], [0.25, 0.375, 2], [7e5, 3, -1e6]]) * size
    locations, rays, _ = ray.intersects_location(starts, [[0, 0, size]] * 4)
    assert rays.tolist() == [0, 0, 1, 1]
    np.testing.assert_allclose(locations / size, [[0.25, 0.375, 0], [0.25, 0.375, 1]] * 2, rtol=0, atol=1e-12)
    assert ray.contains_points(np.array([[0.5, 0.5, 0.5], [0.5, 1.5, 0.5]]) * size).tolist() == [True, False]
    far = min(1e200 * size, 1e305)
    starts = [[0.25 * size, 0.375 * size, far], [far, far, far]]
    assert ray.intersects_any(starts, [[0.0, 0, -1], [1, 1, 1]]).tolist() == [True, False]


def test_the_number_of_hits_can_be_limited():
    sheets = joined(*[box(1, 1, 2.0 * k) for k in range(3)])
    ray = am.trimesh_ray(mesh_of(*sheets))
    o, d = [[-1.0, -0.75, -0.5], [9, 9, 9]], [[1.0, 1, 1], [1, 0, 0]]
    every, rays = ray.intersects_id(o, d)
    assert len(every) == 6 and not rays.any()
    for limit in (1, 4, 100):
        some, _ = ray.intersects_id(o, d, max_hits=limit)
        assert some.tolist() == every[:limit].tolist()
    one, which = ray.intersects_id(o, d, multiple_hits=False)
    assert (one.tolist(), which.tolist()) == (every[:1].tolist(), [0])


def test_a_start_in_a_face_is_not_blocked_by_it():
    ray = am.trimesh_ray(mesh_of(*box(1, 2)))
    origins = np.array([[0.25, 0.125, 0], [0.25, 0.125, 0], [0.5, 0.5, 1], [0, 0, 0], [0.25, 0.25, 0.5]])
    directions = np.array([[0, 0, 1.0], [0, 0, -1], [1, 0, 0], [1, 1, 1], [0, 0, 0]])
    _, rays = ray.intersects_id(origins, directions)
    # In a face: to the other side; outwards: nothing; in the plane of a face: its rim; a corner: the far corner.
    assert np.bincount(rays, minlength=5).tolist() == [1, 0, 1, 1, 0]


def test_inside_is_a_closed_form():
    # |x| + |y| + |z| ≤ 1 in eighths: sums are exact, and many points lie on faces, edges and corners.
    tips = np.concatenate([np.eye(3), -np.eye(3)])
    faces = [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]]
    points = lattice(-1.125, 1.125, 0.125)
    inside = np.abs(points).sum(axis=1) <= 1
    turns = [np.eye(3), np.roll(np.eye(3), 1, axis=0), np.roll(np.eye(3), 2, axis=0)]
    for turn in turns:
        ray = am.trimesh_ray(mesh_of(tips @ turn, faces))
        np.testing.assert_array_equal(ray.contains_points(points @ turn), inside)
    # The surface belongs to the solid, one rounding beside it decides.
    beside = np.array([[1.0, 0, 0], [np.nextafter(1, 2), 0, 0], [0.5, np.nextafter(0.5, 0), 0]])
    assert ray.contains_points(beside).tolist() == [True, False, True]


def test_inside_where_solids_meet_and_where_they_are_hollow():
    points = lattice(0.125, 2.875, 0.25)
    one, two, all_ = (
        (points > low).all(axis=1) & (points < high).all(axis=1) for low, high in ((0, 2), (1, 3), (0, 3))
    )
    touching = am.trimesh_ray(mesh_of(*joined(box(1, 1), box(1, 1, 1.0))))
    np.testing.assert_array_equal(
        touching.contains_points(points),
        ((points < 1).all(axis=1)) | ((points > 1) & (points < 2)).all(axis=1),
    )
    sharing = am.trimesh_ray(mesh_of(*joined(box(2, 2), box(2, 2, 1.0))))
    np.testing.assert_array_equal(sharing.contains_points(points), one ^ two)
    assert all_.all()


def test_inside_far_from_the_origin_and_of_loose_triangles():
    vertices, faces = box(1, 3)
    shift = np.array([1e6, -3e5, 2e7])
    ray = am.trimesh_ray(
        mesh_of((vertices + shift)[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3))
    )
    points = np.random.default_rng(3).uniform(-0.5, 1.5, (4000, 3)) + shift
    low, high = shift, (vertices + shift).max(axis=0)
    np.testing.assert_array_equal(
        ray.contains_points(points), ((points >= low) & (points <= high)).all(axis=1)
    )


def test_inside_of_an_open_mesh_is_what_most_directions_say():
    vertices, faces = box(1, 1)
    top = (vertices[faces][..., 2] == 1).all(axis=1)
    ray = am.trimesh_ray(mesh_of(vertices, faces[~top]))
    assert ray.contains_points([[0.4, 0.3, 0.5], [0.5, 0.5, 2], [0.4, 0.3, -0.5]]).tolist() == [
        True,
        False,
        False,
    ]


class Changing:
    """A mesh that hashes what it consists of, as a trimesh does."""

    def __init__(self, vertices, faces):
        self.vertices, self.faces = vertices, faces

    def __hash__(self):
        return hash(self.vertices.tobytes())

    def __eq__(self, other):
        return self is other


def test_a_mesh_that_changes_is_read_again():
    mesh = Changing(*box(1, 1))
    ray = am.trimesh_ray(mesh)
    up = [[0.4, 0.3, -1.0]], [[0.0, 0, 1]]
    assert ray.intersects_any(*up)[0]
    mesh.vertices = mesh.vertices + 5
    assert not ray.intersects_any(*up)[0] and ray.contains_points([[5.5, 5.5, 5.5]])[0]


def test_it_is_copied_and_pickled_as_its_mesh():
    ray = am.trimesh_ray(mesh_of(*box(1, 1)))
    for other in (copy.deepcopy(ray), pickle.loads(pickle.dumps(ray))):
        assert other.contains_points([[0.5, 0.5, 0.5]])[0] and other.mesh is not ray.mesh


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda r: r.intersects_any([[0, 0, 0]], [[0, 0, 1]] * 2), "one direction per origin is needed"),
        (lambda r: r.intersects_id([0, 0, 0], [0, 0, 1]), "ray_origins has shape (3,): (N, 3) is needed"),
        (lambda r: r.intersects_first([[0, 0, np.nan]], [[0, 0, 1]]), "ray_origins[0] is [0.0, 0.0, nan]"),
        (
            lambda r: am.trimesh_ray(mesh_of([[0, 0, 0], [1, 0, np.nan], [0, 1, 0]], [[0, 1, 2]])),
            "vertices[1] is [1.0",
        ),
        (lambda r: r.contains_points([[0, 0, 0], [0, np.inf, 0]]), "points[1] is [0.0, inf, 0.0]"),
        (
            lambda r: am.trimesh_ray(mesh_of(np.zeros((0, 3)), np.zeros((0, 3), int))),
            "is empty: it has no vertices",
        ),
        (
            lambda r: am.trimesh_ray(mesh_of(np.eye(3), [[0, 1, 3]])),
            "faces asks for vertex 3, but there are 3",
        ),
    ],
)
def test_what_is_wrong_is_named(ask, said):
    ray = am.trimesh_ray(mesh_of(*box(1, 1)))
    with pytest.raises(ValueError, match=re.escape(said)):
        ask(ray)
