"""Pictures with more and more rays, and with rays that look farther and farther."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from antumbra.lecture.measures.slopes import Errors
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Picture


def counts(run: Run, errors: Errors, sampler: str, shown: Sequence[int], white: float) -> list[Picture]:
    """The variants `sampler`-n for the numbers n that are `shown`, all at one exposure."""
    pictures = []
    for n in shown:
        caption, key = f"{n} ray{'s' * (n > 1)}", f"{sampler}-{n}"
        alt = f"{caption} a pixel, {sampler}: {errors.relative(sampler, n):v} of the noise of one random ray."
        pictures.append(run.picture(run.image(key).pixels, alt, caption, name=key, white=white, noise=True))
    return pictures


def reference(run: Run, shows: str, white: float, colour: bool = False) -> Picture:
    """The variant "truth", its pixels squares as those of the pictures that it is compared with."""
    alt = f"Reference: {shows}."
    return run.picture("truth", alt, "reference", white=white, colour=colour, noise=True)


def at_radius(run: Run, found: Mapping[str, Quantity], r: int) -> Frame:
    """The openness that the variants "radius-r" and "faded-r" show, and the mean `open-r`, as a frame of a slider."""
    says = f"{r} of 555: {found[f'open-{r}']:1} open on average"
    full, fading = f"Occluders count up to {r}.", f"Occluders count the less the farther, to 0 at {r}."
    pictures = [
        run.picture(f"{kind}-{r}", alt, name=f"{kind}-{r}", white=1.0)
        for kind, alt in (("radius", full), ("faded", fading))
    ]
    return Frame(str(r), says, pictures, short=str(r))
