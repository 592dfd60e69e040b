"""Rays against Embree 4 by its C interface (single and packets), build and memory of the tree: the bench of
crates/antumbra-trace.

On antumbra's built-in race scenes, handed over as plain triangles. One core, processor time; the build on two threads
is measured on the clock.
"""

from __future__ import annotations

import tempfile
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from peers import embree_library
from race import Row, cargo_bench, cores, options, ratios, report, spread
from scenes import Mesh, builtin

# Least speed over Embree's single rays: any hit and closest hit, by how Embree's scene was built.
ANY = {"robust": 0.9, "default": 0.75}
CLOSEST = {"robust": 0.5, "default": 0.5}
# By class of rays: its number in the table of targets, least speed over the fastest of Embree's ways, and where it
# differs by scene.
BEST: dict[str, tuple[str, float, dict[str, float]]] = {
    "area light": ("2", 1.0, {"scan": 0.85}),
    "area light × 16": ("3", 1.3, {"scan": 0.95}),
    "ambient × 16": ("4", 1.0, {}),
    "ambient, short × 16": ("5", 1.2, {"hall": 0.95, "scan": 0.95, "pillars": 2.0}),
    "sun": ("6b", 0.8, {}),
    "point light": ("6b", 0.8, {}),
}
NEAREST = ("camera", "bounce")
# What is fewer triangles than this says little of a build.
LARGE = 300_000


def main() -> None:
    """Exports the scenes, runs the bench, reads what it found."""
    asked = options(__doc__, scenes="interior,hall,terrain,scan,pillars")
    library = embree_library()
    if library is None:
        print("     left out: the wheel embreex, which brings Embree, is not installed")
        return
    rows: list[Row] = []
    for name in asked.scenes.split(","):
        small = {"boxes": 1000} if name == "hall" else {"triangles": 20_000} if name == "scan" else {}
        found = bench(library, builtin(name, **(small if asked.quick else {})), asked.quick)
        rows += [row for one in found for row in read(one)]
    report(rows, asked.result)


def bench(library: Path, mesh: Mesh, quick: bool) -> list[dict[str, Any]]:
    """What the bench says of one scene."""
    with tempfile.TemporaryDirectory() as folder:
        write(mesh, Path(folder) / f"{mesh.name}.mesh")
        only = {"ANTUMBRA_CLASS": "area light"} if quick else {}
        known = {"ANTUMBRA_EMBREE": str(library), "ANTUMBRA_MESHES": folder}
        found: list[dict[str, Any]] = []
        for threads in (1, 2):
            with cores(threads):
                found += cargo_bench(
                    "antumbra-trace", "embree", ANTUMBRA_THREADS=str(threads), **known, **only
                )
        return found


def write(mesh: Mesh, file: Path) -> None:
    """A scene as the bench reads it (`given.rs`)."""
    centre, half = mesh.light
    head = np.array([len(mesh.vertices), len(mesh.faces)], "<u4").tobytes()
    looks = np.concatenate([*mesh.view, centre, [half]]).astype("<f4").tobytes()
    file.write_bytes(
        head + looks + mesh.vertices.astype("<f4").tobytes() + mesh.faces.astype("<u4").tobytes()
    )


def read(one: dict[str, Any]) -> list[Row]:
    """Rows of one line of the bench."""
    if "class" in one:
        return speeds(one)
    large = one["triangles"] >= LARGE
    if one["threads"] > 1:
        ours, high, _ = one["build_seconds"]
        row = _row(
            "7",
            f"{one['scene']}: build",
            "Embree HIGH",
            2,
            "our time on the clock / Embree's",
            ratios(ours, high),
        )
        row.target, row.bound = (2.0 if large else None), "most"
        times = [f"{spread(seconds)['median']:.3f}" for seconds in (ours, high)]
        row.more = {"triangles": one["triangles"], "seconds, ours and Embree's": ", ".join(times)}
        return [row]
    ours, theirs, _ = one["bytes_per_triangle"]
    fields = spread([ours / theirs])
    row = _row("8", f"{one['scene']}: memory of the tree", "Embree HIGH", 1, "our bytes / Embree's", fields)
    row.target, row.bound = (1.5 if large else None), "most"
    times = f"{ours:.0f}, {theirs:.0f}"
    row.more = {"triangles": one["triangles"], "bytes a triangle, ours and Embree's": times}
    return [row]


def speeds(one: dict[str, Any]) -> list[Row]:
    """Speed over both of Embree's scenes."""
    rows = []
    nearest = one["class"] in NEAREST
    for k, (kind, key) in enumerate(
        (("default", "speed_over_embree"), ("robust", "speed_over_embree_robust"))
    ):
        low, high = one["spread"][2 * k : 2 * k + 2]
        fields = {"median": one[key], "low": low, "high": high, "rounds": 7}
        peer = f"{'rtcIntersect1' if nearest else 'rtcOccluded1'}, {kind}"
        work = f"{one['scene']}: {one['class']}"
        row = _row("6" if nearest else "1", work, peer, 1, "processor time, Embree / ours", fields)
        row.target = (CLOSEST if nearest else ANY)[kind]
        row.more = {
            "Mray/s": one["mrays_per_second"],
            "differ": one["answers_differ"][k],
            "asked": one["rays"],
        }
        rows.append(row)
    if one["class"] in BEST:
        rows.append(best(one))
    return rows


def best(one: dict[str, Any]) -> Row:
    """Speed over the fastest of Embree's ways."""
    number, target, apart = BEST[one["class"]]
    low, high = one["spread"][4:6]
    fields = {"median": one["speed_over_best"], "low": low, "high": high, "rounds": 7}
    peer = f"fastest way ({one['best_mode']})"
    row = _row(number, f"{one['scene']}: {one['class']}", peer, 1, "processor time, Embree / ours", fields)
    row.target = apart.get(one["scene"], target)
    row.more = {"Mray/s, ours and Embree's": [one["mrays_per_second"], one["best_mrays_per_second"]]}
    return row


def _row(number: str, work: str, peer: str, threads: int, measure: str, fields: dict[str, Any]) -> Row:
    return Row(
        "embree", number, work, f"{peer} (Embree 4, embreex {version('embreex')})", threads, measure, **fields
    )


if __name__ == "__main__":
    main()
