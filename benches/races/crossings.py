"""`trimesh_ray` against the two engines of trimesh: the same rays, one thread, in turn.

trimesh's own engine gets one in 250 of the rays; what is compared is the time of one ray. Both peers answer with their
own rounding: how many rays differ stands beside it (`benches/engines.py` says who is right where answers are known).
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

import antumbra as am
from race import Row, cores, in_turn, options, report, spread

Array = NDArray[Any]
NUMBER = "9"
# So many times fewer rays for the engine without a compiled core.
FEWER = 250
# What is asked: how the answer is made, and which numbers of it are compared.
QUESTIONS: dict[str, Callable[[Any, Array, Array], Array]] = {
    "intersects_any": lambda ray, o, d: ray.intersects_any(o, d),
    "intersects_first": lambda ray, o, d: ray.intersects_first(o, d) >= 0,
    "intersects_location, all hits": lambda ray, o, d: np.bincount(
        ray.intersects_location(o, d, multiple_hits=True)[1], minlength=len(o)
    ),
    "contains_points": lambda ray, o, d: ray.contains_points(o + 0.75 * d),
}


def main() -> None:
    """All meshes, questions and engines."""
    asked = options(__doc__, size=200_000)
    size = min(asked.size, 20_000) if asked.quick else asked.size
    rows = []
    for name, mesh in meshes().items():
        engines = engines_of(mesh)
        ours = am.trimesh_ray(mesh)
        origins, directions = rays(mesh, size)
        few = origins[: size // FEWER], directions[: size // FEWER]
        for question, ask in QUESTIONS.items():
            parts = [(ours, (origins, directions))]
            parts += [
                (ray, (origins, directions) if who.startswith("embreex") else few)
                for who, ray in engines.items()
            ]
            answers = [lambda ray=ray, part=part, ask=ask: ask(ray, *part) for ray, part in parts]
            with cores(1):
                times = in_turn(answers, asked.rounds)
            mine = answers[0]()
            each = [np.array(t.processor) / len(part[0]) for t, (_, part) in zip(times, parts, strict=True)]
            for (who, _), answer, taken in zip(engines.items(), answers[1:], each[1:], strict=True):
                other = answer()
                line = Row(
                    "crossings",
                    NUMBER,
                    f"{name}: {question}",
                    who,
                    1,
                    "processor time of the peer / ours",
                    **spread(list(taken / each[0])),
                )
                line.more = {
                    "µs a ray, ours and theirs": f"{np.median(each[0]) * 1e6:.2f}, {np.median(taken) * 1e6:.2f}",
                    "differ": int((mine[: len(other)] != other).sum()),
                    "asked": len(other),
                }
                rows.append(line)
    report(rows, asked.result)


def meshes() -> dict[str, Any]:
    """A ball, and a knot of many turns that a ray crosses up to a dozen times."""
    create = importlib.import_module("trimesh.creation")
    ball = create.icosphere(subdivisions=5)
    turns = np.linspace(0, 2 * np.pi, 1200, endpoint=False)
    knot = np.stack(
        [
            (2 + np.cos(7 * turns)) * np.cos(3 * turns),
            (2 + np.cos(7 * turns)) * np.sin(3 * turns),
            np.sin(7 * turns),
        ],
        axis=1,
    )
    return {"ball, 20,480 faces": ball, "knot, 38,400 faces": tube(knot, 0.2, 16)}


def tube(path: Array, radius: float, around: int) -> Any:
    """A closed tube along a closed path."""
    ahead = np.roll(path, -1, axis=0) - np.roll(path, 1, axis=0)
    side = np.cross(ahead, [0.3, 0.2, 1.0])
    side /= np.linalg.norm(side, axis=1)[:, None]
    up = np.cross(side, ahead)
    up /= np.linalg.norm(up, axis=1)[:, None]
    angle = 2 * np.pi * np.arange(around) / around
    rings = path[:, None] + radius * (
        side[:, None] * np.cos(angle)[:, None] + up[:, None] * np.sin(angle)[:, None]
    )
    n = len(path)
    i, j = (x.reshape(-1) for x in np.meshgrid(np.arange(n), np.arange(around), indexing="ij"))
    a, b = i * around + j, (i + 1) % n * around + j
    c, d = (i + 1) % n * around + (j + 1) % around, i * around + (j + 1) % around
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return importlib.import_module("trimesh").Trimesh(rings.reshape(-1, 3), faces, process=False)


def engines_of(mesh: Any) -> dict[str, Any]:
    """trimesh's engines for a mesh."""
    version = importlib.import_module("trimesh").__version__
    embreex = importlib.import_module("trimesh.ray.ray_pyembree").RayMeshIntersector(mesh)
    own = importlib.import_module("trimesh.ray.ray_triangle").RayMeshIntersector(mesh)
    return {f"embreex in trimesh {version}": embreex, f"trimesh {version} alone": own}


def rays(mesh: Any, count: int) -> tuple[Array, Array]:
    """From a ball around the mesh to points in it, seeded."""
    rng = np.random.default_rng(14)
    middle, size = mesh.bounds.mean(axis=0), np.ptp(mesh.bounds)
    out = rng.normal(size=(count, 3))
    origins = middle + size * out / np.linalg.norm(out, axis=1)[:, None]
    aims = rng.uniform(*mesh.bounds, (count, 3))
    return origins, aims - origins


if __name__ == "__main__":
    main()
