"""`antumbra check`: whose fault an error is, and what stands on standard output."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from antumbra.checks import run as asked

BLACK = "def black(scene, at, u):\n    return at.t * 0\n"


@pytest.fixture
def coarse(monkeypatch):
    """A quarter of the samples, and no pictures: what is wrong altogether is caught by less."""
    monkeypatch.setattr(asked, "RUNS", 1)
    kinds = {name: kind._replace(scenes=()) for name, kind in asked.KINDS.items()}
    monkeypatch.setattr(asked, "KINDS", kinds)


@pytest.mark.parametrize("seed", ["-1", "4294967296", "many"])
def test_a_wrong_seed_is_no_fault_of_the_file(antumbra, seed):
    Path("mine.py").write_text(BLACK, encoding="utf-8")
    ended = antumbra("check", "mine.py", "--seed", seed)
    assert ended.code == 2
    assert "--seed" in ended.err and "mine.py" not in ended.err


def test_the_largest_seed_is_taken(antumbra, coarse):
    Path("mine.py").write_text(BLACK, encoding="utf-8")
    assert antumbra("check", "mine.py", "--seed", "4294967295").code == 1


def test_an_error_of_ours_is_no_fault_of_the_file(antumbra, monkeypatch):
    Path("mine.py").write_text(BLACK, encoding="utf-8")

    def broken(*given):
        raise ZeroDivisionError("ours")

    monkeypatch.setattr(asked, "_weight", broken)
    ended = antumbra("check", "mine.py", "--quiet")
    assert ended.code == 1
    assert ended.err.startswith("error: antumbra itself failed: ZeroDivisionError: ours")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("def a(s, at, u):\n    return s.occluded(at, at, at, at)\n", "mine.py: line 2: in a: TypeError"),
        ("NOISE = 3\n" + BLACK, "mine.py: AttributeError"),
        ("KIND = []\n" + BLACK, "mine.py: TypeError"),
    ],
)
def test_an_error_of_the_file_is_said_with_its_place(antumbra, text, says):
    Path("mine.py").write_text(text, encoding="utf-8")
    ended = antumbra("check", "mine.py")
    assert ended.code == 2 and says in ended.err, ended.err


def test_an_answer_that_is_no_array_is_the_fault(antumbra, coarse):
    Path("mine.py").write_text("def a(s, at, u):\n    return [[1.0], [1.0, 2.0]]\n", encoding="utf-8")
    ended = antumbra("check", "mine.py")
    assert ended.code == 1 and "a returned list, no array" in ended.out


def test_what_a_file_prints_is_no_part_of_the_report(antumbra, coarse):
    printing = "print('at the start')\n" + BLACK.replace("\n ", "\n    print('asked')\n ")
    Path("mine.py").write_text(printing, encoding="utf-8")
    ended = antumbra("check", "mine.py", "--json")
    assert ended.code == 1 and json.loads(ended.out)["passed"] is False
    assert "at the start\n" in ended.err and "asked\n" in ended.err
    assert "asked" not in antumbra("check", "mine.py").out
