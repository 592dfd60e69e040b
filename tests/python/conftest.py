"""What every test uses: the test data, the command as people call it, small scenes, the real browser."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

import antumbra as am
from common import FACES, SQUARE, Ended, data_folder


@pytest.fixture
def antumbra(tmp_path, monkeypatch, capsys):
    """Runs `antumbra …` in this process, in an empty folder: quick, the same code."""
    from antumbra.cli._run import run

    monkeypatch.chdir(tmp_path)
    # Whoever runs the tests may say how wide its lines are; nobody reads these.
    monkeypatch.delenv("COLUMNS", raising=False)

    def ran(*arguments: str) -> Ended:
        code = run([str(a) for a in arguments])
        out, err = capsys.readouterr()
        return Ended(code, out, err)

    return ran


@pytest.fixture
def data() -> Path:
    """The test data. Without it: skipped, but an error under CI=true."""
    folder = data_folder()
    if folder is None and os.environ.get("CI") == "true":
        pytest.fail("the test data is missing: set ANTUMBRA_DATA")
    if folder is None:
        pytest.skip("the test data is not here (ANTUMBRA_DATA)")
    return folder


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
