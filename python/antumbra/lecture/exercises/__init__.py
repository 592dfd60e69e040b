"""Exercises: small files with a gap each, written into a folder with the picture that the right answer gives."""

from __future__ import annotations

from pathlib import Path

import antumbra as am
from antumbra._files import write_whole
from antumbra.image import save_pixels
from antumbra.own import Estimator

_FILES = Path(__file__).parent
_SIZE = (320, 240)


def names() -> list[str]:
    """The exercises in their order, each a file of this folder."""
    return sorted(path.name for path in _FILES.glob("[0-9]_*.py"))


def write(folder: Path) -> list[str]:
    """Copies the exercises into a folder and gives their names; those that are there are kept with what stands in them.

    Raises OSError where the folder cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    missing = [name for name in names() if not (folder / name).exists()]
    for name in missing:
        write_whole(folder / name, (_FILES / name).read_text(encoding="utf-8"))
    return missing


def show(file: str, scene: str, estimator: Estimator, *, right: str = "mis", viewing_rays: int = 16) -> None:
    """Renders an exercise and its right answer side by side, as `FILE.png`, and tells how far they are apart."""
    import numpy as np

    made = am.builtin(scene)
    # Each with a noise of its own: where both are right they differ by that alone.
    mine = made.render(estimator=estimator, viewing_rays=viewing_rays, size=_SIZE, seed=1)
    theirs = made.render(estimator=right, viewing_rays=viewing_rays, size=_SIZE, seed=2)
    path = Path(file).with_suffix(".png")
    both = np.concatenate([mine.pixels, theirs.pixels], axis=1)
    save_pixels(path, both)
    share = float(mine.pixels.mean() / theirs.pixels.mean())
    print(f"{path.name}   yours on the left, mean {share:.3f} of the right one")
