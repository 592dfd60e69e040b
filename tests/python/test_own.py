"""Estimators of one's own: rendered like built-in ones, with the same rays and the same numbers."""

from __future__ import annotations

import re
import sys

import numpy as np
import pytest

import antumbra as am
from antumbra import own
from own_estimators import area, hemisphere, mis

SIZE = (40, 30)


@pytest.mark.parametrize(("sampler", "rays"), [("owen", 8), ("random", 6), ("stratified", 9)])
def test_one_light_gives_the_very_picture_of_the_built_in_estimator(sampler, rays):
    scene = am.builtin("pillars")
    mine, theirs = (
        scene.render(estimator=e, viewing_rays=rays, size=SIZE, sampler=sampler, seed=3)
        for e in (area, "area")
    )
    # The same rays, numbers and sums; single and double precision differ by some roundings of 2⁻²⁴ each.
    assert np.allclose(mine.pixels, theirs.pixels, rtol=2e-5, atol=1e-7)
    assert np.allclose(mine.standard_error, theirs.standard_error, rtol=1e-3, atol=1e-6)


@pytest.mark.parametrize("name", ["pillars", "cornell-box", "antumbra", "sky-dome"])
@pytest.mark.parametrize("estimator", [area, mis], ids=lambda e: e.__name__)
def test_the_mean_is_that_of_the_built_in_estimator(name, estimator):
    scene = am.builtin(name)
    mine = scene.render(estimator=estimator, viewing_rays=32, size=SIZE, seed=1)
    # `area` is as blind to mirrors as these are.
    theirs = scene.render(estimator="area", viewing_rays=32, size=SIZE, seed=2)
    errors = [image.standard_error.astype(np.float64).mean(axis=2) for image in (mine, theirs)]
    difference = (mine.pixels.astype(np.float64) - theirs.pixels).mean(axis=2)
    # A sum over 1,200 pixels of independent errors, so normal. Two-sided, α = 1e-6: |z| < 4.9.
    error = np.sqrt((errors[0] ** 2 + errors[1] ** 2).sum()) / difference.size
    assert abs(difference.mean()) < 4.9 * error + 1e-6


def test_lights_at_infinity_behind_one_another_are_weighed_without_bias():
    scene = am.Scene()
    scene.add_mesh([(-9, 0, -9), (-9, 0, 9), (9, 0, 9), (9, 0, -9)], [(0, 1, 2), (0, 2, 3)])
    scene.add_light(am.lights.Environment(1.0))
    scene.add_light(am.lights.Sun((0, 1, 0), 0.5, 3.0))
    view = {"eye": (0, 1, 0.1), "look_at": (0, 0, 0), "size": (16, 12), "viewing_rays": 256}
    image = scene.render(estimator=mis, **view)
    # ρ (L_sky + L_sun sin² α) for a diffuse floor under both; four standard errors of 576 means of 256 samples.
    truth = 0.5 * (1.0 + 3.0 * np.sin(0.5) ** 2)
    error = float(
        np.sqrt((image.standard_error.astype(np.float64) ** 2).sum()) / image.pixels.size
    ) * np.sqrt(3)
    assert abs(image.pixels.mean() - truth) < 4 * error + 1e-6


@pytest.mark.parametrize("lights", ["uniform", "power", "contribution"])
@pytest.mark.parametrize("name", ["pillars", "veach-mis"])
def test_a_direction_is_found_as_densely_as_it_is_drawn(name, lights):
    scene = am.builtin(name)
    hit = scene.closest_hit(*scene.camera_rays(SIZE))
    hit = scene.closest_hit(*(rays[np.isfinite(hit.t)] for rays in scene.camera_rays(SIZE)))
    drawn = scene.sample_light(hit, u=np.random.default_rng(5).random((len(hit), 3)), lights=lights)
    lit = drawn.radiance.sum(axis=1) > 0
    free = lit & ~scene.occluded(hit, drawn.target)
    toward = np.where(lit[:, None], drawn.direction, hit.normal)
    found = scene.find_light(hit, directions=toward, lights=lights)
    assert free.sum() > 300
    # The same density worked out from the point and from the direction, in single precision; at the very edge of a
    # light the direction may miss it.
    met = free & (found.pdf > 0)
    assert met.sum() > 0.99 * free.sum()
    assert np.allclose(found.pdf[met], drawn.pdf[met], rtol=2e-3)
    assert np.allclose(found.radiance[met], drawn.radiance[met], rtol=1e-5)


def test_what_stands_far_from_the_point_blocks_a_sun():
    scene = am.Scene()
    wall = [(1000, -9, -9), (1000, 9, -9), (1000, 9, 9), (1000, -9, 9)]
    scene.add_mesh(np.array(wall, float), [(0, 1, 2), (0, 2, 3)])
    scene.add_light(am.lights.Directional((1, 0, 0), 1.0))
    s = scene.sample_light([(0.0, 0, 0)], (1.0, 0, 0), np.full((1, 3), 0.5))
    assert scene.occluded([(0.0, 0, 0)], s.target).all()


@pytest.mark.parametrize("how", ["solid-angle", "area"])
def test_points_of_a_disk_are_even_over_its_area_either_way(how):
    scene, n = am.Scene(), 100_000
    scene.add_light(am.lights.Disk((0, 1, 0), (0, -1, 0), 1.0))
    u = np.random.default_rng(6).random((n, 3))
    s = scene.sample_light(np.zeros((n, 3)), (0, 1.0, 0), u, light_points=how)
    light = (s.radiance[:, 0] * s.direction[:, 1] / s.pdf).astype(np.float64)
    # CF35a (docs/decisions/0007). The standard error of a variance is √((m₄ − m₂²)/n); five of them.
    centred = light - light.mean()
    error = np.sqrt(((centred**4).mean() - (centred**2).mean() ** 2) / n)
    assert abs(light.var() - 0.4112335167121) < 5 * error


def test_one_light_is_drawn_never_all():
    with pytest.raises(am.OptionError, match="one light is drawn here"):
        am.builtin("pillars").sample_light([(0.0, 1, 0)], (0, 1.0, 0), np.full((1, 3), 0.5), lights="all")


@pytest.mark.parametrize(
    ("option", "value"), [("light", "key"), ("environment", "none"), ("shadow_rays", 4), ("masks", "opaque")]
)
@pytest.mark.parametrize("query", ["sample_light", "find_light"])
def test_what_light_points_do_not_heed_is_refused(query, option, value):
    ask = getattr(am.builtin("pillars"), query)
    with pytest.raises(am.OptionError, match=f"{option} is not heeded here.*light_points, threads are"):
        ask([(0.0, 1, 0)], (0, 1.0, 0), np.full((1, 3), 0.5), **{option: value})
    ask([(0.0, 1, 0)], (0, 1.0, 0), np.full((1, 3), 0.5), threads=1, **{option: None})


def test_numbers_are_other_ones_at_each_call_and_the_same_in_another_render():
    asked = []

    def grey(scene, at, u):
        asked.append([u(1), u(2), u(2), u(3), u(4)])
        return np.full(len(at), 0.5)

    scene = am.builtin("pillars")
    images = [scene.render(estimator=grey, viewing_rays=2, size=SIZE, seed=4) for _ in range(2)]
    assert images[0].hash == images[1].hash
    shapes = [[n.shape[1] for n in calls] for calls in asked]
    assert shapes == [[1, 2, 2, 3, 4]] * 4
    columns = np.concatenate(asked[0], axis=1).T
    assert ((columns >= 0) & (columns < 1)).all()
    # No column is another again: 12 columns of some 1,000 numbers correlate by less than 5/√1000.
    off = np.corrcoef(columns) - np.eye(len(columns))
    assert np.abs(off).max() < 5 / np.sqrt(columns.shape[1])
    assert all((a == b).all() for a, b in zip(asked[0], asked[2], strict=True))


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        (lambda s, at, u: np.zeros((3, 3)), "returned shape (3, 3)"),
        (lambda s, at, u: np.full(len(at), np.nan), "finite numbers are needed"),
        (lambda s, at, u: ["a"] * len(at), "numbers are needed"),
        (lambda s, at, u: u(0), "at least one number"),
    ],
)
def test_what_is_no_light_is_refused(answer, says):
    with pytest.raises(ValueError, match=re.escape(says)):
        am.builtin("pillars").render(estimator=answer, viewing_rays=1, size=(8, 6))


def test_settings_of_built_in_estimators_are_refused():
    with pytest.raises(am.OptionError, match="shadow_rays is not heeded with a function as estimator"):
        am.builtin("pillars").render(estimator=area, shadow_rays=4)


def test_a_stopped_render_keeps_its_passes():
    scene = am.builtin("pillars")
    image = scene.render(estimator=area, viewing_rays=64, size=SIZE, progress=lambda p: p.passes_done < 3)
    assert (image.passes_done, image.passes) == (3, 64)
    # No replicate is complete: the error is not known.
    assert image.standard_error is None
    assert image.metadata["antumbra.passes"] == "3 of 64"
    assert image.metadata["antumbra.estimator"] == "area (a function of Python)"

    def interrupted(scene, at, u):
        if interrupted.calls == 2:
            raise KeyboardInterrupt
        interrupted.calls += 1
        return area(scene, at, u)

    interrupted.calls = 0
    with pytest.raises(am.RenderStopped) as raised:
        scene.render(estimator=interrupted, viewing_rays=8, size=SIZE)
    assert raised.value.image.passes_done == 2


def test_a_picture_of_ones_own_is_saved_and_kept_like_any_other(tmp_path):
    import pickle

    image = am.builtin("cornell-box").render(estimator=hemisphere, viewing_rays=2, size=SIZE)
    image.save(tmp_path / "mine.exr")
    assert (am.load_image(tmp_path / "mine.exr").shape) == (30, 40, 3)
    again = pickle.loads(pickle.dumps(image))
    assert again.hash == image.hash == image.metadata["antumbra.pixel-hash"]


def test_ctrl_c_within_a_sum_leaves_it_out_or_counts_it():
    words = {"size": "4x3", "viewing_rays": "8"}
    light = np.ones((12, 3))

    def pressed_after(steps):
        """The picture of two passes, Ctrl-C after so many steps of the second sum, and whether that was within."""
        sums, left, within = own._Sums(am.builtin("pillars")._core, words, "one"), steps, False
        sums.add(0, light)

        def trace(frame, event, _):
            nonlocal left, within
            if frame.f_code is not own._Sums.add.__code__:
                return None
            frame.f_trace_opcodes = True
            left -= event == "opcode"
            if left < 0:
                within = True
                raise KeyboardInterrupt
            return trace

        sys.settrace(trace)
        try:
            sums.add(1, light)
        except KeyboardInterrupt:
            pass
        finally:
            sys.settrace(None)
        return sums.image("pillars", 0.0), within

    steps, within = 0, True
    while within:
        image, within = pressed_after(steps)
        assert (image.pixels == 1).all() and image.passes_done in (1, 2)
        steps += 1
    assert steps > 10 and image.passes_done == 2
