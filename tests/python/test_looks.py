"""Materials made of others, and the lens, from Python and from the command line."""

import re

import numpy as np
import pytest

import antumbra as am

WHITE = am.lights.Environment(1.0)


def floor(material):
    """A floor of this material under an even sky."""
    scene = am.Scene()
    corners = [[-9, 0, -9], [9, 0, -9], [9, 0, 9.0], [-9, 0, 9]]
    scene.add_mesh(corners, [[0, 2, 1], [0, 3, 2]], material=material)
    scene.add_light(WHITE)
    return scene


def seen(scene, height, **options):
    options = {"size": (16, 12), "viewing_rays": 16, "bounces": 1, **options}
    return scene.render(eye=(0, height, 0.1), look_at=(0, 0, 0), **options)


def test_each_side_has_its_material():
    """From above the front, from below the back: to the last bit what that material alone would show."""
    red, blue = am.materials.Diffuse((0.8, 0.1, 0.1)), am.materials.Diffuse((0.1, 0.1, 0.8))
    for make in (am.materials.TwoSided, lambda a, b: am.materials.Blend(am.materials.TwoSided(a, b), b, 0.0)):
        both = floor(make(red, blue))
        for height, plain in ((2, red), (-2, blue)):
            assert np.array_equal(seen(both, height).pixels, seen(floor(plain), height).pixels)


def test_a_rough_pane_spreads_what_it_lets_through():
    """Under an even sky a white pane is seen only by what masking takes away: little at a roughness of 0.3."""
    for roughness, lost in ((0.0, 1e-5), (0.3, 0.02)):
        pane = am.materials.ThinDielectric(1.5, roughness)
        mean = seen(floor(pane), 2, viewing_rays=64, bounces=3).pixels.mean()
        assert 1 - lost <= mean <= 1 + 1e-5, roughness


def test_principled_glass_is_ground_glass():
    """With `spec_trans` 1 and a white base nothing is left of Disney's model but ground glass of α = roughness²."""
    sky = am.lights.Sky(elevation=0.5)
    means = []
    for glass in (
        am.materials.Dielectric(1.5, 0.5),
        am.materials.Principled(1.0, roughness=0.5, spec_trans=1.0),
    ):
        scene = floor(glass)
        scene.add_light(sky)
        image = seen(scene, 2, viewing_rays=256, size=(32, 24), seed=5)
        means.append((image.pixels.mean(), image.standard_error.mean() / np.sqrt(32 * 24)))
    (a, da), (b, db) = means
    # Four standard errors: α below 10⁻⁴.
    assert abs(a - b) < 4 * np.hypot(da, db) + 1e-6 < 0.02 * a, means


def test_cloth_passes_light_on_to_its_other_side():
    """Under a far light of irradiance π: ρ from above, τ from below; what is more than 1 together is scaled down."""
    for (rho, tau), seen_as in (((0.2, 0.6), (0.2, 0.6)), ((0.6, 0.9), (0.4, 0.6))):
        scene = am.Scene()
        corners = [[-9, 0, -9], [9, 0, -9], [9, 0, 9.0], [-9, 0, 9]]
        cloth = am.materials.DiffuseTransmission(rho, tau)
        scene.add_mesh(corners, [[0, 2, 1], [0, 3, 2]], material=cloth)
        scene.add_light(am.lights.Directional((0, 1, 0), np.pi))
        for height, share in zip((2, -2), seen_as, strict=True):
            assert np.allclose(seen(scene, height, viewing_rays=1).pixels, share, rtol=1e-5)


def dots():
    """White dots of radius 0.05 on black in the planes z = 0 and z = -4, about the axis of the camera."""
    scene = am.Scene()
    for depth in (0.0, -4.0):
        x = 0.3 if depth else -0.3
        scene.add_light(am.lights.Disk((x, 0, depth), (0, 0, 1), 0.05, 1.0))
    return scene


def spread(pixels):
    """The width of each half of a picture that a dot covers: lit pixels."""
    lit = pixels.mean(-1) > 1e-4
    half = lit.shape[1] // 2
    return lit[:, :half].sum(), lit[:, half:].sum()


def test_a_lens_blurs_what_is_not_in_focus():
    view = {
        "eye": (0, 0, 4),
        "look_at": (0, 0, 0),
        "fov": 0.4,
        "size": (96, 64),
        "viewing_rays": 64,
        "filter": "box",
    }

    def of(**lens):
        return spread(dots().render(**view, **lens).pixels)

    near, far = of()
    # In focus at the point looked at: the near dot stays, the far one spreads over 2 · 0.3 · 4 / 8 = 0.3 in its plane
    # of focus, six times its own 0.05.
    assert of(aperture=0.0) == (near, far)
    sharp, blurred = of(aperture=0.3)
    assert sharp <= 1.3 * near and blurred > 9 * far
    blurred, sharp = of(aperture=0.3, focus=8.0)
    assert blurred > 9 * near and sharp <= 1.6 * far


def test_the_lens_of_a_file_is_told_and_may_be_changed(antumbra, tmp_path):
    file = tmp_path / "lens.xml"
    file.write_text(
        "<scene version='3.0.0'><sensor type='thinlens'><float name='aperture_radius' value='0.25'/>"
        "<float name='focus_distance' value='3'/></sensor><shape type='cube'/><emitter type='constant'/></scene>"
    )
    assert "a lens of radius 0.25 in focus at 3" in antumbra("info", file).out
    assert am.load(file).info()["cameras"][0]["focus"] == 3.0
    out = tmp_path / "a.exr"
    small = ("--size", "8x6", "--viewing-rays", "1", "-o", out)
    assert re.search("no effect", antumbra("render", "cornell-box", *small, "--focus", "2").err)
    assert "no effect" not in antumbra("render", file, *small, "--focus", "2").err
    done = antumbra("render", "cornell-box", *small, "--aperture", "-1")
    assert done.code == 2 and "aperture" in done.err


@pytest.mark.parametrize("name", ["aperture", "focus"])
def test_a_lens_needs_a_number(name):
    with pytest.raises((am.OptionError, TypeError), match=name):
        am.builtin("pillars").render(**{name: "wide"})
