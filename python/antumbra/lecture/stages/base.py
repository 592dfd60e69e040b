"""What stages are made of: `Part`, `Picture` with its colour `Bar`, `Drawing`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, ClassVar


@dataclass(frozen=True)
class Part:
    """One part of a stage. `kind` is its template; `data`: on a slide it comes with the numbers."""

    kind: ClassVar[str] = ""
    data: ClassVar[bool] = False


@dataclass(frozen=True)
class Bar(Part):
    """What the colours of a map mean: ramps of `pictures.RAMPS` and their values.

    `ticks`: places along them, 0 to 1, with what stands there; `unit`: of the values, or what they count; `names`: what
    has which ramp, where there are two.
    """

    kind = "bar"
    ramps: Sequence[str]
    ticks: Sequence[tuple[float, str]]
    unit: str = ""
    names: Sequence[str] = ()


@dataclass(frozen=True)
class Picture(Part):
    """A picture file of the page, its size in pixels, its result as a sentence (`alt`), what stands under it.

    `noise`: pixels stay squares when it is enlarged; `bar`: of a map of numbers, what its colours mean; `ring`: about
    a place that is spoken of, in parts of its width and height.
    """

    kind = "picture"
    file: str
    width: int
    height: int
    alt: str
    caption: str = ""
    noise: bool = False
    bar: Bar | None = None
    ring: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        """A picture says its result in words, for those who do not see it."""
        if not self.alt.strip():
            raise ValueError(f"{self.file}: a picture needs its alt text")


@dataclass(frozen=True)
class Drawing(Part):
    """An inline SVG: `svg` is what stands inside of a viewBox of `width` × `height`, `alt` the same in a sentence."""

    kind = "drawing"
    svg: str
    width: float
    height: float
    alt: str


def plain(part: Any) -> Any:
    """Parts as dicts and lists for JSON, each with its kind."""
    if isinstance(part, Part):
        own = {field.name: plain(getattr(part, field.name)) for field in fields(part)}
        return {"kind": part.kind, "data": part.data, **own}
    if isinstance(part, Mapping):
        return {key: plain(value) for key, value in part.items()}
    if isinstance(part, Sequence) and not isinstance(part, str):
        return [plain(value) for value in part]
    return part
