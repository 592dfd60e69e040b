"""The page: a table of numbers, then every picture beside its reference and their difference."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agreement.compare import Agreement
from agreement.scenes import Ours, Reference

HEAD = """# The same picture as theirs

Mitsuba 3.9.1 rendered each scene below at the size shown, with many samples and a standard error for every pixel; we
read the same `scene.xml` and render it with the settings of the same name. The page is made by `make agreement`.

- `ao`: ambient occlusion within a tenth of the scene's diagonal; only geometry and camera matter.
- `clay_direct`: direct light, every surface two-sided diffuse 0.8; geometry, camera and lights matter.
- `direct`: direct light with the scene's materials.
- `clay_path`, `path`: with indirect light, up to six segments.

What is compared is the mean of the three channels. A pixel is left out as a firefly where its standard error, in either
picture, is above 20 times the mean of those of that picture that are not 0. *Mean* is ours over theirs with its
standard error; *tile* is the median over tiles of 8 × 8 pixels of the relative difference, *noise* what the noise of
both pictures alone makes of it, *beyond* what is left of the first without the second; *far* are tiles more than five
standard errors apart (differences below a thousandth of the picture's mean do not count). An entry holds if the mean
lies within 1 % and the median tile within 2 %, beyond the noise of both.

In the pictures: ours, theirs, and (ours − theirs) / theirs from −20 % (blue) to 20 % (red) of each pixel, so that noise
is grain and a real difference a patch of one colour.

"""


class Entry(NamedTuple):
    """One picture of the page."""

    ref: Reference
    ours: Ours
    rays: int
    found: Agreement


def write(folder: Path, entries: Iterable[Entry], notes: dict[str, str]) -> None:
    """Writes `README.md` and its pictures."""
    folder.mkdir(parents=True, exist_ok=True)
    all_of = list(entries)
    for entry in all_of:
        _panel(entry, folder / f"{_name(entry)}.jpg")
    text = HEAD + _table(all_of, notes)
    for scene in dict.fromkeys(e.ref.scene for e in all_of):
        text += f"\n## {scene}\n\n"
        for entry in (e for e in all_of if e.ref.scene == scene):
            name, note = _name(entry), notes.get(_name(entry), "")
            text += f"`{entry.ref.variant}`{': ' + note if note else ''}\n\n"
            text += f"![{name}: ours, theirs, their difference]({name}.jpg)\n\n"
    (folder / "README.md").write_text(text.rstrip("\n") + "\n")


def _name(entry: Entry) -> str:
    return f"{entry.ref.scene}.{entry.ref.variant}"


def _table(entries: list[Entry], notes: dict[str, str]) -> str:
    lines = [
        "| scene | variant | rays (ours, theirs) | mean | tile | noise | beyond | far | left out | holds |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for entry in entries:
        f = entry.found
        mark = "yes" if f.holds else "no"
        lines.append(
            f"| {entry.ref.scene} | {entry.ref.variant} | {entry.rays}, {entry.ref.about['spp_total']} "
            f"| {f.mean:+.2%} ± {f.mean_error:.2%} | {f.tile:.2%} | {f.tile_noise:.2%} | {f.tile_beyond:.2%} "
            f"| {f.far:.1%} | {f.left_out:.2%} | {mark} |"
        )
    return "\n".join(lines) + "\n"


def _panel(entry: Entry, path: Path) -> None:
    from PIL import Image

    a, b = (p.astype(np.float64) for p in (entry.ours.pixels, entry.ref.pixels))
    grey = b.mean(-1)
    lit = grey[grey > 0]
    # The brighter half of what is lit comes near white; shares stay as they are.
    scale = (
        1.0
        if entry.ref.variant == "ao"
        else 0.5 / max(float(np.percentile(lit, 75)) if lit.size else 1.0, 1e-9)
    )
    relative = (a.mean(-1) - grey) / np.maximum(grey, 0.02 * grey.mean())
    gap = np.ones((a.shape[0], 4, 3))
    row = np.concatenate([_screen(a * scale), gap, _screen(b * scale), gap, _map(relative / 0.2)], axis=1)
    picture: Any = Image.fromarray((row * 255.0 + 0.5).astype(np.uint8))
    picture = picture.resize((picture.width * 2, picture.height * 2), Image.Resampling.NEAREST)
    picture.save(path, quality=80, optimize=True)


def _screen(linear: NDArray[np.float64]) -> NDArray[np.float64]:
    """sRGB."""
    x = np.clip(linear, 0.0, 1.0)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def _map(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """From blue over white to red."""
    x = np.clip(x, -1.0, 1.0)
    return np.stack([1.0 - np.maximum(-x, 0.0), 1.0 - np.abs(x), 1.0 - np.maximum(x, 0.0)], axis=-1)


def said(entry: Entry) -> str:
    """One line for the terminal."""
    f = entry.found
    return (
        f"{_name(entry):<28} mean {f.mean:+.2%} ± {f.mean_error:.2%}  tile {f.tile:.2%} (noise {f.tile_noise:.2%})"
        f"  far {f.far:.1%}  {'holds' if f.holds else 'DIFFERS'}  {entry.ours.seconds:.1f} s"
    )
