"""The command: what goes to which stream, how it ends, what it says when something is wrong."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

import antumbra as am
from conftest import command

SMALL = ["--size", "24x16", "--viewing-rays", "4"]
ENDING = re.compile(
    r"(?P<file>\S+)   [\d.]+ s · [\d,.]+( [MG])? shadow rays, [\d.e-]+ M/s · "
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
        (["render", "pillars", "--camera", "Tele"], 'there is no camera "Tele"'),
        (["render", "pillars", "--light", "Moon"], 'there is no light "Moon"'),
        (["render", "pillars", "--eye", "1,2"], "--eye 1,2: three numbers joined by commas are needed"),
        (["render", "pillars", "--crop", "600,0,100,10"], "does not lie in 640 x 480 pixels"),
        (["info"], "SCENE is missing (or --list, for the built-in scenes)"),
        (["diff", "a.exr", "b.exr"], "a.exr: cannot be read (no such file)"),
        (["diff", "a.jpg", "b.exr"], '"a.jpg": a picture ends in .exr or .png'),
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
    assert "-D light-size=1" in ended.out
    assert max(map(len, ended.out.splitlines())) <= 140


def test_info_as_json_has_stable_keys(antumbra):
    found = json.loads(antumbra("info", "pillars", "--json").out)
    assert list(found) == [
        "name", "bytes", "seconds", "source", "triangles", "shapes", "meshes", "objects", "instances", "bounds",
        "tree_bytes", "lights", "cameras", "materials", "masked_materials", "textures", "texture_bytes",
        "looks_wrong", "parameters", "messages",
    ]  # fmt: skip
    assert found["name"] == "pillars" and found["triangles"] > 0
    listed = json.loads(antumbra("info", "--list", "--json").out)
    assert {"cornell-box", "pillars", "eclipse"} <= {scene["name"] for scene in listed}


def test_every_built_in_scene_is_listed_with_its_parameters(antumbra):
    text = antumbra("info", "--list").out
    for name, shows in am.builtins().items():
        assert name in text and shows in text


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
    assert am.load_image(tmp_path / "map.png").shape == (8, 12, 3)


def test_diff_wants_the_same_size(antumbra, tmp_path):
    write(tmp_path / "a.png", np.zeros((8, 12, 3)))
    write(tmp_path / "b.png", np.zeros((8, 13, 3)))
    ended = antumbra("diff", "a.png", "b.png")
    assert ended.code == 2
    assert ended.err.startswith("error: a.png is 12 × 8, b.png is 13 × 8: the same size is needed")


def test_the_command_works_as_a_process(tmp_path):
    ended = command("render", "corner", *SMALL, "-o", "c.png", folder=tmp_path)
    assert ended.code == 0, ended.err
    assert (tmp_path / "c.png").stat().st_size > 100
    assert command("--version").out == f"antumbra {am.__version__}\n"
