"""What other engines answer to the questions of tests/python/reported.py: how many of their answers are wrong.

`PYTHONPATH=benches:tests/python python benches/engines.py` prints the table of docs/bridges.md for the libraries that
are installed (benches/requirements.txt).
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

import numpy as np
from numpy.typing import NDArray

import antumbra as am
from reported import CASES, Case

Array = NDArray[Any]
Engine = Callable[[Case], Array]

# Places of a ray that are nearer to each other than this are one, relative to the size of the mesh: engines that
# report both sides of an edge are not blamed for it.
SAME = 1e-9


def of_ray(ray: Any, case: Case) -> Array:
    """An object with the methods of `mesh.ray`."""
    if case.question == "inside":
        return np.asarray(ray.contains_points(case.origins))
    if case.question == "blocked":
        return np.asarray(ray.intersects_any(case.origins.copy(), case.directions.copy()))
    places, rays, _ = ray.intersects_location(case.origins.copy(), case.directions.copy(), multiple_hits=True)
    return np.array([distinct(case, i, places[rays == i]) for i in range(len(case.origins))])


def distinct(case: Case, number: int, places: Array) -> int:
    """How many places there are along a ray."""
    if not len(places):
        return 0
    along = np.sort((places - case.origins[number]) @ case.directions[number]) / np.linalg.norm(
        case.directions[number]
    )
    return 1 + int(np.sum(np.diff(along) > SAME * np.ptp(case.vertices)))


def antumbra(case: Case) -> Array:
    """Ours."""
    return of_ray(am.trimesh_ray(trimesh(case)), case)


def trimesh(case: Case) -> Any:
    """The case's mesh, as it is."""
    return importlib.import_module("trimesh").Trimesh(case.vertices, case.faces, process=False)


def default(case: Case) -> Array:
    """The engine that trimesh uses where embreex is not installed."""
    return of_ray(importlib.import_module("trimesh.ray.ray_triangle").RayMeshIntersector(trimesh(case)), case)


def embreex(case: Case) -> Array:
    """The engine that trimesh uses where it is."""
    return of_ray(importlib.import_module("trimesh.ray.ray_pyembree").RayMeshIntersector(trimesh(case)), case)


def open3d(case: Case) -> Array:
    """RaycastingScene, in single precision as it asks for."""
    o3d = importlib.import_module("open3d")
    scene = o3d.t.geometry.RaycastingScene()
    single = case.vertices.astype(np.float32)
    scene.add_triangles(o3d.core.Tensor(single), o3d.core.Tensor(case.faces.astype(np.uint32)))
    if case.question == "inside":
        return scene.compute_occupancy(o3d.core.Tensor(case.origins.astype(np.float32))).numpy() > 0.5
    rays = np.concatenate([case.origins, case.directions], axis=1).astype(np.float32)
    if case.question == "blocked":
        return scene.test_occlusions(o3d.core.Tensor(rays)).numpy()
    found = scene.list_intersections(o3d.core.Tensor(rays))
    which, t = found["ray_ids"].numpy(), found["t_hit"].numpy().astype(float)
    places = case.origins[which] + t[:, None] * case.directions[which]
    return np.array([distinct(case, i, places[which == i]) for i in range(len(rays))])


def pyvista(case: Case) -> Array:
    """`ray_trace`, ray by ray as far as the mesh goes; `select_interior_points`."""
    pv = importlib.import_module("pyvista")
    mesh = pv.PolyData.from_regular_faces(case.vertices, case.faces)
    if case.question == "inside":
        points = pv.PolyData(case.origins)
        return np.asarray(points.select_interior_points(mesh, check_surface=False)["selected_points"], bool)
    counts = []
    for i, (start, along) in enumerate(zip(case.origins, case.directions, strict=True)):
        far = np.linalg.norm(case.vertices - start, axis=1).max()
        places, _ = mesh.ray_trace(start, start + along / np.linalg.norm(along) * far)
        counts.append(distinct(case, i, np.asarray(places).reshape(-1, 3)))
    return np.array(counts) if case.question == "count" else np.array(counts) > 0


ENGINES: dict[str, tuple[str, Engine]] = {
    "antumbra": ("antumbra", antumbra),
    "trimesh": ("trimesh", default),
    "embreex": ("trimesh with embreex", embreex),
    "open3d": ("Open3D", open3d),
    "pyvista": ("PyVista", pyvista),
}


def main() -> None:
    """Prints the table."""
    here = {name: (f"{title} {number(name)}", ask) for name, (title, ask) in ENGINES.items() if found(name)}
    print("| reported | question | asked |" + "".join(f" {title} |" for title, _ in here.values()))
    print("|---|---|---|" + "---|" * len(here))
    for make in CASES:
        case = make()
        wrong = [judged(ask, case) for _, ask in here.values()]
        print(
            f"| {case.report} | {case.what} | {len(case.answer):,} | " + " | ".join(wrong) + " |", flush=True
        )


def judged(ask: Engine, case: Case) -> str:
    """How many answers are wrong, in words of the question."""
    answer = ask(case)
    less, more = int(np.sum(answer < case.answer)), int(np.sum(answer > case.answer))
    parts = [f"{less:,} too few" if less else "", f"{more:,} too many" if more else ""]
    if case.question != "count":
        words = ("said outside", "said inside") if case.question == "inside" else ("missed", "false")
        parts = [f"{n:,} {word}" if n else "" for n, word in zip((less, more), words, strict=True)]
    return ", ".join(filter(None, parts)) or "0"


def number(name: str) -> str:
    """The version of a library, which may be installed under another name."""
    known = getattr(importlib.import_module(name), "__version__", None)
    return known or version(name)


def found(name: str) -> bool:
    """Whether a library can be imported."""
    try:
        importlib.import_module("embreex.rtcore_scene" if name == "embreex" else name)
    except ImportError:
        return False
    return True


if __name__ == "__main__":
    main()
