"""A study as people hold it: what was found, and how it shows itself."""

from __future__ import annotations

from dataclasses import dataclass

from antumbra.study import page
from antumbra.study.findings import Findings


@dataclass(frozen=True, repr=False)
class Study(Findings):
    """A table of error against rays and seconds, as `antumbra.study.run` returns it; it shows itself in a notebook."""

    def html(self) -> str:
        """The page: plots, tables, what was measured how. Whole in one file, no network."""
        return page.page(self)

    def _repr_html_(self) -> str:
        return page.fragment(self)
