"""A lecture of two made-up figures, and its page in a browser."""

from __future__ import annotations

from dataclasses import replace

import pytest
from made_up import figure

from antumbra.lecture import catalog, make
from antumbra.lecture.chapters import CHAPTERS
from antumbra.lecture.figure import Figure
from antumbra.lecture.make import Lecture


def in_place_of_all(patch) -> dict[str, Figure]:
    """Makes the lecture one of two figures, `one` and `two`, whose chapter opens with pictures of 24 × 16 pixels."""
    figures = {"one": figure(1), "two": figure(2)}
    patch.setattr(catalog, "names", lambda: list(figures))
    patch.setattr(catalog, "ordered", lambda: figures)
    first, *others = CHAPTERS
    small = {"size": (24, 16), "viewing_rays": 1}
    opening = [(replace(v, options={**v.options, **small}), *words) for v, *words in first.pictures]
    patch.setattr(make, "CHAPTERS", (replace(first, pictures=opening), *others))
    return figures


@pytest.fixture
def two_figures(monkeypatch):
    """A catalog of two figures, `one` and `two`."""
    return in_place_of_all(monkeypatch)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The page of two figures, made once."""
    folder = tmp_path_factory.mktemp("lecture")
    with pytest.MonkeyPatch.context() as patch:
        Lecture(folder, in_place_of_all(patch), quick=True).run()
        yield folder


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
