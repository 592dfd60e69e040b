"""What every race shares: contestants in turn, ratios with their spread, one file of results a run."""

from __future__ import annotations

import argparse
import json
import os
import platform
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "benches" / "results"
PEERS = ("numpy", "embreex", "open3d-cpu", "mitsuba", "trimesh", "rtree", "pyvista")


@dataclass
class Row:
    """One line of a result: what was done, against whom, and how it came out."""

    race: str
    # Its number in the table of docs/performance.md.
    number: str
    work: str
    peer: str
    threads: int
    # What `median` is: "peer's processor time / ours", "seconds", ...
    measure: str
    median: float
    low: float
    high: float
    rounds: int
    target: float | None = None
    # The target is a least value ("least") or a largest one ("most").
    bound: str = "least"
    # Further numbers: rates, answers that differ, ...
    more: dict[str, Any] = field(default_factory=dict)
    load: float = field(default_factory=lambda: round(os.getloadavg()[0], 2))

    @property
    def verdict(self) -> str:
        """ "reached", "missed", or "" without a target."""
        if self.target is None:
            return ""
        good = self.median >= self.target if self.bound == "least" else self.median <= self.target
        return "reached" if good else "missed"


@dataclass
class Times:
    """Seconds of one contestant, round by round."""

    wall: list[float] = field(default_factory=list)
    processor: list[float] = field(default_factory=list)


def options(what: str | None, **extra: Any) -> argparse.Namespace:
    """The options that every race takes; `extra`: name and default of more."""
    parser = argparse.ArgumentParser(description=what)
    parser.add_argument(
        "--quick", action="store_true", help="small sizes: shows that it works, measures nothing"
    )
    parser.add_argument("--rounds", type=int, default=7, help="turns of each contestant (7)")
    parser.add_argument("--result", type=Path, help="the file that the rows are added to")
    for name, default in extra.items():
        kind = type(default)
        parser.add_argument(f"--{name}", type=kind, default=default, help=f"({default})")
    asked = parser.parse_args()
    if asked.quick:
        asked.rounds = min(asked.rounds, 3)
    return asked


def in_turn(contestants: Sequence[Callable[[], object]], rounds: int) -> list[Times]:
    """Times of all, one after the other, A B A B ...; a first turn of each warms up and does not count."""
    times = [Times() for _ in contestants]
    for turn in range(rounds + 1):
        for work, kept in zip(contestants, times, strict=True):
            wall, processor = time.perf_counter(), time.process_time()
            work()
            if turn > 0:
                kept.wall.append(time.perf_counter() - wall)
                kept.processor.append(time.process_time() - processor)
    return times


def ratios(over: Sequence[float], under: Sequence[float]) -> dict[str, Any]:
    """Median, least and largest of over / under, round by round: the fields of a Row."""
    return spread([a / b for a, b in zip(over, under, strict=True)])


def spread(values: Sequence[float]) -> dict[str, Any]:
    """Median, least and largest: the fields of a Row."""
    return {
        "median": statistics.median(values),
        "low": min(values),
        "high": max(values),
        "rounds": len(values),
    }


def cargo_bench(package: str, name: str, **surroundings: str) -> list[dict[str, Any]]:
    """What a bench of a crate writes into the file that ANTUMBRA_RESULT names."""
    words = ["cargo", "bench", "--locked", "--profile", "demo", "--quiet", "-p", package, "--bench", name]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "result.json"
        known = os.environ | surroundings | {"ANTUMBRA_RESULT": str(file)}
        subprocess.run(words, cwd=ROOT, env=known, check=True, stdout=subprocess.DEVNULL)
        found: list[dict[str, Any]] = json.loads(file.read_text())
    return found


@contextmanager
def cores(count: int) -> Iterator[None]:
    """This process and what it starts run on the last `count` cores that it may use."""
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, sorted(before)[-count:])
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)


def cpu() -> str:
    """Name of the processor; family and model where the name says little."""
    found: dict[str, str] = {}
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        key, _, value = line.partition(":")
        found.setdefault(key.strip(), value.strip())
    name = found.get("model name", platform.processor() or platform.machine())
    return f"{name} (family {found.get('cpu family', '?')} model {found.get('model', '?')})"


def machine() -> dict[str, Any]:
    """What the run was made on and of."""
    versions: dict[str, str] = {"python": platform.python_version()}
    for name in PEERS:
        try:
            versions[name] = version(name)
        except PackageNotFoundError:
            versions[name] = "absent"
    return {
        "date": time.strftime("%Y-%m-%d %H:%M"),
        "cpu": cpu(),
        "cores": os.cpu_count(),
        "system": platform.platform(),
        "load_average_at_start": [round(x, 2) for x in os.getloadavg()],
        "commit": _git("rev-parse", "HEAD"),
        "changed_files": len(_git("status", "--porcelain", "--untracked-files=no").splitlines()),
        "versions": versions,
    }


def _git(*words: str) -> str:
    done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=False)
    return done.stdout.strip()


def result_path() -> Path:
    """A fresh name under benches/results: date, time, machine."""
    name = "".join(c if c.isalnum() else "-" for c in cpu().split("(family")[0].lower())
    words = [w for w in name.split("-") if w not in ("", "r", "tm", "processor")]
    return RESULTS / f"{time.strftime('%Y-%m-%d-%H%M')}-{'-'.join(words)}-{os.cpu_count()}-cores.json"


def report(rows: Sequence[Row], file: Path | None) -> None:
    """Prints the rows and adds them to the file, in place of older ones of the same race."""
    for row in rows:
        print(line(asdict(row) | {"verdict": row.verdict}), flush=True)
    if file is None or not rows:
        return
    known = json.loads(file.read_text()) if file.exists() else {"machine": machine(), "rows": []}
    kept = [old for old in known["rows"] if old["race"] != rows[0].race]
    known["rows"] = kept + [asdict(row) | {"verdict": row.verdict} for row in rows]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(known, indent=1, ensure_ascii=False) + "\n")


def line(row: dict[str, Any]) -> str:
    """One row for the eye."""
    value = f"{row['median']:.3g} ({row['low']:.3g}–{row['high']:.3g})"
    sign = "≥" if row["bound"] == "least" else "≤"
    wanted = "" if row["target"] is None else f"{sign} {row['target']:g}"
    who = f"{row['work']} | {row['peer']}" if row["peer"] else row["work"]
    head = f"{row['number']:>3}  {who:<72} {row['threads']:>2}  {value:<22} {wanted:<8}"
    return f"{head} {row['verdict']:<8} {_notes(row)}"


def _notes(row: dict[str, Any]) -> str:
    return ", ".join(
        f"{name} {value}" for name, value in row["more"].items() if not isinstance(value, dict | list)
    )
