"""The exercises: unsolved they fail with the term that is asked for, solved they pass; wrong answers are caught."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import antumbra as am
from antumbra import _files
from antumbra.checks import run as asked
from antumbra.checks.load import load
from antumbra.lecture import exercises
from common import ROOT

FOLDER = Path(exercises.__file__).parent

PAGE = ROOT / "docs" / "exercises.md"


def told() -> dict[str, list[tuple[str | None, bool, str]]]:
    """Of each exercise: the lines that the page for teachers has, whether each passes, and what the check says."""
    found: dict[str, list[tuple[str | None, bool, str]]] = {}
    row = re.compile(r'^\| (?:`([^`]+)`|unsolved) \| (passes|fails|says "([^"]+)") \|$', re.MULTILINE)
    for part in PAGE.read_text(encoding="utf-8").split("\n## ")[1:]:
        name = re.match(r"`([^`]+)`", part)[1]
        found[name] = [(line or None, verdict == "passes", says) for line, verdict, says in row.findall(part)]
    return found


TOLD = told()
GAPS = [(name, *each) for name, lines in TOLD.items() for each in lines]


def filled(name: str, line: str | None, folder: Path) -> Path:
    """The exercise with `line` in its gap."""
    text = (FOLDER / name).read_text(encoding="utf-8")
    gap = re.findall(r"^( +)[^#\n]+# GAP$", text, re.MULTILINE)
    assert len(gap) == 1, name
    if line is not None:
        text = re.sub(r"^ +[^#\n]+# GAP$", gap[0] + line, text, flags=re.MULTILINE)
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def test_there_are_eight_and_each_fails_before_and_passes_after():
    assert exercises.names() == [*TOLD]
    assert len(TOLD) == 8
    rows = PAGE.read_text(encoding="utf-8").count("\n| ") - 8
    assert len(GAPS) == rows, "a row of the page has another form"
    for lines in TOLD.values():
        assert lines[0][:2] == (None, False)
        assert any(passes for _, passes, _ in lines)


def test_no_file_of_a_student_has_an_answer():
    for name, lines in TOLD.items():
        written = {line.split("#")[0].strip() for line in (FOLDER / name).read_text("utf-8").splitlines()}
        assert not [line for line, passes, _ in lines if passes and line in written]


@pytest.mark.parametrize(("name", "line", "passes", "says"), GAPS)
def test_the_check_judges_what_stands_in_the_gap(name, line, passes, says, tmp_path, monkeypatch):
    if not passes and "picture" not in says:
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
    path = filled("3_cos_light.py", TOLD["3_cos_light.py"][1][0], tmp_path)
    estimator, _ = load(str(path))
    exercises.show(str(path), "pillars", estimator, viewing_rays=1)
    picture = am.load_image(tmp_path / "3_cos_light.png")
    assert picture.shape == (240, 640, 3)
    said = re.fullmatch(
        r"3_cos_light\.png   yours on the left, mean (\S+) of the right one\n", capsys.readouterr().out
    )
    # Two pictures of 320 × 240 pixels and one sample each; a sample deviates by less than its mean times 2.
    assert abs(float(said[1]) - 1) < 5 * 2 * (2 / (320 * 240)) ** 0.5


def test_a_picture_and_the_right_one_have_noise_of_their_own(tmp_path, monkeypatch):
    path, seeds = filled("3_cos_light.py", TOLD["3_cos_light.py"][1][0], tmp_path), []
    render = am.Scene.render
    monkeypatch.setattr(
        am.Scene, "render", lambda self, **given: seeds.append(given["seed"]) or render(self, **given)
    )
    exercises.show(str(path), "pillars", load(str(path))[0], viewing_rays=1)
    assert len(set(seeds)) == 2


def test_a_disk_that_fills_up_leaves_no_half_an_exercise(antumbra, monkeypatch):
    def full(self, content):
        with self.open("wb") as out:
            out.write(content[:10])
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        # Both ways to write a file: in its place, and beside it.
        patch.setattr(Path, "write_bytes", full)
        patch.setattr(_files.Path, "replace", lambda self, target: full(self, b"cut"))
        ended = antumbra("lecture", "--exercises", "-o", "mine")
    assert ended.code == 2 and "No space left" in ended.err
    assert [*Path("mine").iterdir()] == []
    assert "8 exercises" in antumbra("lecture", "--exercises", "-o", "mine").out


@pytest.mark.parametrize("given", [["noise"], ["nothing"], ["--list"]])
def test_exercises_are_written_all_eight(antumbra, given):
    ended = antumbra("lecture", *given, "--exercises", "-o", "mine")
    assert ended.code == 2 and f"{given[0]} has no place beside it" in ended.err
    assert not Path("mine").exists()
