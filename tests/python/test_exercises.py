"""The exercises: unsolved they fail with the term that is asked for, solved they pass; wrong answers are caught."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import antumbra as am
from antumbra.checks import run as asked
from antumbra.checks.load import load
from antumbra.lecture import exercises

FOLDER = Path(exercises.__file__).parent

# Of each exercise: the right line for the gap, wrong ones with words of what the check says, and what it says unsolved.
LINES = {
    "1_offset.py": (
        "start = at",
        {
            "start = at.position - 1e-3 * at.normal": "no lamp gives light",
            "start = at.position + 0.05 * at.normal": "too large an offset",
        },
        "false shadow",
    ),
    "2_t_max.py": (
        "reach = s.distance * (1 - 1e-4)",
        {
            "reach = s.distance * 1.5": "blocked by the lamp itself",
            "reach = s.distance * 0.3": "end long before the light",
            "reach = s.distance": "end at r exactly",
        },
        "blocked by the lamp itself",
    ),
    "3_cos_light.py": (
        "cos_light = s.cos_light",
        {
            "cos_light = s.cos_light**2": "cos θ′ at the light comes twice",
            "cos_light = s.cos_light / 2": "half",
        },
        "cos θ′ at the light is missing",
    ),
    "4_distance.py": (
        "falls = 1 / s.distance**2",
        {"falls = 1 / s.distance**4": "1/r² comes twice", "falls = 3 / s.distance**2": "3 samples"},
        "1/r² is missing",
    ),
    "5_own_pdf.py": (
        "pdf = 3 * z**2 / (2 * np.pi)",
        {"pdf = z / np.pi": "comes twice", "pdf = z**2": "all light"},
        "comes three times",
    ),
    "6_stratify.py": (
        "x, y = (k % 3 + x) / 3, (k // 3 + y) / 3",
        {"x, y = (k % 3 + x) / 6, (k // 3 + y) / 3": "", "x, y = x, (k // 9 + y) / 3": ""},
        "right, but too noisy",
    ),
    "7_mis_weight.py": (
        "return mine / np.maximum(mine + other, 1e-30)",
        {
            "return np.full_like(mine, 0.25)": "counts half",
            "return mine / np.maximum(mine + 2 * other, 1e-30)": "no single term",
        },
        "counts twice",
    ),
    "8_occlusion.py": (
        "z = np.sqrt(pair[:, :1])",
        {"z = 1 - pair[:, :1]": "directions drawn evenly", "z = pair[:, :1] ** 2": "no single term"},
        "directions drawn evenly",
    ),
}
GAPS = [
    *((name, None, False, says) for name, (_, _, says) in LINES.items()),
    *((name, line, True, "") for name, (line, _, _) in LINES.items()),
    *((name, line, False, says) for name, (_, wrong, _) in LINES.items() for line, says in wrong.items()),
]


def filled(name: str, line: str | None, folder: Path) -> Path:
    """The exercise with `line` in its gap."""
    text = (FOLDER / name).read_text(encoding="utf-8")
    gap = re.findall(r"^( +)[^#\n]+# GAP$", text, re.MULTILINE)
    assert len(gap) == 1, name
    if line is not None:
        text = re.sub(r"^ +[^#\n]+# GAP$", gap[0] + line, text, flags=re.MULTILINE)
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def test_there_are_eight_and_each_has_an_answer():
    assert exercises.names() == [*LINES]
    assert len(LINES) == 8


@pytest.mark.parametrize(("name", "line", "passes", "says"), GAPS)
def test_the_check_judges_what_stands_in_the_gap(name, line, passes, says, tmp_path, monkeypatch):
    if not passes:
        # A quarter of the samples and no pictures are enough to catch it.
        monkeypatch.setattr(asked, "RUNS", 1)
        monkeypatch.setattr(asked, "KINDS", {k: kind._replace(scenes=()) for k, kind in asked.KINDS.items()})
    estimator, options = load(str(filled(name, line, tmp_path)))
    report = am.check(estimator, **options)
    assert report.passed is passes, str(report)
    assert says in " ".join(report.faults), str(report)


def test_the_folder_keeps_what_a_student_wrote(antumbra):
    ended = antumbra("lecture", "--exercises", "-o", "mine")
    assert ended.code == 0
    assert "8 exercises" in ended.out
    Path("mine/3_cos_light.py").write_text("# mine\n", encoding="utf-8")
    Path("mine/4_distance.py").unlink()
    assert "1 exercise" in antumbra("lecture", "--exercises", "-o", "mine").out
    assert Path("mine/3_cos_light.py").read_text(encoding="utf-8") == "# mine\n"
    assert "GAP" in Path("mine/4_distance.py").read_text(encoding="utf-8")


def test_a_folder_that_cannot_be_written(antumbra):
    Path("mine").write_text("", encoding="utf-8")
    ended = antumbra("lecture", "--exercises", "-o", "mine")
    assert ended.code == 2
    assert "mine cannot be written" in ended.err


def test_an_exercise_renders_its_picture(tmp_path, capsys):
    path = filled("3_cos_light.py", LINES["3_cos_light.py"][0], tmp_path)
    estimator, _ = load(str(path))
    exercises.show(str(path), "pillars", estimator, viewing_rays=1)
    picture = am.load_image(tmp_path / "3_cos_light.png")
    assert picture.shape == (240, 640, 3)
    assert "3_cos_light.png   yours on the left, mean 1.0" in capsys.readouterr().out
