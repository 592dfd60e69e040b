"""Arrays in every shape, stride and kind of number; what is wrong is named with its shape or its value."""

from __future__ import annotations

import re

import numpy as np
import pytest

import antumbra as am
from common import FACES, SQUARE

RNG = np.random.default_rng(20)
ORIGINS = RNG.uniform([-1, 0.5, -1], [1, 1.5, 1], (1000, 3))
TARGETS = RNG.uniform([-2, -1, -2], [2, 0.4, 2], (1000, 3))


def blocked_by_the_square(p, q):
    """The closed form: the segment crosses y = 0 inside [−1, 1]²."""
    t = p[:, 1] / (p[:, 1] - q[:, 1])
    at = p + (q - p) * t[:, None]
    return (t > 0) & (t < 1) & (np.abs(at[:, [0, 2]]) < 1).all(axis=1)


@pytest.fixture
def square() -> am.Scene:
    scene = am.Scene()
    scene.add_mesh(SQUARE, FACES)
    return scene


def strided(array):
    """The same numbers, every second row and column of a larger array, backwards."""
    large = np.zeros((2 * len(array), 2 * array.shape[1]), array.dtype)
    large[::-2, ::2] = array
    return large[::-2, ::2]


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


LAYOUTS = {
    "float64": lambda a: a,
    "float32": lambda a: a.astype(np.float32),
    "column by column": np.asfortranarray,
    "strided": strided,
    "read-only": read_only,
    "big-endian": lambda a: a.astype(">f8"),
    "unaligned": lambda a: np.frombuffer(b"x" + a.tobytes(), np.uint8)[1:].view(np.float64).reshape(a.shape),
    "list": lambda a: a.tolist(),
}


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_every_layout_gives_the_closed_form(square, layout):
    origins, targets = ORIGINS.astype(np.float32).astype(float), TARGETS.astype(np.float32).astype(float)
    dark = square.occluded(layout(origins), layout(targets))
    assert dark.dtype == bool and dark.shape == (1000,)
    np.testing.assert_array_equal(dark, blocked_by_the_square(origins, targets))


def test_directions_with_a_distance_are_the_same_question(square):
    along = TARGETS - ORIGINS
    plain = square.occluded(ORIGINS, TARGETS)
    # f32 rounding of the end may move a crossing at the very edge: compare where it is not that near.
    near_edge = np.zeros(1000, bool)
    for axis in (0, 2):
        at = ORIGINS[:, axis] + along[:, axis] * (ORIGINS[:, 1] / -along[:, 1])
        near_edge |= np.abs(np.abs(at) - 1) < 1e-5
    rays = square.occluded(ORIGINS, directions=along, max_distance=1.0)
    np.testing.assert_array_equal(rays[~near_edge], plain[~near_edge])
    assert not square.occluded(ORIGINS, directions=along, max_distance=np.zeros(1000)).any()


def test_one_target_stands_for_all(square):
    below = square.occluded(ORIGINS, (0.0, -1.0, 0.0))
    np.testing.assert_array_equal(below, square.occluded(ORIGINS, np.tile([0.0, -1.0, 0.0], (1000, 1))))


def test_empty_arrays_have_empty_answers(floor):
    none = np.zeros((0, 3))
    assert floor.occluded(none, none).shape == (0,)
    assert floor.closest_hit(none, none).t.shape == (0,)
    assert floor.irradiance(none, none).shape == (0, 3)
    assert floor.ambient_occlusion([], []).shape == (0,)
    assert floor.visible_fraction(none, none).shape == (0,)
    assert repr(floor.irradiance(none, none)).startswith("<Estimate (0, 3) of irradiance: empty")


UP = np.array([0.0, 1.0, 0.0])


@pytest.mark.parametrize(
    ("ask", "error", "said"),
    [
        (
            lambda s: s.irradiance(ORIGINS, np.tile(UP, (5, 1))),
            ValueError,
            "points has shape (1000, 3), normals has shape (5, 3): one normal per point is needed",
        ),
        (lambda s: s.irradiance(ORIGINS), ValueError, "normals are missing"),
        (lambda s: s.irradiance(ORIGINS, UP * 0), ValueError, "normals[0] is (0, 0, 0): it points nowhere"),
        (
            lambda s: s.occluded(ORIGINS[:, :2], TARGETS),
            ValueError,
            "origins has shape (1000, 2): (N, 3) is needed",
        ),
        (lambda s: s.occluded(ORIGINS), ValueError, "one of targets and directions is needed"),
        (
            lambda s: s.occluded(ORIGINS, TARGETS[:7]),
            ValueError,
            "origins has shape (1000, 3), targets has shape (7, 3)",
        ),
        (lambda s: s.occluded(np.array(["a", "b"]), TARGETS), TypeError, "origins has dtype <U1"),
        (lambda s: s.occluded(ORIGINS.astype(complex), TARGETS), TypeError, "origins has dtype complex128"),
        (lambda s: s.occluded(ORIGINS * np.nan, TARGETS), ValueError, "origins[0] is"),
        (lambda s: s.occluded(ORIGINS, np.where(TARGETS > 2, 0, np.inf)), ValueError, "targets[0] is"),
        (
            lambda s: s.occluded(ORIGINS * 1e300, TARGETS),
            ValueError,
            "beyond the largest single-precision number",
        ),
        (
            lambda s: s.occluded(ORIGINS, directions=TARGETS, max_distance=np.ones(3)),
            ValueError,
            "max_distance has shape (3,): one number, or (1000,) is needed",
        ),
        (
            lambda s: s.closest_hit(ORIGINS, TARGETS, -1.0),
            ValueError,
            "max_distance[0] is -1: 0 or more is needed",
        ),
        (lambda s: s.closest_hit(ORIGINS, TARGETS, np.nan), ValueError, "max_distance[0] is NaN"),
        (
            lambda s: s.sample_light(ORIGINS, UP, ORIGINS * 0 + 1),
            ValueError,
            "u[0] is [1.0, 1.0, 1.0]: numbers from 0",
        ),
        (lambda s: s.brdf(ORIGINS, TARGETS, TARGETS), TypeError, "hit is a ndarray"),
        (lambda s: s.visible_fraction(ORIGINS, UP, light="sun"), ValueError, 'there is no light "sun"'),
        (lambda s: s.add_mesh(SQUARE, [[0, 1, 4]]), ValueError, "faces asks for vertex 4, but there are 4"),
        (lambda s: s.add_mesh(SQUARE, [[0, 1, -1]]), ValueError, "faces asks for vertex -1"),
        (
            lambda s: s.add_mesh(SQUARE, [[0.0, 1, 2]]),
            TypeError,
            "faces has dtype float64: whole numbers are needed",
        ),
        (lambda s: s.add_mesh(SQUARE, [0, 1, 2]), ValueError, "faces has shape (3,): (N, 3) is needed"),
        (lambda s: s.add_mesh(SQUARE[:, :2], FACES), ValueError, "vertices has shape (4, 2)"),
        (
            lambda s: s.add_mesh(SQUARE, FACES, normals=SQUARE[:2]),
            ValueError,
            "one normal per vertex is needed",
        ),
        (
            lambda s: s.add_mesh(SQUARE, FACES, transform=np.eye(3)),
            ValueError,
            "transform has shape (3, 3): (4, 4)",
        ),
        (lambda s: s.add_mesh(SQUARE), TypeError, "faces are missing"),
        (
            lambda s: s.add_mesh(SQUARE, FACES, material="red"),
            TypeError,
            "material is 'red': one of antumbra.materials is needed (Diffuse, ",
        ),
        (
            lambda s: s.add_mesh(SQUARE, FACES, material=am.materials.Mirror),
            TypeError,
            "material is the class antumbra.materials.Mirror: one of its kind is needed, as antumbra.materials.Mirror(",
        ),
        (lambda s: s.add_light(3), TypeError, "light is 3: one of antumbra.lights is needed (Point, Spot, "),
        (
            lambda s: s.add_light(am.shapes.Sphere((0, 0, 0), 1)),
            TypeError,
            "light is of type antumbra.shapes.Sphere: one of antumbra.lights is needed",
        ),
        (
            lambda s: s.add_shape("x"),
            TypeError,
            "shape is 'x': one of antumbra.shapes is needed (Sphere, Disk, ",
        ),
        (
            lambda s: s.add_shape(np.zeros(3)),
            TypeError,
            "shape is of type numpy.ndarray: one of antumbra.shapes is needed",
        ),
        (
            lambda s: s.irradiance(s.closest_hit(ORIGINS, -UP), UP),
            ValueError,
            "the receivers of a hit have their own normals: leave normals out",
        ),
        (
            lambda s: s.add_mesh(SQUARE, FACES, emission=-1),
            ValueError,
            "emission = -1: light is not negative",
        ),
        (
            lambda s: s.add_light(am.lights.Point((0, 1), 1)),
            ValueError,
            "position has 2 numbers: three are needed",
        ),
        (
            lambda s: s.add_shape(am.shapes.Sphere((0, 0, 0), 0)),
            ValueError,
            "radius = 0: a length above 0 is needed",
        ),
    ],
)
def test_what_is_wrong_is_named(floor, ask, error, said):
    with pytest.raises(error, match=re.escape(said)):
        ask(floor)


def test_receivers_of_another_scene_are_refused(floor, square):
    hit = floor.closest_hit([[0.0, 1, 0]], [[0.0, -1, 0]])
    with pytest.raises(ValueError, match="belong to another scene"):
        square.occluded(hit.receivers, [[0.0, 5, 0]])
    floor.add_light(am.lights.Point((0, 3, 0), 1.0))
    with pytest.raises(ValueError, match="before something was added"):
        floor.occluded(hit.receivers, [[0.0, 5, 0]])
