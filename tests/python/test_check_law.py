"""The law that the check reads off lamps: its sums are as good as it takes them to be."""

from __future__ import annotations

import itertools

import numpy as np

from antumbra.checks import lamps, law
from antumbra.checks.cases import LAMPS

# The exponents that lie farthest apart: what lies between is no farther off.
LAWS = list(itertools.product((0, 4), (0, 2), (0, 4)))


def shares(points: int, monkeypatch) -> np.ndarray:
    """Every lamp's light under every law over that under the right one, with so many points a side."""
    monkeypatch.setattr(lamps, "_GRID", points)
    falls_as = lamps.falls_as.__wrapped__  # without its cache
    return np.array(
        [[falls_as(lamp, *each) / falls_as(lamp, 1, 1, 2) for each in LAWS] for lamp in LAMPS.values()]
    )


def test_the_sums_are_as_good_as_the_law_takes_them_to_be(monkeypatch):
    ours = shares(lamps._GRID, monkeypatch)
    worst = np.abs(ours / shares(256, monkeypatch) - 1).max()
    assert law._SUM / 2 < worst <= law._SUM


def test_a_law_is_told_from_one_that_is_a_thousandth_off():
    known = list(LAMPS.values())
    errors = [1e-6] * len(known)
    cubed = np.array([lamps.falls_as(lamp, 2, 1, 2) / lamps.falls_as(lamp, 1, 1, 2) for lamp in known])
    assert law.followed(known, [*cubed], errors)[:3] == (2, 1, 2)
    # With 10⁻³ for the sums' error such answers passed for a law: off by 3 ‰, one up, the next one down.
    off = cubed * (1 + 3e-3 * (-1.0) ** np.arange(len(known)))
    assert law.followed(known, [*off], errors) is None
