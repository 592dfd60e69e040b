"""Finished figures are kept: written whole, and used again as long as nothing that made them changed."""

from __future__ import annotations

import hashlib
import json
import math
import re
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from antumbra._files import PART, write_whole
from antumbra._made_by import made_by
from antumbra.lecture import catalog
from antumbra.lecture.believed import is_record
from antumbra.lecture.variant import edition

# Another number where what is kept gets another form.
FORM = 5
# What is being made, and what is made and on its way to its places.
_UNFINISHED, _FINISHED = ".unfinished-", ".finished-"
# After so many seconds [s] without a change, what is unfinished belongs to nobody any more.
_LEFT = 3600.0
_NAME = re.compile(r"[a-z0-9-]+")
_EDITION = re.compile(r"(\.quick)?(\.seed-[1-9][0-9]*)?")


def key(name: str, quick: bool, seed: int) -> str:
    """A number that changes with everything that a figure's result depends on: sources, core, libraries, size, seed."""
    made = made_by(catalog.sources(name))
    return hashlib.sha256(f"{FORM} {made} {name} {quick} {seed}".encode()).hexdigest()[:16]


class Folder:
    """The folder of a lecture: index.html, lecture.json, pictures/, exr/, and kept/ with what each figure found."""

    def __init__(self, path: Path) -> None:
        """Nothing is made yet."""
        self.path = path

    def check(self) -> None:
        """Raises OSError if nothing can be written there.

        What an ended run left is brought to its places, or cleaned away if it was not finished.
        """
        self.path.mkdir(parents=True, exist_ok=True)
        self.tidy()
        with tempfile.TemporaryFile(dir=self.path):
            pass

    def check_room(self, room: int) -> None:
        """Raises OSError if there are less than `room` free bytes."""
        if shutil.disk_usage(self.path).free < room:
            raise OSError(28, f"less than {math.ceil(room / 1e6)} MB are free")

    def tidy(self) -> None:
        """Brings what is finished to its places; takes away what was left unfinished an hour ago or more."""
        for made in self.path.glob(f"{_FINISHED}*"):
            self._settle(made)
        for left in (
            *self.path.glob(f"{_UNFINISHED}*"),
            *self.path.glob(f".*{PART}"),
            *self.path.glob(f"kept/.*{PART}"),
        ):
            if _age(left) < _LEFT:
                continue
            if left.is_dir() and not left.is_symlink():
                shutil.rmtree(left, ignore_errors=True)
            else:
                left.unlink(missing_ok=True)

    def kept(self, name: str, key: str = "", of: str = "") -> dict[str, Any] | None:
        """What a figure found in an `edition`, if it is finished and its files are still there (and of this key, if
        one is given).
        """
        found = self._record(self.path / "kept" / f"{name}{of}.json", name, of)
        whole = found and all(map(self._is_own, found["files"]))
        return found if found and whole and key in ("", found["key"]) else None

    def best(self, name: str, of: str) -> dict[str, Any] | None:
        """What a figure found in an edition, or else in another: full size first, then by seed."""
        if mine := self.kept(name, of=of):
            return mine
        editions = [path.stem.removeprefix(name) for path in self.path.glob(f"kept/{name}*.json")]
        others = [
            found for each in editions if _EDITION.fullmatch(each) and (found := self.kept(name, of=each))
        ]
        return min(others, key=lambda found: (found["quick"], found["seed"]), default=None)

    def _record(self, path: Path, name: str, of: str) -> dict[str, Any] | None:
        """What a file says, if it can be believed."""
        try:
            found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"), parse_constant=_no_number)
        except (OSError, ValueError, RecursionError):
            return None
        right = is_record(found, name, FORM) and edition(found["quick"], found["seed"]) == of
        return found if right else None

    def _is_own(self, file: str) -> bool:
        """Whether it is there, and within this folder also where a link leads."""
        path = self.path / file
        return path.is_file() and path.resolve().is_relative_to(self.path.resolve())

    @contextmanager
    def beside(self) -> Iterator[Path]:
        """A folder for what is not finished; it is gone afterwards."""
        made = Path(tempfile.mkdtemp(prefix=_UNFINISHED, dir=self.path))
        try:
            yield made
        finally:
            shutil.rmtree(made, ignore_errors=True)

    def finish(self, beside: Path, result: dict[str, Any]) -> None:
        """Keeps what a figure found, then moves its files to their places.

        All that can fail comes first: the record is written among the files, and one renaming says that they are
        finished. If the rest is cut short, `tidy` does it at the next start. Raises ValueError for a number that is
        none.
        """
        text = json.dumps({**result, "form": FORM}, ensure_ascii=False, allow_nan=False)
        (beside / "record.json").write_text(text, encoding="utf-8")
        made = beside.with_name(_FINISHED + beside.name.removeprefix(_UNFINISHED))
        beside.rename(made)
        self._settle(made)

    def _settle(self, made: Path) -> None:
        """Moves a finished figure to its places by renaming alone, its record last; may be repeated at any point."""
        try:
            said = json.loads((made / "record.json").read_text(encoding="utf-8"))
            name, of = str(said["name"]), edition(said["quick"], said["seed"])
        except (OSError, ValueError, TypeError, KeyError):
            said = None
        new = said and self._record(made / "record.json", name, of)
        if new and _NAME.fullmatch(name) and not made.is_symlink():
            before = self.kept(name, of=of)
            for file in new["files"]:
                if (made / file).is_file():
                    _move(made / file, self.path / file)
            _move(made / "record.json", self.path / "kept" / f"{name}{of}.json")
            for file in set(before["files"] if before else ()) - set(new["files"]):
                (self.path / file).unlink(missing_ok=True)
        shutil.rmtree(made, ignore_errors=True)

    def write(self, file: str, text: str) -> None:
        """Writes a file whole or not at all."""
        path = self.path / file
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, text)


def _age(left: Path) -> float:
    """Seconds since something changed there; 0 of what another run moves or takes away meanwhile."""
    try:
        return time.time() - max(p.lstat().st_mtime for p in (left, *left.rglob("*")))
    except FileNotFoundError:
        return 0.0


def _move(file: Path, place: Path) -> None:
    """By renaming; what is gone was moved by another run, which settles the same."""
    place.parent.mkdir(parents=True, exist_ok=True)
    with suppress(FileNotFoundError):
        file.replace(place)


def _no_number(word: str) -> float:
    raise ValueError(f"{word} is no number")
