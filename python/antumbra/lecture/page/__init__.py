"""The page: what the figures found, as HTML that needs no network. `html` makes it, `head` says what stands on top."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from antumbra import __version__
from antumbra.lecture.page import slide, small

_HERE = Path(__file__).parent
HEAD = {
    "title": "Direct illumination",
    "idea": "A point is as bright as the part of the light that it can see, weighted by angle and distance. We find "
    "out by trying segments to the light, and every figure says how far its answer can be trusted.",
    "phases": "One disk under one light, the receiver moved away step by step (figure 2).",
}
# A page of one file stays below this many bytes.
LARGEST = 25_000_000


def html(
    chapters: Sequence[Mapping[str, Any]], contents: Sequence[Mapping[str, Any]], data: Any, foot: str
) -> str:
    """The page whose pictures lie beside it.

    `chapters`: openings (number, title, short, paragraphs, equation, pictures, figures), `contents`: the whole lecture,
    `data`: what stands in the page as JSON.
    """
    return _render(chapters, contents, data, foot, single=False, src=lambda file: file)


def single(
    chapters: Sequence[Mapping[str, Any]],
    contents: Sequence[Mapping[str, Any]],
    data: Any,
    foot: str,
    folder: Path,
) -> str:
    """The same as one file: pictures of `folder` are inside, made smaller until it is below `LARGEST`."""
    from antumbra.lecture import pictures

    factor = 1.0
    while True:

        def inside(file: str, factor: float = factor) -> str:
            png = (folder / file).read_bytes()
            png = png if factor == 1.0 else pictures.smaller(png, factor)
            return "data:image/png;base64," + base64.b64encode(png).decode()

        page = _render(chapters, contents, data, foot, single=True, src=inside)
        if len(page.encode()) <= LARGEST or factor < 0.1:
            return page
        factor *= 0.8


def together(text: str) -> str:
    """No line ends between a number, its error and its unit, nor at a sign before a number."""
    return re.sub(r" (?=[±%=])|(?<=[±=×÷]) (?=[\d−])", "\N{NO-BREAK SPACE}", text)


def _render(
    chapters: Sequence[Mapping[str, Any]],
    contents: Sequence[Mapping[str, Any]],
    data: Any,
    foot: str,
    *,
    single: bool,
    src: Callable[[str], str],
) -> str:
    import jinja2
    from markupsafe import Markup

    from antumbra.lecture.page.math import mathml

    templates = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_HERE), autoescape=True, undefined=jinja2.StrictUndefined
    )
    templates.filters["together"] = together
    templates.globals |= {
        "part": lambda p, figure="": Markup(
            templates.get_template(f"stages/{p['kind']}.html").render(p=p, figure=figure)
        ),
        "src": src,
        "math": lambda latex, spoken: Markup(mathml(latex, spoken)),
        "columns": columns,
        "aspect": aspect,
        "printed": printed,
        "scales": scales,
        "slide": slide,
        "single": single,
    }
    # Nothing in the numbers can end the script element that holds them, or begin a comment in it.
    numbers = Markup(json.dumps(data, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c"))
    return templates.get_template("index.html").render(
        version=__version__,
        head=HEAD,
        chapters=chapters,
        contents=contents,
        phases=_phases(chapters),
        foot=foot,
        data=numbers,
        ramps=Markup(_ramps()),
        css=Markup(css()),
        js=Markup(js()),
    )


def css() -> str:
    """The style of the page, as it stands in it."""
    return small.style("".join(_source(f"{name}.css") for name in ("page", "figure", "slides", "media")))


def js() -> str:
    """The script of the page, as it stands in it."""
    return f"(()=>{{{small.script(''.join(_source(f'{name}.js') for name in ('state', 'stages', 'slides')))}}})()"


def _source(file: str) -> str:
    return (_HERE / file).read_text(encoding="utf-8")


def columns(cells: Sequence[Mapping[str, Any]]) -> str:
    """Widths of columns that make all cells equally high."""
    return " ".join(f"minmax(0,{1000 * cell['width'] / cell['height']:.0f}fr)" for cell in cells)


def aspect(cells: Sequence[Mapping[str, Any]], at_most: int = 99) -> str:
    """Width over height of equally high cells in a row, or of rows of `at_most` equally wide ones."""
    ratios = [cell["width"] / cell["height"] for cell in cells]
    if len(ratios) <= at_most:
        return f"{sum(ratios):.4g}"
    rows = -(-len(ratios) // at_most)
    return f"{at_most * min(ratios) / rows:.4g}"


def printed(frames: int, tells: int, at_most: int = 6) -> set[int]:
    """Which frames of a slider are printed: evenly spread, with the first, the last and the one that tells."""
    if frames <= at_most:
        return set(range(frames))
    chosen = {round(i * (frames - 1) / (at_most - 1)) for i in range(at_most)}
    if tells not in chosen:
        chosen.remove(min(chosen - {0, frames - 1}, key=lambda i: abs(i - tells)))
    return chosen | {tells}


def scales(strip: Mapping[str, Any]) -> list[tuple[str, Mapping[str, Any]]]:
    """The maps of a slider whose colour bars stand once below its printed frames: label of the column, and its bar.

    Frames of a column share their scale; of their bars, one that says that a map goes beyond it.
    """
    found = []
    for column, pictures in enumerate(zip(*(frame["pictures"] for frame in strip["frames"]), strict=True)):
        bars = [picture["bar"] for picture in pictures if picture["bar"]]
        if bars:
            beyond = max(bars, key=lambda bar: sum(len(words) for _, words in bar["ticks"]))
            found.append((_label(strip, column), beyond))
    return found


def _label(strip: Mapping[str, Any], column: int) -> str:
    """What stands over a column of pictures; a drawing has the first label."""
    labels = strip["labels"][1 if strip["frames"][0]["drawing"] else 0 :]
    return str(labels[column]) if column < len(labels) else ""


def _ramps() -> str:
    """The ramps of maps as colours of the page, for their bars."""
    from antumbra.lecture.pictures import RAMPS

    return ";".join(f"--{name}:linear-gradient(90deg,{','.join(stops)})" for name, stops in RAMPS.items())


def _phases(chapters: Sequence[Mapping[str, Any]]) -> list[Any]:
    """The row of real pictures on top: ten frames of the receiver that moves away, where they are there."""
    for chapter in chapters:
        for figure in chapter["figures"]:
            for part in figure["stage"] if figure["name"] == "regions" else ():
                if part["kind"] == "strip":
                    pictures = [frame["pictures"][-1] for frame in part["frames"]]
                    count = min(10, len(pictures))
                    return [
                        pictures[round(i * (len(pictures) - 1) / max(1, count - 1))] for i in range(count)
                    ]
    return []
