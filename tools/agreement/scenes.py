"""The scenes and their references, and how our options name each variant."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import antumbra as am
from agreement.compare import Noisy, counted

# Variant → our options; viewing rays per pixel of the full and of the quick page.
VARIANTS: dict[str, tuple[dict[str, Any], int, int]] = {
    "ao": ({"estimator": "ambient-occlusion"}, 128, 8),
    "clay_direct": ({"estimator": "mis", "clay": 0.8}, 256, 8),
    "direct": ({"estimator": "mis"}, 256, 8),
    "clay_path": ({"estimator": "path", "bounces": 5, "clay": 0.8}, 192, 8),
    "path": ({"estimator": "path", "bounces": 5}, 256, 8),
}
# Others see the same: the seed is one of many.
SEED = 1


class Reference(NamedTuple):
    """A reference: what it shows and how noisy it is."""

    scene: str
    variant: str
    about: dict[str, Any]
    pixels: NDArray[np.float32]
    grey: Noisy


class Ours(NamedTuple):
    """Our picture of the same."""

    pixels: NDArray[np.float32]
    grey: Noisy
    seconds: float
    hash: str


def rays(variant: str, quick: bool) -> int:
    """Viewing rays per pixel of a variant."""
    _, full, few = VARIANTS[variant]
    return few if quick else full


def listed(data: Path) -> list[tuple[str, str]]:
    """(scene, variant) of every reference that a variant of ours belongs to."""
    names = json.loads((data / "references" / "manifest.json").read_text())
    pairs = [(about["scene"], about["variant"]) for about in names.values()]
    return sorted((p for p in pairs if p[1] in VARIANTS), key=lambda p: (p[0], list(VARIANTS).index(p[1])))


def reference(data: Path, scene: str, variant: str) -> Reference:
    """Reads one."""
    folder, name = data / "references", f"{scene}.{variant}"
    about = json.loads((folder / "manifest.json").read_text())[name]
    pixels = am.load_image(folder / f"{name}.exr")
    error = am.load_image(folder / f"{name}.err.exr").astype(np.float64)
    error = error if error.ndim == 2 else error[..., 0]
    value = pixels.astype(np.float64).mean(-1)
    grey = counted(value, error, about["spp_total"]) if variant == "ao" else Noisy(value, error)
    return Reference(scene, variant, about, pixels, grey)


def opened(data: Path, ref: Reference) -> am.Scene:
    """The scene at the size of its reference."""
    size = {"resx": ref.about["width"], "resy": ref.about["height"]}
    return am.load(data / "scenes" / "xml" / ref.scene / "scene.xml", parameters=size)


def render(scene: am.Scene, ref: Reference, rays: int, **more: Any) -> Ours:
    """Our picture with the settings of the reference."""
    options = dict(VARIANTS[ref.variant][0])
    if ref.variant == "ao":
        options["radius"] = ref.about["radius"]
    options |= {"viewing_rays": rays, "filter": "box", "masks": "opaque", "seed": SEED, **more}
    began = time.perf_counter()
    image = scene.render(**options)
    seconds = time.perf_counter() - began
    value = image.pixels.astype(np.float64).mean(-1)
    # Of the mean of three channels: at most the mean of their errors (they are drawn together).
    error = np.asarray(image.standard_error, dtype=np.float64).mean(-1)
    grey = counted(value, error, rays) if ref.variant == "ao" else Noisy(value, error)
    return Ours(image.pixels, grey, seconds, image.hash)
