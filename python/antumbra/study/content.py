"""What a scene's file holds, with the files that it names, as one number."""

from __future__ import annotations

import glob
import hashlib
import json
import re
from collections.abc import Iterator
from html import unescape
from pathlib import Path
from typing import Any
from urllib.parse import unquote

# The first bytes of a binary glTF, and its JSON's length and place in it (glTF 2.0, section 4.4).
_GLB, _LENGTH, _JSON = b"glTF", slice(12, 16), 20


def content(scene: Path) -> str:
    """Changes with the bytes of a scene's file and of those beside it that it names; the same if those are the same."""
    seen = hashlib.sha256()
    waiting, known = [scene], {scene}
    while waiting:
        file = waiting.pop(0)
        try:
            data = file.read_bytes() if file.is_file() else b""
        except OSError:
            # What cannot be read is told when the scene is.
            data = b""
        seen.update(hashlib.sha256(data).digest())
        names = list(_named(file.suffix.lower(), data))
        folders = dict.fromkeys((scene.parent, file.parent))
        beside = [found for name in names for folder in folders for found in _at(folder, name)]
        waiting += [f for f in dict.fromkeys(beside) if f not in known]
        known.update(beside)
    return seen.hexdigest()


def _named(suffix: str, data: bytes) -> Iterator[str]:
    """What a glTF, an OBJ, an MTL, a Mitsuba XML or a pbrt file names, relative to it.

    Of the last two, any quoted text may be a name.
    """
    if data.lstrip(_BLANK).startswith(b"<"):
        yield from dict.fromkeys(
            unescape(a or b) for a, b in _QUOTED.findall(data.decode("utf-8", "replace"))
        )
    elif suffix == ".pbrt":
        yield from dict.fromkeys(name.decode("utf-8", "replace") for name in _STRING.findall(data))
    elif suffix in (".gltf", ".glb"):
        if data.startswith(_GLB):
            data = data[_JSON : _JSON + int.from_bytes(data[_LENGTH], "little")]
        try:
            yield from _uris(json.loads(data))
        except (ValueError, RecursionError):
            return
    elif suffix in (".obj", ".mtl"):
        for line in data.splitlines():
            key, *words = line.decode("utf-8", "replace").split(maxsplit=1)[:2] or [""]
            if words and (key.lower() == "mtllib" if suffix == ".obj" else key.lower().startswith(_MAPS)):
                # A name may have spaces, stand after options, or be one of several.
                yield from dict.fromkeys([words[0].strip(), *words[0].split()])


def _at(folder: Path, name: str) -> list[Path]:
    """The files of that name; of one with parameters (`$name`), all that it may come to be."""
    try:
        if "$" in name:
            pattern = "*".join(glob.escape(part) for part in _PARAMETER.split(name))
            root = Path(pattern).anchor
            found = (Path(root) if root else folder).glob(pattern.removeprefix(root))
            return sorted(path for path in found if path.is_file())
        return [folder / name] if (folder / name).is_file() else []
    except (OSError, ValueError):
        # Too long for a name, or with a zero: no file's.
        return []


_STRING = re.compile(rb'"([^"\n]*)"')
_QUOTED = re.compile(r"""=\s*(?:"([^"]*)"|'([^']*)')""")
_PARAMETER = re.compile(r"\$[\w-]+")
# White space and the byte order mark, which may stand before an XML's first tag.
_BLANK = b" \t\r\n\xef\xbb\xbf"
_MAPS = ("map_", "bump", "norm", "disp")


def _uris(part: Any) -> Iterator[str]:
    if isinstance(part, dict):
        uri = part.get("uri")
        if isinstance(uri, str) and not uri.startswith("data:"):
            yield unquote(uri)
        part = list(part.values())
    if isinstance(part, list):
        for inner in part:
            yield from _uris(inner)
