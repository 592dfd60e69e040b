"""An edge and a penumbra for each split of a pixel's rays, the split that theory advises, and both in a plot."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from antumbra._words import written
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.split import CROPS, RAYS, VIEWING, WIDTH, advised_map, key_of, scatter
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Panel, Row, Strip, Table
from antumbra.lecture.stages.quantities import curve_of, table_of
from antumbra.study.plot import Curve, error_curves


def splits(run: Run, found: Mapping[str, Quantity], white: float) -> Panel:
    """A slider of the splits: each crop with its error."""
    names = [*map(key_of, VIEWING), f"centre{RAYS - 1}"]
    words = [key.replace("x", " × ") for key in names[:-1]] + [f"1 centred × {RAYS - 1}"]
    frames = [_frame(run, found, *each, white) for each in zip(names, words, strict=True)]
    note = (
        "Errors of this one picture, of white: blue too dark, orange too bright. Viewing rays are random but for the "
        "last, which goes through the centre."
    )
    label, columns = "Viewing rays × shadow rays of each", ("an edge and a penumbra", "their errors")
    return Panel("splits", f"{RAYS} rays", [Strip("split", label, frames, columns, note, len(frames) - 1)])


def _frame(run: Run, found: Mapping[str, Quantity], key: str, word: str, white: float) -> Frame:
    ones = [luminances(run, f"{key}-{where}")[0] for where in CROPS]
    off = [one - luminances(run, f"truth-{where}").mean(0) for one, where in zip(ones, CROPS, strict=True)]
    edge, penumbra = (found[f"error-{key}-{where}"] for where in CROPS)
    says = f"error {edge:1} at the edge, {penumbra:1} in the penumbra"
    pictures = [
        run.picture(_beside(ones, white), f"An edge and a penumbra, {word} rays.", name=key, white=white, noise=True),
        run.map(
            _beside(off, 0.0) / white, f"{word}: {says}, of white.", name=f"{key}-off", ramp="signed",
            low=-0.2, high=0.2, unit="%", noise=True,
        ),
    ]  # fmt: skip
    return Frame(key, f"{word}: {says}", pictures, short="centred" if "c" in key else word)


def _beside(crops: list[NDArray[np.float64]], gap: float) -> NDArray[np.float64]:
    """Two crops, a pixel of `gap` between them."""
    first, second = crops
    return np.concatenate([first, np.full((len(first), 1), gap), second], axis=1)


def advice(run: Run, found: Mapping[str, Quantity], white: float) -> Panel:
    """The whole picture with both crops outlined, and N* of each pixel."""
    best, shown = advised_map(run, 0.005 * white, cost_of(found)), run.light("all-truth")
    scale = shown.shape[1] / WIDTH
    for x, y, width, height in CROPS.values():
        left, top, right, bottom = (round(scale * side) for side in (x, y, x + width, y + height))
        shown[[top, bottom], left : right + 1] = shown[top : bottom + 1, [left, right]] = white
    where = "Pillars with two crops outlined: an edge of a pillar, and a penumbra."
    says = f"Advised shadow rays, least at edges; the median is {written(float(np.nanmedian(best)), 2)}."
    pictures = [
        run.picture(shown, where, "the crops", name="crops", white=white, noise=True),
        run.map(
            np.log2(np.maximum(best, 1e-3)), says, "N*, shadow rays for each viewing ray", name="advised", ramp="amber",
            low=0.0, high=6.0, unit="shadow rays", ticks={0: "1", 2: "4", 4: "16", 6: "64"}, noise=True,
        ),
    ]  # fmt: skip
    note = (
        f"N* = σₛ/σₚ · √(cᵥ/cₛ), {_costs(found)}; below 1 it means 1. Variances are means over 3 × 3 of "
        f"this picture's {shown.shape[1]} pixels a row: in larger ones more varies, and N* is less. "
        "Black: edges, and no light."
    )
    return Panel("advised", "advised N*", [Row(pictures, note)])


def cost_of(found: Mapping[str, Quantity]) -> float:
    """c_v / c_s as measured (`took`); 1 where no clock was asked."""
    return found["took"].value if "took" in found else 1.0


def _costs(found: Mapping[str, Quantity]) -> str:
    took = found.get("took")
    return f"cᵥ/cₛ = {took:r} by the clock" if took else "rays counted, cᵥ = cₛ"


def _split(advised: float) -> str:
    return written(advised, 2) if math.isfinite(advised) else "∞"


def noise_plot(run: Run, found: Mapping[str, Quantity], white: float) -> str:
    """Error of each split at `RAYS` rays, the lines of theory, and the errors of rays through the centre."""
    shadow = [RAYS / v - 1 for v in VIEWING]
    curves = []
    for where in reversed(CROPS):
        of = scatter(run, where)
        exact = np.vectorize(lambda n, of=of: np.sqrt(of.variance(RAYS / (1 + n), n).value) / white)
        marks = [found[f"noise-{key_of(v)}-{where}"] for v in VIEWING]
        curves.append(curve_of(where, shadow, marks, exact, f"N* = {_split(of.advised(cost_of(found)))}"))
    for where in CROPS:
        centred = found[f"error-centre{RAYS - 1}-{where}"]
        low, high = centred.interval
        curves.append(Curve(f"{where} ○", [RAYS - 1], [centred.value], [low], [high], hollow=[True]))
    return error_curves(
        curves, x_title="shadow rays of each viewing ray, N", y_title=f"error over white, {RAYS} rays",
        chosen="penumbra", x_ticks=[1, 4, 19, 49, 199], y_ticks=[0.2, 0.1, 0.05, 0.02, 0.01],
        label="Error against shadow rays for each viewing ray: at the edge it grows, in the penumbra it first falls; "
        "two marks for one viewing ray through the centre.",
    )  # fmt: skip


def plot_note(run: Run, found: Mapping[str, Quantity]) -> str:
    """What marks and lines of the plot are, and which costs N* has."""
    count, least = len(run.images(f"{key_of(VIEWING[0])}-edge")), _split(scatter(run, "penumbra").advised())
    costs = f"{_costs(found)}; by rays counted, as drawn, {least}" if "took" in found else _costs(found)
    return (
        f"Marks: measured, 95 % of {count} replicates. Lines: √((σₚ² + σₛ²/N) / V), both variances measured apart. "
        f"○: through the centre, with its bias. N*: {costs}."
    )


def bias_and_noise(found: Mapping[str, Quantity]) -> Table:
    """Bias and noise of the split that goes through the centre and of that which does not, at equal rays.

    And at equal time, where `took`, the cost of a viewing ray over that of a shadow ray, was measured.
    """
    least = f"centre{RAYS - 1}"
    kept = {key_of(100): "100 × 1", "centre100": "1 × 100", least: f"1 × {RAYS - 1}"}
    noises = [found[f"noise-{key}-{where}"] for key in kept for where in CROPS]
    sure = max(noise.error / noise.value for noise in noises)
    note = f"In % of white; noise within {100 * sure:.0f} % of itself. 1 × N: through the centre. Rays: 200, 101, 200."

    def row(key: str, less: float = 1.0) -> list[Quantity | str]:
        cells = ((found[f"bias-{key}-{where}"], found[f"noise-{key}-{where}"]) for where in CROPS)
        return [cell for bias, noise in cells for cell in (bias, f"{100 * less * noise.value:.2f}")]

    rows = {word: row(key) for key, word in kept.items()}
    if took := found.get("took"):
        # As many shadow rays as take the time of 100 × 1: c_v + M c_s = 100 (c_v + c_s).
        longer = round(100 + 99 * took.value)
        rows[f"1 × {longer}"] = row(least, ((RAYS - 1) / longer) ** 0.5)
        note += (
            f" 1 × {longer} takes the time of 100 × 1: a viewing ray took {took:r} shadow rays. "
            f"Its noise is that of {RAYS - 1}, times √({RAYS - 1}/{longer})."
        )
    head = ("split", "edge: bias", "noise", "penumbra: bias", "noise")
    return table_of(head, rows, "Bias and noise at an edge and in a penumbra, by split", note=note, bare=True)
