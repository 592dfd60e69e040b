"""Plots: classes instead of colours, names apart, the same bits each time."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import matplotlib
import numpy as np
import pytest

from antumbra.study import plot

N = np.array([1, 9, 36, 100])


def curves(*names, replicates=6):
    random = np.random.default_rng(1)
    noise = random.normal(0, 0.05, (len(names), replicates, len(N)))
    return [plot.measured(name, N, np.exp(noise[i]) / N ** (1 + 0.3 * i)) for i, name in enumerate(names)]


def drawn(made, **options):
    words = {"x_title": "shadow rays, N", "y_title": "RMSE", "label": "RMSE against N.", **options}
    return plot.error_curves(made, **words)


def test_a_plot_is_a_labelled_picture_that_takes_its_colours_from_the_page():
    svg = drawn(curves("random", "owen <4>"), chosen="owen <4>")
    root = ElementTree.fromstring(svg)
    assert root.get("role") == "img" and root.get("aria-label") == "RMSE against N."
    assert [(g.get("data-s"), g.get("class")) for g in root.findall("g")] == [
        ("random", None),
        ("owen <4>", "on"),
    ]
    assert not re.search(r"style=|#[0-9a-f]{3}|font|<defs|<style|id=", svg)
    for group in root.findall("g"):
        classes = [e.get("class") for e in group]
        assert (classes.count("ln"), classes.count("bd"), classes.count("eb"), classes.count("mk")) == (
            1,
            1,
            4,
            4,
        )
        assert [t.get("class") for t in group.findall("text")] == [None, "fine"]
    assert "slope −0.5" in root.findall("g")[0].findall("text")[1].text


def test_ticks_are_those_of_the_lecture():
    svg = drawn(curves("random"), y_ticks=[1, 1 / 3, 1 / 6, 1 / 10])
    shown = [t.text for t in ElementTree.fromstring(svg).findall("text")]
    assert shown == ["1", "9", "36", "100", "1", "1/3", "1/6", "1/10", "RMSE", "shadow rays, N"]


def test_ticks_in_the_corner_stand_clear_of_each_other():
    """However near the axis the lowest tick of the left lies, its label ends above that of the axis."""
    for least in np.geomspace(10, 13, 40):
        made = plot.error_curves([plot.Curve("a", [10, 1e3], [least, 1e3])], x_title="", y_title="", label="")
        tens = re.findall(r'y="([0-9.]+)" text-anchor="(\w+)">10<', made)
        places = {anchor: float(y) for y, anchor in tens}
        assert places["middle"] - places.get("end", 0.0) >= 28


def test_the_same_curves_give_the_same_bits():
    assert drawn(curves("a", "b")) == drawn(curves("a", "b"))


def test_the_settings_of_a_user_s_own_plots_change_nothing():
    hostile = {"text.usetex": True, "savefig.bbox": "tight", "svg.fonttype": "path", "axes.xmargin": 0.4,
               "lines.linewidth": 9, "font.size": 30, "savefig.dpi": 300, "figure.autolayout": True}  # fmt: skip
    expected = drawn(curves("a", "b"))
    with matplotlib.rc_context(hostile):
        assert drawn(curves("a", "b")) == expected
        assert matplotlib.rcParams["lines.linewidth"] == 9


def test_marks_differ_in_shape_and_hollow_ones_are_not_fitted():
    made = curves("a", "b")
    half = plot.measured("c", N, 1 / np.stack([N, 2 * N]), fit=[True, False, True, True])
    svg = drawn([*made, half])
    shapes = [
        re.findall(r'class="mk" transform="[^"]*" d="([^"]*)"', part)[0] for part in svg.split("<g ")[1:]
    ]
    assert len(set(shapes)) == 3
    assert svg.count('class="mk h"') == 1


def test_names_are_pushed_apart_as_little_as_possible():
    assert plot.pushed_apart([100, 200], 38, 0, 400) == [100, 200]
    assert plot.pushed_apart([200, 200, 200], 40, 0, 400) == [160, 200, 240]
    assert plot.pushed_apart([210, 190], 40, 0, 400) == [220, 180]
    placed = plot.pushed_apart([390, 395, 400], 38, 0, 400)
    assert max(placed) == 400 and min(np.diff(placed)) >= 38


def test_one_replicate_has_a_line_without_a_band():
    curve = plot.measured("regular", N, [1.0 / N])
    svg = drawn([curve])
    assert curve.note == "slope −0.5"
    assert 'class="ln"' in svg and 'class="bd"' not in svg and 'class="eb"' not in svg


def test_curves_share_shapes_when_there_are_more_than_shapes():
    y = [1.0, 0.5, 0.2]
    low, high = np.multiply(y, 0.9), np.multiply(y, 1.1)
    crowd = [plot.Curve(f"curve {i}", [1, 4, 16], y, low.tolist(), high.tolist()) for i in range(12)]
    groups = ElementTree.fromstring(drawn(crowd)).findall("g")
    marks = [[path for path in group.findall("path") if path.get("class") == "mk"] for group in groups]
    assert [len(each) for each in marks] == [3] * 12


def test_many_curves_make_a_higher_plot():
    names = [f"curve {i}" for i in range(12)]
    root = ElementTree.fromstring(drawn(curves(*names)))
    at = sorted(float(g.find("text").get("y")) for g in root.findall("g"))
    assert min(np.diff(at)) >= 38 - 0.11
    assert at[-1] < float(root.get("viewBox").split()[3])


@pytest.mark.parametrize("logarithmic", [(False, False), (True, False), (False, True)])
def test_axes_may_be_linear(logarithmic):
    curve = plot.Curve("width", [1.0, 2.0, 4.0], [0.5, 1.0, 2.0])
    svg = drawn([curve], logarithmic=logarithmic)
    assert svg.count('class="mk"') == 3 and "nan" not in svg
