"""The table of one file of results: `python benches/table.py FILE [--markdown]`."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from race import line


def markdown(row: dict[str, Any]) -> str:
    """One row of a Markdown table."""
    sign = "≥" if row["bound"] == "least" else "≤"
    target = "" if row["target"] is None else f"{sign} {row['target']:g}"
    value = f"**{row['median']:.3g}** ({row['low']:.3g}–{row['high']:.3g})"
    differ = row["more"].get("differ")
    answers = "" if differ is None else f"{differ:,} of {row['more']['asked']:,}"
    cells = (row["number"], row["work"], row["peer"], row["threads"], value, target, row["verdict"], answers)
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def main() -> None:
    """Prints it."""
    found = json.loads(Path(sys.argv[1]).read_text())
    rows = sorted(found["rows"], key=lambda row: int("".join(c for c in row["number"] if c.isdigit())))
    if "--markdown" in sys.argv:
        print("| # | work | peer | threads | reached (spread) | target | verdict | answers that differ |")
        print("|---|---|---|---|---|---|---|---|")
        print("\n".join(map(markdown, rows)))
        return
    box = found["machine"]
    print(f"\n{box['cpu']}, {box['cores']} cores, {box['date']}, load {box['load_average_at_start'][0]}")
    print(f"{'#':>3}  {'work | peer':<72} {'th':>2}  {'median (least–largest)':<22} {'target':<8} verdict")
    print("\n".join(map(line, rows)))
    missed = [row for row in rows if row["verdict"] == "missed"]
    print(
        f"\n{len(missed)} of {sum(row['target'] is not None for row in rows)} targets missed: {sys.argv[1]}"
    )


if __name__ == "__main__":
    main()
