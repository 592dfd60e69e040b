"""The open sky over receivers, and albedo × L × AO beside the picture: two panels about ambient occlusion."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra._words import written
from antumbra.lecture.fisheye import MISSED, Fisheye
from antumbra.lecture.measures.noise import reflected
from antumbra.lecture.measures.open_sky import CELLS, Directions, Seen, all_seen, product
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Panel, Row, Strip
from antumbra.lecture.variant import Pick

SIDE = Pick(160, 320)
_SKY, _DOT = "#ccd9ec", "#bf3a12"


def sky_panel(run: Run) -> Panel:
    """A slider of the receiver's depth in the box."""
    frames = []
    for z, seen in all_seen(run).items():
        shares = [f"{100 * each.share:.0f} %" for each in (seen.random, seen.cells)]
        says = f"z = {z}: {shares[0]} and {shares[1]} of the directions, {100 * seen.open:.1f} % of the disk"
        pictures = []
        for name, each, share in zip(("random", "spread"), (seen.random, seen.cells), shares, strict=True):
            shown = _drawn(run.pick(SIDE), seen, each)
            alt = f"The sky from z = {z}: {share} of {CELLS**2} {name} directions find it."
            pictures.append(run.picture(shown, alt, name=f"sky-{z}-{name}", white=1.0, colour=True, tones=32))
        frames.append(Frame(str(z), says, pictures, short=f"z = {z}"))
    note = (
        "The hemisphere over a point of the floor, from straight above: equal areas count alike, so the bright part "
        f"of the disk is AO. Of {CELLS**2} directions, dots find the sky, crosses do not."
    )
    label, columns = (
        "Receiver: depth z in the box, 559 deep",
        (f"{CELLS**2} random", f"one in each of {CELLS**2} cells"),
    )
    return Panel("sky", "open sky", [Strip("z", label, frames, columns, note)])


def _drawn(side: int, seen: Seen, of: Directions) -> NDArray[np.float64]:
    """The hemisphere with dots for directions to the sky and crosses for those that something blocks."""
    fisheye = Fisheye(side, cosine=True)
    fisheye.fill(seen.sky, _SKY)
    fisheye.dots(of.along[of.free], [0.012] * int(of.free.sum()), _DOT)
    fisheye.crosses(of.along[~of.free], MISSED)
    return fisheye.radiance()


def identity_panel(run: Run, found: Mapping[str, Quantity]) -> Panel:
    """The product, the picture by other directions, and what is left between them."""
    mine, picture = product(run), reflected(run, "identity-other").mean(0)
    white, off = float(np.percentile(picture, 99)), (picture - mine).mean(2) / float(picture.mean())
    looks: dict[str, Any] = {"white": white, "colour": True, "noise": True}
    pictures = [
        run.picture(mine, "Albedo times AO: the coloured box.", "albedo × L × AO", name="product", **looks),
        run.picture(picture, "The box under the sky: the same.", "under the sky", name="under-sky", **looks),
        run.map(
            off, f"Their difference: noise, {found['off']} in the mean.", f"difference: {found['off']:1} in the mean",
            name="identity-off", ramp="signed", low=-0.1, high=0.1, unit="%", noise=True,
        ),
    ]  # fmt: skip
    note = (
        "L = 1; the sky's own pixels are left out. The picture has even directions and random numbers of its own, so "
        f"this is noise: by the same rays as AO the difference is {written(found['identical'].value, 1)} at most."
    )
    return Panel("identity", "identity", [Row(pictures, note)])
