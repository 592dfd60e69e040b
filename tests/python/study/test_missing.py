"""A variant that misses all light is accused if it had samples enough, and never passes for unbiased."""

from __future__ import annotations

import re

import pytest

import antumbra as am
from antumbra.study import plan
from antumbra.study.renders import REFERENCE_SEEDS


@pytest.fixture
def under_a_point():
    """A floor and a lamp without size, which no direction hits."""
    scene = am.Scene("floor")
    scene.add_mesh([(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)], [(0, 2, 1), (0, 3, 2)])
    scene.add_light(am.lights.Point((0, 1, 0), intensity=1.0))
    return scene


VIEW = {"eye": (0, 1, 1), "look_at": (0, 0, 0), "fov": 0.6, "seeds": 6}
TWO = {"vary": {"estimator": ["area", "hemisphere"]}, "reference": "area", "reference_rays": 64}


def test_a_variant_without_any_light_is_flagged(under_a_point):
    found = am.study.run(under_a_point, viewing_rays=64, size=(64, 48), **TWO, **VIEW)
    assert [(row.values["estimator"], row.bias.flagged) for row in found.rows] == [
        ("area", False), ("hemisphere", True),
    ]  # fmt: skip
    assert not found.black()


def test_a_black_row_of_few_samples_is_told_and_does_not_pass(under_a_point):
    found = am.study.run(under_a_point, viewing_rays=1, size=(16, 12), **TWO, **VIEW)
    assert not found.flagged() and [row.values["estimator"] for row in found.black()] == ["hemisphere"]
    assert [
        text
        for level, _, text in found.messages
        if level == "warning" and "hemisphere found no light" in text
    ]


@pytest.mark.parametrize(("size", "said"), [("16x12", "not tested: black"), ("128x96", "1 row of 2 biased")])
def test_the_command_never_finds_no_bias_in_a_black_row(antumbra, tmp_path, size, said):
    (tmp_path / "point.xml").write_text(POINT, encoding="utf-8")
    vary = ["--vary", "estimator=area,hemisphere", "--reference", "area", "--seeds", "6"]
    done = antumbra("study", "point.xml", *vary, *RAYS, "--size", size, "-o", "out")
    assert done.code == 0, done.err
    assert said in done.out and "no bias found" not in done.out


RAYS = ["--viewing-rays", "16", "--reference-rays", "64"]
POINT = """<scene version="3.0.0">
<sensor type="perspective"><transform name="to_world"><lookat origin="0,1,1" target="0,0,0" up="0,1,0"/></transform>
</sensor><shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/><scale value="9"/></transform>
</shape><emitter type="point"><point name="position" x="0" y="1" z="0"/><rgb name="intensity" value="1"/></emitter>
</scene>"""


@pytest.mark.parametrize("first", [0, 1 << 27, 1 << 28, 1 << 29, 1 << 30, 3 << 30, (1 << 32) - 1])
def test_variants_pilots_and_reference_never_share_a_seed(monkeypatch, first):
    real, seen = am.Scene.render, {}

    def noted(self, **options):
        kind = options["estimator"], options["viewing_rays"]
        seen.setdefault(int(options["seed"]), set()).add(kind)
        return real(self, **options)

    monkeypatch.setattr(am.Scene, "render", noted)
    am.study.run("pillars", vary={"shadow_rays": [1]}, estimator="area", viewing_rays=1, seed=first, size=(8, 6),
                 seeds=3, reference="mis")  # fmt: skip
    variant = {seed for seed, kinds in seen.items() if ("area", "1") in kinds}
    others = {seed for seed, kinds in seen.items() if any(name == "mis" for name, _ in kinds)}
    assert len(variant) == 3 and len(others) == REFERENCE_SEEDS + 4 and not variant & others


def test_a_reference_of_the_same_kind_has_noise_of_its_own():
    # With the seeds of the variant the difference was 0.0000, whatever the estimator did.
    found = am.study.run("pillars", vary={"shadow_rays": [1]}, estimator="area", reference="area", viewing_rays=1,
                         reference_rays=8, seed=1 << 30, size=(8, 6), seeds=8)  # fmt: skip
    assert found.rows[0].bias.difference.value != 0


def test_more_seeds_than_lie_apart_are_refused():
    with pytest.raises(am.OptionError, match=re.escape("at most 1,048,576")):
        plan.plan({"sampler": ["owen"]}, {}, parameters={}, budget={}, seeds=1 << 27)
