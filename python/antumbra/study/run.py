"""`run`: a study from Python."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antumbra.study.job import Job
from antumbra.study.plan import plan
from antumbra.study.renders import Step
from antumbra.study.result import Study
from antumbra.study.sources import Source, source

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from antumbra.scene import Scene

SEEDS = 8


def run(
    scene: Scene | Source | str | Callable[[Mapping[str, float]], Scene],
    *,
    vary: Mapping[str, Sequence[Any]],
    reference: str | PathLike[str] | ArrayLike | None = None,
    reference_error: str | PathLike[str] | None = None,
    reference_rays: int | None = None,
    budget: Mapping[str, Sequence[float]] | None = None,
    seeds: int = SEEDS,
    parameters: Mapping[str, float] | None = None,
    folder: str | PathLike[str] | None = None,
    progress: Callable[[Step], object] | None = None,
    command: str = "",
    **options: Any,
) -> Study:
    """Measures the error of several ways of rendering a scene, each from `seeds` independent renders.

    `scene`: a Scene, the name of a built-in one, a file, or a function that makes it of its parameters. `vary`:
    settings of `render`, or `D.NAME` of the scene's parameters, with the values to take; all combinations are
    rendered. `options`: every other setting of `render`; `parameters`: those of the scene. `budget`: {"rays": […]}
    per pixel or {"seconds": […]} per picture, to be spent alike by all; pilots find out how many rays that is.

    `reference`: a picture's file (`reference_error`: one with its standard errors), an (H, W, 3) array, or the name
    of an estimator, best of a kind that is not varied. It is rendered with `reference_rays` viewing rays over 8 seeds
    (default: as many as all variants take, or more, until pilots find its own error small). None chooses an estimator,
    apart from those varied if one sees the light well (short pilots find out), else with a warning. Its own noise is
    taken off, and told. What a Mitsuba file asks for holds where neither `vary` nor `options` says something else.

    `folder`: where results.csv, results.json and index.html go; rows that an earlier, stopped run of the same study
    left there are kept. `progress` is called with a `Step`. `command`: how this was called, for the page.

    Raises, before anything is rendered, ValueError for what cannot be varied and OSError for a folder that cannot be
    written; `StudyStopped` (a KeyboardInterrupt) with `.study` on Ctrl-C.

    >>> import antumbra as am
    >>> am.study.run("pillars", vary={"shadow_rays": [1, 4]}, estimator="area", viewing_rays=1, size=(8, 6), seeds=3)
    <Study of pillars: 2 rows × 3 seeds>
    """
    found = scene if isinstance(scene, Source) else source(scene)
    own = {name: float(value) for name, value in (parameters or {}).items()}
    own = own if found.verbatim else {name.replace("_", "-"): value for name, value in own.items()}
    made = plan(vary, options, parameters=own, budget=budget or {}, seeds=seeds, verbatim=found.verbatim)
    job = Job(made, found, progress)
    job.command = command
    job.settle_reference(reference, reference_error, reference_rays)
    return job.run(None if folder is None else Path(fspath(folder)))
