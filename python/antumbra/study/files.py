"""The folder of a study: results.csv, results.json, index.html, each whole or not at all.

Those of another study that lay there are moved into a folder `earlier-…` of it, named by their content.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Container
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antumbra import _core
from antumbra._files import why, write_whole
from antumbra.study.rows import Row

if TYPE_CHECKING:
    from antumbra.study.plan import Variant
    from antumbra.study.result import Study

_EARLIER = "earlier-"
NAMES = ("results.csv", "results.json", "index.html")


class FolderError(OSError):
    """The folder cannot be written; nothing was rendered yet."""


def check_folder(folder: Path) -> None:
    """Makes the folder; raises FolderError if its files could not be written."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in NAMES:
            _core.check_writable(str(folder / name))
    except OSError as problem:
        raise FolderError(f"{folder} cannot be written ({why(problem)})") from problem


def keep(study: Study, folder: Path) -> None:
    """Writes results.json alone: so much survives whatever ends the process."""
    write_whole(folder / "results.json", study.json())


def write(study: Study, folder: Path) -> None:
    """Writes all three files. The page is made before any of them is touched."""
    texts = dict(zip(NAMES, (study.csv(), study.json(), study.html()), strict=True))
    for name, text in texts.items():
        write_whole(folder / name, text)


def set_aside(folder: Path, study: Study, keys: Container[str]) -> Path | None:
    """Moves what lies in the folder out of the way, unless it is this study or a part of it; says where it is then.

    `keys`: which rows this study will have, as `key_of` has them.
    """
    there = [folder / name for name in NAMES if (folder / name).is_file()]
    if not there or _is_part(folder / "results.json", study, keys):
        return None
    seen = hashlib.sha256(b"".join(file.read_bytes() for file in there)).hexdigest()[:8]
    aside = folder / f"{_EARLIER}{seen}"
    aside.mkdir(exist_ok=True)
    for file in there:
        file.replace(aside / file.name)
    return aside


def _is_part(file: Path, study: Study, keys: Container[str]) -> bool:
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
        alike = all(
            found[name] == getattr(study, name) for name in ("fingerprint", "scene", "fixed", "seeds")
        )
        return alike and all(key_of(Row.of_json(row)) in keys for row in found["rows"])
    except (OSError, ValueError, KeyError, TypeError):
        return False


def key_of(of: Row | Variant) -> str:
    """Which variant a row is of, or the variant itself."""
    return json.dumps([of.values, of.budget], sort_keys=True)


def finished_rows(folder: Path, fingerprint: str) -> list[Row]:
    """Rows that earlier runs of the same study left in the folder, also where they were moved aside."""
    return [row for file in _results(folder) for row in _rows(file, fingerprint)]


def _results(folder: Path) -> list[Path]:
    return [folder / "results.json", *sorted(folder.glob(f"{_EARLIER}*/results.json"))]


def _rows(file: Path, fingerprint: str) -> list[Row]:
    if not fingerprint or not file.is_file():
        return []
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
        if found["fingerprint"] != fingerprint:
            return []
        return [Row.of_json(row) for row in found["rows"]]
    except (ValueError, KeyError, TypeError):
        # Somebody else's file: it is moved aside.
        return []


def kept_pilots(folder: Path, asked: str) -> dict[str, Any]:
    """What the pilots of an earlier run of the same study found; without one, nothing."""
    return next(filter(None, (_pilots(file, asked) for file in _results(folder))), {})


def _pilots(file: Path, asked: str) -> dict[str, Any]:
    try:
        found = json.loads(file.read_text(encoding="utf-8"))["pilots"]
        costs = {str(key): (float(base), float(each)) for key, (base, each) in found["costs"].items()}
        if not asked or found["asked"] != asked or not all(map(math.isfinite, chain(*costs.values()))):
            return {}
        kept: dict[str, Any] = {"asked": asked, "costs": costs}
        if "rays" in found:
            kept["rays"] = int(found["rays"])
        if "reference" in found:
            by, refused = found["reference"]
            kept["reference"] = (str(by), {str(kind): str(why) for kind, why in refused.items()})
        return kept
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}
