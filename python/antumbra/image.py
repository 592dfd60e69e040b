"""A rendered picture with its error and everything that was summed beside it: `Image`."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from os import PathLike, fspath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra import _core
from antumbra._words import seconds, significant
from antumbra.messages import Message


class Image:
    """A picture in linear radiance [W·m⁻²·sr⁻¹] with its standard error, as `Scene.render` returns it.

    It pickles, shows itself in a notebook, and stands for `pixels` where NumPy wants an array.
    """

    def __init__(
        self,
        picture: _core.Picture,
        *,
        name: str = "",
        seconds: float = 0.0,
        messages: Iterable[Message] = (),
    ) -> None:
        """Wraps what the core returned, with what else there is to say."""
        self._picture, self.name, self.seconds = picture, name, seconds
        self._messages = tuple(messages)

    @property
    def width(self) -> int:
        """Pixels from left to right."""
        return self._picture.width

    @property
    def height(self) -> int:
        """Pixels from top to bottom."""
        return self._picture.height

    @cached_property
    def pixels(self) -> NDArray[np.float32]:
        """Radiance, (H, W, 3) float32, row 0 at the top."""
        return self._picture.pixels()

    @cached_property
    def standard_error(self) -> NDArray[np.float32] | None:
        """Standard error of each value of `pixels`, (H, W, 3) float32; None below two independent replicates.

        There are 4 replicates below 256 viewing rays and 16 from there: an interval is `pixels` ± t · standard error,
        with Student's t of 3 or 15 degrees of freedom. One viewing ray, a fixed grid (`sampler="regular"` without
        `rotate=True`) and a render that was stopped early have one replicate, and no known error.
        """
        return self._picture.standard_error()

    @cached_property
    def aov(self) -> dict[str, NDArray[np.float32]]:
        """What `aov=` asked for, by name: (H, W, 3) or (H, W) float32."""
        return dict(self._picture.aovs())

    @property
    def metadata(self) -> dict[str, str]:
        """Settings, seed, version, scene hash: what the EXR file will say."""
        return dict(self._picture.metadata)

    @property
    def messages(self) -> list[Message]:
        """Notes and warnings of this render; the scene has its own."""
        return [*self._messages, *(Message(*said) for said in self._picture.messages)]

    @property
    def passes_done(self) -> int:
        """Passes that are in the picture: fewer than `passes` if it was stopped."""
        return self._picture.passes_done

    @property
    def passes(self) -> int:
        """Passes that were asked for."""
        return self._picture.passes

    @property
    def shadow_rays(self) -> int:
        """Shadow rays that were traced."""
        return self._picture.segments

    @property
    def rays(self) -> int:
        """Viewing rays and bounces that were traced."""
        return self._picture.rays

    @property
    def hash(self) -> str:
        """A number of the pixels' bits: the same picture has the same."""
        return f"{self._picture.hash:08x}"

    @property
    def relative_error(self) -> float | None:
        """Mean standard error of a pixel as a part of the mean pixel; None where it is unknown or all is black."""
        return self._picture.relative_error()

    @property
    def error_words(self) -> str:
        """How sure the picture is, in words."""
        if self.relative_error is not None:
            return f"standard error {significant(100 * self.relative_error, 2)} % of the mean"
        if self.standard_error is None:
            return "standard error not known (fewer than 2 replicates)"
        return "black"

    def save(self, path: str | PathLike[str]) -> None:
        """Writes an EXR (with all planes and metadata) or a PNG (the tone curve of the settings), whole or not at all.

        Raises ValueError for another suffix, OSError where it cannot be written.
        """
        self._picture.save(fspath(path))

    def png(self) -> bytes:
        """The picture as a PNG file in memory."""
        return bytes(self._picture.png())

    def summary(self) -> str:
        """Size, error and time in one line."""
        parts = [f"{self.width} × {self.height}", self.error_words]
        if self.passes_done < self.passes:
            parts.append(f"{self.passes_done} of {self.passes} passes")
        if self.seconds:
            parts.append(seconds(self.seconds))
        return " · ".join(parts)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """`pixels`, for NumPy."""
        return np.array(self.pixels, dtype=dtype, copy=copy)

    def __repr__(self) -> str:
        """`<Image pillars: 640 × 480 · standard error 0.8 % of the mean · 2.1 s>`."""
        return f"<Image {self.name}: {self.summary()}>"

    def _repr_html_(self) -> str:
        from antumbra.notebook import image_html

        return image_html(self.png(), self.width, self.name, self.summary())

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles the arrays, not the core's object."""
        return _rebuilt, (self._picture.parts(), self.name, self.seconds, self.messages)


def _rebuilt(parts: tuple[Any, ...], name: str, seconds: float, messages: list[Message]) -> Image:
    return Image(_core.Picture.from_parts(*parts), name=name, seconds=seconds, messages=messages)


def save_pixels(path: str | PathLike[str], pixels: NDArray[np.float32]) -> None:
    """Writes linear (H, W, 3) as an EXR, HDR or PNG picture, whole or not at all. Raises OSError where it cannot."""
    _core.write_picture(fspath(path), np.ascontiguousarray(pixels, np.float32))


def load_image(path: str | PathLike[str]) -> NDArray[np.float32]:
    """Reads an EXR, HDR or PNG picture as linear (H, W, 3) float32; of an EXR, its data window.

    Raises SceneError for a file that is not such a picture.
    """
    return _core.read_picture(fspath(path))
