"""The command: what goes to which stream, how it ends, what it says when something is wrong."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

import antumbra as am
from common import command

SMALL = ["--size", "24x16", "--viewing-rays", "4"]
ENDING = re.compile(
    r"(?P<file>\S+)   [\d.]+ s · [\d,.]+( [MG])? rays( \([\d,.]+( [MG])? shadow rays\))?, [\d.e-]+ M/s · "
    r"standard error [\d.]+ % of the mean · same bits: [0-9a-f]{8}\n"
)


def test_render_says_what_it_wrote_and_nothing_else_on_standard_output(antumbra, tmp_path):
    ended = antumbra("render", "cornell-box", *SMALL)
    assert ended.code == 0
    assert ENDING.fullmatch(ended.out)["file"] == "cornell-box.exr"
    assert ended.err == (
        "  cornell-box · 42 triangles · 1 area light · 24 × 16 · path, 4 viewing × 1 shadow ray, owen\n"
    )
    assert am.load_image(tmp_path / "cornell-box.exr").shape == (16, 24, 3)
    assert [p.name for p in tmp_path.iterdir()] == ["cornell-box.exr"]


def test_quiet_leaves_standard_error_empty(antumbra):
    ended = antumbra("render", "corner", *SMALL, "--quiet", "-o", "corner.png")
    assert ended.code == 0 and ended.err == ""
    assert ENDING.fullmatch(ended.out)


def test_the_same_command_gives_the_same_bits_for_any_number_of_threads(antumbra):
    bits = {
        antumbra("render", "pillars", *SMALL, "--threads", n).out.split("same bits: ")[1] for n in (1, 2, 5)
    }
    assert len(bits) == 1


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["rendr", "pillars"], 'there is no verb "rendr"; did you mean "render"?'),
        (["render"], "SCENE is missing"),
        (["render", "pilars"], 'there is no scene "pilars"; did you mean "pillars"?'),
        (["render", "nowhere.glb"], "nowhere.glb: cannot be read (no such file)"),
        (
            ["render", "pillars", "--shadow-ray", "4"],
            "there is no option --shadow-ray; did you mean --shadow-rays?",
        ),
        (
            ["render", "pillars", "--estimator", "arae"],
            'there is no estimator "arae"; did you mean "area"? (path, ',
        ),
        (
            ["render", "pillars", "--shadow-rays", "0"],
            "--shadow-rays 0: at least 1 is needed (use --shadows off to leave shadows out)",
        ),
        (["render", "pillars", "--size", "many"], "--size many: width x height is needed, as 640x480"),
        (["render", "pillars", "-o", "p.jpg"], '"p.jpg": a picture ends in .exr or .png'),
        (["render", "pillars", "-o", "no/p.png"], "no/p.png cannot be written (there is no folder no)"),
        (["render", "pillars", "-D", "light-size"], "-D light-size: a name and its value are needed"),
        (["render", "pillars", "-D", "light-sise=1"], 'did you mean "light-size"?'),
        (["render", "pillars", "-D", "light-size=big"], "-D light-size=big: a number is needed"),
        (["render", "pillars", "--up-axis", "z"], "--up-axis is for files"),
        (["render", "pillars", "--at-time", "1"], "--at-time is for files"),
        (["render", "pillars", "--camera", "Tele"], 'there is no camera "Tele"'),
        (
            ["render", "pillars", "--camera", "camera 2"],
            'there is no camera "camera 2"; did you mean "camera 1"?',
        ),
        (["render", "pillars", "--light", "Moon"], 'there is no light "Moon"'),
        (
            ["render", "pillars", "-o", "a.png", "-o", "b.png"],
            "-o is given 2 times (a.png, b.png): once is needed",
        ),
        (
            ["render", "pillars", "--viewing-rays", "9" * 30],
            f"--viewing-rays {'9' * 30}: at most 16,777,216 are possible",
        ),
        (["render", "pillars", "--up", "0,0,0"], "camera: up is 0, 0, 0: it points nowhere"),
        (
            ["render", "pillars", "--eye", "1,2,3", "--look-at", "1,2,3"],
            "camera: eye and look-at are the same point",
        ),
        (
            ["render", "pillars", "--estimator", "ambient-occlusion", "--falloff", "linear"],
            "--falloff linear needs a radius",
        ),
        (
            ["render", "pillars", "--lights", "al"],
            '--lights al: there is no "al"; did you mean "all"? (auto, all, ',
        ),
        (["render", "pillars", "--mistake", "no-cos"], 'did you mean "no-cos-light"?'),
        (["render", "fuze", "uv.jpg"], '"uv.jpg": nothing takes this beside SCENE'),
        (["study", "pillars", "-o", "a", "-o", "b"], "-o is given 2 times (a, b): once is needed"),
        (["render", "pillars", "--eye", "1,2"], "--eye 1,2: three numbers joined by commas are needed"),
        (["render", "pillars", "--crop", "600,0,100,10"], "does not lie in 640 x 480 pixels"),
        (["info"], "SCENE is missing (or --list, for the built-in scenes)"),
        (["diff", "a.exr", "b.exr"], "a.exr: cannot be read (no such file)"),
    ],
)
def test_bad_input_is_one_message_and_exit_2(arguments, said, antumbra, tmp_path):
    ended = antumbra(*arguments)
    assert ended.code == 2
    assert ended.out == ""
    assert ended.err.startswith("error: ") and ended.err.count("error:") == 1
    assert said in ended.err
    assert "Traceback" not in ended.err
    assert list(tmp_path.iterdir()) == []


def test_help_is_a_word_too(antumbra):
    assert antumbra("help").out == antumbra("--help").out
    assert antumbra("help", "diff").out == antumbra("diff", "--help").out


def test_notes_of_a_file_name_it_and_its_options_as_they_are_typed(antumbra, data):
    file = data / "scenes" / "gltf" / "BoxInterleaved.glb"
    ended = antumbra("render", file, *SMALL, "-o", "box.png")
    assert ended.err.splitlines()[:2] == [
        "note: BoxInterleaved.glb: no light in the file: lit by the default sky (--environment to choose)",
        "note: BoxInterleaved.glb: no camera: made one that sees everything (--eye, --look-at to choose)",
    ]


def test_a_folder_without_rights_is_told_before_rendering(antumbra, tmp_path):
    (tmp_path / "out.png").mkdir()
    ended = antumbra("render", "pillars", "-o", "out.png")
    assert ended.code == 2
    assert ended.err == "error: out.png cannot be written (it is a folder). Nothing was rendered.\n"


def test_a_failure_of_ours_is_exit_1(antumbra, monkeypatch):
    from antumbra.cli import _scene

    monkeypatch.setattr(_scene, "open_scene", lambda *_: 1 / 0)
    ended = antumbra("info", "pillars")
    assert ended.code == 1
    assert ended.err.startswith("error: antumbra itself failed: ZeroDivisionError")


def test_a_path_that_exists_wins_over_a_built_in_scene(antumbra, tmp_path):
    (tmp_path / "pillars").write_bytes(b"not a scene")
    ended = antumbra("render", "pillars")
    assert ended.code == 2 and ended.err.startswith("error: pillars: ")


def test_info_names_everything(antumbra):
    ended = antumbra("info", "pillars")
    assert ended.code == 0
    rows = {line[:25].strip() for line in ended.out.splitlines()}
    assert {"pillars", "geometry", "lights", "cameras", "materials"} <= rows
    assert "-D light-size=1" in ended.out and '"light"' in ended.out and '"camera 1"' in ended.out
    assert max(map(len, ended.out.splitlines())) <= 140


def test_info_as_json_has_stable_keys(antumbra):
    found = json.loads(antumbra("info", "pillars", "--json").out)
    assert list(found) == [
        "name", "bytes", "seconds", "source", "triangles", "shapes", "meshes", "objects", "instances", "bounds",
        "tree_bytes", "lights", "cameras", "materials", "masked_materials", "material_kinds", "textures",
        "texture_bytes", "largest_texture", "surfaces", "looks_wrong", "parameters", "messages",
    ]  # fmt: skip
    assert found["name"] == "pillars" and found["triangles"] > 0
    listed = json.loads(antumbra("info", "--list", "--json").out)
    assert {"cornell-box", "pillars", "eclipse"} <= {scene["name"] for scene in listed}


def ring_of_quads(side, n, turned=()):
    """An OBJ of an n-sided tube of squares, open at both ends; the squares of `turned` run the other way round."""
    corners = [(np.cos(a) * side, h, np.sin(a) * side) for h in (0, 1) for a in 2 * np.pi * np.arange(n) / n]
    faces = [[i + 1, (i + 1) % n + 1, (i + 1) % n + n + 1, i + n + 1] for i in range(n)]
    faces = [face[::-1] if i in turned else face for i, face in enumerate(faces)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + ["f " + " ".join(map(str, face)) for face in faces]
    return "o Tube\n" + "\n".join(lines) + "\n"


def test_info_tells_open_closed_and_flipped_geometry(antumbra, tmp_path):
    (tmp_path / "tube.obj").write_text(ring_of_quads(1, 12), encoding="utf-8")
    said = antumbra("info", "tube.obj").out
    assert "surfaces                 1 open (24 open edges)\n" in said and "looks wrong" not in said
    (tmp_path / "tube.obj").write_text(ring_of_quads(1, 12, turned=[3]), encoding="utf-8")
    assert '"Tube" (2 edges) is flipped in part' in antumbra("info", "tube.obj").out
    found = json.loads(antumbra("info", "tube.obj", "--json").out)
    assert found["surfaces"] == {
        "closed_meshes": 0, "open_meshes": 1, "edges": 48, "open_edges": 24, "turned_edges": 2,
        "duplicate_triangles": 0, "triangles_without_area": 0, "triangles_with_normals_on_the_back": 0,
    }  # fmt: skip


def test_info_of_real_files(antumbra, data):
    spot = antumbra("info", data / "scenes/mesh/spot.obj").out
    assert "surfaces                 1 closed\n" in spot and "looks wrong" not in spot
    spider = antumbra("info", data / "scenes/mesh/spider.obj").out
    assert "36 duplicate triangles" in " ".join(spider.split())
    blend = antumbra("info", data / "scenes/gltf/AlphaBlendModeTest.glb").out
    assert "8 textures, 71.3 MB decoded, the largest 2048 × 2048" in " ".join(blend.split())


def test_every_built_in_scene_is_listed_with_its_parameters(antumbra):
    text = antumbra("info", "--list").out
    for name, shows in am.builtins().items():
        assert name in text and shows in text
    assert "10,000,000)" in text and not re.search(r"\de[+-]?\d", text), "numbers as people write them"


def write(path, pixels):
    from antumbra import _core

    _core.write_picture(str(path), np.asarray(pixels, np.float32))


def test_diff_of_a_picture_with_itself_is_zero(antumbra, tmp_path):
    write(tmp_path / "a.exr", np.random.default_rng(1).random((8, 12, 3)))
    found = json.loads(antumbra("diff", "a.exr", "a.exr", "--json").out)
    assert found == {"picture": "a.exr", "reference": "a.exr", "mse": 0, "relmse": 0, "flip": 0, "map": None}


def test_diff_measures_what_it_says(antumbra, tmp_path):
    a, b = np.full((8, 12, 3), 0.5), np.full((8, 12, 3), 0.25)
    write(tmp_path / "a.exr", a)
    write(tmp_path / "b.exr", b)
    found = json.loads(antumbra("diff", "a.exr", "b.exr", "--json", "-o", "map.png").out)
    assert found["mse"] == pytest.approx(0.0625)
    assert found["relmse"] == pytest.approx(0.0625 / (0.0625 + 0.01))
    assert 0 < found["flip"] <= 1
    # The map of 8 × 12 pixels, its colour bar below, and paper beside, as wide as the words of the bar.
    assert am.load_image(tmp_path / "map.png").shape == (56, 160, 3)


def test_parts_of_a_picture_compose_and_are_compared_where_they_lie(antumbra, tmp_path):
    antumbra("render", "corner", *SMALL, "--exr", "float", "-o", "all.exr")
    antumbra("render", "corner", *SMALL, "--exr", "float", "--crop", "5,3,10,8", "-o", "part.exr")
    antumbra("render", "corner", *SMALL, "--exr", "float", "--crop", "0,0,3,3", "-o", "far.exr")
    whole, part = am.load_image(tmp_path / "all.exr"), am.load_image(tmp_path / "part.exr")
    np.testing.assert_array_equal(whole[3:11, 5:15], part)
    ended = antumbra("diff", "part.exr", "all.exr", "--json")
    assert json.loads(ended.out)["mse"] == 0
    assert ended.err == "note: compared where both are: 10 × 8 pixels from 5, 3\n"
    ended = antumbra("diff", "part.exr", "far.exr")
    assert ended.code == 2
    assert ended.err.startswith(
        "error: part.exr is 10 × 8 at 5, 3 of 24 × 16, far.exr is 3 × 3 at 0, 0 of 24 × 16: the same size is needed"
    )


def test_diff_wants_the_same_size(antumbra, tmp_path):
    write(tmp_path / "a.png", np.zeros((8, 12, 3)))
    write(tmp_path / "b.png", np.zeros((8, 13, 3)))
    ended = antumbra("diff", "a.png", "b.png")
    assert ended.code == 2
    assert ended.err.startswith("error: a.png is 12 × 8, b.png is 13 × 8: the same size is needed")


def test_every_light_and_camera_can_be_chosen_by_the_name_that_info_shows(antumbra, tmp_path):
    (tmp_path / "two.gltf").write_text(json.dumps(TWO_OF_EACH), encoding="utf-8")
    ended = antumbra("info", "two.gltf")
    assert '2 point: "light 2" 113 W, "Lamp" 12.6 W' in ended.out
    assert '"camera 1" (57.3° vertical), "camera 2" (28.6° vertical)' in ended.out
    found = json.loads(antumbra("info", "two.gltf", "--json").out)
    bits = set()
    for light in found["lights"]:
        for camera in found["cameras"]:
            ended = antumbra(
                "render", "two.gltf", *SMALL, "--light", light["name"], "--camera", camera["name"]
            )
            assert ended.code == 0, ended.err
            bits.add(ended.out.split("same bits: ")[1])
    assert len(bits) == 4
    ended = antumbra("render", "two.gltf", "--light", "lihgt 2")
    assert ended.err == (
        'error: two.gltf: there is no light "lihgt 2"; did you mean "light 2"?\n'
        '       Its lights are "Lamp", "light 2".\n'
    )


# A triangle, two point lights of which one has a name, and two cameras without one.
TWO_OF_EACH = {
    "asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {
        "KHR_lights_punctual": {
            "lights": [{"type": "point", "intensity": 9}, {"type": "point", "name": "Lamp"}]
        }
    },
    "cameras": [
        {"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}},
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
    ],
    "buffers": [
        {
            "byteLength": 36,
            "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA",
        }
    ],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "nodes": [
        {"mesh": 0},
        {"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [0, 0, 2]},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 1, 1]},
        {"camera": 0, "translation": [0, 0, 3]},
        {"camera": 1, "translation": [0, 0, 3]},
    ],
    "scenes": [{"nodes": [0, 1, 2, 3, 4]}],
}


def test_a_view_straight_down_gets_another_up_with_a_note(antumbra):
    view = ["--eye", "0,9,0", "--look-at", "0,0,0"]
    above = antumbra("render", "pillars", *SMALL, *view)
    assert above.code == 0
    assert above.err.startswith(
        "note: the camera looks straight along its up direction 0, 1, 0: 0, 0, -1 is up in the picture (--up to choose)"
    )
    same = antumbra("render", "pillars", *SMALL, *view, "--up", "0,0,-1")
    assert "note:" not in same.err
    assert above.out.split("same bits")[1] == same.out.split("same bits")[1]


def test_settings_without_effect_are_told_once_before_the_picture(antumbra):
    ended = antumbra(
        "render", "corner", *SMALL, "--radius", "0.5", "--rotate", "on", "--aov", "depth", "-o", "c.png"
    )
    assert ended.code == 0
    assert ended.err.splitlines()[:-1] == [
        "note: --radius 0.5 has no effect with --estimator path (only with ambient-occlusion)",
        "note: --rotate on has no effect with --sampler owen (only with regular)",
        "note: --aov depth has no effect on a .png (only on .exr)",
    ]


def test_the_rays_and_the_error_are_told_as_they_are(antumbra):
    said = antumbra("render", "pillars", *SMALL, "--estimator", "hemisphere").out
    assert "shadow rays" not in said and " rays, " in said
    assert (
        "4 viewing × 1 direction, owen"
        in antumbra("render", "pillars", *SMALL, "--estimator", "hemisphere").err
    )
    said = antumbra("render", "pillars", "--size", "24x16", "--viewing-rays", "1").out
    assert "standard error not known (fewer than 2 replicates)" in said


def test_a_radiance_picture_is_compared_too(antumbra, tmp_path):
    (tmp_path / "a.hdr").write_bytes(
        b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + b"\x80\x80\x80\x81" * 4
    )
    # (128 + ½)·2^(129 − 136)
    write(tmp_path / "b.exr", np.full((2, 2, 3), 1.00390625))
    assert json.loads(antumbra("diff", "a.hdr", "b.exr", "--json").out)["mse"] == 0
    (tmp_path / "c.png").write_bytes(b"GIF89a")
    ended = antumbra("diff", "c.png", "b.exr")
    assert ended.code == 2
    assert ended.err.startswith("error: c.png: this is no picture that antumbra reads")


def test_the_command_works_as_a_process(tmp_path):
    ended = command("render", "corner", *SMALL, "-o", "c.png", folder=tmp_path)
    assert ended.code == 0, ended.err
    assert (tmp_path / "c.png").stat().st_size > 100
    assert command("--version").out == f"antumbra {am.__version__}\n"
