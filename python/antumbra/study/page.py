"""The page of a study, and its short form for a notebook."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, Any

from antumbra._words import written
from antumbra.study import plot
from antumbra.study.statistics import Interval, plus_minus, ratio

if TYPE_CHECKING:
    import jinja2

    from antumbra.study.findings import Findings
    from antumbra.study.rows import Row

# A slope's interval that is wider than ± this does not tell 1/N from other laws.
_NARROW = 0.1
RADIANCE = "W·m⁻²·sr⁻¹"


def page(study: Findings) -> str:
    """The whole page in one file."""
    return _environment().get_template("page.html.j2").render(_facts(study))


def fragment(study: Findings) -> str:
    """Plot and table alone, with styles that touch nothing else."""
    return _environment().get_template("fragment.html.j2").render(_facts(study))


@cache
def _environment() -> jinja2.Environment:
    import jinja2

    loader = jinja2.PackageLoader("antumbra.study", "templates")
    return jinja2.Environment(
        loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined
    )


def short_table(study: Findings) -> list[str]:
    """One line per curve for a terminal: its slope, and its last row."""
    lines = [("", "slope of the variance", "noise", "RMSE", "bias")]
    for name, rows in study.curves().items():
        slope, last = study.slope(name), rows[-1]
        at = "" if last.n is None else f" at {_short(f'{last.n:.12g}')}"
        biased = any(r.bias is not None and r.bias.flagged for r in rows)
        errors = f"{last.noise}{at}", f"{_error(last) or '–'}{at}"
        lines.append((name, str(slope or "–"), *errors, "biased" if biased else _bias(last)))
    widths = [max(len(line[i]) for line in lines) for i in range(5)]
    return [
        "  " + "   ".join(text.ljust(w) for text, w in zip(line, widths, strict=True)).rstrip()
        for line in lines
    ]


def _facts(study: Findings) -> dict[str, Any]:
    best = study.most_efficient()
    return {
        "study": study,
        "plot_css": plot.CSS,
        "over_axis": _plot(study, "axis") if study.axis else "",
        "over_seconds": ""
        if study.axis == "budget" and study.budget == "seconds"
        else _plot(study, "seconds"),
        "slopes": [
            (name, slope, _half_of(slope), against_independent(slope)) for name, slope in _slopes(study)
        ],
        "rows": [_line(study, row) for row in study.rows],
        "own_error": _own_error(study),
        "best": study.name_of(best) if best else "",
        "biased": _biased(study),
        "shown": _shown(study),
        "axis": axis_title(study),
        "varied": [(_dashed(name), [_short(v) for v in values]) for name, values in study.varied.items()],
        "fixed": [(_dashed(name), value) for name, value in study.fixed.items()],
        "radiance": RADIANCE,
    }


def axis_title(study: Findings) -> str:
    """What the numbers below the plot are of."""
    budgets = {"rays": "rays per pixel, of any kind", "seconds": "seconds per picture"}
    known = {"shadow_rays": "shadow rays, N", "viewing_rays": "viewing rays per pixel, N"}
    if study.axis == "budget":
        return budgets[study.budget]
    return known.get(study.axis, _dashed(study.axis))


def _plot(study: Findings, over: str) -> str:
    best = study.most_efficient()
    of_time = over == "seconds"
    title = "seconds per picture" if of_time else axis_title(study)
    numbers = study.axis in ("shadow_rays", "viewing_rays", "budget")
    curves = [c for c in study.plot_curves(over) if any(map(math.isfinite, c.y))]
    if not curves:
        return ""
    said = "; ".join(f"{c.name}: {c.note or 'not fitted'}" for c in curves)
    return plot.error_curves(
        curves,
        x_title=title,
        y_title=f"{_shown(study)}, {RADIANCE}",
        label=f"{_shown(study)} against {title}. {said}.",
        chosen=study.name_of(best) if best else None,
        x_ticks=None
        if not of_time and study.axis != "budget"
        else _decades([x for c in curves for x in c.x]),
        logarithmic=(of_time or numbers, True),
    )


def _shown(study: Findings) -> str:
    """What the plots show: the error against the reference, or without one the noise alone."""
    return "RMSE" if any(row.mse for row in study.rows) else "noise"


def _decades(values: list[float]) -> list[float]:
    low, high = (math.log10(f(v for v in values if v > 0)) for f in (min, max))
    ticks = [m * 10.0**p for p in range(math.floor(low), math.ceil(high) + 1) for m in (1, 3)]
    return [t for t in ticks if 10**low * 0.999 <= t <= 10**high * 1.001]


def _slopes(study: Findings) -> list[tuple[str, Interval]]:
    found = [(name, study.slope(name)) for name in study.curves()]
    return [(name, slope) for name, slope in found if slope is not None]


def _half_of(slope: Interval) -> Interval:
    """Of the noise, which is the root of the variance."""
    return Interval(slope.value / 2, slope.low / 2, slope.high / 2)


def _own_error(study: Findings) -> str:
    """How well the reference itself is known; nothing if that is not known."""
    found = study.reference_error()
    if found is None:
        return ""
    error, part = found
    least = f", at most {_percent(100 * part)} % of the noise of a row" if math.isfinite(part) else ""
    return f"own error {written(error, 2)} {RADIANCE} a pixel{least}"


def against_independent(slope: Interval) -> str:
    """How the variance falls, in words: as that of independent samples, faster or slower; or undecided."""
    if slope.contains(-1.0):
        return "as 1/N" if slope.half <= _NARROW else "undecided"
    return "faster than 1/N" if slope.high < -1 else "slower than 1/N"


def _line(study: Findings, row: Row) -> dict[str, Any]:
    """A row of the table, in words."""
    error = row.rmse
    first = study.rows[0]
    gain = ratio(row.efficiency, first.efficiency) if row is not first else None
    return {
        "curve": study.name_of(row),
        "n": "" if row.n is None else _short(f"{row.n:.12g}"),
        "rays": f"{row.viewing_rays:,} × {row.shadow_rays:,}",
        "traced": f"{row.rays:,.1f}",
        "seconds": str(row.seconds),
        "noise": str(row.noise) if row.noisy else "0",
        "error": _error(row),
        "share": f"{_percent(100 * error.value / row.true_mean)} %" if error and row.true_mean else "",
        "gain": "1" if gain is None else _times(gain),
        "bias": _bias(row),
        "flagged": row.bias is not None and row.bias.flagged,
    }


def _error(row: Row) -> str:
    """The RMSE in words; nothing without a reference."""
    if row.rmse is None:
        return ""
    return str(row.rmse) if row.rmse.value > 0 else "below the reference's noise"


def _times(gain: Interval) -> str:
    """A factor: `× 24 ± 2`, or with the ends of its interval where that is wide."""
    if not math.isfinite(gain.value):
        return "–"
    if gain.half < 0.3 * gain.value:
        return f"× {gain}"
    return f"× {written(gain.value, 2)} ({written(gain.low, 2)} … {written(gain.high, 2)})"


def _bias(row: Row) -> str:
    if row.bias is None or not row.true_mean:
        return "–"
    if not row.tested:
        return "not tested"
    found, whole = row.bias.difference, abs(row.true_mean)
    return f"{plus_minus(100 * found.value / whole, 100 * found.half / whole)} %"


def _percent(share: float) -> str:
    """Two digits, and all before the point."""
    return written(share, 2)


def _biased(study: Findings) -> list[str]:
    """What is said of each curve that has flagged rows; its numbers are those of the last of them."""
    found = []
    for name, rows in study.curves().items():
        flagged = [r for r in rows if r.bias is not None and r.bias.flagged]
        if not flagged:
            continue
        last = flagged[-1]
        places = [_short(f"{r.n:.12g}") for r in flagged if r.n is not None]
        at = f" (at {', '.join(places)})" if places else ""
        found.append(f"{name}{at}: its mean is off by {_bias(last)} of the reference's{_where(last)}")
    return found


def _where(row: Row) -> str:
    """Where it is clearest, and how likely chance is."""
    assert row.bias is not None
    chance = "below 10⁻⁶" if row.bias.p < 1e-6 else written(row.bias.p, 1)
    place = ""
    if row.bias.tile is not None:
        x, y, width, height = row.bias.tile
        place = f"; it is clearest at pixels {x}…{x + width - 1}, {y}…{y + height - 1}"
    return f"{place}; probability of that by chance {chance}"


def _dashed(name: str) -> str:
    return name.removeprefix("D.").replace("_", "-")


def _short(value: str) -> str:
    try:
        return written(float(value), 6)
    except ValueError:
        return value
