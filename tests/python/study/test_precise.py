"""A rendered reference is known well enough, and what a scene's file asks for holds as it does for `render`."""

from __future__ import annotations

import pytest
from small_study import SMALL

import antumbra as am
from antumbra._words import written
from antumbra.study import renders

ASKS = """<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="3"/></integrator>
<sensor type="perspective"><transform name="to_world"><lookat origin="0,2,4" target="0,0,0" up="0,1,0"/></transform>
<sampler type="independent"><integer name="sample_count" value="2"/></sampler>
<film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="12"/>
<integer name="crop_width" value="8"/><integer name="crop_height" value="6"/><rfilter type="box"/></film>
</sensor><shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/></transform>
</shape><shape type="rectangle"><transform name="to_world">
<rotate x="1" angle="90"/><translate y="2"/></transform><emitter type="area"><rgb name="radiance" value="1"/></emitter>
</shape></scene>"""


@pytest.fixture
def asking(tmp_path):
    """A file that asks for a part of its film, a filter, a number of samples and of bounces."""
    file = tmp_path / "asking.xml"
    file.write_text(ASKS, encoding="utf-8")
    return str(file)


def test_what_a_scene_s_file_asks_for_holds(asking):
    found = am.study.run(asking, vary={"shadow_rays": [1, 2]}, seeds=3)
    rendered = am.load(asking).render(shadow_rays=1)
    assert found.size == (rendered.width, rendered.height) == (8, 6)
    assert {row.viewing_rays for row in found.rows} == {2}
    # max_depth counts the viewing ray: two bounces, so it is all light.
    assert (found.fixed["bounces"], found.fixed["filter"]) == ("2", "box")
    assert found.reference.startswith("path")


def test_what_is_said_stands_above_what_a_file_asks_for(asking):
    given = {"vary": {"bounces": [1]}, "reference": "mis", "seeds": 3}
    found = am.study.run(asking, viewing_rays=1, **given)
    assert found.rows[0].viewing_rays == 1 and "bounces" not in found.fixed
    # A budget chooses the viewing rays, though the file asks for two.
    budget = am.study.run(asking, budget={"rays": [32]}, **given)
    assert budget.rows[0].viewing_rays > 8


def test_the_own_error_of_a_named_reference_is_small_and_stated():
    given = {
        "estimator": "area",
        "sampler": "owen",
        "light_points": "area",
        "size": (16, 12),
        "seeds": 4,
        "parameters": {"light_size": 4.0},
    }
    found = am.study.run(
        "pillars", vary={"shadow_rays": [4, 16]}, viewing_rays=1, reference="hemisphere", **given
    )
    error, part = found.reference_error()
    # What is asked for is a quarter; pilots of three and four pictures are right within a factor of two.
    assert 0 < part < 0.5
    assert f"at most {written(100 * part, 2)} % of the noise of a row" in found.html()
    assert error == pytest.approx(max(r.reference_variance for r in found.rows) ** 0.5)
    # Without pilots, with as many rays as all variants take, directions are not good enough, and that is told.
    fair = renders.REFERENCE_SEEDS * 16
    poor = am.study.run("pillars", vary={"shadow_rays": [4, 16]}, viewing_rays=1, reference="hemisphere",
                        reference_rays=fair, **given)  # fmt: skip
    assert poor.reference_error()[1] > 0.5 > part
    assert any("reference's own error is" in text for _, _, text in poor.messages)
    assert not any("reference's own error is" in text for _, _, text in found.messages)


def test_a_pilot_of_a_row_is_not_rendered_twice(monkeypatch):
    real, seen = am.Scene.render, []

    def counted(self, **options):
        seen.append((options["seed"], options.get("shadow_rays"), options["viewing_rays"]))
        return real(self, **options)

    monkeypatch.setattr(am.Scene, "render", counted)
    found = am.study.run("pillars", **SMALL, reference="mis")
    assert len(seen) == len(set(seen)) == len(found.rows) * 3 + renders.REFERENCE_SEEDS + 4
