"""`trimesh_ray`: the questions of trimesh's `mesh.ray`, answered by the law of visibility."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra._arrays import finite
from antumbra._asked import Asked
from antumbra._meshes import mesh_of

Index = NDArray[np.int64]
Places = NDArray[np.float64]


def trimesh_ray(mesh: Any) -> TrimeshRay:
    """An object to ask a mesh about rays as one asks `mesh.ray` of trimesh.

    `mesh`: a trimesh, or any other mesh that `Scene.add_mesh` takes. `mesh.ray = antumbra.trimesh_ray(mesh)` makes
    trimesh itself use it, in `mesh.contains` and wherever else it asks rays.

    >>> import numpy as np, antumbra as am
    >>> from types import SimpleNamespace
    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> square = SimpleNamespace(vertices=corners, faces=np.array([[0, 1, 2], [0, 2, 3]]))
    >>> ray = am.trimesh_ray(square)
    >>> ray.intersects_location([[0.5, 0.5, 1]], [[0, 0, -1]])  # on the diagonal: one hit, not two
    (array([[0.5, 0.5, 0. ]]), array([0]), array([0]))
    """
    return TrimeshRay(mesh)


class TrimeshRay:
    """Answers about rays (o, d) and one mesh, with the shapes and kinds of numbers that trimesh gives.

    **What counts.** A ray meets the closed triangle: its edges and corners belong to it. Nothing behind the start and
    nothing at the start itself is met, so a start that lies in a face is not blocked by it; a triangle that is
    parallel to the ray is not met. Directions have any length; one of length 0 meets nothing.

    **Each place once.** Where a ray meets several faces at the same place (an edge, a corner, faces that lie in one
    another), that is one hit, and the face with the lowest number is named. Two places count as two however near they
    are. Touching a ridge is one hit, too: the number of hits tells inside from outside only for rays that meet neither
    an edge nor a corner; `contains_points` is right for all. Whoever asks only for the first hit is told one of the
    faces at the nearest place, or at one that is farther by less than 2⁻²⁸ of the distance.

    **In which numbers.** Mesh and rays are rounded to single precision once, relative to a place near the mesh (0 if
    that is one); a start farther than four sizes of the mesh is first drawn along its ray up to it. For these numbers
    every answer is exact, and all methods agree. `contains_points` does not round: it is exact for float64 as given.

    A trimesh that changes is read again; other meshes are read once. Raises ValueError for shapes that do not match and
    for numbers that are not finite.
    """

    def __init__(self, mesh: Any) -> None:
        """`mesh`: anything that `Scene.add_mesh` takes."""
        self.mesh = mesh
        self._version = _version(mesh)
        self._asked = Asked(mesh_of(mesh))

    def intersects_id(
        self,
        ray_origins: ArrayLike,
        ray_directions: ArrayLike,
        *,
        multiple_hits: bool = True,
        max_hits: int | None = None,
        return_locations: bool = False,
    ) -> Any:
        """Faces that rays hit: `index_tri` (H,) and `index_ray` (H,) int64, sorted by ray, then by distance.

        `ray_origins`, `ray_directions` (N, 3); `multiple_hits`: all hits of a ray, or its first; `max_hits`: the first
        so many of each (all, if it is None); `return_locations`: gives `locations` (H, 3) float64, too.
        """
        mesh = self._current()
        rays = mesh.rays(*_matching(ray_origins, ray_directions))
        index_ray, index_tri, t = mesh.all_hits(rays) if multiple_hits else mesh.first_hits(rays)
        if max_hits is not None:
            # The number of each hit within its ray.
            nth = np.arange(len(index_ray)) - np.searchsorted(index_ray, index_ray)
            kept = nth < max_hits
            index_ray, index_tri, t = index_ray[kept], index_tri[kept], t[kept]
        if return_locations:
            return index_tri, index_ray, mesh.locations(rays, index_ray, index_tri, t)
        return index_tri, index_ray

    def intersects_location(
        self,
        ray_origins: ArrayLike,
        ray_directions: ArrayLike,
        *,
        multiple_hits: bool = True,
        max_hits: int | None = None,
    ) -> tuple[Places, Index, Index]:
        """Places where rays hit: `locations` (H, 3) float64, `index_ray` (H,) and `index_tri` (H,) int64.

        A place is where the ray as given meets the plane of the face as given, in double precision; where the two are
        so nearly parallel that this would lie elsewhere, it is the place in single precision.
        """
        index_tri, index_ray, locations = self.intersects_id(
            ray_origins,
            ray_directions,
            multiple_hits=multiple_hits,
            max_hits=max_hits,
            return_locations=True,
        )
        return locations, index_ray, index_tri

    def intersects_first(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> Index:
        """The face that each ray hits first, (N,) int64; −1 where it hits none."""
        mesh = self._current()
        return mesh.closest(mesh.rays(*_matching(ray_origins, ray_directions)))[0]

    def intersects_any(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> NDArray[np.bool_]:
        """Whether each ray hits the mesh, (N,) bool."""
        mesh = self._current()
        return mesh.blocked(mesh.rays(*_matching(ray_origins, ray_directions)))

    def contains_points(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Whether `points` (N, 3) lie in the solid that the mesh bounds, (N,) bool. Points of its surface do.

        Inside is where a ray crosses the surface an odd number of times: hollows are outside, and so is what two
        solids of one mesh share. Exact for a mesh whose every edge belongs to an even number of faces; for one with
        open edges the majority of six directions decides.
        """
        return self._current().contains(finite("points", points))

    def _current(self) -> Asked:
        """The mesh as it is now."""
        version = _version(self.mesh)
        if version != self._version:
            self._asked, self._version = Asked(mesh_of(self.mesh)), version
        return self._asked

    def __reduce__(self) -> tuple[Any, ...]:
        """It is copied and pickled as its mesh."""
        return TrimeshRay, (self.mesh,)

    def __repr__(self) -> str:
        """`<TrimeshRay: 12 faces>`."""
        return f"<TrimeshRay: {self._current().count:,} faces>"


def _version(mesh: Any) -> int:
    """A number that changes with the mesh where its type gives one: a trimesh hashes what it consists of."""
    own = getattr(type(mesh), "__hash__", None)
    return 0 if own is None or own is object.__hash__ else hash(mesh)


def _matching(ray_origins: ArrayLike, ray_directions: ArrayLike) -> tuple[Places, Places]:
    origins, directions = finite("ray_origins", ray_origins), finite("ray_directions", ray_directions)
    if origins.shape != directions.shape:
        raise ValueError(
            f"ray_origins has shape {origins.shape}, ray_directions has shape {directions.shape}: one direction per "
            "origin is needed"
        )
    return origins, directions
