"""What every test uses: the test data, the command as people call it, small scenes, the real browser."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

import antumbra as am

ROOT = Path(__file__).resolve().parents[2]
STRESS = os.environ.get("ANTUMBRA_STRESS") == "1"


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


@pytest.fixture
def antumbra(tmp_path, monkeypatch, capsys):
    """Runs `antumbra …` in this process, in an empty folder: quick, the same code."""
    from antumbra.cli._run import run

    monkeypatch.chdir(tmp_path)

    def ran(*arguments: str) -> Ended:
        code = run([str(a) for a in arguments])
        out, err = capsys.readouterr()
        return Ended(code, out, err)

    return ran


def data_folder() -> Path | None:
    """The folder of test data: ANTUMBRA_DATA, or ../shared/data beside the repository."""
    given = os.environ.get("ANTUMBRA_DATA")
    folder = Path(given) if given else ROOT.parent / "shared" / "data"
    return folder if folder.is_dir() else None


@pytest.fixture
def data() -> Path:
    """The test data. Without it: skipped, but an error under CI=true."""
    folder = data_folder()
    if folder is None and os.environ.get("CI") == "true":
        pytest.fail("the test data is missing: set ANTUMBRA_DATA")
    if folder is None:
        pytest.skip("the test data is not here (ANTUMBRA_DATA)")
    return folder


SQUARE = np.array([[-1.0, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
FACES = np.array([[0, 2, 1], [0, 3, 2]])


@pytest.fixture
def floor() -> am.Scene:
    """A square floor (y = 0, facing up, ρ = 0.5) and a square lamp of 1 × 1 at y = 2 that shines down."""
    scene = am.Scene("floor")
    scene.add_mesh(SQUARE, FACES, material=am.materials.Diffuse(0.5), name="floor")
    scene.add_light(am.lights.Rectangle((-0.5, 2, -0.5), (1, 0, 0), (0, 0, 1), radiance=3.0), name="lamp")
    return scene


@pytest.fixture(scope="session")
def browser():
    """Chromium. Without it: skipped, but a failure under CI=true."""
    path = shutil.which(os.environ.get("ANTUMBRA_CHROMIUM") or "chromium")
    if path is None:
        if os.environ.get("CI") == "true":
            pytest.fail("no Chromium: install it, or name it in ANTUMBRA_CHROMIUM")
        pytest.skip("no Chromium (ANTUMBRA_CHROMIUM)")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        # Containers have no user namespaces; the page is our own.
        opened = play.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield opened
        opened.close()
