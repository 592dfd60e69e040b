"""Direct light and shadow: which part of each light does this point see, and how much light arrives from it?

>>> import antumbra as am
>>> scene = am.builtin("cornell-box")
>>> image = scene.render(viewing_rays=4, size=(32, 32))
>>> image.pixels.shape
(32, 32, 3)

Lengths are in scene units, radiance in W·m⁻²·sr⁻¹ (linear, Rec. 709 primaries), angles in radians.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from antumbra._core import __version__
from antumbra.errors import OptionError, RenderStopped, SceneError
from antumbra.messages import Message

if TYPE_CHECKING:
    from antumbra import lights, materials, shapes, study
    from antumbra.anatomy import Region
    from antumbra.checks import check
    from antumbra.estimate import Estimate
    from antumbra.explanation import Explanation
    from antumbra.hit import Hit
    from antumbra.image import Image, load_image
    from antumbra.rays import trimesh_ray
    from antumbra.scene import Scene, builtin, builtins, load

__all__ = [
    "Estimate",
    "Explanation",
    "Hit",
    "Image",
    "Message",
    "OptionError",
    "Region",
    "RenderStopped",
    "Scene",
    "SceneError",
    "__version__",
    "builtin",
    "builtins",
    "check",
    "lights",
    "load",
    "load_image",
    "materials",
    "shapes",
    "study",
    "trimesh_ray",
]

# Where each name lives. Imported when first asked for, because `import antumbra` must not wait for NumPy.
_HOME = {
    "Estimate": "estimate",
    "Explanation": "explanation",
    "Hit": "hit",
    "Image": "image",
    "Region": "anatomy",
    "Scene": "scene",
    "builtin": "scene",
    "builtins": "scene",
    "check": "checks",
    "load": "scene",
    "load_image": "image",
    "trimesh_ray": "rays",
}
_MODULES = {"lights", "materials", "shapes", "study"}


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return importlib.import_module(f"antumbra.{name}")
    if name in _HOME:
        value = getattr(importlib.import_module(f"antumbra.{_HOME[name]}"), name)
        globals()[name] = value
        return value
    raise AttributeError(f"module 'antumbra' has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
