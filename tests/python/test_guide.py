"""The guide follows the lecture: each figure in its chapter, with its title, and with words that its slide has."""

from __future__ import annotations

import re

import pytest

from antumbra.lecture import catalog
from antumbra.lecture.chapters import CHAPTERS
from common import ROOT

GUIDE = (ROOT / "docs" / "guide.md").read_text(encoding="utf-8")
FIGURES = catalog.chosen(())
PARTS = dict(re.findall(r"^### (\d+ · .*?)\n(.*?)(?=^#|\Z)", GUIDE, re.MULTILINE | re.DOTALL))


def test_every_chapter_and_figure_in_its_order():
    expected = []
    for chapter in CHAPTERS:
        expected.append(f"## Chapter {chapter.number} · {chapter.title}")
        own = [(f.number, name, f.title) for name, f in FIGURES.items() if f.chapter == chapter.number]
        expected += [f"### {number} · `{name}` · {title}" for number, name, title in sorted(own)]
    found = [line for line in GUIDE.splitlines() if re.match(r"## Chapter|### ", line)]
    assert found == expected


@pytest.mark.parametrize("heading", PARTS)
def test_a_figure_has_what_to_say_to_change_and_to_ask(heading):
    part = PARTS[heading]
    assert re.findall(r"^- \*\*(\w+):\*\*", part, re.MULTILINE) == ["Say", "Change", "Ask"]
    assert "*" in part.split("**Ask:**")[1], "an answer"
