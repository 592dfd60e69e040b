"""Pictures for the page: small PNG files of few tones, made of linear radiance, maps of numbers, or maps of classes."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Ramps from low to high: colours that are joined by straight lines. Lightness climbs evenly in all but "signed".
RAMPS = {
    # A scene of one colour under warm light.
    "warm": ("#0b0d14", "#2b2a2d", "#5a5652", "#8e887e", "#c4bdad", "#fbf6e8"),
    # Shares, counts, errors: one hue, dark to light.
    "blue": ("#0d1526", "#22406b", "#4e70aa", "#8ea9d1", "#ccd9ec", "#ffffff"),
    "amber": ("#1c1206", "#5a3a0c", "#9c6714", "#de9e34", "#f3ce86", "#fff8e6"),
    # Differences: zero is white.
    "signed": ("#1b4f8f", "#7fa6d6", "#ffffff", "#ef9f6b", "#bf3a12"),
}
# Umbra, penumbra, antumbra, lit: the colours of the page.
REGIONS = ("#141a2e", "#4e70aa", "#de9e34", "#fdf1c4")


def exposed(pixels: ArrayLike, white: float) -> NDArray[np.float64]:
    """Linear radiance, `white` mapped to 1, as display values in [0, 1] (the curve of sRGB). NaN is 0."""
    x = np.clip(np.nan_to_num(np.asarray(pixels, np.float64)) / white, 0.0, 1.0)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.power(x, 1 / 2.4) - 0.055)


def linear(shown: ArrayLike) -> NDArray[np.float64]:
    """Display values in [0, 1] as linear ones: `exposed` backwards."""
    x = np.asarray(shown, np.float64)
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


def luminance(pixels: ArrayLike) -> NDArray[np.float64]:
    """Luminance (H, W) of linear Rec. 709 (H, W, 3); an (H, W) array is left as it is."""
    x = np.asarray(pixels, np.float64)
    return x if x.ndim == 2 else x @ np.array([0.2126, 0.7152, 0.0722])


def tones_png(pixels: ArrayLike, white: float, tones: int = 128) -> bytes:
    """A scene of one colour: its luminance in `tones` steps of the warm ramp."""
    return ramp_png(exposed(luminance(pixels), white), "warm", tones=tones)


def colour_png(pixels: ArrayLike, white: float, tones: int = 128) -> bytes:
    """A scene of many colours, in a palette of `tones` of its own."""
    from PIL import Image

    shown = np.round(255 * exposed(pixels, white)).astype(np.uint8)
    picture = Image.fromarray(shown, "RGB").quantize(
        tones, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE
    )
    return _png(picture)


def ramp_png(values: ArrayLike, ramp: str, low: float = 0.0, high: float = 1.0, tones: int = 128) -> bytes:
    """A map of numbers (H, W): `low` to `high` along a ramp of `RAMPS`; NaN is low."""
    share = np.nan_to_num((np.asarray(values, np.float64) - low) / (high - low))
    steps = np.round(np.clip(share, 0.0, 1.0) * (tones - 1)).astype(np.uint8)
    return classes_png(steps, ramp_colours(RAMPS[ramp], tones))


def two_ramps_png(
    values: ArrayLike, second: ArrayLike, ramps: tuple[str, str], high: float, tones: int = 64
) -> bytes:
    """A map of numbers (H, W) from 0 to `high`, along another ramp where `second` is true; NaN is black."""
    of, known = np.asarray(values, np.float64), ~np.isnan(np.asarray(values, np.float64))
    share = np.clip(np.nan_to_num(of) / high, 0.0, 1.0)
    steps = 1 + np.round(share * (tones - 1)).astype(np.uint8) + tones * np.asarray(second, bool)
    colours = [colour for ramp in ramps for colour in ramp_colours(RAMPS[ramp], tones)]
    return classes_png(steps * known, ("#000000", *colours))


def classes_png(classes: ArrayLike, colours: tuple[str, ...] = REGIONS) -> bytes:
    """A map of whole numbers (H, W), each in its colour `#rrggbb`."""
    from PIL import Image

    picture = Image.fromarray(np.ascontiguousarray(classes, np.uint8), "P")
    picture.putpalette([int(c[i : i + 2], 16) for c in colours for i in (1, 3, 5)])
    return _png(picture, next(bits for bits in (1, 2, 4, 8) if len(colours) <= 1 << bits))


def smaller(png: bytes, factor: float) -> bytes:
    """The same picture with its sides `factor` times as long."""
    from PIL import Image

    picture = Image.open(io.BytesIO(png))
    size = (max(1, round(picture.width * factor)), max(1, round(picture.height * factor)))
    if picture.mode != "P":
        return _png(picture.resize(size, Image.Resampling.BOX))
    colours = len(picture.getcolors() or ()) or 128
    shrunk = picture.convert("RGB").resize(size, Image.Resampling.BOX)
    return _png(shrunk.quantize(min(colours, 64), dither=Image.Dither.NONE))


def ramp_colours(stops: tuple[str, ...], tones: int) -> tuple[str, ...]:
    """`tones` colours along a ramp."""
    at = np.linspace(0, len(stops) - 1, tones)
    channels = [
        np.interp(at, range(len(stops)), [int(stop[i : i + 2], 16) for stop in stops]) for i in (1, 3, 5)
    ]
    return tuple(f"#{r:02x}{g:02x}{b:02x}" for r, g, b in np.round(channels).astype(int).T)


def _png(picture: Any, bits: int = 8) -> bytes:
    out = io.BytesIO()
    picture.save(out, "PNG", optimize=True, **({"bits": bits} if picture.mode == "P" else {}))
    return out.getvalue()
