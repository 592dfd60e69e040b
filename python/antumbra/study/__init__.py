"""Error against rays and seconds: `run` measures ways of rendering a scene against each other.

>>> import antumbra as am
>>> found = am.study.run(
...     "pillars", vary={"sampler": ["random", "owen"], "shadow_rays": [1, 4]},
...     estimator="area", viewing_rays=1, viewing="centre", size=(16, 12), seeds=4,
... )
>>> found
<Study of pillars: 4 rows × 4 seeds>
>>> -1.5 < found.slope("random").value < -0.5
True

`statistics` has the intervals, `plot` the curves, `bias` the test.
"""

from __future__ import annotations

from antumbra.study import statistics
from antumbra.study.files import FolderError
from antumbra.study.job import StudyStopped
from antumbra.study.renders import Step
from antumbra.study.result import Study
from antumbra.study.rows import Row
from antumbra.study.run import run
from antumbra.study.statistics import Interval

__all__ = ["FolderError", "Interval", "Row", "Step", "Study", "StudyStopped", "run", "statistics"]
