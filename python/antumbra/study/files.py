"""The folder of a study: results.csv, results.json, index.html, each whole or not at all."""

from __future__ import annotations

import json
import math
import os
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antumbra import _core
from antumbra.study.rows import Row

if TYPE_CHECKING:
    from antumbra.study.result import Study

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
        reason = problem.strerror.lower() if problem.strerror else problem
        raise FolderError(f"{folder} cannot be written ({reason})") from problem


def keep(study: Study, folder: Path) -> None:
    """Writes results.json alone: so much survives whatever ends the process."""
    _replace(folder / "results.json", study.json())


def write(study: Study, folder: Path) -> None:
    """Writes all three files. The page is made before any of them is touched."""
    texts = dict(zip(NAMES, (study.csv(), study.json(), study.html()), strict=True))
    for name, text in texts.items():
        _replace(folder / name, text)


def finished_rows(folder: Path, fingerprint: str) -> list[Row]:
    """Rows that an earlier run of the same study left in the folder."""
    file = folder / "results.json"
    if not fingerprint or not file.is_file():
        return []
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
        if found["fingerprint"] != fingerprint:
            return []
        return [Row.of_json(row) for row in found["rows"]]
    except (ValueError, KeyError, TypeError):
        # Somebody else's file: it is replaced when the study is done.
        return []


def kept_pilots(folder: Path, asked: str) -> dict[str, Any]:
    """What the pilots of an earlier run of the same study found; without one, nothing."""
    try:
        found = json.loads((folder / "results.json").read_text(encoding="utf-8"))["pilots"]
        costs = {str(key): (float(base), float(each)) for key, (base, each) in found["costs"].items()}
        if not asked or found["asked"] != asked or not all(map(math.isfinite, chain(*costs.values()))):
            return {}
        kept: dict[str, Any] = {"asked": asked, "costs": costs}
        if "reference" in found:
            by, refused = found["reference"]
            kept["reference"] = (str(by), {str(kind): str(why) for kind, why in refused.items()})
        return kept
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def _replace(target: Path, text: str) -> None:
    beside = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        beside.write_text(text, encoding="utf-8")
        beside.replace(target)
    finally:
        beside.unlink(missing_ok=True)
