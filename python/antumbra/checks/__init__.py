"""Is an estimator of one's own right? `check(function)`, and the questions that it asks."""

from antumbra.checks.report import Report, Row
from antumbra.checks.run import check

__all__ = ["Report", "Row", "check"]
