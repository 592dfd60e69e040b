"""Meshes of trimesh, Open3D and PyVista as arrays of triangles; none of these libraries is imported."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra._values import shown

Array = NDArray[Any]


class Triangles(NamedTuple):
    """`vertices` (V, 3), `faces` (F, 3) and, where the mesh holds them, vertex `normals` (V, 3)."""

    vertices: Array
    faces: Array
    normals: Array | None


def mesh_of(mesh: Any) -> Triangles:
    """The triangles of a mesh, known by its attributes.

    trimesh: `vertices`, `faces`; Open3D: `vertices`, `triangles`, or the tensors `vertex`, `triangle`; PyVista:
    `points`, `faces`, polygons cut into triangles in the order of the cells.

    Raises TypeError for what has no faces, ValueError for a mesh that is empty or has other cells beside its faces.
    """
    if hasattr(mesh, "vertex") and hasattr(mesh, "triangle"):
        found = _tensors(mesh)
    elif hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        # Asked first: a trimesh has `triangles` too, its corners.
        found = _arrays(mesh.vertices, mesh.faces, _held_normals(mesh))
    elif hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):
        has_normals = getattr(mesh, "has_vertex_normals", None)
        normals = mesh.vertex_normals if has_normals is not None and has_normals() else None
        found = _arrays(mesh.vertices, mesh.triangles, normals)
    elif hasattr(mesh, "points") and hasattr(mesh, "faces"):
        found = _cells(mesh)
    else:
        raise TypeError(_no_mesh(mesh))
    if not (len(found.vertices) and len(found.faces)):
        raise ValueError(f"the mesh ({shown(mesh)}) is empty: it has no {_missing(found)}")
    return found


def _missing(found: Triangles) -> str:
    return "faces" if len(found.vertices) else "vertices"


def _array(values: Any) -> Array:
    """An array of a list, an array or a tensor, wherever it lies."""
    return np.asarray(values.cpu().numpy() if hasattr(values, "cpu") else values)


def _arrays(vertices: Any, faces: Any, normals: Any) -> Triangles:
    return Triangles(_array(vertices), _array(faces), None if normals is None else _array(normals))


def _held_normals(mesh: Any) -> Any:
    """Vertex normals that a trimesh holds: of its file, or made when somebody asked. As its exporters decide it."""
    return mesh.vertex_normals if "vertex_normals" in getattr(mesh, "_cache", ()) else None


def _tensors(mesh: Any) -> Triangles:
    """An Open3D tensor mesh: attributes by name."""
    vertices, faces = _named(mesh.vertex, "positions"), _named(mesh.triangle, "indices")
    none = np.zeros((0, 3), int)
    return _arrays(
        none if vertices is None else vertices,
        none if faces is None else faces,
        _named(mesh.vertex, "normals"),
    )


def _named(tensors: Any, name: str) -> Any:
    return tensors[name] if name in tensors else None  # noqa: SIM401  (a map of tensors has no get)


def _cells(mesh: Any) -> Triangles:
    """A PyVista surface: `faces` is a run of (count, index, index, …)."""
    for kind, what in (("lines", "line cells"), ("strips", "triangle strips"), ("verts", "vertex cells")):
        if np.size(getattr(mesh, kind, ())):
            hint = ": .triangulate() makes faces of them" if kind == "strips" else ", which are no surface"
            raise ValueError(f"the mesh ({shown(mesh)}) has {what}{hint}")
    points = _array(mesh.points)
    data = getattr(mesh, "point_data", {})
    normals = _array(data["Normals"]) if "Normals" in data else None
    return Triangles(points, triangulated(points, _array(mesh.faces)), normals)


def _no_mesh(mesh: Any) -> str:
    """Why this is no mesh, and what would be one."""
    if hasattr(mesh, "extract_surface"):
        return f"the mesh is {shown(mesh)}, which is no surface: give .extract_surface()"
    if hasattr(mesh, "geometry") and hasattr(mesh, "to_mesh"):
        return f"the mesh is {shown(mesh)}, which holds several meshes: give .to_mesh(), or each one"
    if any(hasattr(mesh, name) for name in ("points", "vertices", "point")):
        return f"the mesh is {shown(mesh)}, which has no faces: points and lines cast no shadow"
    return "faces are missing: give (F, 3) whole numbers, or a mesh of trimesh, Open3D or PyVista"


def triangulated(points: Array, cells: Array) -> Array:
    """(F, 3) corners of the triangles of polygons, in the order of the polygons.

    `cells`: (count, index, index, …) one after the other. A polygon is cut by a fan from the first of its corners
    from which all triangles face the polygon's side: that is right for every polygon that is seen whole from one of
    its corners, so for every quad.

    Raises ValueError for a run that does not add up, an index out of range, or a polygon without such a corner.
    """
    starts = _starts(cells)
    sizes = cells[starts] if len(starts) else cells[:0]
    if np.any(sizes < 3):
        raise ValueError(f"faces has a cell of {sizes.min()} corners: 3 or more are needed")
    if np.all(sizes == 3):
        return cells.reshape(-1, 4)[:, 1:]
    made, owners = [], []
    for size in np.unique(sizes):
        chosen = np.flatnonzero(sizes == size)
        corners = cells[starts[chosen][:, None] + 1 + np.arange(size)]
        if corners.min() < 0 or corners.max() >= len(points):
            wrong = corners.min() if corners.min() < 0 else corners.max()
            raise ValueError(f"faces asks for vertex {wrong}, but there are {len(points)}")
        made.append(_fans(points, corners, chosen).reshape(-1, 3))
        owners.append(np.repeat(chosen, size - 2))
    return np.concatenate(made)[np.argsort(np.concatenate(owners), kind="stable")]


def _starts(cells: Array) -> Array:
    """Where each cell begins."""
    if len(cells) % 4 == 0 and np.all(cells[::4] == 3):
        return np.arange(0, len(cells), 4)
    found, at, run = [], 0, cells.tolist()
    while at < len(run):
        found.append(at)
        at += max(run[at], 0) + 1
    if at != len(run):
        raise ValueError(f"faces ends within its last cell: {at - len(run)} indices are missing")
    return np.array(found, int)


def _fans(points: Array, corners: Array, numbers: Array) -> Array:
    """(P, K−2, 3): each polygon of K corners as a fan from the first corner that serves."""
    size = corners.shape[1]
    places = points[corners].astype(np.float64)
    places -= places[:, :1]
    ahead = np.roll(places, -1, axis=1)
    # Twice the area of a polygon, as a vector along its normal (Newell).
    normal = np.cross(places, ahead).sum(axis=1)
    fans = np.zeros((len(corners), size - 2, 3), corners.dtype)
    waiting = np.ones(len(corners), bool)
    for apex in range(size):
        turned, at = np.roll(corners, -apex, axis=1), np.roll(places, -apex, axis=1)
        fan = np.stack([np.repeat(turned[:, :1], size - 2, 1), turned[:, 1:-1], turned[:, 2:]], axis=2)
        sides = np.cross(at[:, 1:-1] - at[:, :1], at[:, 2:] - at[:, :1])
        serves = waiting & np.all(np.einsum("pkc,pc->pk", sides, normal) >= 0, axis=1)
        fans[serves] = fan[serves]
        waiting &= ~serves
    if waiting.any():
        first = numbers[np.argmax(waiting)]
        raise ValueError(
            f"face {first} has {size} corners and is seen whole from none of them: .triangulate() the mesh first"
        )
    return fans
