"""What a start of the shadow rays gets wrong, against the closed form of the leaning board."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.leaning_board import FLOOR, Truth, leaning_board, truth

Cameras = Mapping[str, Mapping[str, Any]]


def starts_measured(
    run: Run, files: Mapping[str, float], starts: Sequence[str], cameras: Mapping[str, Cameras]
) -> dict[str, Quantity]:
    """Of each file (name: scale) and start: `false_`, shares of lit pixels in false shadow; `wrong_`, of wrong pixels;
    `foot_`, the shadow that is lost at the foot of the board [mm]; and `viewing`, of wrong viewing rays.

    `cameras`: of each file its views "all" and "foot", a column of four pixels across the foot of the board.
    """
    found, viewing = {}, []
    for file, scale in files.items():
        (true, wrong), (near, _) = (_truth(run, scale, cameras[file][view]) for view in ("all", "foot"))
        viewing.append(wrong)
        step = abs(np.gradient(near.place[:, 0].reshape(-1, 4)[:, 0])).repeat(4) / 4
        for start in starts:
            lit, lost = (run.light(f"{start}-{file}-{view}").ravel() > 0 for view in ("all", "foot"))
            of = f"{file}_{start}"
            found[f"false_{of}"] = _share(~lit[true.facing & true.free], "of the pixels that see the light")
            found[f"wrong_{of}"] = _share(
                (lit != true.free)[true.facing], "of the pixels that face the light"
            )
            lost &= (near.object == FLOOR) & ~near.free
            edge = float(step[lost].max()) if lost.any() else 0.0
            found[f"foot_{of}"] = Quantity(
                1e3 * float(step[lost].sum()), 2e3 * edge, "mm", "spread: half a pixel at each end"
            )
    views = np.concatenate(viewing)
    return {**found, "viewing": _share(views, f"of {len(views):,} viewing rays")}


def worst_file(found: Mapping[str, Quantity], start: str) -> Quantity:
    """Share of wrong pixels of a start in the file where it is largest."""
    each = [of for name, of in found.items() if name.startswith("wrong_") and name.endswith(f"_{start}")]
    return max(each, key=lambda quantity: quantity.value)


def _truth(run: Run, scale: float, camera: Mapping[str, Any]) -> tuple[Truth, NDArray[np.bool_]]:
    """The closed form of a view, and which viewing rays meet something else than it says."""
    chosen = {name: run.pick(value) for name, value in camera.items()}
    scene = run.scene(leaning_board(scale))
    origins, directions = scene.camera_rays(**chosen)
    true, met = truth(origins, directions, scale), scene.closest_hit(origins, directions)
    near = np.isclose(met.t / scale, true.distance, rtol=0, atol=1e-4)
    return true, ~(near & ((met.mesh == true.object) | (true.object < 0)))


def _share(wrong: NDArray[np.bool_], note: str) -> Quantity:
    """A share of pixels, its error from 8 parts of the picture that lie like a comb."""
    return mean_of([np.mean(wrong[part::8]) for part in range(8)], unit="%", note=note)
