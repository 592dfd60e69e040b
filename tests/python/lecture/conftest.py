"""A lecture of two made-up figures, and its page in a browser."""

from __future__ import annotations

import pytest
from made_up import figure

from antumbra.lecture import catalog
from antumbra.lecture.make import Lecture


@pytest.fixture
def two_figures(monkeypatch):
    """A catalog of two figures, `one` and `two`."""
    figures = {"one": figure(1), "two": figure(2)}
    monkeypatch.setattr(catalog, "names", lambda: list(figures))
    monkeypatch.setattr(catalog, "ordered", lambda: figures)
    return figures


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The page of two figures, made once."""
    patch = pytest.MonkeyPatch()
    figures = {"one": figure(1), "two": figure(2)}
    patch.setattr(catalog, "names", lambda: list(figures))
    patch.setattr(catalog, "ordered", lambda: figures)
    folder = tmp_path_factory.mktemp("lecture")
    Lecture(folder, figures, quick=True).run()
    yield folder
    patch.undo()


@pytest.fixture
def open_page(browser, made):
    """Opens the page at an address and width; every console error and every failed request ends the test."""
    wrong = []
    contexts = []

    def opened(address="", size=(1280, 720), **context):
        contexts.append(browser.new_context(viewport={"width": size[0], "height": size[1]}, **context))
        tab = contexts[-1].new_page()
        tab.on("console", lambda said: wrong.append(said.text) if said.type in ("error", "warning") else None)
        tab.on("pageerror", lambda problem: wrong.append(str(problem)))
        tab.on("requestfailed", lambda request: wrong.append(request.url))
        tab.goto(f"{(made / 'index.html').as_uri()}{address}")
        return tab

    yield opened
    for context in contexts:
        context.close()
    assert wrong == []
