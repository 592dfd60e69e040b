"""The Python package as its listing has it: scenes, pictures, estimates, hits, progress, cancelling."""

from __future__ import annotations

import math
import pickle
import threading
import time

import numpy as np
import pytest

import antumbra as am
from antumbra import _core
from common import FACES, SQUARE


def test_a_point_light_over_a_floor_is_its_formula(floor):
    scene = am.Scene()
    scene.add_mesh(SQUARE, FACES)
    scene.add_light(am.lights.Point((0, 2, 0), intensity=(8.0, 4.0, 2.0)))
    points = np.array([[0.0, 0, 0], [0.5, 0, 0.5]])
    irradiance = scene.irradiance(points, (0.0, 1, 0), shadow_rays=4, estimator="area")
    distance = np.linalg.norm(points - [0, 2, 0], axis=1)
    exact = np.array([8.0, 4.0, 2.0]) * (2 / distance**3)[:, None]
    # f32 arithmetic: a few units in the last place.
    np.testing.assert_allclose(irradiance, exact, rtol=1e-5)
    # The samples differ in nothing: what is left is the rounding of sums.
    assert irradiance.standard_error.max() < 1e-5


def test_a_square_lamp_is_its_form_factor(floor):
    """E = L·(2/π)·… of a centred parallel square, from the corner formula (Howell, C-11, four quarters)."""
    a = b = 0.5 / 2.0
    x, y = a / math.sqrt(1 + a * a), b / math.sqrt(1 + b * b)
    quarter = (x * math.atan(b / math.sqrt(1 + a * a)) + y * math.atan(a / math.sqrt(1 + b * b))) / (
        2 * math.pi
    )
    exact = 3.0 * math.pi * 4 * quarter
    found = floor.irradiance([[0.0, 0, 0]], [[0.0, 1, 0]], shadow_rays=4096, estimator="area")
    # Two-sided z-test, α = 1e-6 (|z| < 4.9), with 16 replicates: Student's t of 15 degrees has its α/2 point at 7.9.
    assert abs(found[0, 0] - exact) < 7.9 * found.standard_error[0, 0]
    assert found.standard_error[0, 0] < 0.01 * exact


def test_an_open_floor_is_open(floor):
    openness = floor.ambient_occlusion([[0.0, 0, 0]], [[0.0, 1, 0]], rays=64, radius=1.0)
    assert openness.shape == (1,) and openness[0] == 1
    assert floor.ambient_occlusion([[0.0, 0, 0]], [[0.0, 1, 0]], rays=256)[0] < 1
    assert floor.visible_fraction([[0.0, 0, 0]], [[0.0, 1, 0]], light="lamp")[0] == 1


@pytest.mark.parametrize("far", [0.0, 1e3, 5.2e6])
def test_far_from_zero_everything_stays_where_it_is_about_an_origin(far):
    """A scene of 2 units at 5.2·10⁶ (UTM) answers as the same scene at 0, because all is re-centred in f64."""
    at = np.array([far, far / 3, -far])
    scene = am.Scene(origin=at)
    scene.add_mesh(SQUARE + at, FACES)
    moved = np.eye(4)
    moved[:3, 3] = at + [0, 0.5, 0]
    scene.add_mesh(SQUARE / 10, FACES, transform=moved)
    scene.add_light(am.lights.Point(at + [0, 2, 0], intensity=1.0))
    scene.add_shape(am.shapes.Sphere(at + [0.5, 0.25, 0.5], 0.25))
    points = at + np.array([[0.0, 0, 0], [0.3, 0, 0], [0.9, 0, -0.9]])
    up = (0.0, 1.0, 0.0)
    # f64 keeps 10⁻⁹ at 5·10⁶; the answers are those at 0 to single precision.
    irradiance = np.asarray(scene.irradiance(points, up, shadow_rays=1, estimator="area"))[:, 0]
    distance = np.sqrt(4 + ((points - at) ** 2).sum(axis=1))
    np.testing.assert_allclose(irradiance, [0, 2 / distance[1] ** 3, 2 / distance[2] ** 3], rtol=1e-5, atol=0)
    np.testing.assert_array_equal(scene.occluded(points, at + [0, 2, 0]), [True, False, False])
    hit = scene.closest_hit(points + [0, 1, 0], (0.0, -1, 0))
    np.testing.assert_allclose(hit.position - at, [[0, 0.5, 0], [0.3, 0, 0], [0.9, 0, -0.9]], atol=1e-6)
    origins, _ = scene.camera_rays((2, 2), eye=at + [0, 1, 2], look_at=at)
    np.testing.assert_allclose(origins - at, np.tile([0, 1, 2], (4, 1)), atol=1e-6)
    draw = scene.sample_light(points, up, np.zeros((3, 3)))
    np.testing.assert_allclose(draw.target - at, np.tile([0, 2, 0], (3, 1)), atol=1e-6)
    np.testing.assert_allclose(np.array(scene.info()["bounds"]) - at, [[-1, 0, -1], [1, 0.5, 1]], atol=1e-6)


def test_hits_know_where_they_are(floor):
    hit = floor.closest_hit([[0.25, 1, 0.5], [5, 1, 5]], [[0.0, -2, 0], [0, -1, 0]])
    assert hit.t[0] == 0.5 and np.isinf(hit.t[1])
    assert hit.mesh[0] == 0 and hit.mesh[1] == 0xFFFF_FFFF and hit.primitive[1] == 0xFFFF_FFFF
    np.testing.assert_allclose(hit.position[0], [0.25, 0, 0.5], atol=1e-7)
    np.testing.assert_array_equal(hit.normal[0], [0, 1, 0])
    assert np.isnan(hit.position[1]).all() and np.isnan(hit.normal[1]).all()
    assert repr(hit) == "<Hit (2): 1 hit>"
    weights = np.array([1 - hit.uv[0].sum(), *hit.uv[0]])
    np.testing.assert_allclose(weights @ SQUARE[FACES[hit.primitive[0]]], [0.25, 0, 0.5], atol=1e-6)


def test_receivers_go_into_every_query(floor):
    origins, directions = floor.camera_rays((8, 8), eye=(0, 1.5, 0.1), look_at=(0, 0, 0))
    hit = floor.closest_hit(origins, directions)
    at = hit.receivers
    assert len(at) == 64
    assert not floor.occluded(at[hit.mesh == 0], (0.0, 1.0, 0.0)).any()
    lit = floor.irradiance(at, shadow_rays=4)
    assert lit.shape == (64, 3)
    missed = np.isinf(hit.t)
    assert (np.asarray(lit)[missed] == 0).all()
    assert (np.asarray(floor.ambient_occlusion(at, rays=4))[missed] == 1).all()
    below = floor.occluded(at[~missed], np.tile([0.0, -5, 0], ((~missed).sum(), 1)))
    assert below[hit.mesh[~missed] == 0].all(), "the own surface blocks what lies behind it"


def test_the_brdf_of_a_diffuse_floor_is_rho_over_pi(floor):
    hit = floor.closest_hit([[0.0, 1, 0]], [[0.0, -1, 0]])
    up = np.array([[0.0, 1, 0]])
    np.testing.assert_allclose(floor.brdf(hit, up, up), 0.5 / math.pi, rtol=1e-6)
    assert (floor.brdf(hit.receivers, up, -up) == 0).all()


def test_a_picture_has_everything_that_was_asked_for(floor, tmp_path):
    image = floor.render(size=(20, 10), viewing_rays=16, aov="albedo,depth", estimator="area", eye=(0, 1, 2))
    assert image.pixels.shape == (10, 20, 3) and image.pixels.dtype == np.float32
    assert image.standard_error.shape == (10, 20, 3)
    assert set(image.aov) == {"albedo", "depth"}
    assert image.aov["depth"].shape == (10, 20) and image.aov["albedo"].shape == (10, 20, 3)
    assert image.metadata["antumbra.estimator"] == "area" and image.metadata["antumbra.seed"] == "0"
    assert (image.passes_done, image.passes) == (16, 16) and image.shadow_rays > 0 and image.rays > 0
    np.testing.assert_array_equal(np.asarray(image), image.pixels)
    assert repr(image).startswith("<Image floor: 20 × 10 · standard error")
    assert "<img" in image._repr_html_() and "floor" in image._repr_html_()
    image.save(tmp_path / "floor.png")
    image.save(tmp_path / "floor.exr")
    # Half floats have 11 significant bits.
    np.testing.assert_allclose(am.load_image(tmp_path / "floor.exr"), image.pixels, rtol=2**-11, atol=1e-7)
    with pytest.raises(ValueError, match=r"a picture ends in \.exr or \.png"):
        image.save(tmp_path / "floor.jpg")
    with pytest.raises(OSError, match="no folder"):
        image.save(tmp_path / "no" / "floor.png")


def test_a_written_exr_is_read_by_the_official_library(floor, tmp_path):
    open_exr = pytest.importorskip("OpenEXR")
    image = floor.render(size=(20, 10), viewing_rays=4, aov="position", eye=(0, 1, 2))
    image.save(tmp_path / "floor.exr")
    with open_exr.File(str(tmp_path / "floor.exr"), separate_channels=True) as file:
        channels = file.channels()
        assert {"R", "G", "B", "position.R", "position.G", "position.B"} <= set(channels)
        np.testing.assert_allclose(channels["G"].pixels, image.pixels[..., 1], rtol=2**-11, atol=1e-7)
        np.testing.assert_array_equal(channels["position.R"].pixels, image.aov["position"][..., 0])
        assert file.header()["antumbra.seed"] == "0"


def test_a_cropped_exr_says_where_it_lies_to_the_official_library(floor, tmp_path):
    open_exr = pytest.importorskip("OpenEXR")
    floor.render(size=(20, 10), crop=(3, 2, 8, 5), viewing_rays=1, eye=(0, 1, 2)).save(tmp_path / "part.exr")
    with open_exr.File(str(tmp_path / "part.exr"), separate_channels=True) as file:
        windows = [
            [list(corner) for corner in file.header()[name]] for name in ("dataWindow", "displayWindow")
        ]
    assert windows == [[[3, 2], [10, 6]], [[0, 0], [19, 9]]]


def test_pictures_and_estimates_pickle(floor):
    image = floor.render(size=(8, 8), viewing_rays=4, aov="depth")
    again = pickle.loads(pickle.dumps(image))
    np.testing.assert_array_equal(again.pixels, image.pixels)
    np.testing.assert_array_equal(again.aov["depth"], image.aov["depth"])
    assert (again.hash, again.metadata, repr(again)) == (image.hash, image.metadata, repr(image))
    assert again.png() == image.png()
    estimate = floor.irradiance([[0.0, 0, 0]], [[0.0, 1, 0]])
    assert repr(pickle.loads(pickle.dumps(estimate))) == repr(estimate)


def test_hits_pickle_and_their_receivers_stay_with_the_scene(floor):
    hit = floor.closest_hit([[0.25, 1, 0.5], [5, 1, 5]], [[0.0, -2, 0], [0, -1, 0]])
    again = pickle.loads(pickle.dumps(hit))
    for name in ("t", "primitive", "mesh", "uv", "position", "normal"):
        np.testing.assert_array_equal(getattr(again, name), getattr(hit, name))
    assert repr(again) == repr(hit)
    with pytest.raises(ValueError, match="its receivers stayed with the scene"):
        _ = again.receivers
    with pytest.raises(TypeError, match="receivers do not pickle"):
        pickle.dumps(hit.receivers)
    with pytest.raises(TypeError, match="a Scene does not pickle: make 'floor' again"):
        pickle.dumps(floor)


def test_a_hit_stands_for_its_receivers(floor):
    hit = floor.closest_hit([[0.0, 1, 0], [0.5, 1, 0.5]], (0.0, -1, 0))
    for ask in (
        lambda at: floor.irradiance(at, shadow_rays=4),
        lambda at: floor.ambient_occlusion(at, rays=4),
        lambda at: floor.visible_fraction(at, light="lamp", rays=4),
        lambda at: floor.occluded(at, (0.0, 3, 0)),
        lambda at: floor.closest_hit(at, (0.0, 1, 0)).t,
        lambda at: floor.sample_light(at, None, np.full((2, 3), 0.25)).direction,
    ):
        np.testing.assert_array_equal(ask(hit), ask(hit.receivers))


def test_the_pieces_of_an_estimator_do_not_depend_on_threads(floor):
    """More receivers than a thread takes at once: the same rows as when asked a few at a time."""
    n = 5000
    random = np.random.default_rng(3)
    points = random.uniform(-1, 1, (n, 3)) * [1, 0, 1] + [0, 1, 0]
    hit = floor.closest_hit(points, (0.0, -1, 0))
    u, up = random.random((n, 3)), np.array([0.0, 1, 0])
    drawn = floor.sample_light(hit, None, u, threads=2)
    reflected = floor.brdf(hit, up, drawn.direction)
    for run in (slice(0, 7), slice(3000, 3100)):
        few = floor.sample_light(hit.receivers[run], None, u[run], threads=1)
        for all_rows, rows in zip(drawn, few, strict=True):
            np.testing.assert_array_equal(all_rows[run], rows)
        np.testing.assert_array_equal(
            reflected[run], floor.brdf(hit.receivers[run], up, drawn.direction[run])
        )
    with pytest.raises(ValueError, match=r"wi\[4321\] is"):
        wrong = drawn.direction.astype(float)
        wrong[4321:] = np.nan
        floor.brdf(hit, up, wrong)


def test_a_scene_shows_itself_in_a_notebook(floor):
    shown = floor._repr_html_()
    assert "Scene floor: 4 triangles" in shown and "<th>lights</th><td>lamp (area)</td>" in shown


def test_an_error_that_is_not_known_is_said_to_be_unknown(floor):
    image = floor.render(size=(8, 6), viewing_rays=1)
    assert image.standard_error is None and image.relative_error is None
    assert "standard error not known" in repr(image)
    one = floor.irradiance([[0.0, 0, 0]], [[0.0, 1, 0]], shadow_rays=1)
    assert np.isnan(one.standard_error).all() and "standard error not known" in repr(one)


def test_an_environment_of_a_file_is_given_by_its_path(floor, tmp_path):
    _core.write_picture(str(tmp_path / "grey.exr"), np.full((4, 8, 3), 0.5, np.float32))
    lit = floor.render(size=(8, 6), viewing_rays=4, environment=tmp_path / "grey.exr")
    assert lit.hash != floor.render(size=(8, 6), viewing_rays=4).hash


def test_an_estimate_acts_as_its_array(floor):
    estimate = floor.irradiance(np.zeros((5, 3)), (0.0, 1, 0), shadow_rays=8)
    values = np.asarray(estimate)
    for plain in (
        estimate + 1,
        2 * estimate,
        np.sqrt(estimate),
        estimate.mean(axis=0),
        estimate[1:3],
        -estimate,
    ):
        assert type(plain) is np.ndarray
    np.testing.assert_array_equal(estimate + estimate, 2 * values)
    np.testing.assert_array_equal(np.concatenate([estimate, estimate])[:5], values)
    assert (len(estimate), estimate.shape, estimate.ndim, estimate.size) == (5, (5, 3), 2, 15)
    assert (estimate >= 0).all() and float(np.sum(estimate)) == values.sum()
    assert repr(estimate).startswith("<Estimate (5, 3) of irradiance: mean ") and "8 rays each" in repr(
        estimate
    )
    assert "<table>" in estimate._repr_html_()
    with pytest.raises(AttributeError):
        _ = estimate.nothing


def test_every_light_shape_and_material_is_made():
    scene = am.Scene()
    m, s = am.materials, am.shapes
    looks = [
        m.Diffuse(0.2),
        m.DiffuseTransmission(0.2, (0.5, 0.3, 0.1)),
        m.Mirror(0.9),
        m.MetallicRoughness((1, 0.8, 0.3), 1.0, 0.3),
        m.ClearCoat((0.8, 0.1, 0.1), metallic=0.5, coat_roughness=0.1),
        m.Principled((1, 0.8, 0.3), metallic=0.5, anisotropic=0.5, sheen=0.2, clearcoat=1.0),
        m.Principled(0.9, spec_trans=1.0, ior=1.33),
        m.Conductor("au"),
        m.Conductor((0.2, (3, 2, 1)), roughness=0.4),
        m.Dielectric(1.33),
        m.Dielectric(roughness=0.5),
        m.ThinDielectric(),
        m.Plastic((0.1, 0.2, 0.8)),
        m.Plastic(roughness=0.3, nonlinear=False),
    ]
    with pytest.raises(ValueError, match='there is no metal "gold"; there are: Ag, Al, Au'):
        m.Conductor("gold").fields()
    for x, material in enumerate(looks):
        scene.add_shape(s.Sphere((x, 0.5, 0), 0.4), material=material)
    scene.add_shape(s.Disk((0, 0, 0), (0, 1, 0), 5))
    scene.add_shape(s.Cylinder((0, 0, 2), (0, 1, 2), 0.2))
    scene.add_shape(s.Rectangle((-1, 0, -2), (2, 0, 0), (0, 1, 0)), emission=(1, 0.5, 0.2))
    lights = [
        am.lights.Point((0, 3, 0), 1),
        am.lights.Spot((0, 3, 0), (0, -1, 0), 5, 0.2, 0.4),
        am.lights.Directional((0, 1, 1), 0.5),
        am.lights.Spot((0, 3, 0), (0, -1, 0), 5, 0.2, 0.4, range=9),
        am.lights.Sun((0, 1, 0.2), 0.00465, 1e4),
        am.lights.Rectangle((0, 4, 0), (1, 0, 0), (0, 0, 1)),
        am.lights.Disk((0, 4, 0), (0, -1, 0), 0.5, 2),
        am.lights.Triangle((0, 4, 0), (1, 4, 0), (0, 4, 1), 2),
        am.lights.Sphere((3, 3, 3), 0.5, 2),
        am.lights.Environment(0.1),
    ]
    for i, light in enumerate(lights):
        scene.add_light(light, name=f"light {i}")
    image = scene.render(size=(16, 12), viewing_rays=4, estimator="area")
    assert np.isfinite(image.pixels).all() and image.pixels.max() > 0
    assert scene.messages == []
    kinds = {light["kind"] for light in scene.info()["lights"]}
    assert kinds == {"point", "spot", "directional", "sun", "area", "environment"}


def test_an_environment_of_pixels_shines_from_where_they_are():
    """Upper half 2, lower half 0: an upward floor gets π·2, a downward one nothing."""
    picture = np.zeros((16, 32, 3))
    picture[:8] = 2.0
    scene = am.Scene()
    scene.add_light(am.lights.Environment(picture, scale=0.5))
    normals = np.array([[0.0, 1, 0], [0, -1, 0]])
    found = scene.irradiance(np.zeros((2, 3)), normals, shadow_rays=1024, estimator="area")
    # Student's t with 15 degrees of freedom, α = 1e-6; 1 % for the picture's bilinear edge at the horizon.
    assert abs(found[0, 0] - math.pi) < 7.9 * found.standard_error[0, 0] + 0.01 * math.pi
    assert found[1, 0] < 0.02 * math.pi


@pytest.mark.parametrize("azimuth", [0.0, math.pi / 2, -2.5])
def test_an_environment_is_turned_clockwise_and_its_pixels_may_be_patches(azimuth):
    """One of four columns is bright, φ = 0 … π/2: E = L ∫ cos φ dφ ∫ sin² θ dθ = √2 · π/2 toward its middle."""
    picture = np.zeros((1, 4, 3))
    picture[:, 0] = 1.0
    scene = am.Scene()
    scene.add_light(am.lights.Environment(picture, azimuth=azimuth, nearest=True))
    middle = math.pi / 4 + azimuth
    toward = np.array([[math.sin(middle), 0, -math.cos(middle)]])
    found = scene.irradiance(np.zeros((2, 3)), np.concatenate([toward, -toward]), shadow_rays=1024)
    # Student's t with 15 degrees of freedom, α = 1e-6; 10⁻³ for the table's cells.
    assert abs(found[0, 0] - math.pi / math.sqrt(2)) < 7.9 * found.standard_error[0, 0] + 1e-3
    assert found[1, 0] == 0


def test_progress_is_told_and_can_stop():
    scene = am.builtin("pillars")
    states = []

    def watch(state):
        states.append(state)
        return state.passes_done < 8

    image = scene.render(size=(320, 240), viewing_rays=4096, progress=watch)
    assert 8 <= image.passes_done < image.passes == 4096
    assert [s.done for s in states] == sorted(s.done for s in states)
    assert states[-1].passes == 4096
    again = scene.render(
        size=(320, 240), viewing_rays=4096, progress=lambda s: s.passes_done < image.passes_done
    )
    if again.passes_done == image.passes_done:
        assert again.hash == image.hash, "the same number of passes gives the same bits"


def test_what_the_callback_raises_comes_out():
    def watch(_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        am.builtin("pillars").render(size=(64, 48), viewing_rays=256, progress=watch)


def test_other_threads_run_while_a_picture_is_rendered():
    """The lock is free: a counting thread moves on during one call."""
    scene = am.builtin("pillars")
    ticks, over = [0], threading.Event()

    def count():
        while not over.is_set():
            ticks[0] += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    before = ticks[0]
    scene.render(size=(160, 120), viewing_rays=16)
    during = ticks[0] - before
    over.set()
    counter.join()
    assert during >= 3
