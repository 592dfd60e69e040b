"""What the figures of the third chapter compare with, and how they measure: closed forms, areas, lengths."""

from __future__ import annotations

import math

import numpy as np
import pytest

from antumbra.lecture.fisheye import LIGHT, Fisheye
from antumbra.lecture.geometry import seen_from_above
from antumbra.lecture.measures import solid_angle
from antumbra.lecture.measures.maps import box_mean
from antumbra.lecture.scenes import low_room
from antumbra.lecture.scenes.square_lights import irradiance_under


def test_solid_angles_are_those_of_the_table_of_closed_forms():
    # CF40a, CF40e, CF41a, CF41b; agreement of float64 with 20 digits.
    assert solid_angle.of_rectangle((-1, -1), (2, 2), 1.0) == pytest.approx(2 * math.pi / 3, rel=1e-14)
    assert solid_angle.of_rectangle((2, 1), (3, 3), 1.0) == pytest.approx(0.1253917553766, rel=1e-12)
    assert solid_angle.of_triangle(*np.eye(3)) == pytest.approx(math.pi / 2, rel=1e-14)
    corners = np.array([[1.0, 2.0, 0.5], [-1.5, 2.5, 1.0], [0.2, 1.8, -1.4]])
    assert solid_angle.of_triangle(*corners) == pytest.approx(0.50709396389919563574, rel=1e-14)


def test_irradiance_under_a_square_is_its_sum_over_parts():
    whole = irradiance_under(2.0, 1.0, 0.3, -0.2)
    parts = sum(irradiance_under(1.0, 1.0, 0.3 - x, -0.2 - z) for x in (-0.5, 0.5) for z in (-0.5, 0.5))
    assert whole == pytest.approx(parts, rel=1e-13)
    # CF06b and CF06d.
    assert irradiance_under(2.0, 2.0) == pytest.approx(0.7522746884541, rel=1e-12)
    assert irradiance_under(2.0, 0.001) == pytest.approx(3.141590082796, rel=1e-12)


def test_variances_of_the_low_room_are_those_of_a_disk_above():
    # CF35a and CF35c, radius and height 1.
    assert low_room.variance_of_points(1.0) == pytest.approx(0.4112335167121, rel=1e-12)
    assert low_room.variance_of_directions(1.0) == pytest.approx(2.467401100272, rel=1e-12)
    even = low_room.even_ratio()
    assert low_room.variance_of_points(even) == pytest.approx(
        low_room.variance_of_directions(even), rel=1e-12
    )


def test_dots_of_a_fisheye_are_as_large_as_their_solid_angle():
    fisheye = Fisheye(300)
    along, omega = np.array([[0.0, 1.0, 0.0], [0.8, 0.6, 0.0]]), [0.3, 0.2]
    fisheye.dots(along, omega, LIGHT)
    red = fisheye.radiance()[..., 0]
    yellow = np.count_nonzero(red > 0.5) - np.count_nonzero(Fisheye(300).radiance()[..., 0] > 0.5)
    sky = math.pi * (0.49 * 300) ** 2
    # Rims of circles are a pixel wide: 2 π r of 0.49 · 300 · √(ω / 2π) each, half of it to either side.
    assert yellow / sky * 2 * math.pi == pytest.approx(0.5, abs=0.01)


def test_directions_are_even_in_solid_angle():
    along = solid_angle.directions(solid_angle.patches(64))
    assert np.linalg.norm(along, axis=1) == pytest.approx(1.0)
    # ∫ cos θ dω / 2π = 1/2, exact for the middles of equal cells.
    assert along[:, 1].mean() == pytest.approx(0.5, rel=1e-12)


def test_a_box_mean_keeps_even_maps_and_sums():
    even = np.full((5, 7), 2.5)
    assert np.allclose(box_mean(even, 2), even)
    dot = np.zeros((9, 9))
    dot[4, 4] = 25.0
    assert box_mean(dot, 2).sum() == pytest.approx(25.0)


def test_parts_of_a_disk_seen_from_above_count_with_the_cosine():
    # Below cos θ = ½ lies the rim sin² θ > ¾, a quarter of the disk; on one side of a plane a half.
    inside, along = seen_from_above(900)
    assert np.mean(along[:, 1] < 0.5) == pytest.approx(0.25, abs=0.001)
    assert np.allclose(np.linalg.norm(along, axis=1), 1.0, atol=1e-12)  # rounding
    lit = inside.copy()
    lit[inside] = (along[:, 0] > 0) & (along[:, 2] > 0)
    fisheye = Fisheye(300, cosine=True)
    fisheye.fill(lit, LIGHT)
    # The picture has them at the right and above, a quarter of the disk but for its rim of pixels.
    bright = (fisheye.radiance()[..., 0] > 0.5) & (np.hypot(*np.indices((300, 300)) - 149.5) < 147)
    assert bright.sum() == bright[:150, 150:].sum() == pytest.approx(0.49**2 * math.pi * 300**2 / 4, rel=0.02)
