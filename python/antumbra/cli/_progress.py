"""A bar on standard error while a picture is rendered, where standard error is a terminal."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    import rich.progress

    from antumbra.messages import Progress

# Work that is over sooner shows no bar.
_PATIENCE = 1.0


class Bar:
    """`with Bar() as bar: scene.render(progress=bar.show)`: a bar with the time left, once it takes over a second."""

    def __init__(self, quiet: bool) -> None:
        """Draws nothing if `quiet` or if nobody watches."""
        self._wanted = not quiet and sys.stderr.isatty()
        self._began = time.monotonic()
        self._drawn: rich.progress.Progress | None = None

    @property
    def show(self) -> Callable[[Progress], object] | None:
        """What to call with each step, or None if nothing is drawn."""
        return self._show if self._wanted else None

    def __enter__(self) -> Self:
        """Starts the clock."""
        self._began = time.monotonic()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, _: BaseException | None, __: TracebackType | None
    ) -> None:
        """Leaves a full bar, or as far as it came."""
        if self._drawn:
            if kind is None:
                self._drawn.update(self._drawn.task_ids[0], completed=1.0)
            self._drawn.stop()

    def _show(self, state: Progress) -> None:
        if self._drawn is None and time.monotonic() - self._began > _PATIENCE:
            self._drawn = _rich_bar()
            self._drawn.start()
        if self._drawn:
            self._drawn.update(self._drawn.task_ids[0], completed=state.done)


def _rich_bar() -> rich.progress.Progress:
    import rich.console
    import rich.progress as r

    bar = r.Progress(
        r.TextColumn("  rendering"),
        r.BarColumn(),
        r.TextColumn("{task.percentage:>3.0f} %"),
        r.TimeRemainingColumn(elapsed_when_finished=True),
        console=rich.console.Console(stderr=True),
    )
    bar.add_task("rendering", total=1.0)
    return bar
