"""Reading a PLY of 10⁶ triangles, a GLB and an STL of 100 MB, and text of 100 MB: bytes to scene builder.

Runs the bench of crates/antumbra-io. Binary files race the copy of their bytes from the warm page cache; text has a
rate to reach. One thread.
"""

from __future__ import annotations

from race import Row, cargo_bench, options, report, spread

NUMBER, TARGET = "14", 5.0
# MB/s of text.
LEAST = 100.0


def main() -> None:
    """One call of the bench."""
    asked = options(__doc__)
    detail = {"ANTUMBRA_DETAIL": "0.05"} if asked.quick else {}
    found = cargo_bench("antumbra-io", "reading", ANTUMBRA_ROUNDS=str(asked.rounds), **detail)
    rows = []
    for one in found:
        work = f"{one['name']}, {one['bytes'] / 1e6:.0f} MB, {one['triangles']:,} triangles"
        if one["name"].startswith("text."):
            fields = spread([one["bytes"] / 1e6 / seconds for seconds in one["building"]])
            row = Row("reading", NUMBER, work, "none", 1, "MB/s", **fields, target=LEAST)
        else:
            measure = "time from bytes to builder / time to read the bytes"
            fields = spread([b / a for a, b in zip(one["reading"], one["building"], strict=True)])
            row = Row(
                "reading",
                NUMBER,
                work,
                "reading the bytes",
                1,
                measure,
                **fields,
                target=TARGET,
                bound="most",
            )
        row.more = {
            f"{key} ms": round(1e3 * spread(one[key])["median"], 1) for key in ("reading", "building")
        }
        rows.append(row)
    report(rows, asked.result)


if __name__ == "__main__":
    main()
