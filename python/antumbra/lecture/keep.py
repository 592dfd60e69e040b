"""Finished figures are kept: written whole, and used again as long as nothing that made them changed."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from antumbra._made_by import made_by
from antumbra.lecture import catalog

# Another number where what is kept gets another form.
FORM = 2
# Where a figure's files lie: a plain name in one of two folders. A folder from somebody else may say anything.
_PLACE = re.compile(r"(pictures|exr)/[^./\\:\0][^/\\:\0]*")


def key(name: str, quick: bool, seed: int) -> str:
    """A number that changes with everything that a figure's result depends on: sources, core, libraries, size, seed."""
    made = made_by(catalog.sources(name))
    return hashlib.sha256(f"{FORM} {made} {name} {quick} {seed}".encode()).hexdigest()[:16]


class Folder:
    """The folder of a lecture: index.html, lecture.json, pictures/, exr/, and kept/ with what each figure found."""

    def __init__(self, path: Path) -> None:
        """Nothing is made yet."""
        self.path = path

    def check(self, room: int) -> None:
        """Raises OSError if nothing can be written there, or if there are less than `room` free bytes."""
        self.path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=self.path):
            pass
        if shutil.disk_usage(self.path).free < room:
            raise OSError(28, f"less than {room // 1_000_000} MB are free")

    def kept(self, name: str, key: str = "") -> dict[str, Any] | None:
        """What a figure found, if it is finished and its files are still there (and of this key, if one is given)."""
        try:
            found: dict[str, Any] = json.loads(
                (self.path / "kept" / f"{name}.json").read_text(encoding="utf-8")
            )
        except (OSError, ValueError):
            return None
        whole = _is_record(found, name) and all(map(self._is_own, found["files"]))
        return found if whole and key in ("", found["key"]) else None

    def _is_own(self, file: str) -> bool:
        """Whether it is there, and within this folder also where a link leads."""
        path = self.path / file
        return path.is_file() and path.resolve().is_relative_to(self.path.resolve())

    @contextmanager
    def beside(self) -> Iterator[Path]:
        """A folder for what is not finished; it is gone afterwards."""
        made = Path(tempfile.mkdtemp(prefix=".unfinished-", dir=self.path))
        try:
            yield made
        finally:
            shutil.rmtree(made, ignore_errors=True)

    def finish(self, beside: Path, result: dict[str, Any]) -> None:
        """Moves the files of a figure to their places, then keeps what it found."""
        name = result["name"]
        before = self.kept(name)
        # Without its record a figure counts as not finished, should this be cut short.
        (self.path / "kept" / f"{name}.json").unlink(missing_ok=True)
        for file in result["files"]:
            (self.path / file).parent.mkdir(parents=True, exist_ok=True)
            (beside / file).replace(self.path / file)
        for file in set(before["files"] if before else ()) - set(result["files"]):
            (self.path / file).unlink(missing_ok=True)
        self.write(f"kept/{name}.json", json.dumps({**result, "form": FORM}, ensure_ascii=False))

    def write(self, file: str, text: str) -> None:
        """Writes a file whole or not at all."""
        path = self.path / file
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=".", suffix=".part", dir=path.parent)
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as out:
                out.write(text)
            Path(name).chmod(0o666 & ~_umask())
            Path(name).replace(path)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise


def _is_record(found: Any, name: str) -> bool:
    """Whether it is what `finish` writes of this figure: all files in their places, its pictures among them."""
    if not isinstance(found, dict) or (found.get("form"), found.get("name")) != (FORM, name):
        return False
    files = found.get("files")
    if not isinstance(files, list) or not all(isinstance(f, str) and _PLACE.fullmatch(f) for f in files):
        return False
    return isinstance(found.get("key"), str) and not [f for f in _shown(found.get("stage")) if f not in files]


def _shown(part: Any) -> Iterator[Any]:
    """The files that a stage names, however deep."""
    if isinstance(part, Mapping):
        if "file" in part:
            yield part["file"]
        part = list(part.values())
    if isinstance(part, list):
        for inner in part:
            yield from _shown(inner)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
