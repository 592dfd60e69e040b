"""`antumbra diff`: how far a picture is from another one."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from antumbra import _core
from antumbra.cli import _say
from antumbra.cli._command import Option, Verb, output_option

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Picture = NDArray[np.float32]

ORDER = 3
# relMSE divides by the reference's square plus this, so that black pixels do not decide alone.
EPSILON = 0.01
# The colour bar under the map: its height, and how narrow a map may be for its words [pixels].
_BAR, _NARROWEST = 48, 160


def run(a: str, b: str, output: str | None, json: bool, quiet: bool, verbose: bool) -> int:
    """Compare picture A with the reference B: MSE, relMSE, FLIP, and a false-colour map of where they differ."""
    if output is not None and Path(output).suffix.lower() != ".png":
        raise click.UsageError(f'"{output}": the map is a .png')
    first, second, part = _same_part(a, b)
    if part and not quiet:
        _say.messages("", [("note", "", f"compared where both are: {part}")])
    shown = any(Path(name).suffix.lower() == ".png" for name in (a, b))
    found, error = measures(first, second, shown)
    if output is not None:
        _write_map(error, found["flip"], output)
    print(_as_json(found, a, b, output) if json else _as_text(found, a, b, first, output))
    return 0


VERB = Verb(
    "diff",
    run,
    arguments=[("A", True), ("B", True)],
    examples=[
        ("antumbra diff mine.exr reference.exr", "three numbers"),
        ("antumbra diff mine.exr reference.exr -o map.png", "and where they differ"),
        ("antumbra diff mine.png yours.png --json", "for programs"),
    ],
    options=[
        output_option("FILE", "the false-colour map with its colour bar, .png"),
        Option("--json", is_flag=True, group="Run", help="the numbers as JSON"),
    ],
)


def _same_part(a: str, b: str) -> tuple[Picture, Picture, str]:
    """The pixels that both files have, and which part that is if it is not all of both.

    A cropped EXR knows where it lies in the whole picture; files of the same size are compared as they are.
    """
    (first, one), (second, other) = _core.read_part(a), _core.read_part(b)
    if first.shape == second.shape and (one == other or one[2:] != other[2:]):
        return first, second, ""
    left, top = max(one[0], other[0]), max(one[1], other[1])
    right = min(one[0] + first.shape[1], other[0] + second.shape[1])
    bottom = min(one[1] + first.shape[0], other[1] + second.shape[0])
    if one[2:] != other[2:] or left >= right or top >= bottom:
        said = f"{a} is {_extent(first, one)}, {b} is {_extent(second, other)}"
        raise click.UsageError(f"{said}: the same size is needed, or parts of one picture that overlap")

    def cut(picture: Picture, at: list[int]) -> Picture:
        return picture[top - at[1] : bottom - at[1], left - at[0] : right - at[0]]

    return cut(first, one), cut(second, other), f"{right - left} × {bottom - top} pixels from {left}, {top}"


def _extent(picture: Picture, at: list[int]) -> str:
    size = f"{picture.shape[1]} × {picture.shape[0]}"
    whole = at == [0, 0, picture.shape[1], picture.shape[0]]
    return size if whole else f"{size} at {at[0]}, {at[1]} of {at[2]} × {at[3]}"


def measures(picture: Picture, reference: Picture, shown: bool) -> tuple[dict[str, float], Picture]:
    """MSE and relMSE of linear values, mean FLIP, and the map of FLIP, (H, W) in [0, 1].

    `shown`: compare as a screen shows them (values above 1 cut off), because one came from a PNG. FLIP: Andersson et
    al. 2020, of a screen picture, and 2021, of a high dynamic range one.
    """
    import flip_evaluator
    import numpy as np

    if shown:
        picture, reference = np.clip(picture, 0, 1), np.clip(reference, 0, 1)
    a, b = picture.astype(np.float64), reference.astype(np.float64)
    squares = (a - b) ** 2
    flip_map, mean, _ = flip_evaluator.evaluate(
        np.ascontiguousarray(np.maximum(reference, 0)),
        np.ascontiguousarray(np.maximum(picture, 0)),
        "LDR" if shown else "HDR",
        inputsRGB=False,
        applyMagma=False,
    )
    found = {
        "mse": float(squares.mean()),
        "relmse": float((squares / (b**2 + EPSILON)).mean()),
        "flip": float(mean),
    }
    return found, np.asarray(flip_map, np.float32)[..., 0]


def _write_map(error: Picture, mean: float, path: str) -> None:
    """FLIP in the colours of magma, with its colour bar below."""
    import numpy as np
    from matplotlib import colormaps

    magma = colormaps["magma"]
    height, width = error.shape
    whole = np.ones((height + _BAR, max(width, _NARROWEST), 3))
    whole[:height, :width] = magma(error)[..., :3]
    whole[height:] = _bar(whole.shape[1], mean)
    # The writer takes linear light: sRGB's curve undone (IEC 61966-2-1), so that the map's own codes come out.
    linear = np.where(whole <= 0.04045, whole / 12.92, ((whole + 0.055) / 1.055) ** 2.4)
    _core.write_picture(path, np.ascontiguousarray(linear, np.float32))


def _bar(width: int, mean: float) -> NDArray[np.float64]:
    """A strip of `width` pixels: magma from 0 to 1, ticks with their numbers, the mean marked. sRGB codes in [0, 1]."""
    import numpy as np
    from matplotlib import colormaps
    from PIL import Image, ImageDraw, ImageFont

    left, right = 8, width - 9
    strip = Image.new("RGB", (width, _BAR), "white")
    colours = colormaps["magma"](np.linspace(0, 1, right - left + 1))[None, :, :3]
    colours = (255 * np.repeat(colours, 10, axis=0) + 0.5).astype(np.uint8)
    strip.paste(Image.fromarray(colours), (left, 8))
    draw, font = ImageDraw.Draw(strip), ImageFont.load_default(10)
    for tick in (0.0, 0.25, 0.5, 0.75, 1.0):
        x = left + round(tick * (right - left))
        draw.line((x, 18, x, 21), "black")
        draw.text((x, 22), f"{tick:g}", "black", font, anchor="mt")
    x = left + round(min(max(mean, 0.0), 1.0) * (right - left))
    draw.polygon([(x - 4, 1), (x + 4, 1), (x, 7)], "black")
    draw.text((left, 34), f"FLIP   mean {_say.significant(mean)} (marked)", "black", font, anchor="lt")
    return np.asarray(strip, np.float64) / 255


def _size(picture: Picture) -> str:
    return f"{picture.shape[1]} × {picture.shape[0]}"


def _as_text(found: dict[str, float], a: str, b: str, picture: Picture, output: str | None) -> str:
    lines = [
        f"{a} against {b}, {_size(picture)}",
        f"MSE      {_say.significant(found['mse'])}",
        f"relMSE   {_say.significant(found['relmse'])}",
        f"FLIP     {_say.significant(found['flip'])}   (mean; 0: no difference seen, 1: black against white)",
    ]
    return "\n".join(lines + ([f"map      {output}   (FLIP: 0 black, 1 pale yellow)"] if output else []))


def _as_json(found: dict[str, float], a: str, b: str, output: str | None) -> str:
    whole: dict[str, Any] = {"picture": a, "reference": b, **found, "map": output}
    return json.dumps(whole, indent=1)
