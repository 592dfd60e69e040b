"""`python tools/agreement [--quick] [SCENE …]`: renders what is not rendered yet, compares, writes docs/agreement."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from agreement import page, scenes  # noqa: E402
from agreement.compare import Noisy, compare  # noqa: E402

# Why a picture differs, where it does, for people; by "scene.variant".
NOTES: dict[str, str] = {
    "classroom.clay_direct": (
        "0.6 % brighter, by interpolated normals: with flat ones in both programs the means agree to −0.00 % ± "
        "0.11 %. Where such a normal turns away from the viewer or towards a light behind its face (inside-out "
        "and angular meshes), Mitsuba follows the normal, black or lit through the face; here the face decides "
        "([conventions](../conventions.md))."
    ),
    "classroom.ao": "nearly every ray is blocked within the radius: what is left is noise.",
    "coffee.path": (
        "a line at the rim of the pot is brighter (25 % ± 2 %): glass and lid lie 0.00002 units apart, and "
        "Mitsuba starts its rays 0.0001 units off a surface, beyond the next one. With the scene enlarged 10 000 "
        "times about the pot, so that its offset shrinks, its rim is ours to −2 % ± 2 %."
    ),
    "gen-many-lights.clay_direct": "the reference chooses among 400 lights evenly: the noise is its own.",
    "veach-ajar.clay_direct": "all but the lamp behind the door is without direct light.",
    "veach-ajar.direct": "all but the lamp behind the door is without direct light.",
    "veach-mis.direct": "the four pixels of the smallest sphere are left out: it covers a part of each.",
}


def data_folder() -> Path:
    """ANTUMBRA_DATA, or ../shared/data beside the repository."""
    return Path(os.environ.get("ANTUMBRA_DATA") or ROOT.parent / "shared" / "data")


def picture(data: Path, kept: Path, ref: scenes.Reference, rays: int) -> scenes.Ours:
    """Our picture: kept from an earlier run with as many rays, or rendered now."""
    file = kept / f"{ref.scene}.{ref.variant}.{rays}.npz"
    if file.exists():
        with np.load(file) as z:
            grey = Noisy(z["value"], z["error"])
            return scenes.Ours(z["pixels"], grey, float(z["seconds"]), str(z["hash"]))
    ours = scenes.render(scenes.opened(data, ref), ref, rays)
    kept.mkdir(parents=True, exist_ok=True)
    beside = file.with_suffix(".part.npz")
    np.savez(
        beside, pixels=ours.pixels, value=ours.grey.value, error=ours.grey.error,
        seconds=ours.seconds, hash=ours.hash,
    )  # fmt: skip
    beside.replace(file)
    return ours


def main() -> int:
    """Runs everything; 1 if a picture differs."""
    parser = argparse.ArgumentParser(prog="agreement", description=__doc__)
    parser.add_argument("scenes", nargs="*", help="only these (the page is not written)")
    parser.add_argument("--quick", action="store_true", help="few rays: a look, not a measurement; no page")
    parser.add_argument("--fresh", action="store_true", help="render everything again")
    options = parser.parse_args()
    data, kept = data_folder(), ROOT / "target" / "agreement"
    if options.fresh and kept.exists():
        for file in kept.glob("*.npz"):
            file.unlink()
    entries = []
    for scene, variant in scenes.listed(data):
        if options.scenes and scene not in options.scenes:
            continue
        rays = scenes.rays(variant, options.quick)
        ref = scenes.reference(data, scene, variant)
        ours = picture(data, kept, ref, rays)
        entries.append(page.Entry(ref, ours, rays, compare(ours.grey, ref.grey)))
        print(page.said(entries[-1]), flush=True)
    if not options.quick and not options.scenes:
        page.write(ROOT / "docs" / "agreement", entries, NOTES)
    return 0 if all(e.found.holds for e in entries) else 1


if __name__ == "__main__":
    sys.exit(main())
