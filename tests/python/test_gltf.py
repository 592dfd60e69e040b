"""glTF from Python and the command line: variants of materials, animations at a time."""

from __future__ import annotations

import json
import sys
import types

import numpy as np
import pytest

import antumbra as am


def triangle(**more: object) -> dict[str, object]:
    """A glTF document of one triangle, its numbers in a data URI; a node that goes from x = 0 to x = 4 in 2 s."""
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "buffers": [{"byteLength": 68, "uri": "numbers.bin"}],
        "bufferViews": [
            {"buffer": 0, "byteLength": 36},
            {"buffer": 0, "byteOffset": 36, "byteLength": 8},
            {"buffer": 0, "byteOffset": 44, "byteLength": 24},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
            {"bufferView": 1, "componentType": 5126, "type": "SCALAR", "count": 2, "min": [0], "max": [2]},
            {"bufferView": 2, "componentType": 5126, "type": "VEC3", "count": 2},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "animations": [
            {
                "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                "samplers": [{"input": 1, "output": 2}],
            }
        ],
        **more,
    }


NUMBERS = np.array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 4, 0, 0], dtype="<f4")


@pytest.fixture
def moving(tmp_path):
    (tmp_path / "numbers.bin").write_bytes(NUMBERS.tobytes())
    file = tmp_path / "moving.gltf"
    file.write_text(json.dumps(triangle()))
    return file


def test_a_time_is_a_keyword_of_load_and_an_option_of_info(antumbra, moving):
    for time, x in ((None, 0.0), (0.5, 1.0), (2, 4.0), (9, 4.0)):
        vertices, _ = am.load(moving, at_time=time).triangles()
        assert vertices[:, 0].min() == x
    told = json.loads(antumbra("info", str(moving), "--json", "--at-time", "1.5").out)
    assert told["bounds"][0][0] == 3.0
    still = antumbra("info", str(moving))
    assert "animations stand still (--at-time T, 0 to 2 s)" in still.err
    with pytest.raises(ValueError, match="at_time"):
        am.load(moving, at_time=float("nan"))


def test_a_camera_moves_with_its_node(antumbra, tmp_path, moving):
    camera = {"perspective": {"yfov": 1.0}}
    file = tmp_path / "camera.gltf"
    file.write_text(
        json.dumps(triangle(nodes=[{"mesh": 0, "camera": 0}], cameras=[camera | {"type": "perspective"}]))
    )
    for time, x in ((0, 0.0), (1.5, 3.0)):
        origins, _ = am.load(file, at_time=time).camera_rays(size=(2, 2), viewing_rays=1)
        np.testing.assert_array_equal(
            origins.reshape(-1, 3), np.tile([x, 0, 0], (len(origins.reshape(-1, 3)), 1))
        )
    ended = antumbra("info", str(file), "--animation", "jump")
    assert ended.code == 2 and 'there is no animation "jump"' in ended.err and "There are: 0." in ended.err


def test_an_unknown_variant_lists_those_that_exist(antumbra, tmp_path, moving, data):
    names = {"KHR_materials_variants": {"variants": [{"name": "oak"}, {"name": "birch"}]}}
    chosen = {"KHR_materials_variants": {"mappings": [{"material": 0, "variants": [1]}]}}
    primitive = {"attributes": {"POSITION": 0}, "extensions": chosen}
    file = tmp_path / "chair.gltf"
    file.write_text(
        json.dumps(
            triangle(extensions=names, meshes=[{"primitives": [primitive]}], materials=[{"name": "pale"}])
        )
    )
    with pytest.raises(am.SceneError) as caught:
        am.load(file, variant="elm")
    assert "elm" in str(caught.value) and "oak, birch" in caught.value.hint
    assert antumbra("info", str(file), "--variant", "birch").code == 0
    ended = antumbra("render", str(file), "--variant", "elm")
    assert ended.code == 2 and "oak, birch" in ended.err
    with pytest.raises(am.SceneError, match="only glTF"):
        am.load(data / "scenes/mesh/spot.obj", variant="oak")


def test_a_scene_that_takes_more_than_it_may_is_refused_early(antumbra, data):
    cow = data / "scenes/mesh/spot.obj"
    with pytest.raises(
        am.SceneError, match=r"would take about 863\.6 KiB of memory or more for 5856 triangles"
    ) as caught:
        am.load(cow, max_memory=700 * 1024)
    assert "--max-memory" in caught.value.hint
    assert am.load(cow, max_memory="1M").info()["triangles"] == 5856
    ended = antumbra("info", str(cow), "--max-memory", "100K")
    assert ended.code == 2 and "the limit is 100.0 KiB" in ended.err
    ended = antumbra("render", str(cow), "--max-memory", "lots")
    assert ended.code == 2 and "500M, 4G" in ended.err


SMALL = (
    "--size",
    "24x16",
    "--viewing-rays",
    "1",
    "--shadow-rays",
    "1",
    "--eye",
    "2,0,9",
    "--look-at",
    "2,0,0",
)


def test_frames_are_the_pictures_at_their_times_and_go_on_where_they_stopped(
    antumbra, monkeypatch, moving, tmp_path
):
    from antumbra.scene import Scene

    told = antumbra("render", "moving.gltf", "--frames", "2:4", "--fps", "2", *SMALL)
    names = [f"moving.{frame:04d}.exr" for frame in (2, 3, 4)]
    assert told.code == 0 and all((tmp_path / name).is_file() for name in names)
    assert [line.split()[0] for line in told.out.splitlines()] == names
    assert told.err.count("no light in the file") == 1
    hashes = [line.rsplit("same bits: ")[1] for line in told.out.splitlines()]
    for frame, time in ((2, "1"), (4, "2")):
        alone = antumbra("render", "moving.gltf", "--at-time", time, *SMALL)
        assert alone.out.strip().endswith(hashes[frame - 2])
    assert len(set(hashes)) == 3

    (tmp_path / names[2]).unlink()
    render, calls = Scene.render, []

    def stops(self, **options):
        calls.append(options)
        if len(calls) == 2:
            raise am.RenderStopped(None)
        return render(self, **options)

    monkeypatch.setattr(Scene, "render", stops)
    stopped = antumbra("render", "moving.gltf", "--frames", "2:4", "--fps", "2", *SMALL)
    assert stopped.code == 130 and "frame 3; 1 of 3 frames are written" in stopped.err
    again = antumbra("render", "moving.gltf", "--frames", "2:4", "--fps", "2", *SMALL)
    assert again.code == 0 and "1 frame of 3 are there already" in again.err
    assert [line.rsplit("same bits: ")[1] for line in again.out.splitlines()] == hashes[1:]
    assert not list(tmp_path.glob("*.json"))


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (["pillars", "--frames", "0:3"], "--frames is for glTF files"),
        (["moving.gltf", "--frames", "3"], "as 0:47"),
        (["moving.gltf", "--frames", "3:2"], "follows the first one"),
        (["moving.gltf", "--frames", "0:2", "--at-time", "1"], "one of the two"),
        (["moving.gltf", "--fps", "2"], "goes with --frames"),
        (["moving.gltf", "--frames", "0:2", "--fps", "0"], "a positive number"),
        (["moving.gltf", "--at-time", "nan"], "no finite number"),
    ],
)
def test_what_makes_no_sense_about_time_is_told(antumbra, moving, given, told):
    ended = antumbra("render", *given)
    assert ended.code == 2 and told in ended.err


@pytest.fixture
def packed(data):
    return data / "scenes/gltf/draco_sparse/DracoSparseMesh.gltf"


def test_a_packed_mesh_names_the_extra_that_unpacks_it(packed, monkeypatch):
    monkeypatch.setitem(sys.modules, "DracoPy", None)
    with pytest.raises(am.SceneError) as caught:
        am.load(packed)
    assert "Monochord_Vibrator" in caught.value.place and "antumbra[draco]" in caught.value.hint


def test_a_packed_mesh_is_what_its_decoder_says(packed, monkeypatch):
    faces = np.arange(306).reshape(102, 3) % 62
    points = np.zeros((62, 3)) + np.arange(62)[:, None]

    class Mesh:
        """As DracoPy gives it: whole numbers of any width, floats of double precision too."""

        def __init__(self):
            self.faces = faces

        def get_attribute_by_unique_id(self, number):
            width = {0: 3, 1: 3, 2: 4, 3: 2, 4: 4}[number]
            return {"data": points if number == 0 else np.ones((62, width))}

    seen = []
    monkeypatch.setitem(
        sys.modules, "DracoPy", types.SimpleNamespace(decode=lambda data: seen.append(data) or Mesh())
    )
    vertices, triangles = am.load(packed).triangles()
    assert len(seen) == 1 and seen[0][:5] == b"DRACO"
    assert np.array_equal(vertices, points) and np.array_equal(triangles, faces)
    monkeypatch.setitem(
        sys.modules, "DracoPy", types.SimpleNamespace(decode=lambda data: types.SimpleNamespace(faces=None))
    )
    with pytest.raises(am.SceneError, match="it has no triangles"):
        am.load(packed)
