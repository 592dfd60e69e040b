"""One pixel taken apart: `Explanation`, with its viewing rays, receivers and rays to the lights."""

from __future__ import annotations

from typing import Any

from antumbra._pixel import LightRay as LightRay
from antumbra._pixel import LightRays as LightRays
from antumbra._pixel import Pixel, Triple, ViewingRays
from antumbra._pixel import Receiver as Receiver
from antumbra._pixel import ViewingRay as ViewingRay
from antumbra._table import explained
from antumbra.messages import Message


class Explanation(Pixel):
    """A pixel with everything that makes it, as `Scene.explain` returns it.

    `pixel` (column, row); `size` of the whole picture; `value`: its radiance, the sum of what its rays bring, which is
    what a render with the same settings has; `viewing_rays`, and the `light_rays` of all of them (as
    arrays: `light_rays.array("pdf")`); `lights`: their names by number; `settings`: those that were given, as words;
    `messages`. `print` shows it as a table.
    """

    def __init__(
        self, name: str, pixel: tuple[int, int], found: dict[str, Any], given: dict[str, str]
    ) -> None:
        """Names what the core found."""
        self.name, self.pixel, self.settings = name, pixel, given
        self.size: tuple[int, int] = tuple(found["size"])
        self.value: Triple = tuple(found["value"])
        self.lights: list[str] = found["lights"]
        self.messages = [Message(*said) for said in found["messages"]]
        self.light_rays = LightRays(found["light_rays"], found["names"])
        self.viewing_rays = ViewingRays(found, self.light_rays)

    def as_dict(self) -> dict[str, Any]:
        """Plain dicts, lists and numbers; what is infinite or not a number is None."""
        rays = []
        for ray in self.viewing_rays:
            rows = [
                {**{key: _plain(x) for key, x in row._asdict().items()}, "pdf_area": row.pdf_area}
                for row in ray.light_rays
            ]
            met = ray.receiver._asdict() if ray.receiver else None
            rays.append({**ray._asdict(), "receiver": met, "light_rays": rows})
        return {
            "scene": self.name,
            "pixel": self.pixel,
            "size": self.size,
            "settings": self.settings,
            "lights": self.lights,
            "value": self.value,
            "viewing_rays": rays,
            "messages": [message._asdict() for message in self.messages],
        }

    def __str__(self) -> str:
        """The whole table, 80 columns wide."""
        return explained(self)

    def __repr__(self) -> str:
        """`<Explanation pillars 320,240: 0.0413 0.0384 0.0339, 4 rays to lights>`."""
        value = " ".join(f"{c:.3g}" for c in self.value)
        rays = f"{len(self.light_rays):,} rays to lights"
        return f"<Explanation {self.name} {self.pixel[0]},{self.pixel[1]}: {value}, {rays}>"


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and not abs(value) < float("inf") else value
