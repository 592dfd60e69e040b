"""The glTF assets of the test data, rendered small in the views of the gallery: finite, lit, warnings as expected."""

from __future__ import annotations

import importlib.util
import re
import sys

import numpy as np
import pytest

import antumbra as am
from common import ROOT


def gallery():
    """The module of `make gallery`."""
    spec = importlib.util.spec_from_file_location("gallery", ROOT / "tools" / "gallery.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules["gallery"] = module
    spec.loader.exec_module(module)
    return module


GALLERY = gallery()


@pytest.mark.parametrize("asset", GALLERY.ASSETS, ids=lambda asset: asset.title)
def test_asset(asset, data):
    scene, image = GALLERY.render(asset, data, size=(32, 24), viewing_rays=2)
    assert np.isfinite(image.pixels).all()
    # Something is there: not one value all over, and light.
    assert image.pixels.max() > 0.05 and image.pixels.std() > 1e-3
    warnings = [m.text for m in scene.messages if m.level == "warning"]
    assert len(warnings) == len(asset.warns), warnings
    for word in asset.warns:
        assert any(word in text for text in warnings), (word, warnings)


@pytest.mark.parametrize("file", GALLERY.REFUSED)
def test_refused(file, data, monkeypatch):
    monkeypatch.setitem(sys.modules, "DracoPy", None)
    with pytest.raises(am.SceneError) as told:
        am.load(data / file)
    assert GALLERY.REFUSED[file] in f"{told.value}\n{told.value.hint}"
    assert told.value.hint


def test_every_asset_is_in_the_gallery(data):
    named = {asset.file for asset in GALLERY.ASSETS} | set(GALLERY.REFUSED)
    there = {
        str(file.relative_to(data))
        for folder in ("scenes/gltf", "bake")
        for file in (data / folder).rglob("*")
        if file.suffix in (".gltf", ".glb")
    }
    assert named == there


SHOWN = {words[-1]: words for words in GALLERY.commands()}


def test_every_built_in_scene_and_every_picture_is_on_the_page():
    assert set(am.builtins()) <= {words[1] for words in GALLERY.commands()}
    page = GALLERY.PAGE.read_text(encoding="utf-8")
    named = {f"docs/pictures/{name}" for name in re.findall(r"\]\(pictures/([^)]+)\)", page)}
    folder = ROOT / "docs" / "pictures"
    assert named | {"docs/pictures/antumbra.png"} == {
        f"docs/pictures/{file.name}" for file in folder.iterdir()
    }
    by_hand = {name for name in named if name not in SHOWN}
    assert all(name.startswith("docs/pictures/lecture-") for name in by_hand - {"docs/pictures/gallery.jpg"})
    assert sum(file.stat().st_size for file in folder.iterdir()) < 3_000_000


# Those with the largest scenes are made often enough elsewhere.
LIGHT = [name for name, words in SHOWN.items() if words[1] not in ("scan", "hall", "interior")]


@pytest.mark.parametrize("name", LIGHT)
def test_a_picture_of_the_page_is_what_its_command_makes(name, tmp_path):
    from PIL import Image

    shown, words = Image.open(ROOT / name).convert("RGB"), SHOWN[name]
    rays = min(4, int(words[words.index("--viewing-rays") + 1]))
    size = f"{shown.width // 4}x{shown.height // 4}"
    made = str(tmp_path / "a.png")
    assert GALLERY.run([*words[:-1], made, "--size", size, "--viewing-rays", str(rays)]) == 0
    small = [p.resize((16, 12), Image.Resampling.BOX) for p in (shown, Image.open(made).convert("RGB"))]
    look, made = (np.asarray(picture, float) for picture in small)
    # Of 255. Blurred so much, the noise of 4 viewing rays is less than this; another view or light is not.
    assert abs(made - look).mean() < 12


def turned(uv, angle):
    """KHR_texture_transform of the asset: translation · rotation · scale, as the extension's text has them."""
    offset, scale = np.array([0.1, 0.2]), np.array([4.0, 5.0])
    rotation = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return offset + (uv * scale) @ rotation.T


def test_the_texture_is_turned_as_its_extension_says(data):
    from PIL import Image

    folder = data / "scenes/gltf/texture_transform"
    scene = am.load(folder / "09_texture_transform.gltf")
    view = {"size": (64, 64), "eye": (0, 5, 0), "look_at": (0, 0, 0), "up": (0, 0, -1), "fov": 0.39}
    image = scene.render(**view, viewing="centre", viewing_rays=1, aov="albedo")
    origins, directions = scene.camera_rays(**view)
    x, _, z = (origins + directions * (-origins[..., 1:2] / directions[..., 1:2])).reshape(-1, 3).T
    assert max(abs(x).max(), abs(z).max()) < 1, "the plane from −1 to 1 fills the picture"
    picture = np.asarray(Image.open(folder / "09_tiny_grid.png").convert("RGB"), float) / 255
    linear = np.where(picture <= 0.04045, picture / 12.92, ((picture + 0.055) / 1.055) ** 2.4)
    found = image.aov["albedo"].reshape(-1, 3)[:, 1]

    def likeness(angle):
        # Its plane has (u, v) = ((x + 1)/2, (z + 1)/2).
        place = turned(np.stack([x + 1, z + 1], 1) / 2, angle) * len(linear)
        texel = np.floor(place).astype(int) % len(linear)
        return np.corrcoef(linear[texel[:, 1], texel[:, 0], 1], found)[0, 1]

    # A metal's and a dielectric's albedo rise with the colour; not in proportion. Turned
    # the other way round, nothing is alike.
    assert likeness(0.3) > 0.95
    assert abs(likeness(-0.3)) < 0.3
