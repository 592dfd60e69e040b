"""Pictures of the page: few tones, the right ones; and what is measured in maps of regions."""

from __future__ import annotations

import io
import math

import numpy as np
import pytest
from PIL import Image

from antumbra.lecture import bars, pictures
from antumbra.lecture.geometry import Bodies, Disks, lens
from antumbra.lecture.measures.regions import crossing, radii
from antumbra.lecture.page import aspect, columns, printed


def opened(png: bytes) -> Image.Image:
    return Image.open(io.BytesIO(png))


def test_classes_keep_their_colours_in_two_bits():
    png = pictures.classes_png(np.array([[0, 1], [2, 3]]))
    shown = opened(png).convert("RGB")
    seen = [shown.getpixel((x, y)) for y in range(2) for x in range(2)]
    assert ["#{:02x}{:02x}{:02x}".format(*c) for c in seen] == list(pictures.REGIONS)
    assert png[24] == 2, "bit depth of the PNG header"


def test_a_scene_of_one_colour_has_few_tones_and_small_files():
    y, x = np.mgrid[0:168, 0:240]
    light = (x + y)[..., None] / 400 * np.ones(3)
    png = pictures.tones_png(light, 1.0)
    assert len(opened(png).getcolors()) <= 128
    assert len(png) < 20_000
    dark, bright = (
        opened(pictures.tones_png(np.full((1, 1, 3), v), 1.0)).convert("L").getpixel((0, 0)) for v in (0, 1)
    )
    assert dark < 20 and bright > 240


def test_ramps_climb_evenly_and_signed_is_white_at_zero():
    for ramp in ("warm", "blue", "amber"):
        row = opened(pictures.ramp_png(np.linspace(0, 1, 64)[None], ramp)).convert("L")
        tones = [row.getpixel((i, 0)) for i in range(64)]
        assert tones == sorted(tones) and len(set(tones)) > 50
    zero = opened(pictures.ramp_png(np.zeros((1, 1)), "signed", -1, 1, tones=65)).convert("RGB")
    assert zero.getpixel((0, 0)) == (255, 255, 255)
    assert opened(pictures.ramp_png(np.full((1, 1), np.nan), "blue")).size == (1, 1)


def test_a_map_of_two_kinds_has_two_ramps_and_black_where_nothing_is():
    values, second = np.array([[0.0, 1.0], [1.0, np.nan]]), np.array([[False, False], [True, True]])
    shown = opened(pictures.two_ramps_png(values, second, ("blue", "amber"), 1.0)).convert("RGB")
    found = ["#{:02x}{:02x}{:02x}".format(*shown.getpixel((x, y))) for y in range(2) for x in range(2)]
    blue, amber = pictures.RAMPS["blue"], pictures.RAMPS["amber"]
    assert found == [blue[0], blue[-1], amber[-1], "#000000"]


def test_a_colour_bar_says_where_a_map_goes_beyond_it():
    assert bars.ticks([0.2, 1.0], 0.0, 1.0, "%") == [(0.0, "0"), (0.5, "50"), (1.0, "100\u202f%")]
    beyond = bars.ticks([-0.2, 0.1], -0.15, 0.15, "%")
    assert [words for _, words in beyond] == ["≤ −15", "0", "+15\u202f%"]
    decades = bars.ticks([1.6, np.nan], -1.0, 1.5, "", {-1: "0.1", 0: "1", 1: "10"})
    assert decades == [(0.0, "0.1"), (0.4, "1"), (0.8, "10")]


def test_a_smaller_picture_is_smaller():
    png = pictures.tones_png(np.random.default_rng(0).random((90, 120, 3)), 1.0)
    half = pictures.smaller(png, 0.5)
    assert opened(half).size == (60, 45) and len(half) < len(png)


def test_overlapping_disks_are_the_closed_forms():
    # Visible fraction of a disk of 0.5 behind one that projects to 0.4, 0.3 aside; and the flat lens of an eclipse.
    assert 1 - lens(0.5, 0.4, 0.3) / (math.pi * 0.25) == pytest.approx(0.5376215100673529, abs=1e-14)
    assert lens(0.2665, 0.2575, 0.2) / (math.pi * 0.2665**2) == pytest.approx(0.5082596207585, abs=1e-12)
    assert lens(1, 2, 4) == 0 and lens(2, 0.5, 1) == pytest.approx(math.pi / 4)


def test_the_umbra_closes_where_its_radius_is_zero():
    disks = Disks(R=1.0, r=0.5, a=4.0)
    assert disks.length == 4.0 and disks.umbra(4.0) == 0.0 and disks.penumbra(6.0) == 2.75
    sky = Bodies(sun=695_700.0, moon=1_737.4, earth=6_371.0, unit=149_597_870.7)
    assert sky.umbra(sky.turns) == pytest.approx(0.0, abs=1e-6)
    assert sky.covered(356_500.0, 0.0) == 1.0 and 0.85 < sky.covered(406_700.0, 0.0) < 0.9


def test_radii_are_those_of_disks_of_the_same_area():
    y, x = np.mgrid[-4:4:400j, -4:4:400j]
    far = np.hypot(x, y)
    regions = np.where(far < 0.5, 2, np.where(far < 2, 1, 3))
    found = radii(regions, 8 / 400)
    # The area of a disk of 25 pixels is counted to about 1 %.
    assert found.umbra == 0 and found.signed == pytest.approx(-0.5, rel=0.01)
    assert found.outside == pytest.approx(2.0, rel=0.005)


def test_a_crossing_has_the_interval_of_its_scatter():
    x = np.arange(1.0, 9.0)
    assert crossing(x, 2 * x - 9).value == pytest.approx(4.5)
    noise = np.random.default_rng(3).normal(0, 0.1, (400, 8))
    inside = [abs((q := crossing(x, 2 * x - 9 + e)).value - 4.5) <= q.error for e in noise]
    # 95 % of 400, five standard deviations of a count of them.
    assert abs(sum(inside) - 380) <= 5 * math.sqrt(400 * 0.95 * 0.05)


def test_columns_make_cells_equally_high_and_the_frame_at_the_start_is_printed():
    cells = [{"width": 560, "height": 320}, {"width": 320, "height": 320}]
    assert columns(cells) == "minmax(0,1750fr) minmax(0,1000fr)" and aspect(cells) == "2.75"
    for frames in (1, 6, 12, 16):
        for start in range(frames):
            chosen = printed(frames, start)
            assert start in chosen and len(chosen) == min(frames, 6) and {0, frames - 1} <= chosen
