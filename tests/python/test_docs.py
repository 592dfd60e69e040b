"""Every example that people may copy runs: the docstrings of the package, and the code blocks of the pages."""

from __future__ import annotations

import doctest
import importlib
import importlib.util
import pkgutil
import re
import shlex
import shutil
import sys

import numpy as np
import pytest

import antumbra
from antumbra import _core
from common import ROOT
from stand_ins import modules

MODULES = [
    m.name for m in pkgutil.iter_modules(antumbra.__path__, "antumbra.") if not m.name.endswith("__main__")
]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
# Coarse, so that the test is quick; what is shown stays as it is.
COARSE = ["--size", "16x12", "--viewing-rays", "2"]


@pytest.mark.parametrize("name", ["antumbra", *MODULES])
def test_docstrings(name):
    found = doctest.testmod(importlib.import_module(name), optionflags=doctest.ELLIPSIS)
    assert found.failed == 0


def blocks(*languages):
    """(page, code) of every fenced block of these languages."""
    fence = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
    found = [(page.name, fence.findall(page.read_text("utf-8"))) for page in PAGES if page.is_file()]
    return [(page, code) for page, codes in found for language, code in codes if language in languages]


@pytest.fixture
def room(data, tmp_path, monkeypatch):
    """A folder with the files that the pages speak of: room.glb, mine.py, ours.exr and reference.exr.

    Libraries that the pages import and that are not installed are stood in for.
    """
    shutil.copy(data / "scenes" / "gltf" / "BoxInterleaved.glb", tmp_path / "room.glb")
    for name, value in (("ours.exr", 0.5), ("reference.exr", 0.6)):
        _core.write_picture(str(tmp_path / name), np.full((8, 8, 3), value, np.float32))
    (own,) = [code for page, code in blocks("python") if page == "own.md"]
    (tmp_path / "mine.py").write_text(own, encoding="utf-8")
    for name, stand_in in modules().items():
        if importlib.util.find_spec(name) is None:
            monkeypatch.setitem(sys.modules, name, stand_in)
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(("page", "code"), blocks("python"))
def test_python_of_the_pages(page, code, room):
    coarse = re.sub(r"(viewing_rays|shadow_rays|rays)=\d[\d_]*", r"\1=2", code)
    exec(compile(coarse, page, "exec"), {"__name__": "__main__"})


# What follows a wide gap is a remark.
COMMANDS = [
    (page, re.split(r" {3,}", line.removeprefix("$ "))[0])
    for page, code in blocks("", "console", "sh", "bash", "text")
    for line in code.splitlines()
    if line.removeprefix("$ ").startswith("antumbra ") and "VERB" not in line
]


@pytest.mark.parametrize(("page", "line"), COMMANDS)
def test_commands_of_the_pages(page, line, room, capsys):
    from antumbra.cli._run import run

    words = shlex.split(line, comments=True)[1:]
    if words[0] == "render" and "--help" not in words:
        words += COARSE
    if words[0] == "study":
        words += ["--size", "8x6", "--viewing-rays", "1", "--seeds", "3"]
    assert run(words) == 0, f"{page}: {line}\n{capsys.readouterr().err}"
