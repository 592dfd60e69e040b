"""Broken files, through the command, in processes of their own: the manifest says what a good program answers."""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import time

import pytest

from common import data_folder

FOLDER = data_folder()
MANIFEST = (
    json.loads((FOLDER / "malformed/manifest.json").read_text(encoding="utf-8")) if FOLDER else {"cases": []}
)
SETTINGS = ["--size", "16x16", "--viewing-rays", "1"]


def limited() -> None:
    """Twice the manifest's memory as address space: our libraries are mapped too."""
    most = (2 * MANIFEST["limits"]["memory_mib"] + 1024) << 20
    resource.setrlimit(resource.RLIMIT_AS, (most, most))


def render(file, folder):
    whole = [sys.executable, "-m", "antumbra", "render", str(file), *SETTINGS, "-o", "out.exr"]
    return subprocess.run(
        whole, capture_output=True, text=True, cwd=folder, timeout=120, check=False, preexec_fn=limited
    )


@pytest.mark.parametrize("case", MANIFEST["cases"], ids=lambda case: case["file"])
def test_broken_file(case, data, tmp_path):
    file = data / "malformed" / case["file"]
    if not file.is_file():
        pytest.skip(f"{file.name} is not in the data")
    began = time.monotonic()
    done = render(file, tmp_path)
    seconds = time.monotonic() - began
    left = [p.name for p in tmp_path.iterdir()]
    said = done.stderr
    assert "panicked" not in said and "Traceback" not in said, said
    assert seconds < 10 * MANIFEST["limits"]["seconds"]
    if case["expect"] == "error":
        assert (done.returncode, left) == (2, []), said
        assert said.startswith(f"error: {file}: ") and said.count("error:") == 1, said
    else:
        assert (done.returncode, left) == (0, ["out.exr"]), said
        assert ("warning: " in said) == (case["expect"] == "warning"), said
        warnings = [line for line in said.splitlines() if line.startswith("warning: ")]
        assert len(warnings) == len(set(warnings)), said


def test_the_manifest_is_there(data):
    assert len(MANIFEST["cases"]) > 80
