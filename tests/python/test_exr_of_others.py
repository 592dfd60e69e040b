"""EXR pictures that OpenEXR itself wrote: every compression, tiles, levels, parts, luminance and chroma."""

from __future__ import annotations

import Imath
import numpy as np
import OpenEXR
import pytest

import antumbra as am
from antumbra import _core

ROWS, COLUMNS = np.mgrid[0:32, 0:64].astype(np.float32)
PICTURE = np.stack([COLUMNS / 64, ROWS / 32, (COLUMNS + ROWS) / 96], -1) + 0.01
EXACT = ("NO", "RLE", "ZIPS", "ZIP", "PIZ")
# What a compression may lose of a smooth ramp up to 1: PXR24 rounds to 24 bits; blocks of B44 keep 6 bits of
# differences; DWA at its usual level 45 keeps cosine terms to about 45/100000 of a half.
LOSES = {"PXR24": 1e-4, "B44": 0.02, "B44A": 0.02, "DWAA": 0.01, "DWAB": 0.01}


def read(path):
    """The pixels of a picture, as `diff` reads them."""
    return np.asarray(_core.read_picture(str(path)))


@pytest.mark.parametrize("name", [*EXACT, *LOSES])
@pytest.mark.parametrize("kind", [np.float16, np.float32])
def test_every_compression(tmp_path, name, kind):
    file = tmp_path / "p.exr"
    header = {"compression": getattr(OpenEXR, f"{name}_COMPRESSION"), "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {"RGB": PICTURE.astype(kind)}).write(str(file))
    there = OpenEXR.File(str(file)).channels()["RGB"].pixels.astype(np.float32)
    found = read(file)
    # Two decoders of the same bytes: of cosine terms they round differently.
    assert abs(found - there).max() <= (1e-3 if name.startswith("DWA") else 0.0)
    assert abs(found - PICTURE.astype(kind)).max() <= LOSES.get(name, 0.0)


@pytest.mark.parametrize("levels", ["ONE_LEVEL", "MIPMAP_LEVELS", "RIPMAP_LEVELS"])
def test_tiles_and_levels(tmp_path, levels):
    tiles = OpenEXR.TileDescription()
    tiles.xSize = tiles.ySize = 16
    tiles.mode = getattr(OpenEXR, levels)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.tiledimage, "tiles": tiles}
    OpenEXR.File(header, {"RGB": PICTURE}).write(str(tmp_path / "p.exr"))
    assert np.array_equal(read(tmp_path / "p.exr"), PICTURE)


def test_of_several_parts_the_picture_is_taken(tmp_path):
    def part(name, channels):
        return OpenEXR.Part({"type": OpenEXR.scanlineimage}, channels, name=name)

    depth = part("depth", {"Z": ROWS})
    for names, chosen in ((["albedo", "beauty"], 1), (["left", "right"], 0)):
        scaled = [part(name, {"RGB": PICTURE / (i + 1)}) for i, name in enumerate(names)]
        OpenEXR.File([depth, *scaled]).write(str(tmp_path / "p.exr"))
        assert np.array_equal(read(tmp_path / "p.exr"), PICTURE / np.float32(chosen + 1))
        said = [m.text for m in am.load(tmp_path / "p.exr").messages]
        assert f'it has several layers: "{names[chosen]}" is shown' in said
    OpenEXR.File([depth]).write(str(tmp_path / "p.exr"))
    with pytest.raises(am.SceneError, match="neither R, G, B nor Y"):
        am.load(tmp_path / "p.exr")


def test_luminance_and_chroma(tmp_path):
    luminance = PICTURE @ np.array([0.2126, 0.7152, 0.0722], np.float32)
    red, blue = ((PICTURE[..., i] - luminance) / luminance for i in (0, 2))
    channels = {"Y": luminance, "RY": red, "BY": blue}
    header = {"type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {n: np.ascontiguousarray(c) for n, c in channels.items()}).write(
        str(tmp_path / "p.exr")
    )
    # Single precision, through a difference that is divided by 0.7152.
    np.testing.assert_allclose(read(tmp_path / "p.exr"), PICTURE, rtol=0, atol=2e-6)


def test_what_is_not_read_is_told_with_a_way_out(tmp_path):
    header = OpenEXR.Header(64, 32)
    float32 = Imath.PixelType(Imath.PixelType.FLOAT)
    header["channels"] = {"Y": Imath.Channel(float32), "RY": Imath.Channel(float32, 2, 2)}
    file = OpenEXR.OutputFile(str(tmp_path / "p.exr"), header)
    file.writePixels({"Y": ROWS.tobytes(), "RY": np.ascontiguousarray(ROWS[::2, ::2]).tobytes()})
    file.close()
    with pytest.raises(am.SceneError, match="luminance and chroma") as told:
        am.load(tmp_path / "p.exr")
    assert "magick" in told.value.hint
