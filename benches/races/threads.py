"""Rendering with one thread and with two, in turn.

The ratio of times on the clock needs two free cores. What a busy machine cannot hide stands beside it: processor time
of one thread over that of two is 1 where the second thread costs nothing.
"""

from __future__ import annotations

import antumbra as am
from race import Row, cores, in_turn, options, ratios, report

NUMBER, TARGET = "16", 1.8
# Scene, and how it is asked for: one of direct light, one of paths.
WORK = {
    "interior": {"estimator": "area", "viewing_rays": 16, "size": (640, 400)},
    "cornell-box": {"estimator": "path", "viewing_rays": 32, "size": (512, 512)},
}


def main() -> None:
    """Both scenes."""
    asked = options(__doc__)
    rows = []
    for name, words in WORK.items():
        if asked.quick:
            words = words | {"viewing_rays": 1, "size": (160, 120)}
        scene = am.builtin(name)
        pictures = {}

        def render(threads: int, scene: am.Scene = scene, words: dict = words, kept: dict = pictures) -> None:
            kept[threads] = scene.render(threads=threads, **words)

        with cores(2):
            one, two = in_turn([lambda: render(1), lambda: render(2)], asked.rounds)
        work = f"{name}, {words['estimator']}, {words['viewing_rays']} viewing rays"
        measure = "seconds on the clock, 1 thread / 2 threads"
        row = Row(
            "threads",
            NUMBER,
            work,
            "itself, 1 thread",
            2,
            measure,
            **ratios(one.wall, two.wall),
            target=TARGET,
        )
        rays = pictures[1].rays
        row.more = {
            "processor time, 1 thread / 2": round(ratios(one.processor, two.processor)["median"], 3),
            "Mray/s, 1 thread": round(rays / min(one.wall) / 1e6, 2),
            "same bits": bool((pictures[1].pixels == pictures[2].pixels).all()),
        }
        rows.append(row)
    report(rows, asked.result)


if __name__ == "__main__":
    main()
