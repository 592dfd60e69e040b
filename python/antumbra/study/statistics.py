"""What repeated renders say, and how sure it is: means, variances, errors, slopes, verdicts, each with its interval.

Everywhere the first axis is that of the independent *replicates* (renders with different seeds); the axes after it
are *cells* (pixels, receivers, channels), whose average is meant. Cells of one render need not be independent, so
intervals come from the spread over replicates alone. Intervals are two-sided and hold 95 % unless said otherwise.
"""

from __future__ import annotations

import math
from statistics import NormalDist
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra._words import minus, power_of_ten, written
from antumbra.study.quantiles import t_quantile

LEVEL = 0.95
Verdict = Literal["supported", "undecided", "not supported"]


class Interval(NamedTuple):
    """A value with the interval [low, high] that holds the truth with the confidence that was asked for."""

    value: float
    low: float
    high: float

    @property
    def half(self) -> float:
        """Half the width: the number after ±."""
        return (self.high - self.low) / 2

    def __str__(self) -> str:
        """`−0.499 ± 0.002`, as `plus_minus` writes it."""
        return plus_minus(self.value, self.half)

    def contains(self, value: float) -> bool:
        """Whether `value` is one of those that the data do not exclude."""
        return self.low <= value <= self.high


def plus_minus(value: float, half: float) -> str:
    """`−0.499 ± 0.002`, `3.999 ± 0.014`: the error in one digit (two if it begins with 1), the value as far as that."""
    if not (math.isfinite(half) and half > 0):
        return written(value, 4) + ("" if half == 0 else " ± ?")
    scale = math.floor(math.log10(max(abs(value), half)))
    if not -4 <= scale < 6:
        inner = plus_minus(value / 10.0**scale, half / 10.0**scale)
        return f"({inner}) · {power_of_ten(scale)}"
    power = math.floor(math.log10(half))
    digits = max(0, -power + (half < 2 * 10.0**power))
    shown = f"{value:,.{digits}f}"
    return minus(f"{shown if float(shown.replace(',', '')) else shown.lstrip('-')} ± {half:,.{digits}f}")


def mean(replicates: ArrayLike, level: float = LEVEL) -> Interval:
    """Mean of (K, …) with its t-interval: x̄ ± t(K−1) s/√K, x_k being the average cell of replicate k.

    Student 1908. Right for normal x_k, and nearly for others, because each is an average over many samples.
    One replicate alone says nothing about its error: its interval is (−∞, ∞).
    """
    each = _per_replicate(replicates)
    centre = float(each.mean())
    if len(each) == 1:
        return Interval(centre, -math.inf, math.inf)
    half = t_quantile((1 + level) / 2, len(each) - 1) * float(each.std(ddof=1)) / math.sqrt(len(each))
    return Interval(centre, centre - half, centre + half)


def variance(replicates: ArrayLike, level: float = LEVEL) -> Interval:
    """Variance of one replicate of (K, …), K ≥ 3, averaged over the cells: s² = Σ(x_k − x̄)²/(K−1).

    The interval is the jackknife's: `variance_pseudo_values`, averaged over the cells, are treated as K independent
    numbers. Meant for many cells.
    """
    found = mean(variance_pseudo_values(replicates), level)
    return Interval(found.value, max(found.low, 0.0), found.high)


def variance_pseudo_values(replicates: ArrayLike) -> NDArray[np.float64]:
    """The jackknife's K estimates of the variance in each cell of (K, …), K ≥ 3; their mean is s².

    (K (x_k − x̄)² − s²)/(K−2) (Miller 1974, eq. 2.2). Single ones may be below 0.
    """
    x = np.asarray(replicates, np.float64)
    count = len(x)
    if count < 3:
        raise ValueError(f"{count} replicates: at least 3 are needed for a variance with an interval")
    squares = (x - x.mean(axis=0)) ** 2
    pseudo: NDArray[np.float64] = (count * squares - squares.sum(axis=0) / (count - 1)) / (count - 2)
    return pseudo


def variance_by_replicate(replicates: ArrayLike) -> NDArray[np.float64]:
    """K numbers whose mean is s², one for each replicate of (K, …): K/(K−1) · average cell of (x_k − x̄)².

    For `slope`, where no reference is at hand. They hang together weakly, through x̄.
    """
    x = np.asarray(replicates, np.float64)
    return _per_replicate((x - x.mean(axis=0)) ** 2) * len(x) / (len(x) - 1)


def variances_without(replicates: ArrayLike) -> NDArray[np.float64]:
    """s² as in `variance`, of (K, …), and s² without each replicate in turn: (K + 1,), for `variance_slope`.

    Without k: ((K−1) s² − K/(K−1) (x_k − x̄)²) / (K−2).
    """
    x = np.asarray(replicates, np.float64)
    count = len(x)
    if count < 3:
        raise ValueError(f"{count} replicates: at least 3 are needed for a variance with an interval")
    squares = _per_replicate((x - x.mean(axis=0)) ** 2)
    whole = float(squares.sum()) / (count - 1)
    without = ((count - 1) * whole - count / (count - 1) * squares) / (count - 2)
    return np.concatenate([[whole], without])


def variance_slope(n: ArrayLike, variances: ArrayLike, level: float = LEVEL) -> Interval:
    """Slope of log variance against log N, with no reference: `variances` (K + 1, M), a column per N of `n` (M,).

    Columns as `variances_without` gives them. The interval is the jackknife's over replicates (as in `variance`).
    """
    return _jackknife(slopes(n, variances), level)


def variance_line(n: ArrayLike, variances: ArrayLike, at: ArrayLike, level: float = LEVEL) -> Line:
    """Power law of the standard deviation through `variances` (as in `variance_slope`), with its band at `at`."""
    slope_of, height = _lines(n, variances)
    x = np.asarray(at, np.float64)
    values = (height[:, None] + slope_of[:, None] * (np.log(x) - _centre(n))) / 2
    return _band(x, [_jackknife(column, level) for column in values.T])


def _jackknife(found: NDArray[np.float64], level: float) -> Interval:
    """Of a quantity θ found from all replicates (first) and without each: its pseudo-values are K θ − (K−1) θ₍ₖ₎."""
    count = len(found) - 1
    half = mean(count * found[0] - (count - 1) * found[1:], level).half
    return Interval(float(found[0]), float(found[0]) - half, float(found[0]) + half)


def squared_errors(
    replicates: ArrayLike, reference: ArrayLike, reference_variance: ArrayLike = 0.0
) -> NDArray[np.float64]:
    """Mean squared error of each replicate of (K, …): average cell of (x_k − reference)², (K,).

    `reference_variance`: variance of the reference's own noise, per cell or one number. Its average is subtracted,
    because E(x − r)² = E(x − μ)² + Var r where r is independent of x; a replicate that comes below 0 by that stays so.
    """
    own = float(np.mean(np.asarray(reference_variance, np.float64)))
    difference = np.asarray(replicates, np.float64) - np.asarray(reference, np.float64)
    return _per_replicate(difference**2) - own


def mse_of(squared: ArrayLike, level: float = LEVEL, own_half: float = 0.0) -> Interval:
    """Mean squared error with its t-interval, from `squared_errors` (K,).

    The noise of the reference, which all replicates share, is not in those: its `own_half`, of `reference_half` or
    `error_half`, is added in quadrature.
    """
    found = mean(squared, level)
    half = math.hypot(found.half, own_half)
    return Interval(found.value, max(found.value - half, 0.0), found.value + half)


def reference_half(replicates: ArrayLike, references: ArrayLike, level: float = LEVEL) -> float:
    """Half the interval of `mse_of` that the noise of the reference gives: the mean of R replicates (R, …), R ≥ 3.

    The jackknife's over those (as in `variance`): without the j-th, the mean squared error, less the variance of the
    mean of those that are left, differs by the average cell of (x̄ − r̄₍ⱼ₎)² − (x̄ − r̄)², less that of the variances.
    """
    x, r = np.asarray(replicates, np.float64).mean(axis=0), np.asarray(references, np.float64)
    count = len(r)
    centre, spreads = r.mean(axis=0), variances_without(r)
    own = spreads / np.concatenate([[count], np.full(count, count - 1)])
    without = np.stack([centre, *((count * centre - one) / (count - 1) for one in r)])
    return _jackknife(_per_replicate((x - without) ** 2) - own, level).half


def error_half(replicates: ArrayLike, reference: ArrayLike, error: ArrayLike, level: float = LEVEL) -> float:
    """The same where the reference is one picture (H, W, C) with standard errors σ of its own, pixels independent.

    Its noise ε = σ z, normal and z alike in the channels of a pixel, as the same rays made them, moves the mean of
    (x̄ − r)² over N cells by that of ε² − σ² − 2 ε (x̄ − μ). The variance of that is Σ (2 (Σσ²)² + 4 (Σσ(x̄ − μ))²) / N²,
    inner sums over channels; with d = x̄ − r in place of x̄ − μ the last square is (Σσ²)² too large.
    """
    d: NDArray[np.float64] = np.asarray(replicates, np.float64).mean(axis=0) - np.asarray(reference)
    own = np.asarray(error, np.float64)
    square = float(((own**2).sum(axis=-1) ** 2).sum())
    with_d = float(((own * np.abs(d)).sum(axis=-1) ** 2).sum())
    variance = max(4 * with_d - 2 * square, 2 * square)
    return float(NormalDist().inv_cdf((1 + level) / 2)) * math.sqrt(variance) / d.size


def root(of: Interval) -> Interval:
    """Square root of a quantity that is not negative, end by end."""
    return Interval(*(math.sqrt(max(x, 0.0)) for x in of))


def slopes(n: ArrayLike, errors: ArrayLike) -> NDArray[np.float64]:
    """Slope of log error against log N, fitted within each replicate: `n` (M,), `errors` (K, M) > 0, gives (K,).

    Least squares: Σ(u − ū)(v − v̄)/Σ(u − ū)², u = ln N, v = ln error.
    """
    return _lines(n, errors)[0]


def slope(n: ArrayLike, errors: ArrayLike, level: float = LEVEL) -> Interval:
    """Mean of `slopes` with its t-interval over replicates. Errors at different N may share a seed: it does no harm."""
    return mean(slopes(n, errors), level)


class Line(NamedTuple):
    """Fitted power law at places `x`: `value`, and the ends `low` and `high` of its band (each (M,))."""

    x: NDArray[np.float64]
    value: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]


def line(n: ArrayLike, errors: ArrayLike, at: ArrayLike, level: float = LEVEL) -> Line:
    """Power law through `errors` (K, M) at `n` (M,), and its band at each place of `at`.

    One straight line in (ln N, ln error) per replicate; at each place the mean of the K lines with its t-interval.
    """
    slope_of, height = _lines(n, errors)
    x = np.asarray(at, np.float64)
    values = height[:, None] + slope_of[:, None] * (np.log(x) - _centre(n))
    return _band(x, [mean(column, level) for column in values.T])


def _band(x: NDArray[np.float64], logs: list[Interval]) -> Line:
    ends = np.exp(np.array(logs))
    return Line(x, ends[:, 0], ends[:, 1], ends[:, 2])


def efficiency(variance_of_one: Interval, seconds: Interval | float) -> Interval:
    """1/(variance × time) [1/(unit² s)]; relative half-widths in ln are added in quadrature (they are independent)."""
    time = seconds if isinstance(seconds, Interval) else Interval(seconds, seconds, seconds)
    if variance_of_one.value <= 0 or time.value <= 0:
        return Interval(math.nan, 0.0, math.inf)
    spread = math.hypot(_log_half(variance_of_one), _log_half(time))
    value = 1 / (variance_of_one.value * time.value)
    return Interval(value, value * math.exp(-spread), value * math.exp(spread))


def ratio(a: Interval, b: Interval) -> Interval:
    """a/b of two independent positive quantities; half-widths in ln are added in quadrature."""
    if a.value <= 0 or b.value <= 0:
        return Interval(math.nan, 0.0, math.inf)
    spread = math.hypot(_log_half(a), _log_half(b))
    return Interval(
        a.value / b.value, a.value / b.value * math.exp(-spread), a.value / b.value * math.exp(spread)
    )


def verdict(
    interval: Interval,
    *,
    above: float | None = None,
    below: float | None = None,
    near: float | None = None,
    within: float = 0.0,
) -> Verdict:
    """Whether an interval supports a claim: more than `above`, less than `below`, or `near` a value ± `within`.

    Supported if the whole interval fulfils the claim, not supported if none of it does, else undecided (for `near`
    that is the equivalence test by inclusion, Schuirmann 1987): a wide interval supports nothing.
    """
    if near is not None:
        above, below = near - within, near + within
    low = -math.inf if above is None else above
    high = math.inf if below is None else below
    if not all(map(math.isfinite, (interval.low, interval.high))):
        return "undecided"
    if low <= interval.low and interval.high <= high:
        return "supported"
    return "not supported" if interval.high < low or interval.low > high else "undecided"


def _per_replicate(replicates: ArrayLike) -> NDArray[np.float64]:
    x = np.asarray(replicates, np.float64)
    if x.ndim == 0 or not x.size:
        raise ValueError(f"replicates have shape {x.shape}: at least one along the first axis is needed")
    each: NDArray[np.float64] = x.reshape(len(x), -1).mean(axis=1)
    return each


def _lines(n: ArrayLike, errors: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Slope of each replicate's line, and its height over the centre of ln N."""
    u, e = np.log(np.asarray(n, np.float64)), np.asarray(errors, np.float64)
    if e.ndim != 2 or e.shape[1] != len(u) or len(u) < 2:
        raise ValueError(f"n has shape {u.shape}, errors {e.shape}: (M,) and (K, M) with M ≥ 2 are needed")
    if not (e > 0).all():
        raise ValueError("an error is not above 0: it has no logarithm (is the reference too noisy?)")
    v = np.log(e)
    from_centre = u - u.mean()
    return (v @ from_centre) / (from_centre @ from_centre), v.mean(axis=1)


def _centre(n: ArrayLike) -> float:
    return float(np.log(np.asarray(n, np.float64)).mean())


def _log_half(of: Interval) -> float:
    """Half-width of ln x, by its upper end (the lower may be 0)."""
    return math.log(of.high / of.value) if of.high > of.value else 0.0
