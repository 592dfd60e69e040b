"""Rows that a folder keeps: taken again for the same study, never for another scene, sky, core or reference.

Also scenes of files whose parameters are varied.
"""

from __future__ import annotations

import json

import pytest
from small_study import SMALL

import antumbra as am
from antumbra import _made_by
from antumbra.study import StudyStopped, renders
from antumbra.study.content import content


def test_kept_rows_have_the_places_of_the_new_plan(tmp_path):
    options = {**SMALL, "vary": {"D.light-size": [2]}, "reference": "mis", "folder": tmp_path}
    (alone,) = am.study.run("pillars", **options).rows
    assert alone.truth == 0 and alone.n is None
    both = am.study.run("pillars", **{**options, "vary": {"D.light-size": [0.5, 2]}}).rows
    assert [(row.truth, row.n) for row in both] == [(0, 0.5), (1, 2.0)]
    assert both[1].variances == alone.variances and both[1].seconds == alone.seconds


def test_rows_of_another_reference_error_are_not_mixed(tmp_path):
    scene = am.builtin("pillars")
    picture = scene.render(estimator="mis", viewing_rays=64, size=(8, 6))
    for name in ("truth.exr", "error.exr"):
        picture.save(tmp_path / name)
    given = {
        "reference": tmp_path / "truth.exr",
        "reference_error": tmp_path / "error.exr",
        "folder": tmp_path / "out",
    }
    first = am.study.run("pillars", **given, **SMALL)
    am.builtin("pillars", light_size=0.5).render(viewing_rays=4, size=(8, 6)).save(tmp_path / "error.exr")
    again = am.study.run("pillars", **given, **SMALL)
    assert again.fingerprint != first.fingerprint
    assert again.rows[0].reference_variance != first.rows[0].reference_variance


GLTF = '{"images": [{"uri": "the%20data.bin"}]}'


@pytest.mark.parametrize(
    ("scene", "text"),
    [
        ("a.gltf", GLTF),
        ("a.glb", "glTF........" + chr(len(GLTF)) + "\0\0\0JSON" + GLTF + "and binary data"),
        ("a.obj", "mtllib a.mtl\nv 0 0 0"),
    ],
    ids=["gltf", "glb", "obj"],
)
def test_a_scene_is_another_when_a_file_beside_it_changes(tmp_path, scene, text):
    (tmp_path / scene).write_text(text, encoding="utf-8")
    (tmp_path / "a.mtl").write_text("newmtl a\nmap_Kd -s 1 1 the data.bin data.bin", encoding="utf-8")
    seen = []
    for data in ("old", "new", "old"):
        (tmp_path / "the data.bin").write_text(data, encoding="utf-8")
        (tmp_path / "data.bin").write_text(data, encoding="utf-8")
        (tmp_path / "unrelated.bin").write_text(str(len(seen)), encoding="utf-8")
        seen.append(content(tmp_path / scene))
    assert seen[0] == seen[2] != seen[1]


XML = """<?xml version="1.0"?><scene version="3.0.0"><default name="what" value="ball"/>
<include filename="parts/inside.xml"/><shape type="ply"><string name="filename" value="$what.ply"/></shape></scene>"""
INSIDE = (
    "<scene version='3.0.0'><texture><string value='wood &amp; oak.png' name='filename'/></texture></scene>"
)


@pytest.mark.parametrize("beside", ["parts/inside.xml", "ball.ply", "wood & oak.png"])
def test_an_xml_scene_is_another_when_a_file_that_it_or_an_include_names_changes(tmp_path, beside):
    (tmp_path / "parts").mkdir()
    for name, text in (
        ("a.xml", XML),
        ("parts/inside.xml", INSIDE),
        ("ball.ply", "p"),
        ("wood & oak.png", "w"),
    ):
        (tmp_path / name).write_text(text, encoding="utf-8")
    before = content(tmp_path / "a.xml")
    (tmp_path / "unrelated.txt").write_text("u", encoding="utf-8")
    assert content(tmp_path / "a.xml") == before
    with (tmp_path / beside).open("a", encoding="utf-8") as file:
        file.write("<!-- new -->")
    assert content(tmp_path / "a.xml") != before


@pytest.mark.parametrize("beside", ["parts/inside.pbrt", "ball.ply"])
def test_a_pbrt_scene_is_another_when_a_file_that_it_or_an_include_names_changes(tmp_path, beside):
    (tmp_path / "parts").mkdir()
    for name, text in (
        ("a.pbrt", 'WorldBegin Include "parts/inside.pbrt"'),
        ("parts/inside.pbrt", 'Shape "plymesh" "string filename" [ "ball.ply" ]'),
        ("ball.ply", "p"),
    ):
        (tmp_path / name).write_text(text, encoding="utf-8")
    before = content(tmp_path / "a.pbrt")
    with (tmp_path / beside).open("a", encoding="utf-8") as file:
        file.write("# new")
    assert content(tmp_path / "a.pbrt") != before


def test_rows_under_another_sky_of_the_same_name_are_not_mixed(tmp_path):
    sky = tmp_path / "sky.exr"
    given = {**SMALL, "environment": str(sky), "reference": "mis", "folder": tmp_path / "out"}
    found = []
    for light_size in (1.0, 0.5):
        am.builtin("pillars", light_size=light_size).render(viewing_rays=1, size=(8, 4)).save(sky)
        found.append(am.study.run("pillars", **given))
    assert found[0].fingerprint != found[1].fingerprint
    assert found[0].rows[0].mean != found[1].rows[0].mean


def test_rows_of_another_core_are_not_mixed(tmp_path, monkeypatch):
    first = am.study.run("pillars", **SMALL)
    (tmp_path / "core.so").write_bytes(b"another core")
    monkeypatch.setattr(_made_by._core, "__file__", str(tmp_path / "core.so"))
    assert am.study.run("pillars", **SMALL).fingerprint != first.fingerprint


LIT = """<scene version="3.0.0"><default name="light_size" value="1"/><default name="kind" value="diffuse"/>
<sensor type="perspective"><transform name="to_world"><lookat origin="0,2,4" target="0,0,0" up="0,1,0"/></transform>
</sensor><shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/></transform>
<bsdf type="$kind"/></shape><shape type="rectangle"><transform name="to_world"><scale value="$light_size"/>
<rotate x="1" angle="90"/><translate y="2"/></transform><emitter type="area"><rgb name="radiance" value="1"/></emitter>
</shape></scene>"""


def test_parameters_of_an_xml_scene_are_varied(tmp_path, antumbra):
    (tmp_path / "lit.xml").write_text(LIT, encoding="utf-8")
    given = {**SMALL, "vary": {"D.light_size": [0.5, 1]}, "reference": "mis"}
    small, large = am.study.run(str(tmp_path / "lit.xml"), **given).rows
    # The light's area, and with it nearly what arrives.
    assert 2 < large.mean / small.mean < 5
    with pytest.raises(am.SceneError, match="light_sise"):
        am.study.run(str(tmp_path / "lit.xml"), **{**given, "vary": {"D.light_sise": [1, 2]}})
    words = ["--vary", "shadow-rays=1,2", "--viewing-rays", "1", "--size", "8x6", "--seeds", "3", "-D"]
    done = antumbra("study", "lit.xml", *words, "light_size=0.5", "-D", "kind=diffuse")
    assert done.code == 0, done.err
    done = antumbra("study", "lit.xml", *words, "kind=diffuse", "--vary", "D.kind=1,2")
    assert done.code == 2 and "also given a fixed value" in done.err


def test_a_grown_study_that_is_stopped_keeps_what_was_done_before(tmp_path, monkeypatch):
    given = {**SMALL, "reference": "mis", "reference_rays": 64, "folder": tmp_path}
    am.study.run("pillars", **{**given, "vary": {"shadow_rays": [3, 4]}})
    real, calls = renders.Work.render, []

    def stops(self, parameters, words, seed, what):
        calls.append(what)
        # After the first row: the reference of 8 and 3 seeds.
        if len(calls) > 8 + 3:
            raise KeyboardInterrupt
        return real(self, parameters, words, seed, what)

    monkeypatch.setattr(renders.Work, "render", stops)
    with pytest.raises(StudyStopped) as stopped:
        am.study.run("pillars", **{**given, "vary": {"shadow_rays": [1, 2, 3, 4]}})
    rows = json.loads((tmp_path / "results.json").read_text("utf-8"))["rows"]
    assert [row["n"] for row in rows] == [row.n for row in stopped.value.study.rows] == [1, 3, 4]
    assert not list(tmp_path.glob("earlier-*"))


def test_another_study_leaves_the_rows_of_the_first(tmp_path, monkeypatch):
    given = {**SMALL, "reference": "mis", "reference_rays": 64, "folder": tmp_path}
    first = am.study.run("pillars", **given)
    page = (tmp_path / "index.html").read_text("utf-8")
    others = ({"vary": {"sampler": ["random", "owen"]}}, {"viewing_rays": 2})
    found = [am.study.run("pillars", **{**given, **other}) for other in others]
    assert all(any("held another study" in text for _, _, text in each.messages) for each in found)
    assert len(list(tmp_path.glob("earlier-*"))) == 2
    assert page in [(aside / "index.html").read_text("utf-8") for aside in tmp_path.glob("earlier-*")]
    # Asked for again, nothing is rendered.
    monkeypatch.setattr(renders.Work, "render", lambda *_: pytest.fail("something was rendered"))
    again = am.study.run("pillars", **given)
    assert again.rows == first.rows
