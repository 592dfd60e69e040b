"""A lecture of two made-up figures."""

from __future__ import annotations

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
