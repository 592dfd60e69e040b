"""`scene.occluded` on NumPy rays against embreex and Open3D: the same rays, the same threads, in turn.

One thread: processor time on one core. Two: time on the clock. Every answer is compared; where some differ, a sample
is decided in rational numbers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from exact import blocked
from peers import Answer, antumbra, found
from race import Row, Times, cores, in_turn, options, ratios, report
from scenes import Mesh, Rays, builtin, rays

NUMBER, TARGET = "9", 1.2
# So many of the differing answers are decided exactly (each looks at every triangle).
DECIDED = 64


def main() -> None:
    """All scenes, kinds of rays and numbers of threads."""
    asked = options(__doc__, size=10_000_000, scenes="interior,terrain")
    size = min(asked.size, 200_000) if asked.quick else asked.size
    rows = []
    for name in asked.scenes.split(","):
        mesh = builtin(name)
        ours, theirs = antumbra(mesh), {who: make(mesh) for who, make in found().items()}
        for kind in rays(mesh, size, seed=9):
            for threads in (1, 2):
                # embreex has one thread only.
                racing = {w: of for w, of in theirs.items() if threads == 1 or not w.startswith("embreex")}
                answers = [of(kind, threads) for of in (ours, *racing.values())]
                with cores(threads):
                    times = in_turn(answers, asked.rounds)
                rows += compare(mesh, kind, threads, answers, times, list(racing))
    report(rows, asked.result)


def compare(
    mesh: Mesh, kind: Rays, threads: int, answers: list[Answer], times: list[Times], names: list[str]
) -> list[Row]:
    """A row for each peer."""
    mine, rows = answers[0](), []
    for answer, taken, name in zip(answers[1:], times[1:], names, strict=True):
        attribute = "processor" if threads == 1 else "wall"
        theirs, ours = getattr(taken, attribute), getattr(times[0], attribute)
        other = answer()
        more = {
            "Mray/s, ours and theirs": ", ".join(
                f"{len(mine) / np.median(t) / 1e6:.2f}" for t in (ours, theirs)
            ),
            "blocked": f"{mine.mean():.1%}",
            "asked": len(mine),
            **(judge(mesh, kind, mine, other) if threads == 1 else {"differ": int((mine != other).sum())}),
        }
        measure = f"{attribute} time of the peer / ours"
        line = Row("arrays", NUMBER, kind.work, name, threads, measure, **ratios(theirs, ours), target=TARGET)
        line.more = more
        rows.append(line)
    return rows


def judge(mesh: Mesh, kind: Rays, ours: NDArray[np.bool_], theirs: NDArray[np.bool_]) -> dict[str, int]:
    """How many answers differ, and who is right in a sample of them."""
    differ = np.flatnonzero(ours != theirs)
    drawn = np.random.default_rng(1).permutation(differ)[:DECIDED]
    corners = mesh.corners()
    truth = [blocked(corners, kind.origins[i], kind.directions[i], kind.reach) for i in drawn]
    right = int(np.sum(ours[drawn] == np.array(truth, bool)))
    return {
        "differ": len(differ),
        "decided": len(drawn),
        "ours right": right,
        "theirs right": len(drawn) - right,
    }


if __name__ == "__main__":
    main()
