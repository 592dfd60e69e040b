"""A scene for other programs: the verb, the call, what both say."""

from __future__ import annotations

import json

import numpy as np
import pytest

import antumbra as am


def test_the_verb_writes_what_reads_again(antumbra, tmp_path):
    done = antumbra("export", "pillars", "-D", "light-size=0.5", "-o", "p.xml")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("p.xml   ") and " files in p-files, " in done.out
    small = {"size": (16, 12), "viewing_rays": 2, "estimator": "mis", "filter": "box"}
    ours, again = am.builtin("pillars", light_size=0.5), am.load(tmp_path / "p.xml")
    assert np.array_equal(ours.render(**small).pixels, again.render(**small).pixels)
    assert antumbra("export", "p.xml", "--quiet").code == 0
    assert (tmp_path / "p.glb").read_bytes()[:4] == b"glTF"


def test_the_verb_says_what_is_lost_and_what_is_wrong(antumbra, tmp_path):
    done = antumbra("export", "plane-and-cylinder", "-o", "a.glb")
    assert "--environment a-environment.exr" in done.err and "cylinders are meshes in glTF" in done.err
    assert antumbra("render", "a.glb", "--environment", "a-environment.exr", "--size", "8x6").code == 0
    for arguments, words in (
        (["pillars", "-o", "a.obj"], "a scene is written as .glb"),
        (["pillars", "-o", "no/a.glb"], "there is no folder"),
        (["a.glb"], "a.glb is the scene itself"),
        (["pilars"], 'did you mean "pillars"'),
    ):
        done = antumbra("export", *arguments)
        assert done.code == 2 and words in done.err, done.err
    assert sorted(p.name for p in tmp_path.iterdir() if not p.name.endswith(".exr")) == ["a.glb"]


def test_a_scene_of_arrays_is_written_where_it_stands(tmp_path):
    """Around an origin of its own: the node moves by it, the mesh keeps its digits."""
    scene = am.Scene("yard", origin=(4e5, 0, 5e6))
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, -1]]) + [4e5, 0, 5e6]
    scene.add_mesh(corners, [[0, 1, 2]], material=am.materials.Diffuse(0.5), name="slab")
    scene.add_light(am.lights.Point((4e5, 2, 5e6), intensity=4.0))
    assert scene.export(tmp_path / "yard.gltf") == []
    document = json.loads((tmp_path / "yard.gltf").read_text())
    slab, light = document["nodes"]
    assert (slab["name"], slab["translation"], light["translation"]) == ("slab", [4e5, 0, 5e6], [4e5, 2, 5e6])
    assert document["accessors"][0]["max"] == [1, 0, 0]
    assert document["extensionsUsed"] == ["KHR_lights_punctual", "KHR_materials_specular"]
    with pytest.raises(am.errors.OptionError, match="a scene is written as"):
        scene.export("yard.obj")
    with pytest.raises(OSError, match="there is no folder"):
        scene.export(tmp_path / "no" / "yard.glb")
