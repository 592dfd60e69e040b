"""What is asked together is not seen: the errors of neighbouring pixels are independent."""

from __future__ import annotations

import pytest

from neighbours import correlations


@pytest.mark.parametrize("estimator", ["area", "ambient-occlusion"])
def test_errors_of_neighbours_are_independent(estimator):
    # 11 distances in 2 regions, 2 estimators, on both sides: α = 44 · 2 · 1.3·10⁻⁵ ≈ 10⁻³ at 4.2 standard errors.
    for region, rows in correlations(estimator, "owen", 16).items():
        for rho, error in rows:
            assert abs(rho) < 4.2 * error, (region, rho, error)
