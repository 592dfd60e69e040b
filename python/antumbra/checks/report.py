"""What a check found: one row for each question, and what is wrong in words."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(frozen=True)
class Row:
    """One question: what the function answered ± its standard error, and the truth (both W·m⁻²·sr⁻¹, or shares)."""

    name: str
    answer: float
    error: float
    truth: float
    agrees: bool


@dataclass(frozen=True)
class Report:
    """All rows of a check of the function `name`, the `faults` that they betray, and its time in seconds."""

    name: str
    rows: list[Row]
    faults: list[str] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def passed(self) -> bool:
        """Everything agrees."""
        return not self.faults and all(row.agrees for row in self.rows)

    def as_dict(self) -> dict[str, Any]:
        """All of it as plain values, for JSON."""
        return {"passed": self.passed, **asdict(self)}

    def __str__(self) -> str:
        """A table, and below it what is wrong."""
        wide = max((len(row.name) for row in self.rows), default=0)
        lines = [f"  {'':{wide}}  {'± standard error':>19}  {'truth':>8}"]
        for row in self.rows:
            answer = f"{row.answer:.5f} ± {row.error:.5f}"
            verdict = "agrees" if row.agrees else "wrong"
            lines.append(f"  {row.name:{wide}}  {answer:>19}  {row.truth:8.5f}  {verdict}")
        good = sum(row.agrees for row in self.rows)
        table = lines if self.rows else []
        ending = f"{self.name}: {good} of {len(self.rows)} agree · {self.seconds:.1f} s"
        return "\n".join([*table, ending, *(f"  {fault}" for fault in self.faults)])
