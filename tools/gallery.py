"""Writes docs/pictures/gallery.jpg: the glTF assets of the test data on one sheet, each tile in pictures/gallery/ too.

Every asset by itself, in a view that shows what it is there for; `--size` for larger tiles. Where an asset has no
light, the default sky lights it, or a sunset where something mirrors.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import antumbra as am
from antumbra.cli._run import run

if TYPE_CHECKING:
    from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/gallery.md"
SHEET = ROOT / "docs/pictures/gallery.jpg"
TILES = ROOT / "pictures/gallery"
TILE = (256, 192)
COLUMNS = 5
SUNSET = "env/venice_sunset_512.exr"


class Asset(NamedTuple):
    """One tile: its title, the file, what it is rendered with, and a word of each warning that it is to give."""

    title: str
    file: str
    view: dict[str, Any] = {}  # noqa: RUF012 (never changed)
    warns: tuple[str, ...] = ()


ASSETS = [
    Asset("AlphaBlendModeTest", "scenes/gltf/AlphaBlendModeTest.glb",
          {"eye": (0, 1.6, 14.5), "look_at": (0, 1.05, 0), "fov": 0.46}),
    Asset("alpha_blend", "scenes/gltf/alpha_blend/01_alpha_blend.gltf", {"fov": 0.45}),
    Asset("alpha_mask", "scenes/gltf/alpha_mask/01_alpha_mask.gltf",
          {"eye": (0.6, 3.4, 1.6), "look_at": (0, 0, 0), "fov": 0.7}),
    Asset("BoxInterleaved", "scenes/gltf/BoxInterleaved.glb"),
    Asset("BoxMeshopt", "scenes/gltf/BoxMeshopt.glb"),
    Asset("emission_strength", "scenes/gltf/emission_strength/14_emission_strength.gltf",
          {"eye": (16.9, 9, 32), "look_at": (16.9, 0, 0), "fov": 0.85, "exposure": -1.0, "viewing_rays": 12},
          ("emissiveTexture",)),
    Asset("gen_gpu_instancing_400", "scenes/gltf/gen_gpu_instancing_400.glb", {"fov": 0.4}),
    Asset("gen_lights_cameras", "scenes/gltf/gen_lights_cameras.glb", {"exposure": -2.5}, ("range of point lights",)),
    Asset("gen_morph_weights", "scenes/gltf/gen_morph_weights.glb"),
    Asset("gen_primitive_modes", "scenes/gltf/gen_primitive_modes.glb", {}, ("points and lines",)),
    Asset("gen_quantized", "scenes/gltf/gen_quantized.glb"),
    Asset("gen_sparse", "scenes/gltf/gen_sparse.glb"),
    Asset("gen_ünïcödé 名前", "scenes/gltf/gen_ünïcödé 名前.glb"),
    Asset("gpu_instancing", "scenes/gltf/gpu_instancing/24_gpu_instancing.gltf",
          {"eye": (0, 60, 190), "look_at": (0, 0, 60), "fov": 0.6, "viewing_rays": 12}),
    Asset("many_cubes", "scenes/gltf/many_cubes/many-cubes.gltf", {"viewing_rays": 24}),
    Asset("meshopt_fallback", "scenes/gltf/meshopt_fallback/meshopt-fallback.gltf"),
    Asset("morphed_cube", "scenes/gltf/morphed_cube/01_morphed_cube.gltf", {"environment": SUNSET}),
    Asset("node_hierarchy", "scenes/gltf/node_hierarchy/02_node_hierarchy.gltf"),
    Asset("orm_two_uvmaps", "scenes/gltf/orm_two_uvmaps/12_orm_two_uvmaps.gltf", {"environment": SUNSET}),
    Asset("ShapeCollection", "scenes/gltf/ShapeCollection.glb", {"fov": 0.5}),
    Asset("simple_skin", "scenes/gltf/simple_skin.gltf"),
    Asset("single_vs_double_sided", "scenes/gltf/single_vs_double_sided/01_single_vs_double_sided.gltf", {"fov": 0.5}),
    Asset("texture_transform", "scenes/gltf/texture_transform/09_texture_transform.gltf",
          {"eye": (0.4, 3.6, 1.2), "look_at": (0, 0, 0), "fov": 0.7}),
    Asset("texture_webp", "scenes/gltf/texture_webp/box-textured-separate.gltf"),
    Asset("texture_webp, fallback", "scenes/gltf/texture_webp/box-textured-with-fallback.gltf"),
    Asset("transmission_cups", "scenes/gltf/transmission_cups/KHR_materials_transmission.gltf",
          {"environment": SUNSET}),
    Asset("vertex_color", "scenes/gltf/vertex_color/22_vertex_color.gltf", {"fov": 0.45}, ("points and lines",)),
    Asset("bake: instances_mirrored", "bake/instances_mirrored.glb", {"fov": 0.5}),
    Asset("bake: nodes_no_uv", "bake/nodes_no_uv.glb", {"fov": 0.45}),
    Asset("bake: room_overlapping_uv", "bake/room_overlapping_uv.glb"),
    Asset("bake: skinned_cylinder", "bake/skinned_cylinder/03_skinned_cylinder.gltf"),
    Asset("bake: spot_good_uv", "bake/spot_good_uv.glb"),
    Asset("bake: suzanne_orm", "bake/suzanne_orm/02_suzanne.gltf", {"environment": SUNSET}),
]  # fmt: skip

# What is refused, and a word of the reason.
REFUSED = {
    "scenes/gltf/draco_sparse/DracoSparseMesh.gltf": "antumbra[draco]",
    "scenes/gltf/gltf1_SimpleSkin.gltf": "this is glTF 1.1",
}


def render(asset: Asset, data: Path, **settings: Any) -> tuple[am.Scene, am.Image]:
    """One asset in its view; `settings` win over those of the view."""
    scene = am.load(data / asset.file)
    view = dict(asset.view)
    if "environment" in view:
        view["environment"] = str(data / view["environment"])
    return scene, scene.render(**{**view, **settings})


def sheet(tiles: list[tuple[str, Path]], size: tuple[int, int]) -> Image.Image:
    """All tiles in rows, each with its title below."""
    from matplotlib import font_manager
    from PIL import Image, ImageDraw, ImageFont

    (width, height), line, gap = size, 20, 6
    rows = -(-len(tiles) // COLUMNS)
    whole = Image.new("RGB", (COLUMNS * (width + gap) + gap, rows * (height + line + gap) + gap), "white")
    draw = ImageDraw.Draw(whole)
    font = ImageFont.truetype(font_manager.findfont("DejaVu Sans"), 12)
    for i, (title, file) in enumerate(tiles):
        x, y = gap + i % COLUMNS * (width + gap), gap + i // COLUMNS * (height + line + gap)
        whole.paste(Image.open(file), (x, y))
        # The font of the sheet has no Chinese.
        shown = "".join(c if ord(c) < 0x2E80 else "·" for c in title)
        draw.text((x + 1, y + height + 3), shown, "black", font)
    return whole


def commands() -> list[list[str]]:
    """The words behind `antumbra` of each picture's command on the page."""
    return [shlex.split(line) for line in re.findall(r"`antumbra (render [^`]+)`", PAGE.read_text("utf-8"))]


def pictures() -> int:
    """Runs them, in the root of the repository."""
    os.chdir(ROOT)
    return max(run(words) for words in commands())


def main() -> int:
    """Renders every tile and joins them."""
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--size", default="{}x{}".format(*TILE), help="of a tile")
    words.add_argument("--only", help="tiles whose title has this; no sheet is written")
    words.add_argument(
        "--page", action="store_true", help="instead, the pictures of the page by their commands"
    )
    given = words.parse_args()
    if given.page:
        return pictures()
    data = Path(os.environ.get("ANTUMBRA_DATA", ROOT.parent / "shared/data"))
    if not data.is_dir():
        print(f"error: there is no data folder at {data} (ANTUMBRA_DATA names it)", file=sys.stderr)
        return 2
    width, height = map(int, given.size.split("x"))
    TILES.mkdir(parents=True, exist_ok=True)
    tiles = []
    for asset in ASSETS:
        if given.only and given.only not in asset.title:
            continue
        began = time.perf_counter()
        _, image = render(asset, data, size=(width, height), viewing_rays=asset.view.get("viewing_rays", 48))
        file = TILES / (asset.title.replace(": ", "-").replace(", ", "-").replace(" ", "_") + ".png")
        image.save(file)
        tiles.append((asset.title, file))
        print(f"{file.relative_to(ROOT)}   {time.perf_counter() - began:.1f} s")
    if not given.only:
        sheet(tiles, (width, height)).save(SHEET, quality=90)
        print(f"{SHEET.relative_to(ROOT)}   {SHEET.stat().st_size / 1000:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
