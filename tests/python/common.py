"""What test files import: the command as a process of its own, the folder of test data, a square."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
STRESS = os.environ.get("ANTUMBRA_STRESS") == "1"
SQUARE = np.array([[-1.0, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
FACES = np.array([[0, 2, 1], [0, 3, 2]])


class Ended(NamedTuple):
    """How a command ended."""

    code: int
    out: str
    err: str


def command(*arguments: str, folder: Path | None = None, seconds: float = 120.0) -> Ended:
    """Runs `antumbra …` as a process of its own."""
    whole = [sys.executable, "-m", "antumbra", *map(str, arguments)]
    done = subprocess.run(whole, capture_output=True, text=True, cwd=folder, timeout=seconds, check=False)
    return Ended(done.returncode, done.stdout, done.stderr)


def data_folder() -> Path | None:
    """The folder of test data: ANTUMBRA_DATA, or ../shared/data beside the repository."""
    given = os.environ.get("ANTUMBRA_DATA")
    folder = Path(given) if given else ROOT.parent / "shared" / "data"
    return folder if folder.is_dir() else None
