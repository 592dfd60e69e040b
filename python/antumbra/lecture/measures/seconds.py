"""Time that rays take, without what makes a scene ready."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from antumbra.image import Image
    from antumbra.scene import Scene


def of_rays(images: Sequence[Image], scene: Scene, **options: Any) -> list[float]:
    """Seconds of each picture less those of a picture of one pixel with the same options, the least of three.

    Never less than a thousandth of the whole: what is left of a short picture may drown in other work.
    """
    ready = min(scene.render(size=(1, 1), viewing_rays=1, **options).seconds for _ in range(3))
    return [max(image.seconds - ready, image.seconds / 1000) for image in images]
