"""Pictures of one sampler with more and more shadow rays."""

from __future__ import annotations

from collections.abc import Sequence

from antumbra.lecture.measures.slopes import Errors
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Picture


def counts(run: Run, errors: Errors, sampler: str, shown: Sequence[int], white: float) -> list[Picture]:
    """The variants `sampler`-n for the numbers n that are `shown`, all at one exposure."""
    pictures = []
    for n in shown:
        caption, key = f"{n} ray{'s' * (n > 1)}", f"{sampler}-{n}"
        alt = f"{caption} a pixel, {sampler}: {errors.relative(sampler, n):v} of the noise of one random ray."
        pictures.append(run.picture(run.image(key).pixels, alt, caption, name=key, white=white, noise=True))
    return pictures
