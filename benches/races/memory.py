"""Memory of a render by samples per pixel: the largest resident size of whole processes."""

from __future__ import annotations

import os
import subprocess
import sys

from race import Row, options, report, spread

NUMBER, TARGET = "17", 1.05
RAYS = (16, 64, 256, 1024)
PROGRAM = "import sys, antumbra as am; am.builtin(sys.argv[1]).render(viewing_rays=int(sys.argv[2]), size=({0}, {1}))"


def main() -> None:
    """Each number of viewing rays in a process of its own."""
    asked = options(__doc__, rays=RAYS[-1])
    size = (32, 24) if asked.quick else (96, 72)
    rows = []
    for name in ("pillars", "interior"):
        counts = [n for n in RAYS if n <= (64 if asked.quick else asked.rays)]
        peak = {n: largest([sys.executable, "-c", PROGRAM.format(*size), name, str(n)]) for n in counts}
        shares = [bytes_ / peak[counts[0]] for bytes_ in peak.values()]
        work = f"{name}, {size[0]} × {size[1]}, {counts[0]} to {counts[-1]} viewing rays"
        fields = spread(shares) | {"median": max(shares)}
        row = Row("memory", NUMBER, work, "", 2, "largest memory / that of the fewest rays", **fields)
        row.target, row.bound = TARGET, "most"
        row.more = {f"MB at {n}": round(bytes_ / 1e6, 1) for n, bytes_ in peak.items()}
        rows.append(row)
    report(rows, asked.result)


def largest(words: list[str]) -> int:
    """Largest resident size of one process [bytes]."""
    child = subprocess.Popen(words)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{' '.join(words)} failed with {child.returncode}")
    return usage.ru_maxrss * 1024


if __name__ == "__main__":
    main()
