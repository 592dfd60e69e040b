"""What scenes say of themselves, and of what they cannot be made of."""

from __future__ import annotations

import pytest

import antumbra as am


def test_scenes_say_what_they_are(floor):
    assert repr(floor) == "<Scene floor: 4 triangles, 1 area light>"
    assert repr(am.builtin("pillars", light_size=0.5)).startswith("<Scene pillars: ")
    assert set(am.builtins()) >= {"cornell-box", "pillars", "eclipse", "corner", "many-lights", "sky-dome"}
    with pytest.raises(am.OptionError, match='did you mean "pillars"'):
        am.builtin("pilars")
    with pytest.raises(am.OptionError, match='did you mean "light_size"'):
        am.builtin("pillars", light_sise=1)


def test_an_empty_scene_is_told(floor):
    with pytest.raises(am.SceneError, match="nothing to render"):
        am.Scene().render()


def test_a_broken_file_has_file_place_and_hint(tmp_path):
    file = tmp_path / "broken.gltf"
    file.write_text(
        '{"asset": {"version": "2.0"}, "scenes": [{"nodes": [7]}], "nodes": [{}]}', encoding="utf-8"
    )
    with pytest.raises(am.SceneError) as found:
        am.load(file)
    assert found.value.file == str(file) and found.value.place and found.value.what
    assert str(found.value).startswith(f"{file}: ")


def test_a_loaded_scene_takes_more_lights(data):
    scene = am.load(data / "scenes" / "gltf" / "BoxInterleaved.glb")
    assert [light["name"] for light in scene.info()["lights"]] == ["sky"], (
        "an unlit file gets the default sky"
    )
    scene.add_light(am.lights.Point((3, 3, 3), 10.0), name="mine")
    assert [light["name"] for light in scene.info()["lights"]] == ["mine"]
    assert scene.render(size=(8, 8), viewing_rays=4, light="mine").pixels.max() > 0
