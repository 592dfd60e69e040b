"""Ctrl-C: the picture so far is kept, the exit code is 130, and a query inside Python ends with KeyboardInterrupt."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import time

import pytest

import antumbra as am

# Passes of a small picture are short: some are done soon after the start, even on a busy machine.
LONG = ["--size", "64x48", "--viewing-rays", "10000000", "--shadow-rays", "1"]


def listening() -> None:
    """A process that is started in the background may inherit that Ctrl-C is ignored: it must not be here."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def interrupted(command, folder, after):
    """Runs it, presses Ctrl-C after some seconds, and says how it ended."""
    process = subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=listening
    )
    time.sleep(after)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    return process.returncode, out, err


def test_ctrl_c_keeps_the_picture_so_far(tmp_path):
    command = [
        sys.executable,
        "-m",
        "antumbra",
        "render",
        "pillars",
        *LONG,
        "--estimator",
        "area",
        "-o",
        "p.png",
    ]
    code, out, err = interrupted(command, tmp_path, after=5.0)
    assert code == 130, err
    assert out == "" and "Traceback" not in err
    said = r"stopped after ([\d,]+) of 10,000,000 passes; p\.png holds them, standard error .*\n$"
    done = re.search(said, err)
    assert done and int(done[1].replace(",", "")) > 0, err
    assert am.load_image(tmp_path / "p.png").max() > 0
    assert [p.name for p in tmp_path.iterdir()] == ["p.png"]


QUERY = """
import numpy as np, antumbra as am
scene = am.builtin("{name}")
points = np.random.default_rng(1).uniform(-1, 1, (1_000_000, 3))
print("asking", flush=True)
try:
    {ask}
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


# The second: 400 lights are weighed for each of a million receivers.
ASKED = [
    ("pillars", "scene.ambient_occlusion(points, (0.0, 1, 0), rays=100_000)"),
    ("many-lights", "scene.sample_light(points, (0.0, 1, 0), points % 1, lights='contribution')"),
    ("pillars", "[scene.explain((250, 300), viewing_rays=65536) for _ in range(1000)]"),
]


@pytest.mark.parametrize(("name", "ask"), ASKED)
def test_ctrl_c_ends_a_query(name, ask):
    process = subprocess.Popen(
        [sys.executable, "-c", QUERY.replace("{name}", name).replace("{ask}", ask)],
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=listening,
    )
    assert process.stdout.readline() == "asking\n"
    # It takes many seconds, and has begun.
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert (process.returncode, out) == (0, "interrupted\n")


RENDER = """
import signal, threading, os, time
import antumbra as am
scene = am.builtin("pillars")
threading.Timer(2.0, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    scene.render(size=(64, 48), viewing_rays=10_000_000)
except KeyboardInterrupt as stopped:
    assert isinstance(stopped, am.RenderStopped)
    assert 0 < stopped.image.passes_done < stopped.image.passes
    print(stopped.image.pixels.max() > 0)
"""


def test_ctrl_c_inside_python_keeps_the_image():
    done = subprocess.run(
        [sys.executable, "-c", RENDER],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        preexec_fn=listening,
    )
    assert done.stdout == "True\n", done.stderr
