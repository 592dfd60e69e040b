"""What is imported when: start-up stays short because the heavy packages come late."""

from __future__ import annotations

import subprocess
import sys

import pytest

HEAVY = {"numpy", "rich", "matplotlib", "flip_evaluator", "PIL", "jinja2"}
AFTER = "; import sys; print(*sys.modules, file=sys.stderr)"


def imported(code: str) -> set[str]:
    """Names of all modules that a fresh interpreter has after `code`."""
    done = subprocess.run([sys.executable, "-c", code + AFTER], capture_output=True, text=True, check=True)
    return set(done.stderr.split())


def verb(*arguments: str) -> str:
    return f"from antumbra.cli._run import run; run({list(arguments)!r})"


@pytest.mark.parametrize(
    "code",
    [
        "import antumbra",
        verb("--help"),
        verb("render", "--help"),
        verb("study", "--help"),
        verb("--version"),
        verb("info", "--list"),
        verb("info", "corner"),
    ],
)
def test_nothing_heavy_is_imported_before_it_is_needed(code):
    assert {name.split(".")[0] for name in imported(code)} & HEAVY == set()


def test_a_verb_does_not_import_the_others():
    names = imported(verb("render", "--help"))
    assert "antumbra.cli.render" in names
    assert not {"antumbra.cli.info", "antumbra.cli.diff"} & names


def test_the_package_says_what_it_has():
    import antumbra

    for name in antumbra.__all__:
        assert getattr(antumbra, name) is not None
    assert set(antumbra.__all__) <= set(dir(antumbra))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = antumbra.nothing
