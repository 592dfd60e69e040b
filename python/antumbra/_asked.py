"""A mesh that is asked about rays and points: in single precision for the core, in double as it was given."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra._arrays import finite, indices
from antumbra._boxes import Boxes
from antumbra._crossings import crossings
from antumbra._inside import inside, is_closed
from antumbra._law import cross, dot, minus, vectors
from antumbra._meshes import Triangles
from antumbra.scene import Scene

Doubles = NDArray[np.float64]
Singles = NDArray[np.float32]
Index = NDArray[np.int64]

# A start that lies farther from the mesh than so many of its sizes is drawn up to it.
FAR = 4.0
# Farther than this, in sizes of the mesh, a place does not move when it is computed again in double precision.
SHARP = 2.0**-18
# Between these, directions fit single precision as they are.
TINY, HUGE = 2.0**-40, 2.0**40
# Smaller components of a direction are 0: their reciprocals would not fit.
NONE = 2.0**-100


class Rays(NamedTuple):
    """Rays relative to the mesh's origin and in its unit, (N, 3) each: as given, and as the core takes them."""

    origins: Doubles
    directions: Doubles
    starts: Singles
    along: Singles


class Asked:
    """The triangles of one mesh, with the scene and the trees that questions need."""

    def __init__(self, mesh: Triangles) -> None:
        """Raises ValueError or TypeError for arrays that are no triangles."""
        self._vertices = finite("vertices", mesh.vertices)
        self._faces = indices("faces", mesh.faces, 3, len(self._vertices), "vertex").astype(np.int64)
        self.count = len(self._faces)
        low, high = self._vertices.min(axis=0), self._vertices.max(axis=0)
        # A coarse grid: coordinates that single precision holds lose nothing when such a number is taken from them.
        step = 2.0 ** np.ceil(np.log2(2 * np.max(high - low))) if np.any(high > low) else 1.0
        self._origin = np.round((low + high) / 2 / step) * step
        # In units of a power of two, which loses nothing, the size is 1/2 to 1: none is too large or too small.
        self._unit = 2.0 ** np.frexp(np.abs(self._vertices - self._origin).max())[1]
        self._local = (self._vertices - self._origin) / self._unit
        self._single = self._local.astype(np.float32)
        self._size = float(np.abs(self._local).max())
        self._scene = Scene()
        self._scene.add_mesh(self._single, self._faces)

    @cached_property
    def _single_corners(self) -> Doubles:
        corners: Doubles = self._single.astype(np.float64)[self._faces]
        return corners

    @cached_property
    def _single_boxes(self) -> Boxes:
        return Boxes(self._single_corners.astype(np.float32))

    @cached_property
    def _corners(self) -> Doubles:
        corners: Doubles = (self._vertices / self._unit)[self._faces]
        return corners

    @cached_property
    def _boxes(self) -> Boxes:
        return Boxes(self._corners)

    @cached_property
    def _closed(self) -> bool:
        return is_closed(self._vertices, self._faces)

    def rays(self, origins: Doubles, directions: Doubles) -> Rays:
        """Rays of the world; those that start far away are drawn up to the mesh."""
        o, d = (origins - self._origin) / self._unit, directions
        length = _largest(d)
        odd = np.flatnonzero((length < TINY) | (length > HUGE))
        if len(odd):
            # By powers of two only, so that directions keep all their digits.
            d = d.copy()
            d[odd] = np.ldexp(d[odd], -np.frexp(length[odd])[1][:, None])
        far = np.flatnonzero(_largest(o) > FAR * self._size)
        if len(far):
            o, d = o.copy(), d.copy()
            o[far], d[far] = self._drawn_up(o[far], d[far])
        single = d.astype(np.float32)
        single[np.abs(single) < NONE] = 0
        return Rays(o, d, o.astype(np.float32), single)

    def _drawn_up(self, o: Doubles, d: Doubles) -> tuple[Doubles, Doubles]:
        """Starts near the mesh on the same rays; those that surely pass it stand at 0 without a direction."""
        ball = 2 * np.sqrt(3) * self._size
        with np.errstate(all="ignore"):
            d = d / np.sqrt(np.einsum("ij,ij->i", d, d))[:, None]
            toward = np.einsum("ij,ij->i", o, d) < 0
            # To where the line is nearest to the origin; again, because the first step is as coarse as it is long.
            for _ in range(2):
                o = o - np.einsum("ij,ij->i", o, d)[:, None] * d
            passes = ~(toward & (np.einsum("ij,ij->i", o, o) <= ball * ball))
        o, d = o - ball * d, d.copy()
        o[passes], d[passes] = 0.0, 0.0
        return o, d

    def blocked(self, rays: Rays) -> NDArray[np.bool_]:
        """Whether each ray meets something."""
        return self._scene.occluded(rays.starts, directions=rays.along)

    def closest(self, rays: Rays) -> tuple[Index, Doubles]:
        """The face that each ray meets first, −1 for none, and t."""
        hit = self._scene.closest_hit(rays.starts, rays.along)
        return np.where(np.isfinite(hit.t), hit.primitive.astype(np.int64), -1), hit.t

    def first_hits(self, rays: Rays) -> tuple[Index, Index, Doubles]:
        """Ray, face and t of the first hit of each ray that meets something."""
        faces, t = self.closest(rays)
        met = np.flatnonzero(faces >= 0)
        return met, faces[met], t[met]

    def all_hits(self, rays: Rays) -> tuple[Index, Index, Doubles]:
        """Ray, face and t of all hits, sorted by ray and distance; each place once."""
        # Only rays that meet something go on.
        met = np.flatnonzero(self.blocked(rays))
        which, faces, t = crossings(
            self._single_boxes, self._single_corners, rays.starts[met], rays.along[met]
        )
        return met[which], faces, t

    def locations(self, rays: Rays, which: Index, faces: Index, t: Doubles) -> Doubles:
        """(H, 3): where rays meet the planes of faces, in double precision where that is sharp."""
        single = rays.starts[which] + t[:, None] * rays.along[which]
        o, d = vectors(rays.origins[which]), vectors(rays.directions[which])
        a, b, c = (vectors(self._local[self._faces[faces, k]]) for k in range(3))
        normal = cross(minus(b, a), minus(c, b))
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            reach = dot(minus(a, o), normal) / dot(d, normal)
            double = np.stack(o, axis=1) + reach[:, None] * np.stack(d, axis=1)
            sharp = np.abs(double - single).max(axis=1, initial=0.0) <= SHARP * self._size
        places: Doubles = self._origin + self._unit * np.where(sharp[:, None], double, single)
        return places

    def contains(self, points: Doubles) -> NDArray[np.bool_]:
        """Whether points lie inside or on the surface."""
        return inside(self._boxes, self._corners, points / self._unit, self._closed)


def _largest(rows_: Doubles) -> Doubles:
    """The largest absolute component of each row."""
    x, y, z = np.abs(rows_).T
    found: Doubles = np.maximum(np.maximum(x, y), z)
    return found
