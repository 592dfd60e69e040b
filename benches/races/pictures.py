"""Whole pictures against Mitsuba 3: samples a second, and time × relMSE, on real scenes of Mitsuba's own format.

Same work for the rates: one independent sample of a uniformly chosen light and one of the BSDF (MIS), or paths of five
bounces; box filter, one thread, processor time; the means of both pictures are compared. For time × relMSE both run as
they are by default (ours: Owen points, lights by their contribution). Peers: `llvm_ad_rgb` (needs libLLVM 15 or later:
DRJIT_LIBLLVM_PATH names it) and `scalar_rgb`.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import antumbra as am
from race import ROOT, Row, Times, cores, in_turn, options, ratios, report, spread

DATA = Path(os.environ.get("ANTUMBRA_DATA", ROOT.parent / "shared" / "data"))
SIZE = (256, 192)
SCENES = "cornell-box,staircase2,living-room"
# Number in the performance table, our estimator, Mitsuba's integrator.
WORK = {
    "10": ("mis", {"type": "direct"}),
    "11": ("path", {"type": "path", "max_depth": 6}),
}
# Mitsuba's variants, with the least ratio of speeds.
PEERS = {"scalar_rgb": 1.5, "llvm_ad_rgb": 0.5}
EFFICIENCY = {"gen-many-lights": 10.0}

Picture = NDArray[np.floating[Any]]
Render = Callable[[int], Picture]


def main() -> None:
    """All scenes, integrators and peers."""
    asked = options(__doc__, scenes=SCENES, samples=16)
    if find_spec("mitsuba") is None:
        print("mitsuba is not installed: left out")
        return
    samples = 2 if asked.quick else asked.samples
    rows = []
    for peer, target in PEERS.items():
        for name in [*asked.scenes.split(","), *EFFICIENCY]:
            theirs = mitsuba(name, peer)
            if theirs is None:
                break
            for number, (estimator, integrator) in WORK.items():
                if name in EFFICIENCY:
                    break
                pair = (
                    ours(name, samples, estimator, lights="uniform", sampler="random"),
                    theirs(integrator, samples),
                )
                rows.append(rate(name, number, peer, target, samples, pair, asked.rounds))
            if peer == "llvm_ad_rgb":
                pair = ours(name, samples, "mis"), theirs(WORK["10"][1], 4 * samples)
                rows.append(efficiency(name, peer, EFFICIENCY.get(name, 2.0), pair, asked.rounds))
    report(rows, asked.result)


def file(name: str) -> str:
    """The scene as Mitsuba wrote it."""
    return str(DATA / "scenes" / "xml" / name / "scene.xml")


def ours(name: str, samples: int, estimator: str, **choices: str) -> Render:
    """Our picture for a seed."""
    scene = am.load(file(name))
    fixed: dict[str, Any] = {"size": SIZE, "viewing_rays": samples, "filter": "box", "threads": 1, **choices}

    def render(seed: int) -> Picture:
        return scene.render(estimator=estimator, bounces=5, seed=seed, **fixed).pixels

    return render


def mitsuba(name: str, variant: str) -> Callable[[dict[str, Any], int], Render] | None:
    """Mitsuba's pictures of a scene in a variant; `None` where the variant does not run here."""
    import drjit
    import mitsuba as mi

    try:
        mi.set_variant(variant)
    except ImportError as error:
        print(f"mitsuba {variant}: {error}: left out")
        return None
    # With one thread in a process on one core its EXR reader waits for ever.
    drjit.set_thread_count(2)
    width, height = map(str, SIZE)
    scene = mi.load_file(file(name), resx=width, resy=height)

    def with_integrator(integrator: dict[str, Any], samples: int) -> Render:
        made = mi.load_dict(integrator)
        return lambda seed: np.array(mi.render(scene, integrator=made, spp=samples, seed=seed))

    return with_integrator


def race(pair: tuple[Render, Render], rounds: int) -> tuple[list[Times], list[list[Picture]]]:
    """Times of both, in turn on one core, and all their pictures, each with another seed."""
    pictures: list[list[Picture]] = [[], []]

    def turn(which: int) -> Callable[[], None]:
        return lambda: pictures[which].append(pair[which](len(pictures[which])))

    with cores(1):
        times = in_turn([turn(0), turn(1)], rounds)
    return times, pictures


def rate(
    name: str, number: str, peer: str, target: float, samples: int, pair: tuple[Render, Render], rounds: int
) -> Row:
    """Samples a second: ours over theirs."""
    times, pictures = race(pair, rounds)
    [mine, theirs] = (np.mean(each) for each in pictures)
    estimator = WORK[number][0]
    row = Row("pictures", number, f"{name}, {estimator}", f"mitsuba {peer}", 1, "samples a second, ours / theirs",
              **ratios(times[1].processor, times[0].processor), target=target)  # fmt: skip
    rays = SIZE[0] * SIZE[1] * samples / 1e6
    row.more = {
        "M samples/s, ours and theirs": ", ".join(f"{rays / np.median(t.processor):.2f}" for t in times),
        "means differ by": f"{abs(mine / theirs - 1):.2%}",
    }
    return row


def efficiency(name: str, peer: str, target: float, pair: tuple[Render, Render], rounds: int) -> Row:
    """Time × relMSE: theirs over ours."""
    times, pictures = race(pair, rounds)
    cost = [
        [seconds * error for seconds in taken.processor]
        for taken, error in zip(times, map(rel_mse, pictures), strict=True)
    ]
    row = Row("pictures", "12", f"{name}, direct", f"mitsuba {peer}", 1, "time × relMSE, theirs / ours",
              **spread([b / a for a, b in zip(*cost, strict=True)]), target=target)  # fmt: skip
    row.more = {"s × relMSE, ours and theirs": ", ".join(f"{np.median(each):.2g}" for each in cost)}
    return row


def rel_mse(pictures: list[Picture]) -> float:
    """Mean over pixels of variance / (mean² + 0.01), of the mean of the channels, from independent pictures."""
    grey = np.stack([each.mean(axis=-1, dtype=np.float64) for each in pictures])
    return float(np.mean(grey.var(axis=0, ddof=1) / (grey.mean(axis=0) ** 2 + 0.01)))


if __name__ == "__main__":
    main()
