"""Start-up: a whole process of `antumbra --help`, and of `antumbra info` on a small GLB."""

from __future__ import annotations

import json
import os
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from race import Row, options, report, spread

NUMBER, TARGET = "15", 0.4


def main() -> None:
    """Twenty processes each, in turn."""
    asked = options(__doc__, times=20)
    times = 3 if asked.quick else asked.times
    program = str(Path(sys.executable).parent / "antumbra")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "tetrahedron.glb"
        file.write_bytes(tetrahedron())
        calls = {
            "antumbra --help": [program, "--help"],
            "antumbra info tetrahedron.glb": [program, "info", str(file)],
        }
        taken: dict[str, list[tuple[float, float]]] = {name: [] for name in calls}
        for turn in range(times + 1):
            for name, words in calls.items():
                seconds = process(words)
                if turn > 0:
                    taken[name].append(seconds)
    rows = []
    for name, seconds in taken.items():
        wall, processor = zip(*seconds, strict=True)
        row = Row(
            "start", NUMBER, name, "", 1, "seconds on the clock", **spread(wall), target=TARGET, bound="most"
        )
        row.more = {"processor s": round(spread(processor)["median"], 3)}
        rows.append(row)
    report(rows, asked.result)


def process(words: list[str]) -> tuple[float, float]:
    """Time on the clock and processor time of one process [s]."""
    before, began = os.times(), time.perf_counter()
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    wall, after = time.perf_counter() - began, os.times()
    return wall, after.children_user + after.children_system - before.children_user - before.children_system


def tetrahedron() -> bytes:
    """Four triangles as a GLB."""
    points = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)
    corners = struct.pack("<12H", 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3)
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": 4,
                "type": "VEC3",
                "min": [0] * 3,
                "max": [1] * 3,
            },
            {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": len(points)},
            {"buffer": 0, "byteOffset": len(points), "byteLength": len(corners)},
        ],
        "buffers": [{"byteLength": len(points) + len(corners)}],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary = points + corners
    head = b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(binary))
    return (
        head
        + struct.pack("<I", len(text))
        + b"JSON"
        + text
        + struct.pack("<I", len(binary))
        + b"BIN\0"
        + binary
    )


if __name__ == "__main__":
    main()
