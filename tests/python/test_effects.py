"""Settings without effect: what the table calls idle changes no bit of a picture; what it does not, changes some."""

from __future__ import annotations

import functools

import pytest

import antumbra as am
from antumbra import settings
from antumbra.effects import RULES, idle

# A word that differs from the default, for each setting that a rule speaks of.
OTHER = {
    "radius": "0.7",
    "falloff": "linear",
    "bounces": "2",
    "roulette": "off",
    "lights": "uniform",
    "light_points": "area",
    "directions": "uniform",
    "distance_test": "off",
    "light": "light 2",
    "environment": "sky",
    "rotate": "on",
    "pairing": "2d",
    "filter": "box",
    "aperture": "0.2",
    "focus": "3.5",
    "region_points": "16",
}
# What has to be set beside it, so that it can be seen.
BESIDE = {
    "falloff": {"radius": "0.7"},
    "distance_test": {"light": "light 1"},
    "focus": {"aperture": "0.2"},
}
CASES = [
    (name, rule.of, word)
    for rule in RULES
    if rule.of not in ("output", "aov")
    for name in rule.settings
    for word in settings.table()[rule.of].choices
]


@functools.cache
def room() -> am.Scene:
    """A floor and a wall in front of it, two lamps of unlike size with things behind and in front of them."""
    scene = am.Scene("room")
    wide = am.shapes.Rectangle((-2, 0, 2), (4, 0, 0), (0, 0, -4))
    scene.add_shape(wide, material=am.materials.Diffuse(0.8))
    scene.add_shape(
        am.shapes.Rectangle((-2, 0, -1), (4, 0, 0), (0, 2, 0)), material=am.materials.Diffuse(0.8)
    )
    scene.add_shape(am.shapes.Rectangle((-2, 3, 2), (4, 0, 0), (0, 0, -4)))
    scene.add_shape(
        am.shapes.Sphere((0.4, 0.4, 0.5), 0.4), material=am.materials.MetallicRoughness(0.7, 0.5, 0.3)
    )
    scene.add_light(am.lights.Rectangle((-0.5, 2, 0), (1, 0, 0), (0, 0, 1), radiance=5.0))
    scene.add_light(am.lights.Sphere((1.5, 0.5, 1), 0.3, radiance=9.0))
    return scene


@functools.cache
def picture(words: tuple[tuple[str, str], ...]) -> str:
    base = {"size": (12, 9), "viewing_rays": 8, "eye": (0.3, 1.5, 4.5), "look_at": (0, 0.6, 0)}
    return room().render(**(base | dict(words))).hash


@pytest.mark.parametrize(("name", "of", "word"), CASES)
def test_a_setting_is_idle_exactly_where_it_changes_no_bit(name, of, word):
    before = {of: word, **BESIDE.get(name, {})}
    if name == of:
        return
    given = before | {name: OTHER[name]}
    said = any(text.startswith(f"{name} = ") or f" and {name} = " in text for text in idle(given))
    same = picture(tuple(before.items())) == picture(tuple(given.items()))
    assert said == same


def test_no_bounce_is_no_light_for_every_estimator_of_light():
    assert idle({"bounces": "0", "estimator": "area"}) == []
    assert picture((("bounces", "0"), ("estimator", "area"))) != picture((("estimator", "area"),))


def test_only_what_was_given_is_told_and_each_once():
    assert idle({}) == []
    assert idle({"estimator": "area"}, ".png") == []
    assert idle({"radius": "0.5", "falloff": "linear"}) == [
        "radius = 0.5 and falloff = linear have no effect with estimator = path (only with ambient-occlusion)"
    ]
    assert idle({"aov": "depth"}, ".png") == ["aov = depth has no effect on a .png (only on .exr)"]
    assert idle({"tone": "filmic"}, ".exr") == ["tone = filmic has no effect on a .exr (only on .png)"]
    assert idle({"light": "a\nb", "estimator": "ambient-occlusion"}) == [
        "light = a, b has no effect with estimator = ambient-occlusion, which looks at no light"
    ]
    assert idle({"aov": "depth"}) == [], "an image in memory has it"
    assert idle({"region_points": "9"}) == ["region_points = 9 has no effect without aov = regions or all"]
    assert idle({"region_points": "9", "aov": "depth"}) == [
        "region_points = 9 has no effect with aov = depth (only with regions or all)"
    ]
    assert idle({"region_points": "9", "aov": "depth,regions"}) == []


def test_python_finds_it_among_the_messages_of_the_image():
    image = am.builtin("corner").render(size=(8, 6), viewing_rays=1, rotate=True)
    assert image.messages == [
        am.Message("note", "", "rotate = on has no effect with sampler = owen (only with regular)")
    ]
