"""The scenes of the races: antumbra's own built-in ones, as plain triangles for every contestant."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import antumbra as am

Array = NDArray[Any]

# A horizontal square to which shadow rays are cast: centre and half edge. Where the scene has such a light, a little
# below it; elsewhere above the geometry.
LIGHTS = {
    "interior": ((0.0, 2.70, 0.0), 1.0),
    "hall": ((0.0, 13.7, -2.0), 3.0),
    "terrain": ((-40.0, 45.0, 10.0), 8.0),
    "scan": ((-3.2, 4.2, 1.4), 0.8),
    "pillars": ((-3.3, 6.2, -3.6), 0.5),
}


@dataclass
class Mesh:
    """A scene as triangles."""

    name: str
    vertices: Array
    faces: Array
    # Eye of the first camera and what it looks at.
    view: tuple[Array, Array]
    light: tuple[tuple[float, float, float], float]

    def scene(self) -> am.Scene:
        """The same triangles as a scene of ours, its tree built."""
        scene = am.Scene(self.name)
        scene.add_mesh(self.vertices, self.faces)
        scene.occluded([[0.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
        return scene

    def corners(self) -> Array:
        """(F, 3, 3) float32."""
        return self.vertices[self.faces]


def builtin(name: str, **parameters: float) -> Mesh:
    """A built-in scene of antumbra."""
    made = am.builtin(name, **parameters)
    vertices, faces = made.triangles()
    camera = made.info()["cameras"][0]
    view = (np.array(camera["eye"]), np.array(camera["look_at"]))
    return Mesh(name, vertices, faces, view, LIGHTS[name])


@dataclass
class Rays:
    """Rays o + t·d, 0 < t < reach, the same for everybody: float32, C order."""

    work: str
    origins: Array
    directions: Array
    reach: float


CHUNK = 1_000_000


def rays(mesh: Mesh, count: int, seed: int) -> list[Rays]:
    """Two kinds of shadow rays from random points of the surface: over the hemisphere, and to the light."""
    rng = np.random.default_rng(seed)
    corners = mesh.corners().astype(np.float64)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    ends = np.cumsum(areas)
    # Far enough that no ray starts below its own triangle after rounding.
    lift = 2e-6 * np.abs(mesh.vertices).max()
    ambient = Rays(f"{mesh.name}: ambient rays from random points", *_empty(count), np.inf)
    light = Rays(
        f"{mesh.name}: segments to a light from random points", ambient.origins, _empty(count)[1], 1.0
    )
    (x, y, z), half = mesh.light
    for at in range(0, count, CHUNK):
        n = min(CHUNK, count - at)
        drawn = np.minimum(np.searchsorted(ends, rng.random(n) * ends[-1]), len(areas) - 1)
        normal = normals[drawn] / np.maximum(areas[drawn], 1e-300)[:, None]
        u, v = np.sqrt(rng.random(n))[:, None], rng.random(n)[:, None]
        a, b, c = corners[drawn].transpose(1, 0, 2)
        point = (1 - u) * a + u * (1 - v) * b + u * v * c + lift * normal
        run = slice(at, at + n)
        ambient.origins[run] = point
        ambient.directions[run] = _cosine(normal, rng)
        goal = np.array([x, y, z]) + half * np.stack(
            [rng.uniform(-1, 1, n), np.zeros(n), rng.uniform(-1, 1, n)], axis=1
        )
        light.directions[run] = goal - ambient.origins[run]
    return [ambient, light]


def _empty(count: int) -> tuple[Array, Array]:
    return np.empty((count, 3), np.float32), np.empty((count, 3), np.float32)


def _cosine(normal: Array, rng: np.random.Generator) -> Array:
    """Directions about the normals, density cos θ / π: a point of the unit sphere on top of the unit normal."""
    z = rng.uniform(-1, 1, len(normal))
    phi = rng.uniform(0, 2 * np.pi, len(normal))
    r = np.sqrt(1 - z * z)
    return normal * (1 + 1e-6) + np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1)
