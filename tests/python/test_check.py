"""The check of estimators: right ones pass, each planted fault is caught and named."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest

import antumbra as am
from antumbra.checks import run as asked
from antumbra.checks.cases import LAMPS
from antumbra.checks.lamps import falls_as, irradiance
from check_rates import caught, false_alarms
from own_estimators import RIGHT, WRONG, WRONG_OPENNESS, even, openness

STRESS = os.environ.get("ANTUMBRA_STRESS") == "1"


@pytest.fixture
def coarse(monkeypatch):
    """A quarter of the samples, and no pictures: what a planted fault needs to be caught."""
    if not STRESS:
        monkeypatch.setattr(asked, "RUNS", 1)
        kinds = {name: kind._replace(scenes=()) for name, kind in asked.KINDS.items()}
        monkeypatch.setattr(asked, "KINDS", kinds)


@pytest.mark.parametrize("estimator", RIGHT, ids=lambda e: e.__name__)
def test_right_ones_pass(estimator):
    report = am.check(estimator)
    assert report.passed, str(report)
    assert len(report.rows) == 15


def test_openness_passes(coarse):
    assert am.check(openness, kind="occlusion").passed


@pytest.mark.parametrize("fault", WRONG_OPENNESS)
def test_each_planted_fault_of_openness_is_caught_and_named(coarse, fault):
    estimator, words = WRONG_OPENNESS[fault]
    report = am.check(estimator, kind="occlusion")
    assert not report.passed
    assert len(report.faults) == 1, report.faults
    assert words in report.faults[0]


@pytest.mark.parametrize("fault", WRONG)
def test_each_planted_fault_is_caught_and_named(coarse, fault):
    estimator, words = WRONG[fault]
    report = am.check(estimator)
    assert not report.passed
    assert len(report.faults) == 1, report.faults
    assert words in report.faults[0]


@pytest.mark.parametrize("fault", WRONG if STRESS else ["an offset of 2 cm"])
def test_planted_faults_are_caught_nearly_always(fault):
    # All of 1,000 caught: more than 99.7 % are, at a confidence of 95 %. Coarse: 10, that it is often.
    count = 1000 if STRESS else 10
    found, named = caught(fault, count)
    # A name is given where one term explains all rows; by chance a row that is right does not fit.
    assert found == count and named >= 0.99 * count


# `even` has the fewest hits: with errors of its own tiles alone, one of its checks in seven failed.
@pytest.mark.parametrize("estimator", RIGHT if STRESS else [even], ids=lambda e: e.__name__)
def test_false_alarms_are_rare(estimator):
    # None of 5,000: below 10⁻³, at a confidence of 99 %.
    count, share = (5000, 1) if STRESS else (30, 0.2)
    assert false_alarms(estimator, count, share) == 0


def test_the_lamps_are_known_twice():
    for lamp in LAMPS.values():
        # Lambert's sum over edges against a sum over 64 × 64 points; the one cut by the horizon converges slowest.
        assert falls_as(lamp, 1, 1, 2) == pytest.approx(irradiance(lamp), rel=1e-4)


def test_an_answer_that_is_no_light_is_the_fault():
    report = am.check(lambda scene, at, u: np.full(len(at), np.nan))
    assert not report.passed
    assert len(report.faults) == 1
    assert "finite numbers are needed" in report.faults[0]


def test_a_limit_of_noise_that_nobody_asks_is_refused():
    with pytest.raises(ValueError, match="the name of a question"):
        am.check(RIGHT[0], noise={"lamp overhead ": 1.0})


def test_a_file_is_run_as_python_runs_it(antumbra):
    Path("beside.py").write_text("RHO = 0.5\n", encoding="utf-8")
    text = (
        "from __future__ import annotations\nfrom dataclasses import dataclass\n\n"
        "@dataclass\nclass A:\n    x: int = 1\n\n"
        "def estimator(scene, at, u):\n    from beside import RHO\n\n    return at.t * 0 + RHO\n"
    )
    Path("mine.py").write_text(text, encoding="utf-8")
    ended = antumbra("check", "mine.py")
    assert ended.code == 1, ended.err


RIGHT_FILE = (Path(__file__).parent / "own_estimators.py").read_text(encoding="utf-8")


def test_the_command_checks_a_function_of_a_file(antumbra, tmp_path):
    Path("mine.py").write_text(RIGHT_FILE, encoding="utf-8")
    ended = antumbra("check", "mine.py", "--function", "area", "--json")
    assert ended.code == 0
    assert json.loads(ended.out)["passed"] is True
    assert "note: mine.py: its code is run as it stands" in ended.err
    ended = antumbra("check", "mine.py", "--function", "even_over_cosine")
    assert ended.code == 1
    assert "directions drawn evenly" in ended.out


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("x = 1\n", "has 0 functions of (scene, at, u)"),
        ("def a(s, at, u): return 0\ndef b(s, at, u): return 0\n", '"a", "b". Name one with --function.'),
        ("import nothing_like_it\n", "line 1: ModuleNotFoundError"),
        ("def a(s, at, u:\n", "line 1: SyntaxError"),
        ("\ndef a(s, at, u):\n    return s.ocluded(at)\n", "line 3: in a: AttributeError"),
        ("KIND = 'dark'\ndef a(s, at, u): return 0\n", 'kind is "dark"'),
        ("def a(s, at, u): raise SystemExit(3)\n", "line 1: in a: SystemExit"),
    ],
)
def test_what_cannot_be_checked_is_said_with_its_line(antumbra, text, says):
    Path("mine.py").write_text(text, encoding="utf-8")
    ended = antumbra("check", "mine.py")
    assert ended.code == 2
    assert says in ended.err
    assert "Traceback" not in ended.err


def test_a_file_that_is_not_there(antumbra):
    assert antumbra("check", "nix.py").err == "error: nix.py: there is no such file\n"
