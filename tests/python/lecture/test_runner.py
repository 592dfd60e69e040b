"""The runner: what is finished is kept, used again, never lost; what is wrong is told before anything is rendered."""

from __future__ import annotations

import errno
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from made_up import RECORD

from antumbra import _made_by
from antumbra.lecture import catalog, keep, make
from antumbra.lecture.believed import only_draws
from antumbra.lecture.figure import Figure


def files(folder):
    return {str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file()}


def test_a_lecture_is_a_page_with_its_pictures_and_numbers(two_figures, antumbra, tmp_path):
    done = antumbra("lecture", "--quick", "-o", "out")
    assert done.code == 0, done.err
    assert done.out.startswith("out/index.html   2 figures · claims: 2 supported, 2 not supported · ")
    assert done.err.splitlines()[0].startswith("  lecture · 2 figures · about ")
    out = tmp_path / "out"
    found = json.loads((out / "lecture.json").read_text())
    assert [f["name"] for f in found["figures"]] == ["one", "two"]
    one = found["figures"][0]
    assert one["numbers"]["mean"]["error"] > 0
    assert [c["verdict"] for c in one["claims"]] == ["supported", "not supported"]
    assert {"pictures/one.quick-a.png", "exr/one.quick.exr", "pictures/chapter-1.quick-on.png"} <= files(out)
    assert not [p for p in out.iterdir() if p.name.startswith(".")]
    page = (out / "index.html").read_text()
    assert "It is &lt;large&gt;." in page and 'class="xx"' in page
    assert "http" not in page.replace("http://www.w3.org/2000/svg", "")


def test_what_is_finished_is_not_rendered_again(two_figures, antumbra, monkeypatch):
    assert antumbra("lecture", "--quick", "-o", "out").code == 0
    calls = []
    examine = make.examine
    monkeypatch.setattr(make, "examine", lambda f, run: calls.append(run.name) or examine(f, run))
    again = antumbra("lecture", "--quick", "-o", "out")
    assert again.code == 0 and calls == [] and "2 of them finished" in again.err
    assert antumbra("lecture", "--quick", "--seed", "1", "one", "-o", "out").code == 0
    assert calls == ["one"]
    assert antumbra("lecture", "--quick", "--seed", "1", "-o", "out").code == 0
    assert calls == ["one", "two"]


def test_the_time_left_goes_by_what_finished_figures_took(two_figures, antumbra, tmp_path):
    assert antumbra("lecture", "--quick", "one", "-o", "out").code == 0
    record = tmp_path / "out/kept/one.quick.json"
    stated = two_figures["two"].seconds.quick
    for slow in (1, 40):
        took = json.loads(record.read_text()) | {"seconds": slow * stated}
        record.write_text(json.dumps(took))
        lecture = make.Lecture(tmp_path / "out", two_figures, quick=True)
        assert lecture.waiting() == ["two"]
        # A second at the stated pace is believed beforehand, and the opening of the chapter took its time.
        assert (lecture.seconds(["two"]) > 5 * stated) == (slow == 40)
    steps = []
    lecture.run(steps.append)
    assert steps[0].left > 5 * stated > steps[-1].left and steps[-1].done == 0
    assert [s.share for s in steps] == sorted(s.share for s in steps)
    assert {"picture 1 of 2", "picture 2 of 2", "measuring", "drawing"} <= {s.doing for s in steps}


def test_ctrl_c_keeps_what_is_finished_and_goes_on(two_figures, antumbra, tmp_path, monkeypatch):
    examine = make.examine

    def interrupted(figure, run):
        if run.name == "two":
            raise KeyboardInterrupt
        return examine(figure, run)

    monkeypatch.setattr(make, "examine", interrupted)
    stopped = antumbra("lecture", "--quick", "-o", "out")
    assert stopped.code == 130
    assert stopped.err.splitlines()[-1].startswith("stopped: 1 of 2 figures finished and kept in out")
    assert 'id="one"' in (tmp_path / "out/index.html").read_text()
    assert not [f for f in files(tmp_path) if "unfinished" in f]
    monkeypatch.setattr(make, "examine", examine)
    assert antumbra("lecture", "--quick", "-o", "out").code == 0
    assert 'id="two"' in (tmp_path / "out/index.html").read_text()


def test_ctrl_c_in_the_middle_of_a_picture(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-m", "antumbra", "lecture", "shadows", "-o", "out"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert process.stderr is not None
    said = process.stderr.readline()
    assert said.startswith("  lecture · 1 figure · about ")
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert err == "stopped: no figure is finished\n"
    assert not [f for f in files(tmp_path) if "unfinished" in f]


def test_a_full_disk_loses_nothing_that_is_finished(two_figures, antumbra, tmp_path, monkeypatch):
    examine = make.examine

    def full(figure, run):
        if run.name == "two":
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return examine(figure, run)

    monkeypatch.setattr(make, "examine", full)
    ended = antumbra("lecture", "--quick", "-o", "out")
    assert ended.code == 1
    assert "error: out cannot be written any more (No space left on device)" in ended.err
    assert "1 of 2 figures are finished and kept" in ended.err
    assert [f["name"] for f in json.loads((tmp_path / "out/lecture.json").read_text())["figures"]] == ["one"]


def test_too_little_room_is_told_before(two_figures, antumbra, monkeypatch):
    usage = keep.shutil.disk_usage
    monkeypatch.setattr(keep.shutil, "disk_usage", lambda path: usage(path)._replace(free=1000))
    ended = antumbra("lecture", "--quick", "-o", "out")
    assert ended.code == 2
    assert ended.err == "error: out cannot be written (less than 4 MB are free). Nothing was rendered.\n"


def test_an_unknown_figure_suggests_the_nearest(antumbra, tmp_path):
    ended = antumbra("lecture", "shadow", "-o", "out")
    assert ended.code == 2
    assert ended.err.startswith('error: there is no figure "shadow"; did you mean "shadows"? (shadows, ')
    assert files(tmp_path) == set()


def test_a_folder_that_cannot_be_written_is_told_before(two_figures, antumbra, tmp_path):
    (tmp_path / "file").write_text("")
    ended = antumbra("lecture", "--quick", "-o", "file/out")
    assert ended.code == 2
    said = "error: file/out cannot be written (a part of the path is a file, not a folder). Nothing was rendered.\n"
    assert ended.err == said


def test_a_single_file_holds_its_pictures(two_figures, antumbra, tmp_path, monkeypatch):
    assert antumbra("lecture", "--quick", "--single-file", "-o", "out").code == 0
    whole = (tmp_path / "out/index.html").read_text()
    assert "pictures/" not in whole and "data:image/png;base64," in whole
    from antumbra.lecture import page

    monkeypatch.setattr(page, "LARGEST", len(whole.encode()) - 1)
    assert antumbra("lecture", "--quick", "--single-file", "-o", "out").code == 0
    assert len((tmp_path / "out/index.html").read_bytes()) < len(whole.encode())


def test_a_changed_source_or_a_lost_picture_is_made_anew(two_figures, antumbra, tmp_path, monkeypatch):
    assert antumbra("lecture", "--quick", "one", "-o", "out").code == 0
    folder = keep.Folder(tmp_path / "out")
    key = keep.key("one", True, 0)
    assert folder.kept("one", key, ".quick")
    assert key != keep.key("one", False, 0) != keep.key("one", False, 1)
    (tmp_path / "out/pictures/one.quick-a.png").unlink()
    assert folder.kept("one", key, ".quick") is None


@pytest.mark.parametrize("cut", ["", "{", '{"form": 0}'])
def test_a_record_that_was_cut_short_counts_as_not_finished(tmp_path, cut):
    (tmp_path / "kept").mkdir()
    (tmp_path / "kept/one.json").write_text(cut)
    assert keep.Folder(tmp_path).kept("one") is None


def test_the_figure_of_the_guide_is_one():
    guide = (Path(__file__).parents[3] / "docs/lecture.md").read_text(encoding="utf-8")
    block = guide.split("```python\n")[1].split("```")[0]
    made: dict = {}
    exec(compile(block, "docs/lecture.md", "exec"), made)
    assert isinstance(made["FIGURE"], Figure)


def test_full_figures_survive_coarse_ones_and_other_seeds(two_figures, antumbra, tmp_path):
    for options in ((), ("--quick",), ("--seed", "1"), ("--quick", "--seed", "1")):
        assert antumbra("lecture", "one", *options, "-o", "out").code == 0
    again = antumbra("lecture", "one", "-o", "out")
    assert "1 of them finished" in again.err
    folder, editions = keep.Folder(tmp_path / "out"), ("", ".quick", ".seed-1", ".quick.seed-1")
    assert all(folder.kept("one", of=each) for each in editions)
    said = json.loads((tmp_path / "out/lecture.json").read_text())["figures"][0]
    assert (said["quick"], said["seed"]) == (False, 0), "the page shows what was asked for"
    assert folder.best("one", ".seed-2")["files"] == folder.kept("one")["files"], (
        "else the full size, the first seed"
    )


class Cut(BaseException):
    """As hard an end as Ctrl-C."""


@pytest.mark.parametrize("last", range(8))
@pytest.mark.parametrize("end", [Cut, OSError])
def test_a_figure_cut_short_while_it_is_kept_is_old_or_new_but_never_lost(tmp_path, monkeypatch, last, end):
    folder, seen = keep.Folder(tmp_path), 0

    def result(name, key, *files):
        return RECORD | {"name": name, "key": key, "files": [f"pictures/{file}" for file in files]}

    def made(text, *files):
        with folder.beside() as beside:
            (beside / "pictures").mkdir()
            for file in files:
                (beside / "pictures" / file).write_text(text)
            folder.finish(beside, result("one", text, *files))

    made("old", "a", "b")

    def cut(of):
        def once(self, *arguments, **options):
            nonlocal seen
            seen += 1
            if seen > last:
                raise end
            return of(self, *arguments, **options)

        return once

    with monkeypatch.context() as patch:
        for method in ("write_text", "rename", "replace", "unlink"):
            patch.setattr(Path, method, cut(getattr(Path, method)))
        with pytest.raises(end):
            made("new", "a", "c")
    folder.tidy()
    kept = folder.kept("one")
    assert kept["key"] in ("old", "new")
    assert all((tmp_path / file).read_text() == kept["key"] for file in kept["files"])
    assert not [p for p in tmp_path.iterdir() if p.name.startswith(".")]


def test_what_an_ended_run_left_is_cleaned_away_at_the_start(two_figures, antumbra, tmp_path):
    out = tmp_path / "out"
    (out / "kept").mkdir(parents=True)
    for left in (".unfinished-old", ".unfinished-new"):
        (out / left).mkdir()
    (out / "kept/.a.part").write_text("")
    for left in (".unfinished-old", "kept/.a.part"):
        os.utime(out / left, (0, 0))
    assert antumbra("lecture", "one", "--quick", "-o", "out").code == 0
    left = [p.name for p in [*out.iterdir(), *(out / "kept").iterdir()] if p.name.startswith(".")]
    assert left == [".unfinished-new"], "it may be another run's of this hour"


def test_a_figure_that_fails_is_said_and_the_others_go_on(two_figures, antumbra, tmp_path, monkeypatch):
    examine = make.examine

    def broken(figure, run):
        if run.name == "one":
            raise ValueError("no\nlight")
        return examine(figure, run)

    monkeypatch.setattr(make, "examine", broken)
    for _ in range(2):
        ended = antumbra("lecture", "--quick", "-o", "out")
        assert ended.code == 1
        assert ended.err.splitlines().count("error: one failed and is left out (ValueError: no light)") == 1
        assert 'id="two"' in (tmp_path / "out/index.html").read_text()


def test_a_number_that_is_none_is_a_failure_of_its_figure(two_figures, antumbra, monkeypatch):
    examine = make.examine
    nan = {"numbers": {"mean": {"value": float("nan")}}}
    monkeypatch.setattr(make, "examine", lambda f, run: examine(f, run) | (nan if run.name == "one" else {}))
    ended = antumbra("lecture", "--quick", "-o", "out")
    assert ended.code == 1 and "error: one failed and is left out (ValueError: " in ended.err


def test_what_older_code_made_is_marked_until_it_is_made_anew(two_figures, antumbra, tmp_path):
    assert antumbra("lecture", "--quick", "-o", "out").code == 0
    record = tmp_path / "out/kept/one.quick.json"
    record.write_text(json.dumps(json.loads(record.read_text()) | {"key": "older"}))
    make.Lecture(tmp_path / "out", two_figures, quick=True).write()
    found = json.loads((tmp_path / "out/lecture.json").read_text())["figures"]
    assert [(f["name"], f["older"]) for f in found] == [("one", True), ("two", False)]
    assert (tmp_path / "out/index.html").read_text().count("Made by older code") == 1
    again = antumbra("lecture", "--quick", "-o", "out")
    assert "1 made by older code, to be replaced" in again.err.splitlines()[0]
    assert "Made by older code" not in (tmp_path / "out/index.html").read_text()


def drawn(svg):
    return {"stage": [{"kind": "drawing", "svg": svg}]}


HOSTILE = [
    {"files": ["../../theirs.txt"]},
    {"files": ["pictures/../../theirs.txt"]},
    {"files": ["/etc/hosts"]},
    {"files": ["pictures\\..\\..\\theirs.txt"]},
    {"files": ["kept/two.json"]},
    {"files": ["pictures/link.png"]},
    {"files": [0]},
    {"files": None},
    {"stage": [{"kind": "row", "cells": [{"kind": "picture", "file": "../theirs.txt"}]}]},
    {"name": "two"},
    {"key": None},
    {"seconds": None},
    {"seconds": float("nan")},
    {"claims": None},
    {"claims": [{"text": "It is."}]},
    {"numbers": None},
    {"exr": ["../theirs.txt"]},
    {"seed": "/../../theirs"},
    drawn("<script>alert(1)</script>"),
    drawn('<g onload="alert(1)"/>'),
    drawn('</svg><img src="x"/><svg>'),
    drawn('<path style="fill:url(https://example.org)"/>'),
    drawn("<!-- --><g/>"),
    {"stage": [{"kind": "plot", "drawing": "<svg><a href='javascript:alert(1)'/></svg>"}]},
]


@pytest.mark.parametrize("said", HOSTILE, ids=str)
def test_a_record_that_names_other_files_than_a_figure_s_own_is_not_believed(tmp_path, said):
    theirs, out = tmp_path / "theirs.txt", tmp_path / "out"
    theirs.write_text("precious")
    for folder in ("kept", "pictures", "new/pictures"):
        (out / folder).mkdir(parents=True)
    (out / "kept/two.json").write_text("{}")
    (out / "pictures/link.png").symlink_to(theirs)
    (out / "new/pictures/one.png").write_text("new")
    record = RECORD | said
    (out / "kept/one.json").write_text(json.dumps(record))
    folder = keep.Folder(out)
    assert folder.kept("one") is None
    folder.finish(out / "new", RECORD | {"key": "1", "files": ["pictures/one.png"]})
    assert theirs.read_text() == "precious" and (out / "kept/two.json").exists()
    assert folder.kept("one", "1")


def test_the_drawings_of_the_lecture_only_draw():
    for svg in (
        '<g class="rg1" data-j="0"><path class="ray f" d="M0 0L9 9"/></g><text x="1" y="2">a &lt; b</text>',
        "",
    ):
        assert only_draws(svg)


def test_the_key_is_of_everything_that_computes_a_figure(monkeypatch, tmp_path):
    ours = {path.relative_to(catalog.ROOT).as_posix() for path in catalog.sources("noise")}
    assert {"scene.py", "study/statistics.py", "lecture/run.py", "lecture/figures/noise.py"} <= ours
    assert not {"cli/lecture.py", "lecture/page/__init__.py", "lecture/figures/pixel.py"} & ours
    before, core = keep.key("noise", True, 0), tmp_path / "core.so"
    core.write_bytes(b"another core")
    monkeypatch.setattr(_made_by._core, "__file__", str(core))
    assert keep.key("noise", True, 0) != before
