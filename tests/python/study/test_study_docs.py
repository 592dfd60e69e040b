"""The examples in the docstrings of studies run."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest

from antumbra import study


@pytest.mark.parametrize("name", ["", *(m.name for m in pkgutil.iter_modules(study.__path__, "."))])
def test_docstrings(name):
    found = doctest.testmod(importlib.import_module(f"antumbra.study{name}"), optionflags=doctest.ELLIPSIS)
    assert found.failed == 0
