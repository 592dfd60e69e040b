"""Scenes: read, built in, or made of arrays; what is asked of them. `Scene`, `load`, `builtin`, `builtins`."""

from __future__ import annotations

import re
import time
import warnings
from collections.abc import Callable, Mapping
from functools import partial
from os import PathLike, fspath
from typing import Any, NoReturn, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra import _core, own, settings
from antumbra._arrays import indices, matching, per_row, places, rows, starts
from antumbra._meshes import mesh_of
from antumbra._parts import lat_long, matrix, one_of
from antumbra._values import Color, Vector, color, number, shown, text, vector
from antumbra.anatomy import Anatomy
from antumbra.effects import idle
from antumbra.errors import OptionError, RenderStopped
from antumbra.estimate import Estimate
from antumbra.exported import Exported
from antumbra.hit import Hit, Receivers
from antumbra.image import Image
from antumbra.lights import Environment, Light
from antumbra.materials import Blend, Diffuse, Material, TwoSided
from antumbra.messages import Message, Progress
from antumbra.occlusion import Openings
from antumbra.pieces import Pieces
from antumbra.shapes import Shape


def load(
    path: str | PathLike[str],
    *,
    up_axis: str | None = None,
    files_from: str | PathLike[str] | None = None,
    parameters: Mapping[str, str | float] | None = None,
    variant: str | None = None,
    at_time: float | None = None,
    animation: str | None = None,
    max_memory: str | int | None = None,
) -> Scene:
    """Reads a scene: glTF/GLB, OBJ, PLY, STL, Mitsuba 3 XML, pbrt-v4, or a lat-long picture (and a scene under it).

    `up_axis`: "y" or "z", the axis that points up in the file; `files_from`: the folder that the file's own paths
    may reach (default: its own folder); `parameters`: values for what a Mitsuba file declares as `<default>`. The
    settings that such a file asks for (samples, filter, estimator) hold where `render` is told nothing else.

    Of glTF, `variant`: the variant of materials; `at_time`: the time [s] that its animations stand at, at rest without;
    `animation`: the one that plays, else all that can play together.

    `max_memory`: a scene that would take more is refused, as early as its size is known: bytes, or a size like "4G".

    Raises SceneError with .file, .place and .hint.

    >>> import antumbra as am
    >>> am.load("room.glb").render().save("room.exr")  # doctest: +SKIP
    """
    folder = None if files_from is None else text("files_from", files_from)
    given = [
        (name, value if isinstance(value, str) else f"{value:g}")
        for name, value in (parameters or {}).items()
    ]
    look = None if variant is None else text("variant", variant)
    time = None if at_time is None else number("at_time", at_time)
    clip = None if animation is None else text("animation", animation)
    most = str(max_memory) if isinstance(max_memory, int) else max_memory and text("max_memory", max_memory)
    core = _core.Scene.load(
        text("path", path),
        up_axis,
        folder,
        given,
        variant=look,
        at_time=time,
        animation=clip,
        max_memory=most,
    )
    return Scene._of(core)


def builtin(name: str, **parameters: float) -> Scene:
    """A scene that needs no file; `builtins()` lists them with their parameters.

    Raises ValueError with the nearest right name.

    >>> import antumbra as am
    >>> am.builtin("pillars", light_size=0.5)  # doctest: +ELLIPSIS
    <Scene pillars: ...>
    """
    text("name", name)
    words = [(key.replace("_", "-"), number(key, value)) for key, value in parameters.items()]
    try:
        return Scene._of(_core.Scene.builtin(name, words))
    except OptionError as problem:
        # Parameters have dashes on the command line, underscores here.
        scene, colon, what = str(problem).partition(": ")
        dashed = re.compile(r"\b[a-z]+(?:-[a-z]+)+\b")
        raise OptionError(scene + colon + dashed.sub(lambda word: word[0].replace("-", "_"), what)) from None


def builtins() -> dict[str, str]:
    """The built-in scenes: name and what each shows."""
    return {name: shows for name, shows, _ in _core.builtins()}


class Scene(Anatomy, Exported, Openings, Pieces):
    """What there is to see. An empty one is filled by `add_mesh`, `add_shape` and `add_light`.

    >>> import numpy as np, antumbra as am
    >>> scene = am.Scene()
    >>> corners = np.array([[-1.0, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
    >>> scene.add_mesh(corners, [[0, 2, 1], [0, 3, 2]], material=am.materials.Diffuse(0.5))
    >>> scene.add_light(am.lights.Point((0, 2, 0), intensity=4.0))
    >>> bool(scene.occluded([[0, 1, 0]], [[0, -1, 0]])[0])
    True
    """

    def __init__(self, name: str = "scene", *, origin: Vector = (0.0, 0.0, 0.0)) -> None:
        """An empty scene; `name` is what it is called in pictures.

        Places are kept in single precision, relative to `origin` (3,): one near the scene keeps their digits where
        all coordinates are large. Everything that is given and returned stays in world coordinates.
        """
        self._core = _core.Scene(text("name", name), vector("origin", origin))

    @classmethod
    def _of(cls, core: _core.Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._core = core
        return scene

    # ---- building ----

    def add_mesh(
        self,
        vertices: ArrayLike,
        faces: ArrayLike | None = None,
        *,
        material: Material | None = None,
        emission: Color | None = None,
        transform: ArrayLike | None = None,
        normals: ArrayLike | None = None,
        name: str = "",
    ) -> None:
        """Adds triangles.

        `vertices` (V, 3) float in scene units; `faces` (F, 3) whole numbers, counter-clockwise from the front; or a
        mesh of trimesh, Open3D or PyVista in place of both, with the vertex normals that it holds (docs/bridges.md).
        `emission`: radiance L_e of the front, one number or three; `transform` (4, 4): object to world; `normals`
        (V, 3): shading normals, flat without.

        Raises ValueError or TypeError for another shape or kind of number, an index out of range, or an object
        without faces.
        """
        if faces is None:
            vertices, faces, held = mesh_of(vertices)
            normals = held if normals is None else normals
        vertices = rows("vertices", vertices)
        corners = indices("faces", faces, 3, len(vertices), "vertex")
        if normals is not None:
            normals = matching("normals", normals, "vertices", len(vertices))
        place = None if transform is None else matrix(transform)
        look = self._material(material, emission)
        self._core.add_mesh(name, vertices, corners, look, place, normals)

    def add_shape(
        self, shape: Shape, *, material: Material | None = None, emission: Color | None = None, name: str = ""
    ) -> None:
        """Adds a sphere, disk, cylinder or rectangle of `antumbra.shapes`, in world space."""
        kind = one_of("shape", shape, Shape)
        self._core.add_shape(name, kind, shape.fields(), self._material(material, emission))

    def add_light(self, light: Light, *, name: str = "") -> None:
        """Adds a light of `antumbra.lights`; `name` is what `light=` and `visible_fraction` call it."""
        kind = one_of("light", light, Light)
        if isinstance(light, Environment) and isinstance(light.radiance, (str, PathLike)):
            self._core.add_environment_file(name, fspath(light.radiance), *light.placed())
        elif isinstance(light, Environment) and np.ndim(cast("ArrayLike", light.radiance)) > 1:
            picture = lat_long(light.radiance)
            self._core.add_environment(name, picture, *light.placed())
        else:
            self._core.add_light(name, kind, light.fields())

    def _material(self, material: Material | None, emission: Color | None) -> int:
        look = Diffuse() if material is None else material
        kind = one_of("material", look, Material)
        radiance = None if emission is None else color("emission", emission)
        fields = look.fields()
        if isinstance(look, Blend | TwoSided):
            fields |= {name: [float(self._material(part, None))] for name, part in look.parts().items()}
        return self._core.add_material(kind, fields, radiance)

    # ---- pictures ----

    def render(
        self,
        *,
        estimator: str | own.Estimator | None = None,
        progress: Callable[[Progress], object] | None = None,
        **options: Any,
    ) -> Image:
        """Renders a picture. The options are those of `antumbra render --help`, with `_` for `-`, angles in radians.

        `estimator` is a word of that help, or a function of your own: see `antumbra.own`.
        `progress` is called about 20 times a second with a `Progress`; if it returns False, the render stops and the
        picture has the passes that were done. Other Python threads run meanwhile.

        Raises ValueError for a wrong option with the nearest right one; RenderStopped (a KeyboardInterrupt) with
        `.image` on Ctrl-C.

        >>> import antumbra as am
        >>> image = am.builtin("cornell-box").render(estimator="area", viewing_rays=4, size=(16, 12))
        >>> image.pixels.shape
        (12, 16, 3)
        """
        if progress is not None and not callable(progress):
            raise TypeError(f"progress is {shown(progress)}: something to call is needed")
        if callable(estimator):
            name = getattr(estimator, "__name__", type(estimator).__name__)
            return own.render(self._core, name, partial(estimator, self), options, progress)
        began = time.perf_counter()
        watch = None if progress is None else lambda *state: progress(Progress(*state))
        words, asked = settings.words({**options, "estimator": estimator}), self._core.suggested()
        picture, interrupted = self._core.render(list({**asked, **words}.items()), watch)
        seconds = time.perf_counter() - began
        said = [Message("note", "", text) for text in idle(words, asked=asked)]
        image = Image(picture, name=self.name, seconds=seconds, messages=said) if picture else None
        if interrupted or image is None:
            raise RenderStopped(image)
        return image

    # ---- questions ----

    def occluded(
        self,
        origins: ArrayLike | Hit | Receivers,
        targets: ArrayLike | None = None,
        *,
        directions: ArrayLike | None = None,
        max_distance: ArrayLike = np.inf,
    ) -> NDArray[np.bool_]:
        """Whether something blocks: exactly the open segment from each origin to its target, (N,) bool.

        `origins` (N, 3) or receivers; `targets` (N, 3), or one (3,) for all. Or `directions` (N, 3) of any length with
        `max_distance`, one number or (N,), in multiples of the direction's length. Origins are taken as they are: one
        that lies in a surface is not blocked by it. A direction of length 0 meets nothing.

        Raises ValueError for shapes that do not match and for numbers that are not finite.
        """
        return self._core.occluded(*self._segments(origins, targets, directions, max_distance))

    def closest_hit(
        self, origins: ArrayLike | Hit | Receivers, directions: ArrayLike, max_distance: ArrayLike = np.inf
    ) -> Hit:
        """What each ray meets first.

        `origins` (N, 3) or receivers, `directions` (N, 3) of any length, `max_distance` in multiples of it: one number
        or (N,). `Hit.t` is inf for a miss; hits at the same distance: the first in the order of building.
        """
        start, count = starts(origins)
        along = matching("directions", directions, "origins", count)
        return Hit(self._core.closest_hit(start, along, per_row("max_distance", max_distance, count)))

    def irradiance(
        self,
        points: ArrayLike | Hit | Receivers,
        normals: ArrayLike | None = None,
        *,
        shadow_rays: int = 64,
        estimator: str = "area",
        **options: Any,
    ) -> Estimate:
        """Irradiance E [W/m²] that arrives on the normal's side of each point, (N, 3).

        Direct light, unless `estimator` is "path" or "path-hemisphere": then with light that other surfaces reflect.

        `points` (N, 3) with unit `normals` (N, 3), or receivers. Further options as in `render` (`lights`,
        `light_points`, `sampler`, `seed`, `threads`, …).
        """
        if estimator == "ambient-occlusion":
            raise OptionError("estimator = ambient-occlusion is no light: ask Scene.ambient_occlusion")
        words = {"shadow_rays": shadow_rays, "estimator": estimator, **options}
        return self._estimate("irradiance", points, normals, words)

    def ambient_occlusion(
        self,
        points: ArrayLike | Hit | Receivers,
        normals: ArrayLike | None = None,
        *,
        rays: int = 64,
        radius: float | None = None,
        falloff: str | None = None,
        **options: Any,
    ) -> Estimate:
        """The open share (1/π)∫V cos θ dω of the hemisphere over each point, (N,): 1 = open.

        `radius`: occluders beyond it do not count; `falloff`: their weight up to it ("none", "linear", "quadratic").
        """
        own = {"shadow_rays": rays, "estimator": "ambient-occlusion", "radius": radius, "falloff": falloff}
        return self._estimate("ambient_occlusion", points, normals, _with(own, options))

    def visible_fraction(
        self,
        points: ArrayLike | Hit | Receivers,
        normals: ArrayLike | None = None,
        *,
        light: str | int = 0,
        rays: int = 64,
        **options: Any,
    ) -> Estimate:
        """Which part of one light each point sees, (N,): mean V over its area (flat) or solid angle (others).

        What lies below a point's horizon is not seen. `light`: its name, or its number in the order of building.
        """
        start, facing, _ = places(points, normals)
        words = settings.words(_with({"shadow_rays": rays, "estimator": "area"}, options))
        began = time.perf_counter()
        values, errors = self._core.visible_fraction(start, facing, str(light), list(words.items()))
        return Estimate(values, errors, "visible fraction", rays, time.perf_counter() - began)

    def _estimate(self, what: str, points: Any, normals: Any, options: dict[str, Any]) -> Estimate:
        start, facing, _ = places(points, normals)
        words = settings.words(options)
        for said in idle(words):
            warnings.warn(said, stacklevel=3)
        began = time.perf_counter()
        values, errors = getattr(self._core, what)(start, facing, list(words.items()))
        seconds = time.perf_counter() - began
        return Estimate(values, errors, what.replace("_", " "), int(options["shadow_rays"]), seconds)

    # ---- about the scene ----

    @property
    def name(self) -> str:
        """What it is called."""
        return self._core.name

    @property
    def messages(self) -> list[Message]:
        """Notes and warnings of the reader and the builder."""
        return [Message(*said) for said in self._core.messages()]

    def info(self) -> dict[str, Any]:
        """Counts, bounds, lights, cameras and memory: what `antumbra info --json` prints."""
        return self._core.info()

    def triangles(self) -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
        """All triangles in world space, for other programs: vertices (V, 3) and faces (F, 3).

        Every placed mesh behind the other in the order of building; spheres, disks and cylinders are left out.
        """
        return self._core.triangles()

    def __reduce__(self) -> NoReturn:
        """Scenes do not pickle: they would have to bring their files along."""
        raise TypeError(
            f"a Scene does not pickle: make {self.name!r} again where it is needed, by load(), builtin() or the same "
            "add_ calls; triangles() gives its geometry as arrays"
        )

    def _repr_html_(self) -> str:
        """What is in it, for a notebook."""
        from antumbra.notebook import scene_html

        return scene_html(repr(self).strip("<>"), self.info(), self.messages)

    def __repr__(self) -> str:
        """`<Scene room.glb: 143,163 triangles, 5 lights, 1 camera>`."""
        found = self._core.counts()
        parts = [f"{n:,} {word}{'' if n == 1 else 's'}" for word, n in found]
        return f"<Scene {self.name}: {', '.join(parts) or 'empty'}>"


def _with(own: dict[str, Any], options: dict[str, Any]) -> dict[str, Any]:
    """The settings of a query and what was given beside, which may not replace them."""
    for name in own.keys() & options.keys():
        raise OptionError(f"{name} is no option of this query: it has its own")
    return own | options
