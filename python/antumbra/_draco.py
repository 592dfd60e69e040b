"""Unpacks Draco meshes with the package DracoPy, the extra `antumbra[draco]`. Called by the core."""

from __future__ import annotations

from typing import Any

# Component types of glTF 2.0, section 5.1.3.
_KINDS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}


def decode(data: bytes, wanted: list[tuple[int, int]]) -> tuple[bytes, list[bytes]]:
    """The indices as u32 and each attribute that is wanted, by (number, component type of glTF), as bytes."""
    import DracoPy  # type: ignore[import-not-found,unused-ignore]
    import numpy as np

    mesh: Any = DracoPy.decode(data)
    faces = getattr(mesh, "faces", None)
    if faces is None:
        raise ValueError("it has no triangles")
    attributes = []
    for number, component in wanted:
        found = mesh.get_attribute_by_unique_id(number)
        if found is None:
            raise ValueError(f"it has no attribute {number}")
        attributes.append(np.ascontiguousarray(found["data"], dtype=_KINDS[component]).tobytes())
    return np.ascontiguousarray(faces, dtype="<u4").tobytes(), attributes
