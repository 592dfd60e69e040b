"""Every example that people may copy runs: the docstrings of the package, and the code blocks of the pages."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import re
import shlex
import shutil

import pytest

import antumbra
from conftest import ROOT

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


def blocks(language):
    """(page, code) of every fenced block of a language."""
    fence = re.compile(rf"^```{language}\n(.*?)^```", re.MULTILINE | re.DOTALL)
    return [
        (page.name, code)
        for page in PAGES
        if page.is_file()
        for code in fence.findall(page.read_text("utf-8"))
    ]


@pytest.fixture
def room(data, tmp_path, monkeypatch):
    """A folder with the file that the pages call room.glb."""
    shutil.copy(data / "scenes" / "gltf" / "BoxInterleaved.glb", tmp_path / "room.glb")
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(("page", "code"), blocks("python"))
def test_python_of_the_pages(page, code, room):
    coarse = re.sub(r"(viewing_rays|shadow_rays|rays)=\d[\d_]*", r"\1=2", code)
    exec(compile(coarse, page, "exec"), {})


COMMANDS = [
    (page, line.removeprefix("$ "))
    for page, code in blocks("(?:console|sh|bash)")
    for line in code.splitlines()
    if line.removeprefix("$ ").startswith("antumbra ")
]


@pytest.mark.parametrize(("page", "line"), COMMANDS)
def test_commands_of_the_pages(page, line, room, capsys):
    from antumbra.cli._run import run

    words = shlex.split(line, comments=True)[1:]
    if words[0] == "render" and "--help" not in words:
        words += COARSE
    assert run(words) == 0, f"{page}: {line}\n{capsys.readouterr().err}"
