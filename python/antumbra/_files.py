"""Files that are there whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

# What a write that was ended by force leaves beside its target: `.NAME.part`.
PART = ".part"


def write_whole(path: Path, text: str) -> None:
    """Writes a text file beside its place, then renames it: whoever reads sees the old one or the new one."""
    handle, name = tempfile.mkstemp(prefix=".", suffix=PART, dir=path.parent)
    beside = Path(name)
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as out:
            out.write(text)
        beside.chmod(0o666 & ~_umask())
        beside.replace(path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def why(problem: OSError) -> str:
    """What stands in the way of a folder, in words."""
    if isinstance(problem, FileExistsError):
        return "it is a file, not a folder"
    if isinstance(problem, NotADirectoryError):
        return "a part of the path is a file, not a folder"
    return problem.strerror or str(problem)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
