"""Studies of small built-in scenes: known slopes, planted biases, budgets, and what is kept when one is stopped.

Seeds are fixed: each test has the same numbers every time. The claims have α = 5 % intervals behind them.
"""

from __future__ import annotations

import csv
import io
import json
from html.parser import HTMLParser

import numpy as np
import pytest
from small_study import SMALL

import antumbra as am
from antumbra.study import StudyStopped, files, kinds, plan, renders
from antumbra.study import statistics as st
from antumbra.study.page import against_independent, short_table

# One ray through the centre of each pixel, points uniform on the lights: all noise is that of the shadow rays.
SHADOW_RAYS = {"estimator": "area", "light_points": "area", "viewing_rays": 1, "viewing": "centre"}


def study(scene, **options):
    return am.study.run(scene, **{"seeds": 4, "reference_rays": 32, "size": (32, 24), **options})


@pytest.mark.parametrize("scene", ["pillars", "antumbra"])
def test_in_penumbrae_random_falls_as_1_over_n_and_stratified_as_its_power_of_1_5(scene):
    # Receivers: floors with the soft shadows of pillars and of balls. In a penumbra, √N of the N cells of a stratified
    # light are cut by the shadow's edge, so the variance falls as √N/N² (Mitchell 1996). Fully lit floor falls as N⁻²,
    # but from 4 rays on it has little of the variance. Intervals of 95 %, seeds fixed.
    found = study(
        scene, vary={"sampler": ["random", "stratified"], "shadow_rays": [4, 16, 64]}, reference="mis", seeds=8,
        **{**SHADOW_RAYS, "size": (40, 30)},
    )  # fmt: skip
    for sampler, expected in (("random", -1.0), ("stratified", -1.5)):
        slope = found.slope(sampler)
        assert slope.contains(expected) and slope.half < 0.15
    assert not found.flagged()


def test_without_shadows_stratified_falls_as_n_to_the_minus_2(floor):
    # A smooth integrand: in each of N cells of width 1/√N the variance is of order 1/N, so N · (1/N)/N² (Haber 1966).
    floor_only = {**SHADOW_RAYS, "eye": (0, 1, 1), "look_at": (0, 0, 0), "fov": 0.6}
    found = study(floor, vary={"shadow_rays": [4, 16, 64]}, sampler="stratified", seeds=6, **floor_only)
    assert st.verdict(found.slope("area"), near=-2.0, within=0.1) == "supported"


def test_a_planted_bias_is_flagged_and_nothing_else():
    found = study(
        "pillars",
        vary={"mistake": ["none", "no-cos-light"], "shadow_rays": [1, 4]},
        estimator="area",
        viewing_rays=4,
    )
    assert {found.name_of(row) for row in found.flagged()} == {"no-cos-light"}
    assert len(found.flagged()) == 2
    assert found.slope("no-cos-light") is None
    assert found.name_of(found.most_efficient()) == "mistake none"
    # A biased error is the distance from the reference: it stays where it is.
    errors = [found.error(row).value for row in found.curves()["no-cos-light"]]
    assert errors[1] == pytest.approx(errors[0], rel=0.3)


def test_estimators_of_different_kinds_agree():
    found = study("pillars", vary={"estimator": ["area", "mis"]}, viewing_rays=16, reference="hemisphere",
                  reference_rays=4096, size=(16, 12))  # fmt: skip
    assert not found.flagged()
    assert found.axis == "" and len(found.curves()) == 2


def test_a_grid_without_noise_is_held_against_the_reference():
    found = study("pillars", vary={"sampler": ["regular", "random"]}, reference_rays=4096, size=(16, 12),
                  **{**SHADOW_RAYS, "shadow_rays": 4})  # fmt: skip
    regular, random = found.rows
    assert regular.variance.value == 0 and random.noisy
    # Its error has that of the reference.
    assert found.error(regular).value > 0 and found.error(regular).half > 0
    assert np.isnan(regular.efficiency.value)
    assert "nan" not in found.html().lower().replace("nanum", "")


def test_rmse_is_against_the_reference_and_noise_is_not():
    given = {"vary": {"shadow_rays": [1, 4]}, "estimator": "area", "viewing_rays": 64, "size": (16, 12)}
    # Half as bright again as it should be.
    wrong = 1.5 * am.builtin("pillars").render(estimator="mis", viewing_rays=64, size=(16, 12)).pixels
    found = study("pillars", reference=wrong, **given)
    for row, line in zip(found.rows, csv.DictReader(io.StringIO(found.csv())), strict=True):
        assert found.error(row) == row.rmse == st.root(row.mse) and row.noise == st.root(row.variance)
        assert float(line["rmse"]) == row.rmse.value > 2 * row.noise.value == 2 * float(line["noise"])
    assert found.plot_curves()[0].y == [row.rmse.value for row in found.rows]
    assert (
        str(found.rows[-1].noise) in short_table(found)[1]
        and str(found.rows[-1].rmse) in short_table(found)[1]
    )
    alone = study("pillars", vary={"estimator": ["area", "mis", "hemisphere", "surfaces"]}, viewing_rays=1)
    assert alone.error(alone.rows[0]) is None and "RMSE" not in alone.html()
    assert [y for c in alone.plot_curves() for y in c.y] == [row.noise.value for row in alone.rows]


def test_a_blunt_test_is_told():
    found = study(
        "pillars", vary={"shadow_rays": [1]}, estimator="area", viewing_rays=1, seeds=3, size=(8, 6)
    )
    (row,) = found.rows
    assert row.tested and found.untestable() == row.hidden > 0.05
    assert any("was not testable: noise hides it" in text for _, _, text in found.messages)


@pytest.mark.parametrize(
    ("slope", "said"),
    [
        ((-1.02, -1.05, -0.99), "as 1/N"),
        ((-1.0, -1.4, -0.6), "undecided"),
        ((-1.5, -1.6, -1.4), "faster than 1/N"),
        ((-0.5, -0.9, -0.1), "slower than 1/N"),
    ],
)
def test_a_wide_interval_says_nothing_of_how_noise_falls(slope, said):
    assert against_independent(st.Interval(*slope)) == said


def test_each_truth_has_its_own_reference():
    found = study("pillars", vary={"D.light-size": [0.5, 2], "estimator": ["area"]}, viewing_rays=4)
    assert [row.truth for row in found.rows] == [0, 1]
    assert found.axis == "D.light-size" and [row.n for row in found.rows] == [0.5, 2.0]
    assert not found.flagged()


def test_a_budget_of_rays_is_spent_by_all_alike():
    found = study("pillars", vary={"estimator": ["area", "mis"]}, budget={"rays": [12, 48]})
    for row in found.rows:
        # One more viewing ray brings up to 3 rays (viewing, light, direction): half of that is what rounding leaves.
        assert abs(row.rays - row.budget) <= 1.5 + 0.02 * row.budget
        # What rounding left is what slopes are fitted against.
        assert row.n == row.rays
    assert found.axis == "budget" and found.slope("area").value < -0.5


def test_shadow_rays_are_chosen_where_viewing_rays_are_given():
    found = study("pillars", vary={"sampler": ["owen"]}, budget={"rays": [20]}, **SHADOW_RAYS)
    (row,) = found.rows
    assert row.viewing_rays == 1 and row.shadow_rays > 10
    assert row.rays == pytest.approx(20, abs=1)


def test_a_budget_of_seconds_is_measured_by_pilots():
    found = study(
        "pillars", vary={"sampler": ["random", "owen"]}, budget={"seconds": [0.2]}, estimator="area"
    )
    assert all(row.viewing_rays > 1 for row in found.rows)
    # A clock on a busy machine: only the order of magnitude is a law.
    assert all(0.2 / 10 < row.seconds.value < 0.2 * 10 for row in found.rows)


def test_slopes_over_a_budget_are_of_what_was_spent():
    # Of 3 and 4 rays asked for, a viewing ray of about 2 leaves as many or a third less: the law holds all the same.
    found = study(
        "pillars", vary={"sampler": ["random"]}, budget={"rays": [3, 4, 96]}, estimator="area", seeds=8
    )
    spent = [row.rays for row in found.rows]
    assert [row.n for row in found.rows] == spent != [row.budget for row in found.rows]
    expected = st.variance_slope(spent, np.array([row.variances for row in found.rows]).T)
    assert found.slope("area") == pytest.approx(expected)
    # Twenty times what a picture of one ray takes: enough on a busy machine too.
    timed = study(
        "pillars", vary={"sampler": ["random"]}, budget={"seconds": [0.2, 0.4]}, estimator="area", seeds=3
    )
    assert [row.n for row in timed.rows] == [row.seconds.value for row in timed.rows]


def test_a_picture_may_be_the_reference(tmp_path):
    scene = am.builtin("pillars")
    truth = scene.render(estimator="mis", viewing_rays=256, size=(32, 24), seed=99)
    truth.save(tmp_path / "truth.exr")
    options = {"vary": {"shadow_rays": [1, 4]}, "estimator": "area", "viewing_rays": 4}
    by_file = study("pillars", reference=str(tmp_path / "truth.exr"), **options)
    by_array = study(scene, reference=truth.pixels, **options)
    assert "taken as exact" in by_file.reference and "given picture" in by_array.reference
    for row, same in zip(by_file.rows, by_array.rows, strict=True):
        # The file has half precision: 2⁻¹¹ of each value.
        assert row.mse.value == pytest.approx(same.mse.value, rel=0.02)
    with pytest.raises(am.OptionError, match=r"truth\.exr is 32 × 24, the pictures of this study 16 × 12"):
        study("pillars", reference=str(tmp_path / "truth.exr"), size=(16, 12), **options)


# Four pictures each of hemisphere and of surfaces, which are too noisy to be the reference of so small a study; three
# of the row of the most rays, and four of the reference, to know how many rays that needs.
PILOTS = 2 * 4 + 3 + 4


def test_what_is_written_can_be_read(tmp_path):
    found = am.study.run("pillars", folder=tmp_path / "new" / "folder", **SMALL)
    folder = tmp_path / "new" / "folder"
    assert sorted(p.name for p in folder.iterdir()) == ["index.html", "results.csv", "results.json"]
    lines = (folder / "results.csv").read_text("utf-8").splitlines()
    assert len(lines) == 4 and lines[0].startswith("curve,shadow-rays,")
    whole = json.loads((folder / "results.json").read_text("utf-8"))
    assert [row["n"] for row in whole["rows"]] == [1, 2, 3] and whole["complete"]
    page = (folder / "index.html").read_text("utf-8")
    assert page == found.html()
    assert "src=" not in page and "<script" not in page and "@import" not in page
    HTMLParser().feed(page)
    assert found._repr_html_().count("<svg") == 1


def test_a_stopped_study_keeps_its_rows_and_goes_on(tmp_path, monkeypatch):
    real, calls = renders.Work.render, []

    def stops(self, parameters, words, seed, what):
        calls.append(what)
        if len(calls) == PILOTS + 8 + 3 + 2:
            raise KeyboardInterrupt
        return real(self, parameters, words, seed, what)

    monkeypatch.setattr(renders.Work, "render", stops)
    with pytest.raises(StudyStopped) as stopped:
        am.study.run("pillars", folder=tmp_path, **SMALL)
    assert len(stopped.value.study.rows) == 1
    assert not json.loads((tmp_path / "results.json").read_text("utf-8"))["complete"]
    assert "stopped before its end" in (tmp_path / "index.html").read_text("utf-8")
    calls.clear()
    calls.extend([""] * 100)
    found = am.study.run("pillars", folder=tmp_path, **SMALL)
    # The reference again, whose pictures are not kept, and the two rows that were missing; no pilot.
    assert len(calls) - 100 == 8 + 2 * 3
    whole = am.study.run("pillars", **SMALL)
    assert [r.variances for r in found.rows] == [r.variances for r in whole.rows]


def test_what_is_not_tested_is_told_on_page_and_terminal():
    # A light that few directions hit, and few of them: their spread says nothing.
    found = study("pillars", vary={"estimator": ["hemisphere"]}, viewing_rays=1, reference="area", size=(8, 6),
                  parameters={"light_size": 0.05})  # fmt: skip
    (row,) = found.rows
    assert row.bias.tested == 0 and found.untested() == 1 and not found.tested()
    assert any("not tested in 100 % of the tiles" in text for _, _, text in found.messages)
    assert ">not tested<" in found.html() and short_table(found)[1].endswith("not tested")
    assert found.csv().splitlines()[1].endswith(",nan,0.0,not tested")
    again = type(row).of_json(json.loads(found.json())["rows"][0])
    assert again.bias.tested == 0 and np.isnan(again.bias.p)


def test_a_study_that_is_stopped_at_once_leaves_nothing(tmp_path, monkeypatch):
    def stops(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(renders.Work, "render", stops)
    with pytest.raises(StudyStopped) as stopped:
        am.study.run("pillars", folder=tmp_path / "new", **SMALL)
    assert stopped.value.study.rows == [] and list(tmp_path.iterdir()) == []


def test_a_disk_that_fills_up_keeps_the_rows_before(tmp_path, monkeypatch):
    real, written = files.write_whole, []

    def full(target, text):
        written.append(target.name)
        if len(written) == 3:
            raise OSError(28, "No space left on device")
        real(target, text)

    monkeypatch.setattr(files, "write_whole", full)
    with pytest.raises(OSError, match="No space left"):
        am.study.run("pillars", folder=tmp_path, **SMALL)
    assert len(json.loads((tmp_path / "results.json").read_text("utf-8"))["rows"]) == 2


def test_progress_is_told():
    steps = []
    am.study.run("pillars", progress=steps.append, **SMALL)
    done = [step.done for step in steps]
    assert done == sorted(done) and done[0] >= 0 and done[-1] <= 1
    said = list(dict.fromkeys(step.what for step in steps))
    assert said[0] == "a pilot" and said[1].startswith("reference, seed 1 of 8")
    assert all(step.done == 0 for step in steps if step.what == "a pilot")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"vary": {"samplr": ["owen"]}}, 'there is no setting "samplr" to vary; did you mean "sampler"'),
        ({"vary": {"sampler": ["owne"]}}, 'did you mean "owen"'),
        ({"vary": {"seed": [1, 2]}}, "the replicates are the seeds"),
        ({"vary": {"sampler": []}}, "has no values"),
        ({"vary": {"sampler": ["owen", "owen"]}}, "there twice"),
        ({"vary": {"sampler": ["owen"]}, "sampler": "random"}, "also given a fixed value"),
        ({"vary": {"D.light-sise": [1]}}, 'did you mean "light-size"'),
        ({"vary": {"D.light-size": [100]}}, "pillars takes 0.001 to 4"),
        ({"vary": {"estimator": ["area", "path"]}}, "find different light"),
        ({"vary": {"sampler": ["owen"]}, "estimator": "area", "reference": "path"}, "finds all light"),
        ({"vary": {"sampler": ["owen"]}, "reference": "pth"}, 'did you mean "path"'),
        ({"vary": {"shadow_rays": [1]}, "viewing_rays": 1, "budget": {"rays": [9]}}, "leave one of them out"),
        ({"vary": {"sampler": ["owen"]}, "budget": {"ray": [9]}}, 'did you mean "rays"'),
        ({"vary": {"sampler": ["owen"]}, "budget": {"rays": [-1]}}, "above 0"),
        ({"vary": {"sampler": ["owen"]}, "seeds": 2}, "at least 3"),
        ({"vary": {"sampler": ["owen"]}, "aov": "normal"}, "no place in a study"),
        ({"vary": {"D.light-size": [1, 2]}, "reference": np.zeros((24, 32, 3))}, "name an estimator"),
        ({"vary": {"sampler": ["owen"]}, "reference": np.zeros((3, 3))}, r"\(24, 32, 3\) is needed"),
        ({"vary": {"sampler": ["owen"]}, "reference_error": "e.exr"}, "belong to one that is a file"),
    ],
)
def test_what_cannot_be_studied_is_told_before_a_ray_is_traced(options, said, monkeypatch):
    monkeypatch.setattr(renders.Work, "render", lambda *_: pytest.fail("something was rendered"))
    with pytest.raises(ValueError, match=said):
        study("pillars", **options)


def test_a_budget_that_is_too_small_is_told():
    with pytest.raises(am.OptionError, match="needs at least"):
        study("pillars", vary={"estimator": ["mis"]}, budget={"rays": [1]})


def test_a_reference_of_the_same_kind_is_warned_of_and_one_is_chosen_of_another():
    assert any("so is a variant" in m[2] for m in am.study.run("pillars", reference="area", **SMALL).messages)
    made = plan.plan({"estimator": ["area", "mis"]}, {}, parameters={}, budget={}, seeds=3)
    assert kinds.any_other(made) == "hemisphere"


def test_occlusion_has_no_second_kind():
    found = study("corner", vary={"shadow_rays": [4, 16]}, estimator="ambient-occlusion", viewing_rays=1)
    assert found.reference == "" and all(row.mse is None for row in found.rows)
    assert found.slope("ambient-occlusion").value < -0.5
    assert "noise is measured, and no bias" in found.html()


def test_a_reference_that_finds_no_light_tests_nothing():
    # The sun of the eclipse is half a degree wide: few directions find it, and none of these.
    found = study(
        "eclipse", vary={"estimator": ["area"]}, viewing_rays=4, reference="hemisphere", size=(8, 6)
    )
    assert not found.tested() and not found.flagged()
    assert any("found no light" in text for _, _, text in found.messages)
    assert "–" in found.html()
