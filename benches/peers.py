"""Programs that answer the same question with Embree inside: arrays of rays in, one answer a ray out."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scenes import Mesh, Rays

Answer = Callable[[], NDArray[np.bool_]]


def antumbra(mesh: Mesh) -> Callable[[Rays, int], Answer]:
    """Ours. The number of threads is that of the cores that the process may use."""
    scene = mesh.scene()
    return lambda r, _: lambda: scene.occluded(r.origins, directions=r.directions, max_distance=r.reach)


def embreex(mesh: Mesh) -> Callable[[Rays, int], Answer]:
    """Ray by ray from a compiled loop; it has one thread only."""
    scene = importlib.import_module("embreex.rtcore_scene").EmbreeScene()
    triangles = importlib.import_module("embreex.mesh_construction").TriangleMesh
    kept = triangles(scene, mesh.vertices, mesh.faces.astype(np.int32))

    def of(r: Rays, _: int) -> Answer:
        reach = None if np.isinf(r.reach) else np.full(len(r.origins), r.reach, np.float32)

        def answer(_keep: Any = kept) -> NDArray[np.bool_]:
            return np.asarray(scene.run(r.origins, r.directions, reach, query="OCCLUDED")) != -1

        return answer

    return of


def open3d(mesh: Mesh) -> Callable[[Rays, int], Answer]:
    """Blocks of rays over threads; takes origin and direction side by side in one tensor."""
    o3d = importlib.import_module("open3d")
    scene = o3d.t.geometry.RaycastingScene()
    scene.add_triangles(o3d.core.Tensor(mesh.vertices), o3d.core.Tensor(mesh.faces.astype(np.uint32)))

    def of(r: Rays, threads: int) -> Answer:
        packed = o3d.core.Tensor(np.concatenate([r.origins, r.directions], axis=1))
        return lambda: scene.test_occlusions(packed, 0.0, r.reach, threads).numpy()

    return of


MAKERS = {"embreex": ("embreex", embreex), "Open3D": ("open3d-cpu", open3d)}


def found() -> dict[str, Callable[[Mesh], Callable[[Rays, int], Answer]]]:
    """The peers that can be loaded here, by name and version; says which cannot and why."""
    out = {}
    for name, (package, maker) in MAKERS.items():
        try:
            importlib.import_module(name.lower() if name == "Open3D" else "embreex.rtcore_scene")
        except (ImportError, OSError) as why:
            print(f"     {name} is left out: {why}")
            continue
        out[f"{name} {version(package)}"] = maker
    return out


def embree_library() -> Path | None:
    """Embree's own library out of the wheel of embreex."""
    try:
        folder = Path(importlib.import_module("embreex").__file__ or "").parent.parent / "embreex.libs"
    except ImportError:
        return None
    return next(iter(sorted(folder.glob("libembree4*"))), None)
