"""Objects with the attributes of meshes of trimesh, Open3D and PyVista, for tests that run without these libraries."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from solids import normals_of_torus, torus

Array = Any


class Trimesh:
    """`trimesh.Trimesh`: `triangles` are corners, vertex normals are made when asked for."""

    def __init__(self, vertices: Array, faces: Array, vertex_normals: Array = None) -> None:
        self.vertices, self.faces = np.asarray(vertices), np.asarray(faces)
        self._cache = {} if vertex_normals is None else {"vertex_normals": vertex_normals}

    @property
    def triangles(self) -> Array:
        return self.vertices[self.faces]

    @property
    def vertex_normals(self) -> Array:
        return self._cache["vertex_normals"]


class Legacy:
    """`open3d.geometry.TriangleMesh`."""

    def __init__(self, vertices: Array, triangles: Array, vertex_normals: Array = ()) -> None:
        self.vertices, self.triangles, self.vertex_normals = (
            list(vertices),
            list(triangles),
            list(vertex_normals),
        )

    def has_vertex_normals(self) -> bool:
        return len(self.vertex_normals) > 0


class Tensor:
    """`open3d.core.Tensor`: an array that lies elsewhere."""

    def __init__(self, values: Array) -> None:
        self._values = np.asarray(values)

    def cpu(self) -> Tensor:
        return self

    def numpy(self) -> Array:
        return self._values


class Tensors:
    """`open3d.t.geometry.TriangleMesh`: tensors by name."""

    def __init__(self, vertices: Array = None, triangles: Array = None, normals: Array = None) -> None:
        given = {"positions": vertices, "normals": normals}
        self.vertex = {name: Tensor(values) for name, values in given.items() if values is not None}
        self.triangle = {} if triangles is None else {"indices": Tensor(triangles)}


class Surface:
    """`pyvista.PolyData`: cells in one run, data by name."""

    def __init__(self, points: Array, faces: Array = (), normals: Array = None, **cells: Array) -> None:
        self.points, self.faces = np.asarray(points), np.asarray(faces, int)
        self.lines, self.strips, self.verts = (cells.get(kind, ()) for kind in ("lines", "strips", "verts"))
        self.point_data = {} if normals is None else {"Normals": np.asarray(normals)}

    def __setitem__(self, name: str, values: Array) -> None:
        self.point_data[name] = values


def cells(*faces: Array) -> list[int]:
    """Polygons as PyVista keeps them."""
    return [number for face in faces for number in (len(face), *face)]


class Grid:
    """`pyvista.StructuredGrid` of heights: its surface has one quad a cell."""

    def __init__(self, x: Array, y: Array, z: Array) -> None:
        self._places = np.stack([x, y, z], axis=-1)

    def extract_surface(self) -> Surface:
        rows, columns, _ = self._places.shape
        number = np.arange(rows * columns).reshape(rows, columns)
        corners = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
        return Surface(
            self._places.reshape(-1, 3), cells(*np.stack([c.reshape(-1) for c in corners], axis=1))
        )


class Ring(Trimesh):
    """`trimesh.creation.torus`."""

    def __init__(self, major_radius: float, minor_radius: float) -> None:
        vertices, faces = torus(major_radius, minor_radius)
        super().__init__(vertices, faces, normals_of_torus(vertices, major_radius))
        self.visual = SimpleNamespace()

    def export(self, path: str) -> None:
        """Nothing is written."""


def modules() -> dict[str, Any]:
    """What `import` gives in the examples of docs/bridges.md where a library is not installed."""
    shapes = SimpleNamespace(create_torus=lambda: Tensors(*torus(1.0, 0.5)))
    return {
        "pyvista": SimpleNamespace(StructuredGrid=Grid),
        "trimesh": SimpleNamespace(creation=SimpleNamespace(torus=Ring)),
        "open3d": SimpleNamespace(t=SimpleNamespace(geometry=SimpleNamespace(TriangleMesh=shapes))),
    }
