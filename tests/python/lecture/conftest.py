"""A lecture of two made-up figures, and the real browser."""

from __future__ import annotations

import os
import shutil

import pytest
from made_up import figure

from antumbra.lecture import catalog


@pytest.fixture
def two_figures(monkeypatch):
    """A catalog of two figures, `one` and `two`."""
    figures = {"one": figure(1), "two": figure(2)}
    monkeypatch.setattr(catalog, "names", lambda: list(figures))
    monkeypatch.setattr(catalog, "ordered", lambda: figures)
    return figures


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
