"""What the figures on skies, vertices and the summary take as known, against closed forms and quadratures."""

from __future__ import annotations

import math

import numpy as np
import pytest

from antumbra.lecture.measures import summary, vertices
from antumbra.lecture.scenes import point_lights, skies
from antumbra.lecture.scenes.open_box import EDGE, FLOOR, around


@pytest.mark.parametrize(
    "x, z, openness",
    [(0.5, 0.5, 0.2394564704608), (0.0, 0.0, 0.1385316059949), (0.5, 0.0, 0.1803687411231)],
)
def test_the_floor_of_a_cube_is_as_open_as_its_closed_form(x, z, openness):
    assert float(vertices.openness(x, z, 1.0)) == pytest.approx(openness, abs=1e-12)


@pytest.mark.parametrize("cells", [1, 2])
def test_blending_vertices_of_a_cube_is_off_by_what_quadrature_says(cells):
    # Midpoints of 64² cells, and vertices that stand 10⁻⁴ inside of the walls: 0.1 % of the error.
    assert vertices.exact(cells, 1.0) == pytest.approx(vertices.CUBE[cells], rel=1e-3)


def test_a_blend_of_vertices_is_exact_at_them_and_bilinear_between():
    values = np.array([[0.0, 1.0], [2.0, 5.0]])
    points = np.array([[0.0, 0, 0], [1.0, 0, 1.0], [0.5, 0, 0.5], [0.25, 0, 0.5]])
    found = vertices.interpolated(values, FLOOR, points)
    s, t = FLOOR.places(points)
    expected = (1 - s) * (1 - t) * 0 + (1 - s) * t * 1 + s * (1 - t) * 2 + s * t * 5
    assert found == pytest.approx(expected)


def test_the_cut_floor_covers_what_lies_beside_the_body_once():
    patches = around(0.31, 0.37)
    area = sum(float(np.linalg.norm(np.cross(p.u, p.v))) for p in patches)
    assert area == pytest.approx(1 - EDGE**2)
    points = np.random.default_rng(0).random((200, 3)) * [1, 0, 1]
    inside = ((points[:, [0, 2]] > [0.31, 0.37]) & (points[:, [0, 2]] < np.array([0.31, 0.37]) + EDGE)).all(1)
    assert (sum(p.holds(points).astype(int) for p in patches) == ~inside).all()


def test_variances_of_a_ray_under_a_thousand_points_are_those_of_the_sum():
    k = np.arange(1000)
    intensity, r2 = k % 7 + 1.0, k / 16 + 9
    # E of one light is I cos θ / d², cos θ = 3 / d; the variance of a ray that goes to it with P is ΣE²/P − (ΣE)².
    light = intensity * 3 / r2**1.5
    for how, p in (("uniform", np.full(1000, 1e-3)), ("power", intensity / intensity.sum())):
        known = (light**2 / p).sum() - light.sum() ** 2
        assert point_lights.VARIANCES[how] == pytest.approx(known, rel=1e-12), how


def test_variances_under_a_square_are_those_of_a_quadrature():
    x = (np.arange(400) + 0.5) / 200 - 1
    r2 = x[:, None] ** 2 + x**2 + 1
    # dω = dA / r³ and cos θ = 1 / r for a square of edge 2 at height 1.
    cell, cos, omega = (2 / 400) ** 2, r2**-0.5, r2**-1.5
    light, square = (cos * omega).sum() * cell, (cos**2 * omega).sum() * cell
    known = summary.of_square()
    assert known["even"] == pytest.approx(2 * math.pi * square - light**2, rel=1e-5)
    assert known["cosine"] == pytest.approx(math.pi * light - light**2, rel=1e-5)
    assert known["area"] == pytest.approx(4 * (cos**2 * omega**2).sum() * cell - light**2, rel=1e-5)


def test_every_sky_has_its_lights_and_a_turned_map_is_the_map():
    names = {light["name"] for light in skies.under_skies().info()["lights"]}
    assert all(name in names for sky in skies.SKIES for name in skies.lights_of(sky))
    assert {f"turn-{turn}" for turn in range(1, skies.TURNS)} <= names
    whole = skies.studio_map(skies.TURNS)
    assert (whole == skies.studio_map()).all()
    assert not (skies.studio_map(1) == whole).all()
