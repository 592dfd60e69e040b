"""The page of equations: links go to at most 20 lines that exist and hold what is named; every figure has one."""

from __future__ import annotations

import importlib.util
import re

import pytest

from antumbra.lecture import catalog
from common import ROOT


def tool():
    """The module that renews the page."""
    spec = importlib.util.spec_from_file_location("equations", ROOT / "tools" / "equations.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


TOOL = tool()
PAGE = TOOL.PAGE.read_text(encoding="utf-8")
LINKS = TOOL.LINK.findall(PAGE)


def test_every_link_is_read():
    assert len(LINKS) == PAGE.count("](") > 50


@pytest.mark.parametrize(("name", "path", "first", "last", "title"), LINKS)
def test_a_link_goes_to_few_lines_that_hold_its_name(name, path, first, last, title):
    lines = (ROOT / path).read_text(encoding="utf-8").splitlines()
    first, last = int(first), int(last)
    assert 1 <= first <= last <= len(lines)
    assert last - first < TOOL.MOST
    assert re.search(rf"\b{re.escape(re.split('::|[.]', name)[-1])}\b", "\n".join(lines[first - 1 : last]))
    assert (first, last) == TOOL.lines_of(path, title), "tools/equations.py renews the numbers"


def test_every_figure_has_an_equation():
    rows = re.findall(r"^\| ([\d, ]+) \|", PAGE, re.MULTILINE)
    numbers = {int(number) for row in rows for number in row.split(",")}
    assert numbers == {figure.number for figure in catalog.chosen(()).values()}
