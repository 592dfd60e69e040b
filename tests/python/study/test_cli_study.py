"""`antumbra study` as people call it."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time

import pytest

SMALL = ["--estimator", "area", "--viewing-rays", "1", "--size", "8x6", "--seeds", "3"]
VARY = ["--vary", "sampler=random,owen", "--vary", "shadow-rays=1,4"]


def test_a_study_prints_a_line_per_curve_and_where_the_page_is(antumbra, tmp_path):
    done = antumbra("study", "pillars", *VARY, *SMALL, "-o", "out")
    assert done.code == 0, done.err
    lines = done.out.splitlines()
    assert [line.split()[0] for line in lines] == ["slope", "random", "owen", "out/index.html"]
    # Of three seeds hardly anything is sure.
    assert "4 rows × 3 seeds · a bias" in lines[-1] and lines[-1].endswith("was not testable")
    assert (tmp_path / "out" / "index.html").stat().st_size > 5_000
    assert json.loads((tmp_path / "out" / "results.json").read_text("utf-8"))["axis"] == "shadow_rays"


def test_values_with_commas_are_joined_by_semicolons(antumbra, tmp_path):
    done = antumbra("study", "pillars", "--vary", "eye=0,3,6;0,4,5", *SMALL, "--quiet")
    assert done.code == 0, done.err
    whole = json.loads((tmp_path / "pillars-study" / "results.json").read_text("utf-8"))
    assert [row["truth"] for row in whole["rows"]] == [0, 1]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["pillers", *VARY], 'there is no scene "pillers"; did you mean "pillars"?'),
        (["pillars"], "--vary"),
        (["pillars", "--vary", "sampler"], "a name and its values are needed"),
        (["pillars", "--vary", "samplr=owen"], 'did you mean "sampler"'),
        (["pillars", "--vary", "sampler=owne"], 'did you mean "owen"'),
        (["pillars", *VARY, "--vary", "sampler=regular"], "a name is there twice"),
        (["pillars", *VARY, "--budget", "rays"], "as --budget rays=64"),
        (["pillars", *VARY, "--budget", "rays=many"], "as --budget rays=64"),
        (["pillars", *VARY, "--reference", "missing.exr"], "missing.exr"),
        (["pillars", *VARY, "-D", "light-sise=1"], 'did you mean "light-size"'),
        (["missing.glb", *VARY], "missing.glb"),
        (["pillars", *VARY, "-o", "file"], "Nothing was rendered."),
    ],
)
def test_bad_input_ends_with_2_and_leaves_nothing(antumbra, tmp_path, words, said):
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    done = antumbra("study", *words, *SMALL)
    assert done.code == 2 and said in done.err, done.err
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def test_ctrl_c_keeps_the_finished_rows(tmp_path):
    # The second row takes a minute, in renders of a fraction of a second.
    long = ["--vary", "shadow-rays=1,2000", "--estimator", "area", "--viewing-rays", "1", "--seeds", "200"]
    command = [sys.executable, "-m", "antumbra", "study", "pillars", *long, "--size", "32x24", "-o", "out"]
    process = subprocess.Popen(
        [*command, "--reference-rays", "64"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        # A shell that starts jobs in the background may have switched Ctrl-C off.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )  # fmt: skip
    results = tmp_path / "out" / "results.json"
    for _ in range(600):
        if results.exists():
            break
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130, err
    assert out == "" and "out holds the 1 row" in err and "Traceback" not in err
    assert len(json.loads(results.read_text("utf-8"))["rows"]) == 1
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == [
        "index.html",
        "results.csv",
        "results.json",
    ]
