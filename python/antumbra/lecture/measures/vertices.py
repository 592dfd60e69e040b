"""Openness computed at the vertices of a mesh and interpolated between them, against what each point sees."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.ratio import farthest_from_one, ratio
from antumbra.lecture.measures.replicates import mean_of, of_interval, slope_of_root
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.open_box import EDGE, FLOOR, TRAY, Patch, around, open_box
from antumbra.lecture.scenes.square_lights import irradiance_under
from antumbra.lecture.variant import Pick
from antumbra.scene import Scene
from antumbra.study import statistics

Floats = NDArray[np.float64]

# Cells along the edge of the box, empty, with the body, and with the mesh cut along its edges.
SMOOTH_CELLS, BODY_CELLS, CUT_CELLS = [3, 6, 12], [8, 16, 32], [3, 6, 12]
CELLS = {"empty": SMOOTH_CELLS, "body": BODY_CELLS, "along": CUT_CELLS}
# RMS errors of one cell and of 2 × 2 on the floor of a cube (quadrature of the closed form).
CUBE = {1: 0.06542137235235, 2: 0.01603618598543}
# Places of the body, rays of a vertex and of a point, points along the edge of the floor.
PLACES, _RAYS, _SIDE = Pick(14, 32), Pick(128, 256), Pick(32, 64)
# Where its corner may be: a whole number of cells of each mesh, so that its edges cross cells anywhere alike.
_NEAREST, _PERIOD = 0.25, 0.25
_SURE = Pick(1 << 14, 1 << 16)


def baked(scene: Scene, patch: Patch, cells: int, rays: int, seed: int) -> Floats:
    """Openness at the vertices of a patch, (M, N)."""
    at = patch.vertices(cells)
    found = scene.ambient_occlusion(at.reshape(-1, 3), patch.normal, rays=rays, seed=seed)
    return np.asarray(found, np.float64).reshape(at.shape[:2])


def interpolated(values: Floats, patch: Patch, points: Floats) -> Floats:
    """Bilinear between the vertices of a patch, at points (N, 3) on it."""
    (m, n), places = values.shape, patch.places(points)
    x, y = (np.clip(p, 0, 1) * (k - 1) for p, k in zip(places, (m, n), strict=True))
    i, j = np.minimum(x.astype(int), m - 2), np.minimum(y.astype(int), n - 2)
    s, t = x - i, y - j
    low = (1 - t) * values[i, j] + t * values[i, j + 1]
    high = (1 - t) * values[i + 1, j] + t * values[i + 1, j + 1]
    return np.asarray((1 - s) * low + s * high, np.float64)


def openness(x: Floats, z: Floats, height: float) -> Floats:
    """Closed form on the floor of the empty box: the form factor of its opening, walls of this height."""
    at = np.vectorize(lambda a, b: irradiance_under(1.0, height, a - 0.5, b - 0.5) / math.pi)
    return np.asarray(at(x, z), np.float64)


def exact(cells: int, height: float) -> float:
    """RMS error on the floor of the empty box by the closed form, at vertices and between: quadrature at 64² points."""
    at = FLOOR.vertices(cells)
    values = openness(at[..., 0], at[..., 2], height)
    points, truth = _floor(height)
    return math.sqrt(((interpolated(values, FLOOR, points) - truth) ** 2).mean())


@cache
def _floor(height: float) -> tuple[Floats, Floats]:
    """Points all over the floor of the empty box, and their openness."""
    middle = (np.arange(64) + 0.5) / 64
    x, z = (a.ravel() for a in np.meshgrid(middle, middle))
    return np.stack([x, 0 * x, z], 1), openness(x, z, height)


def _empty(run: Run, cells: int, height: float) -> Quantity:
    """RMS error in the empty box against the closed form, by four replicates of the vertices."""
    points, truth = _floor(height)
    scene, rays = run.scene(open_box(height)), run.pick(_SURE)
    each = [baked(scene, FLOOR, cells, rays, run.seeded(k)) for k in range(4)]
    return mean_of([math.sqrt(((interpolated(v, FLOOR, points) - truth) ** 2).mean()) for v in each])


class _Body:
    """One place of the body: points of the floor beside it, and what they see."""

    def __init__(self, run: Run, k: int) -> None:
        self.run, self.k = run, k
        draw = np.random.default_rng(run.seeded(k))
        self.place = _NEAREST + _PERIOD * draw.random(2)
        self.scene = run.scene(open_box(TRAY, (float(self.place[0]), float(self.place[1]))))
        side = run.pick(_SIDE)
        cell = np.stack(np.meshgrid(np.arange(side), np.arange(side)), -1).reshape(-1, 2)
        flat = (cell + draw.random(cell.shape)) / side
        free = ((flat < self.place) | (flat > self.place + EDGE)).any(1)
        self.points = np.insert(flat[free], 1, 0.0, axis=1)
        self.share = 1 - EDGE**2
        self.truth = [self._seen(self.points, seed) for seed in (0, 1)]

    def _seed(self, which: int) -> int:
        return self.run.seeded(2 * self.k + which + 64)

    def _seen(self, points: Floats, which: int) -> Floats:
        found = self.scene.ambient_occlusion(
            points, (0.0, 1.0, 0.0), rays=self.run.pick(_RAYS), seed=self._seed(which)
        )
        return np.asarray(found, np.float64)

    def square(self, patches: Sequence[Patch], cells: int) -> float:
        """Mean squared error of a mesh on these patches: the product of two independent errors, free of their noise."""
        off = []
        for which in (0, 1):
            values = np.empty(len(self.points))
            for patch in patches:
                on = patch.holds(self.points)
                grid = baked(self.scene, patch, cells, self.run.pick(_RAYS), self._seed(which + 2) + 1024)
                values[on] = interpolated(grid, patch, self.points[on])
            off.append(values - self.truth[which])
        return float((off[0] * off[1]).mean())

    def phase(self, cells: int) -> float:
        """Mean squared error that is expected here over ∮ A² ds / 12 n, less 1: 0 over all places.

        Where a part f of a cell's width is outside of the body, the blend is off by A t/h at t from its vertex: by
        A² h f³ / 3 in the square, and f³ is 1/4 on average.
        """
        low, high = cells * self.place % 1, -cells * (self.place + EDGE) % 1
        return float(4 * (np.stack([low, high]) ** 3).mean() - 1)

    def predicted(self) -> float:
        """Mean squared error times cells: ∮ A² ds / 12 over the area, A the openness just outside of the contact."""
        s = (np.arange(64) + 0.5) / 64 * EDGE
        low, high = self.place - 1e-4, self.place + EDGE + 1e-4
        (x, z), zero = self.place, np.zeros(64)
        sides = [
            (x + s, zero + low[1]), (x + s, zero + high[1]), (zero + low[0], z + s), (zero + high[0], z + s)
        ]  # fmt: skip
        points = np.concatenate([np.stack([a, zero, b], 1) for a, b in sides])
        products = self._seen(points, 0) * self._seen(points, 1)
        return float(products.mean()) * 4 * EDGE / 12 / self.share


def _with_body(run: Run) -> dict[str, Quantity]:
    places = run.pick(PLACES)
    squares: dict[str, list[list[float]]] = {"body": [], "along": []}
    phases, predicted = [], []
    for k in range(places):
        run.at(k / places, "a body on the floor")
        one = _Body(run, k)
        squares["body"].append([one.square([FLOOR], n) for n in BODY_CELLS])
        squares["along"].append([one.square(around(*one.place), n) for n in CUT_CELLS])
        phases.append([one.phase(n) for n in BODY_CELLS])
        predicted.append(one.predicted())
    # A control variate of mean 0: where in their cells the edges of the few bodies happen to be is known.
    drawn = np.mean(predicted) * np.array(phases) / BODY_CELLS
    squares["body"] = (np.array(squares["body"]) - drawn).tolist()
    found = _roots("body", BODY_CELLS, squares) | _roots("along", CUT_CELLS, squares)
    low, high = (2**end for end in found["body"].interval)
    halved = of_interval(statistics.Interval(2 ** found["body"].value, low, high))
    # All but the coarsest mesh, on whose cells the openness changes: squared error times cells is the same for each.
    each = (np.array(squares["body"]) * BODY_CELLS)[:, 1:].mean(1)
    line = ratio(mean_of(each), mean_of(predicted))
    return found | {"halved": halved, "line": line, "contact": mean_of(predicted)}


def _roots(name: str, cells: Sequence[int], squares: dict[str, list[list[float]]]) -> dict[str, Quantity]:
    """RMS error by number of cells, and its slope, by all places of the body."""
    each = np.array(squares[name])
    means = [statistics.root(statistics.mse_of(column)) for column in each.T]
    found = {f"{name}-{n}": of_interval(root) for n, root in zip(cells, means, strict=True)}
    return found | {name: of_interval(slope_of_root(cells, each))}


def errors_of_meshes(run: Run) -> dict[str, Quantity]:
    """What the meshes are off by, and what of it is predicted.

    `empty-n`, `body-n`, `along-n`: RMS error with n cells along the edge, in the empty box, with a body on the floor,
    and with the mesh cut along its edges; `body`, `along`: slopes against n; `halved`: the factor of the error for
    half the edge, `quarter`: in the empty box; `line`: squared error over what the contact line alone predicts;
    `cube`: error of one cell and of 2 × 2 in the cube over the exact one, that which is farther off.
    """
    empty = {f"empty-{n}": _empty(run, n, TRAY) for n in SMOOTH_CELLS}
    cube = farthest_from_one(ratio(_empty(run, n, 1.0), Quantity(known)) for n, known in CUBE.items())
    quarter = ratio(empty["empty-12"], empty["empty-6"])
    return empty | {"cube": cube, "quarter": quarter} | _with_body(run)
