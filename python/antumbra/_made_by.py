"""What numbers that are kept were made by: the compiled core, sources and libraries, as one number."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import cache
from importlib.metadata import version
from pathlib import Path

from antumbra import __version__, _core

# The folder of the whole package.
ROOT = Path(__file__).parent
# What computes beside the core, and draws the plots.
_LIBRARIES = ("numpy", "matplotlib")


def made_by(sources: Iterable[Path]) -> str:
    """Changes with the version, the core, these files of the package, and the libraries that numbers pass through."""
    seen = hashlib.sha256(" ".join([__version__, *map(version, _LIBRARIES)]).encode())
    core = Path(_core.__file__ or "")
    for path in [*sources, *([core] if core.is_file() else [])]:
        status = path.stat()
        seen.update(path.as_posix().removeprefix(ROOT.as_posix()).encode() + b"\0")
        seen.update(_content(path, status.st_size, status.st_mtime_ns))
    return seen.hexdigest()


@cache
def _content(path: Path, size: int, time: int) -> bytes:
    """The hash of a file, read once as long as its size and time stay."""
    return hashlib.sha256(path.read_bytes()).digest()
