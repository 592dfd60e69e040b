"""What a figure's functions are given: its rendered pictures, and a place to put new ones. `Run`."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra._words import written
from antumbra.image import save_pixels
from antumbra.lecture import bars, pictures
from antumbra.lecture.counted import counted
from antumbra.lecture.stages import Bar, Picture
from antumbra.lecture.variant import SEEDS, Pick, Variant, edition

if TYPE_CHECKING:
    from antumbra.image import Image
    from antumbra.messages import Progress
    from antumbra.scene import Scene

Report = Callable[[float, str], object]

# Seeds of the replicates of a truth begin here.
_TRUTHS = 2048


class Run:
    """One run of one figure, coarse (`quick`) or full, with a `seed`; files go below `folder`."""

    def __init__(
        self,
        name: str,
        folder: Path,
        *,
        quick: bool,
        seed: int = 0,
        report: Report = lambda share, doing: None,
    ) -> None:
        """`report` is called with the share that is done, 0 to 1, and what is being done."""
        self.name, self.folder, self.quick, self.seed, self.report = name, folder, quick, seed, report
        self.files: list[str] = []
        self.rays = 0
        # What its files begin with.
        self._stem = name + edition(quick, seed)
        self._images: dict[str, list[Image]] = {}
        self._scenes: dict[Callable[[], Scene], Scene] = {}
        self._once: dict[Any, Any] = {}
        self._phase = (0.0, 1.0)

    def pick(self, value: Any) -> Any:
        """The value itself, or the part of a `Pick` that this run takes."""
        return (value.quick if self.quick else value.full) if isinstance(value, Pick) else value

    # ---- progress ----

    def phase(self, begins: float, ends: float, doing: str = "") -> None:
        """What comes next takes the figure from one share to another."""
        self._phase = (begins, ends)
        self.at(0.0, doing)

    def at(self, share: float, doing: str) -> None:
        """The share of this phase that is done, and what is being done: a figure may say so in a long loop."""
        begins, ends = self._phase
        self.report(begins + share * (ends - begins), doing)

    # ---- rendering ----

    def render(self, variants: list[Variant]) -> None:
        """Renders all variants with all their replicates."""
        work = [(variant, n) for variant in variants for n in range(self.pick(variant.replicates))]
        for done, (variant, n) in enumerate(work):
            kind = "reference" if variant.truth else "picture"
            doing = f"{kind} {done + 1} of {len(work)}"

            def step(state: Progress, done: int = done, doing: str = doing) -> None:
                self.at((done + state.done) / len(work), doing)

            self._images.setdefault(variant.key, []).append(self._one(variant, n, step))

    def _one(self, variant: Variant, replicate: int, step: Callable[[Progress], object]) -> Image:
        options = {name: self.pick(value) for name, value in variant.options.items()}
        options.setdefault("seed", self.seeded(replicate + (_TRUTHS if variant.truth else 0)))
        return self.scene(variant.scene).render(progress=step, **options)

    def scene(self, build: Callable[[], Scene]) -> Scene:
        """The scene that a function builds; built once. Whatever it is asked, its rays count."""
        if build not in self._scenes:
            self._scenes[build] = counted(build(), self._count)
        return self._scenes[build]

    def _count(self, rays: int) -> None:
        self.rays += rays

    def once(self, what: Hashable, make: Callable[[], Any]) -> Any:
        """What `make` gives, made at the first call with this `what`: measure and stage share it."""
        if what not in self._once:
            self._once[what] = make()
        return self._once[what]

    def seeded(self, replicate: int) -> int:
        """The seed of a replicate, for queries that a figure makes by itself; `replicate` is below `SEEDS`."""
        return self.seed * SEEDS + replicate

    # ---- what was rendered ----

    def image(self, key: str) -> Image:
        """The picture of a variant (of several replicates the first)."""
        return self._images[key][0]

    def images(self, key: str) -> list[Image]:
        """All replicates of a variant."""
        return self._images[key]

    def pixels(self, key: str) -> NDArray[np.float64]:
        """Radiance of a variant (H, W, 3), the mean of its replicates."""
        total: NDArray[np.float64] = np.mean(
            [image.pixels for image in self._images[key]], 0, dtype=np.float64
        )
        return total

    def light(self, key: str) -> NDArray[np.float64]:
        """Luminance of a variant (H, W), the mean of its replicates."""
        return pictures.luminance(self.pixels(key))

    def aov(self, key: str, name: str) -> NDArray[np.float32]:
        """What was summed beside a variant's picture, by name."""
        return self._images[key][0].aov[name]

    def white(self, *keys: str, share: float = 99.0) -> float:
        """A luminance that `share` % of the pixels of these variants do not exceed: their common exposure."""
        return float(np.percentile(np.concatenate([self.light(key).ravel() for key in keys]), share)) or 1.0

    # ---- files ----

    def picture(
        self,
        source: str | ArrayLike,
        alt: str,
        caption: str = "",
        *,
        name: str = "",
        white: float = 0.0,
        colour: bool = False,
        tones: int = 128,
        noise: bool = False,
    ) -> Picture:
        """A variant (by key), or radiance (H, W, 3) or (H, W), as a picture of the page.

        `alt` says its result in a sentence; `white`: the luminance shown as white (default: its own 99 %); `colour`
        keeps colours, else luminance in warm tones; `noise`: its pixels are shown as squares.
        """
        if isinstance(source, str):
            name, source = name or source, self.pixels(source)
        shown = np.asarray(source)
        white = white or float(np.percentile(pictures.luminance(shown), 99)) or 1.0
        png = pictures.colour_png(shown, white, tones) if colour else pictures.tones_png(shown, white, tones)
        return self._put(name, png, shown, alt, caption, noise)

    def map(
        self,
        values: ArrayLike,
        alt: str,
        caption: str = "",
        *,
        name: str,
        ramp: str = "blue",
        low: float = 0.0,
        high: float = 1.0,
        unit: str = "",
        ticks: Mapping[float, str] | None = None,
        noise: bool = False,
    ) -> Picture:
        """Numbers (H, W) as a picture along a ramp of `pictures.RAMPS`, from `low` to `high`, with its colour bar.

        `unit`: of the numbers, or what they count; "%" writes shares as per cent. `ticks`: what stands on the bar at
        which number (default both ends and the middle).
        """
        bar = Bar([ramp], bars.ticks(values, low, high, unit, ticks), "" if unit == "%" else unit)
        png = pictures.ramp_png(values, ramp, low, high)
        return self._put(name, png, values, alt, caption, noise, bar)

    def map_of_two(
        self,
        values: ArrayLike,
        second: ArrayLike,
        alt: str,
        caption: str = "",
        *,
        name: str,
        ramps: Mapping[str, str],
        high: float,
        unit: str = "",
    ) -> Picture:
        """Numbers (H, W) of two kinds from 0 to `high`, NaN black.

        `ramps`: the ramp of each kind by its name; where `second` is true, a pixel is of the second kind.
        """
        ticks = bars.ticks(values, 0.0, high, unit, {0.0: "0", high: written(high, 2)})
        first, other = ramps.values()
        bar = Bar([first, other], ticks, "" if unit == "%" else unit, list(ramps))
        png = pictures.two_ramps_png(values, second, (first, other), high)
        return self._put(name, png, values, alt, caption, True, bar)

    def classes(
        self,
        values: ArrayLike,
        alt: str,
        caption: str = "",
        *,
        name: str,
        colours: tuple[str, ...] = pictures.REGIONS,
    ) -> Picture:
        """Whole numbers (H, W) as a picture, each in its colour; without `colours`: umbra, penumbra, antumbra, lit."""
        return self._put(name, pictures.classes_png(values, colours), values, alt, caption, True)

    def exr(self, source: str | ArrayLike, name: str = "") -> None:
        """Keeps full numbers beside the page: a variant with all its layers, or an array (H, W, 3) or (H, W)."""
        file = f"exr/{self._stem}{'-' if name else ''}{name}.exr"
        self._path(file)
        if isinstance(source, str):
            self.image(source).save(self.folder / file)
        else:
            array = np.asarray(source, np.float32)
            array = array if array.ndim == 3 else np.repeat(array[..., None], 3, 2)
            save_pixels(self.folder / file, array)

    def _put(
        self,
        name: str,
        png: bytes,
        shown: ArrayLike,
        alt: str,
        caption: str,
        noise: bool,
        bar: Bar | None = None,
    ) -> Picture:
        file = f"pictures/{self._stem}{'-' if name else ''}{name}.png"
        self._path(file).write_bytes(png)
        height, width = np.shape(shown)[:2]
        return Picture(file, width, height, alt, caption, noise, bar)

    def _path(self, file: str) -> Path:
        if file not in self.files:
            self.files.append(file)
        path = self.folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        return path
