"""Error curves as inline SVG, whose colours and text size come from the page.

>>> from antumbra.study.plot import Curve, error_curves
>>> random = Curve("random", [1, 9, 36, 100], [1, 1 / 3, 1 / 6, 1 / 10], note="slope −0.5")
>>> svg = error_curves([random], x_title="shadow rays", y_title="RMSE", label="RMSE falls as 1/√N.")
>>> svg[:50]
'<svg class="plot" viewBox="0 0 620 440" role="img"'

Classes of the elements: `ax` axis, `gr` hairline, `s` soft text; and in a group `<g data-s="NAME" class="on">` per
curve (`on`: the chosen one): `ln` line, `bd` band, `eb` error bar, `mk` mark (`mk h`: hollow), `fine` second label.
`CSS` gives them their looks from the variables --svg (text size), --sans, --ink, --soft, --line, --link, --paper.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from antumbra._words import power_of_ten
from antumbra.study import statistics
from antumbra.study._svg import converted

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CSS = """\
.plot{display:block;width:100%;height:auto;overflow:visible}
.plot text{font:var(--svg,14px) var(--sans,sans-serif);fill:var(--ink)}
.plot .s,.plot g text{fill:var(--soft)}
.plot .ax{stroke:var(--soft);stroke-width:1;fill:none}.plot .gr{stroke:var(--line);stroke-width:1;fill:none}
.plot .ln{stroke:var(--soft);stroke-width:1.5;fill:none;opacity:.55}
.plot .eb{stroke:var(--soft);stroke-width:1.2;fill:none;opacity:.6}
.plot .mk{stroke:var(--soft);stroke-width:1.3;fill:var(--paper);opacity:.6}
.plot .bd{display:none;fill:var(--link);opacity:.22}.plot .on .bd{display:block}
.plot .on .ln{stroke:var(--link);stroke-width:2.5;opacity:1}.plot .on .eb{stroke:var(--link);opacity:1}
.plot .on .mk{stroke:var(--link);fill:var(--link);opacity:1}.plot .on .mk.h{fill:var(--paper)}
.plot .on text{fill:var(--link);font-weight:700}
"""

# Of the drawing, in units of its viewBox.
_LEFT, _RIGHT, _TOP, _HEIGHT, _BELOW = 64.0, 470.0, 48.0, 326.0, 66.0
_NAME_GAP, _NAMES, _LETTER, _LARGE_LETTER = 14.0, 136.0, 8.0, 12.0
# Names with a second label under them, and names alone, stand at least so far apart; ticks of an axis likewise.
_APART, _APART_ALONE, _TICKS_APART = 38.0, 24.0, 30.0
_SHAPES = ("o", "s", "^", "D", "v", "P", "X", "p")


@dataclass(frozen=True)
class Curve:
    """One line of a plot: marks at `x`, `y`, their error bars `low`…`high`, a fitted `line` with its band.

    Without `line` the marks are joined. `note` stands under the name; `hollow`: which marks were not fitted.
    """

    name: str
    x: Sequence[float]
    y: Sequence[float]
    low: Sequence[float] = ()
    high: Sequence[float] = ()
    line: statistics.Line | None = None
    note: str = ""
    hollow: Sequence[bool] = field(default=())


def measured(name: str, n: ArrayLike, squared: ArrayLike, *, fit: ArrayLike | bool = True) -> Curve:
    """The curve of the RMSE, from squared errors per replicate, (K, M) as `statistics.squared_errors` gives for each N.

    Bars and band hold 95 %, over the K replicates; one replicate alone (a sampler without noise) has neither. `fit`:
    which of the M places the line is fitted to, or False.
    """
    x, e = np.asarray(n, np.float64), np.asarray(squared, np.float64)
    rows = [statistics.root(statistics.mse_of(column)) for column in e.T]
    chosen = np.broadcast_to(np.asarray(fit, np.bool_), x.shape)
    line, note = None, ""
    if chosen.sum() > 1 and (e[:, chosen] > 0).all():
        roots = np.sqrt(e[:, chosen])
        at = np.geomspace(x[chosen].min(), x[chosen].max(), 24)
        line = statistics.line(x[chosen], roots, at)
        note = f"slope {statistics.slope(x[chosen], roots)}".removesuffix(" ± ?")
    return Curve(
        name,
        [float(v) for v in x],
        [r.value for r in rows],
        [r.low for r in rows],
        [r.high for r in rows],
        line,
        note,
        [not c for c in chosen] if line else (),
    )


def error_curves(
    curves: Sequence[Curve],
    *,
    x_title: str,
    y_title: str,
    label: str,
    chosen: str | None = None,
    x_ticks: Sequence[float] | None = None,
    y_ticks: Sequence[float] | None = None,
    logarithmic: tuple[bool, bool] = (True, True),
) -> str:
    """Curves with their names at the ends, as one `<svg>` element: the same bits for the same curves.

    `label`: the sentence for those who do not see it; `chosen`: the name of the blue curve (the first without);
    ticks: without them, the places of the marks, and decades with their threes. Ticks 1/3, 1/6, 1/10 are written so.
    """
    from matplotlib import rc_context, rcParamsDefault

    # From the library's own settings: a user's may draw text as paths, or cut the picture.
    fresh: dict[Any, Any] = {name: value for name, value in rcParamsDefault.items() if "backend" not in name}
    own: dict[Any, Any] = {"svg.fonttype": "none", "svg.hashsalt": "antumbra", "path.simplify": False}
    with rc_context({**fresh, **own}):
        page = _Page(curves, logarithmic)
        page.axes_and_ticks(x_ticks, y_ticks)
        for number, curve in enumerate(curves):
            page.curve(number, curve)
        page.names()
        page.text(8, 18, y_title, "s")
        page.text(_LEFT, page.height - 5, x_title, "s")
        on = chosen if chosen is not None else (curves[0].name if curves else "")
        return converted(page.figure, [c.name for c in curves], on, label)


class _Page:
    """The drawing while it is made. Every artist carries in its gid the curve that it belongs to and its class."""

    def __init__(self, curves: Sequence[Curve], logarithmic: tuple[bool, bool]) -> None:
        self.curves, self.apart = curves, _APART if any(c.note for c in curves) else _APART_ALONE
        tall = max(_HEIGHT, self.apart * len(curves))
        # Names are seen on a phone too, in letters that are larger in the drawing; notes are not.
        longest = max((max(_LARGE_LETTER * len(c.name), _LETTER * len(c.note)) for c in curves), default=0)
        self.width = round(_RIGHT + _NAME_GAP + max(_NAMES, longest))
        self.height = round(_TOP + tall + _BELOW)
        self.figure, self.axes = self._new(tall)
        for axis, is_log in zip("xy", logarithmic, strict=True):
            if is_log:
                getattr(self.axes, f"set_{axis}scale")("log")
        self._limits(logarithmic)

    def _new(self, tall: float) -> tuple[Figure, Axes]:
        from matplotlib.figure import Figure

        figure = Figure((self.width / 72, self.height / 72), dpi=72)
        box = (_LEFT / self.width, _BELOW / self.height, (_RIGHT - _LEFT) / self.width, tall / self.height)
        axes = figure.add_axes(box)
        axes.set_axis_off()
        return figure, axes

    def _limits(self, logarithmic: tuple[bool, bool]) -> None:
        x = [v for c in self.curves for v in c.x]
        y = [v for c in self.curves for v in (*c.y, *(c.low or ()), *(c.high or ()))]
        y += [float(v) for c in self.curves if c.line for v in (*c.line.value,)]
        self.axes.set_xlim(*_span(x, logarithmic[0], 0.0))
        self.axes.set_ylim(*_span(y, logarithmic[1], 0.04))

    def axes_and_ticks(self, x_ticks: Sequence[float] | None, y_ticks: Sequence[float] | None) -> None:
        """The axis below with its ticks, hairlines at those of the left."""
        bottom = _BELOW
        self.path([_LEFT, _RIGHT], [bottom, bottom], "ax")
        given = x_ticks if x_ticks is not None else sorted({v for c in self.curves for v in c.x})
        for value, x in self._placed(given, 0):
            self.path([x, x], [bottom, bottom - 5], "ax")
            self.text(x, self.height - bottom + 26, _written(value), "s", "middle")
        low, high = self.axes.get_ylim()
        given = y_ticks if y_ticks is not None else _decades(low, high, self.axes.get_yscale() == "log")
        parts = any(_is_part(v) and len(f"{v:.3g}") > 4 for v in given)
        for value, y in self._placed([v for v in given if low <= v <= high], 1):
            self.path([_LEFT, _RIGHT], [y, y], "gr")
            written = f"1/{round(1 / value)}" if parts and _is_part(value) else _written(value)
            # In the corner it stands on the axis, clear of the tick below.
            base = min(self.height - y + 5, self.height - bottom - 2)
            self.text(_LEFT - 8, base, written, "s", "end")

    def _placed(self, values: Sequence[float], axis: int) -> list[tuple[float, float]]:
        """Ticks and their places, without those that would touch the one before."""
        kept: list[tuple[float, float]] = []
        for value in values:
            at = [self.axes.get_xlim()[0], self.axes.get_ylim()[0]]
            at[axis] = value
            place = float(self.axes.transData.transform(at)[axis])
            if not kept or abs(place - kept[-1][1]) >= _TICKS_APART:
                kept.append((value, place))
        return kept

    def curve(self, number: int, curve: Curve) -> None:
        """Band, line, bars, marks."""
        if curve.line is not None:
            x, low, high = curve.line.x, curve.line.low, curve.line.high
            if np.isfinite(high).all():
                self._polygon(np.concatenate([x, x[::-1]]), np.concatenate([low, high[::-1]]), number)
            self._plot(x, curve.line.value, number, "ln")
        else:
            self._plot(curve.x, curve.y, number, "ln")
        for place, least, most in zip(curve.x, curve.low, curve.high, strict=False):
            if least < most and math.isfinite(most):
                bottom = max(least, self.axes.get_ylim()[0])
                self._plot([place, place], [bottom, most], number, "eb")
        hollow = np.broadcast_to(np.asarray(curve.hollow or (False,), np.bool_), (len(curve.x),))
        for name, which in (("mk", ~hollow), ("mk h", hollow)):
            if which.any():
                x, y = np.asarray(curve.x)[which], np.asarray(curve.y)[which]
                shape = _SHAPES[number % len(_SHAPES)]
                self._plot(x, y, number, name, marker=shape, markersize=9, linestyle="none")

    def names(self) -> None:
        """Each name at the end of its line, those that would touch pushed apart; the note under it."""
        ends = []
        for curve in self.curves:
            last = curve.x[-1], curve.y[-1]
            # Where the line ends before the marks do, the name stands at the last mark.
            if curve.line is not None and curve.line.x[-1] > 0.999 * max(curve.x):
                last = float(curve.line.x[-1]), float(curve.line.value[-1])
            y = float(self.axes.transData.transform(last)[1])
            ends.append(self.height - y if math.isfinite(y) else self.height - _BELOW)
        lowest = self.height - _BELOW + (5 if self.apart == _APART_ALONE else -12)
        for number, y in enumerate(pushed_apart(ends, self.apart, _TOP, lowest)):
            curve = self.curves[number]
            self.text(_RIGHT + _NAME_GAP, y, curve.name, "", number=number)
            if curve.note:
                self.text(_RIGHT + _NAME_GAP, y + 17, curve.note, "fine", number=number)

    def text(
        self, x: float, y: float, text: str, kind: str, anchor: str = "start", number: int | None = None
    ) -> None:
        """Text whose base line begins, or has its middle or end, at (x, y) of the viewBox."""
        side = {"start": "left", "middle": "center", "end": "right"}[anchor]
        drawn = self.figure.text(x, self.height - y, text, ha=side, va="baseline", transform=None)
        drawn.set_parse_math(False)
        drawn.set_gid(_gid(number, kind))

    def path(self, x: Sequence[float], y: Sequence[float], kind: str) -> None:
        """A line in units of the viewBox, y upwards."""
        from matplotlib.lines import Line2D

        drawn = Line2D(x, y, transform=None)
        drawn.set_gid(_gid(None, kind))
        self.figure.add_artist(drawn)

    def _plot(self, x: Any, y: Any, number: int, kind: str, **looks: Any) -> None:
        (drawn,) = self.axes.plot(x, y, clip_on=False, **looks)
        drawn.set_gid(_gid(number, kind))

    def _polygon(self, x: Any, y: Any, number: int) -> None:
        (drawn,) = self.axes.fill(x, y, clip_on=False)
        drawn.set_gid(_gid(number, "bd"))


def _gid(number: int | None, kind: str) -> str:
    return f"antumbra|{'' if number is None else number}|{kind}"


def pushed_apart(places: Sequence[float], apart: float, low: float, high: float) -> list[float]:
    """Places moved as little as possible (in the mean square) so that none are nearer than `apart`, within low…high.

    Isotonic regression of place − rank · apart, by pooling of neighbours (Ayer et al. 1955).
    """
    order = sorted(range(len(places)), key=lambda i: places[i])
    pools: list[list[float]] = []
    for rank, i in enumerate(order):
        pools.append([places[i] - rank * apart])
        while len(pools) > 1 and _average(pools[-2]) > _average(pools[-1]):
            pools[-2:] = [pools[-2] + pools[-1]]
    flat = [_average(pool) for pool in pools for _ in pool]
    most = high - (len(places) - 1) * apart
    moved = [0.0] * len(places)
    for rank, i in enumerate(order):
        moved[i] = max(low, min(flat[rank], max(most, low))) + rank * apart
    return moved


def _average(numbers: Sequence[float]) -> float:
    return sum(numbers) / len(numbers)


def _span(values: Sequence[float], is_log: bool, margin: float) -> tuple[float, float]:
    """From the least to the most, with a margin; of numbers above 0 alone where the axis is logarithmic."""
    kept = [v for v in values if math.isfinite(v) and (v > 0 or not is_log)] or [1.0]
    low, high = min(kept), max(kept)
    if is_log:
        wide = max(math.log(high / low), math.log(2) if margin else 0.0)
        middle = math.sqrt(low * high)
        half = math.exp(wide * (0.5 + margin)) if wide else 2.0
        return middle / half, middle * half
    if low == high:
        return low - 0.5, high + 0.5
    return low - margin * (high - low), high + margin * (high - low)


def _decades(low: float, high: float, is_log: bool) -> list[float]:
    """1 and 3 of each decade, more of few and fewer of many; on a linear axis 1, 2 or 5 times a power of ten."""
    if is_log:
        first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
        parts = (1, 2, 3, 5) if high < 15 * low else (1, 3) if high < 1e5 * low else (1,)
        return [float(f"{part}e{power}") for power in range(first, last + 1) for part in parts]
    power = 10.0 ** math.floor(math.log10((high - low) / 3))
    step = power * max(s for s in (1, 2, 5) if s * power <= (high - low) / 3)
    return [step * k for k in range(math.ceil(low / step), math.floor(high / step) + 1)]


def _is_part(value: float) -> bool:
    """Whether it is 1/n for a whole n > 1."""
    return 1e-3 < value < 1 and abs(1 / value - round(1 / value)) < 1e-6


def _written(value: float) -> str:
    """`0.03`, `100`, `10⁻⁵`, `3·10⁻⁵`."""
    decimal = f"{value:.3g}"
    if "e" in decimal or (value and abs(value) < 1e-3):
        head, power = f"{value:.0e}".split("e")
        ten = power_of_ten(int(power))
        return (ten if head == "1" else f"{head}·{ten}").replace("-", "−")
    return decimal.replace("-", "−")
