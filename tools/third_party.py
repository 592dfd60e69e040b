"""Writes THIRD-PARTY.md: every Rust crate that the wheel links, with its licence (from `cargo metadata`).

`--check` writes nothing and fails if the file is out of date.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
FILE = ROOT / "THIRD-PARTY.md"
HEAD = """# Third-party software

The wheel links the Rust crates below, each under the licence that it names. Python packages are installed beside it
and not copied. This page is made by `python tools/third_party.py`.

| crate | version | licence |
|---|---|---|
"""


def metadata() -> dict[str, Any]:
    """What cargo knows of the workspace."""
    command = [
        "cargo",
        "metadata",
        "--format-version",
        "1",
        "--locked",
        "--features",
        "pyo3/extension-module",
    ]
    command += ["--manifest-path", str(ROOT / "crates/antumbra-py/Cargo.toml")]
    found: dict[str, Any] = json.loads(
        subprocess.run(command, check=True, capture_output=True, text=True).stdout
    )
    return found


def linked(found: dict[str, Any]) -> set[str]:
    """Ids of all crates that the binding is built from, not those of tests or of other systems' build tools."""
    nodes = {node["id"]: node for node in found["resolve"]["nodes"]}
    waiting = [p["id"] for p in found["packages"] if p["name"] == "antumbra-py"]
    seen: set[str] = set()
    while waiting:
        current = waiting.pop()
        if current not in seen:
            seen.add(current)
            deps = nodes[current]["deps"]
            waiting += [d["pkg"] for d in deps if any(kind["kind"] != "dev" for kind in d["dep_kinds"])]
    return seen


def page() -> str:
    """The whole page."""
    found = metadata()
    inside = linked(found)
    rows = sorted(
        (p["name"], p["version"], p["license"] or "see its source")
        for p in found["packages"]
        if p["id"] in inside and p["source"]
    )
    return HEAD + "".join(f"| {name} | {version} | {licence} |\n" for name, version, licence in rows)


def main() -> int:
    """Writes or checks the page."""
    text = page()
    if "--check" not in sys.argv[1:]:
        FILE.write_text(text, encoding="utf-8")
        return 0
    if FILE.is_file() and FILE.read_text(encoding="utf-8") == text:
        return 0
    print("error: THIRD-PARTY.md is out of date: run `python tools/third_party.py`", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
