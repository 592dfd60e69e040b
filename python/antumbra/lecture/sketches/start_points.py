"""The leaning board by shadow rays that start in different ways: a slider, and what each loses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from antumbra._words import power_of_ten, written
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Entry, Frame, Key, Part, Strip


def starts_compared(
    run: Run, measured: Mapping[str, Quantity], files: Mapping[str, float], starts: Sequence[str]
) -> list[Part]:
    """A frame for each start, "safe" first, a picture for each file (name: scale).

    Quantities are those of `starts_measured`.
    """
    order = ["safe", *(start for start in starts if start != "safe")]
    white = 0.85 * run.white(*(f"safe-{file}-all" for file in files))
    frames = [_frame(run, measured, list(files), start, white) for start in order]
    entries = [
        Entry("var(--soft)", file, f"one metre is {written(scale)}", fact=n, always=frames[0].facts[n])
        for n, (file, scale) in enumerate(files.items())
    ]
    label = "Start of the shadow rays: where antumbra has it, at the point, or ε above it in the units of the file"
    note = (
        "One scene in three files. Wrong: pixels whose visibility differs from the closed form. "
        "Contact: the shadow at the foot of the board."
    )
    return [
        Strip("start", label, frames, [f"in {file}" for file in files], tells=order.index("none")),
        Key(entries, "start", note),
    ]


def _frame(
    run: Run, measured: Mapping[str, Quantity], files: Sequence[str], start: str, white: float
) -> Frame:
    pictures, facts = [], []
    for file in files:
        key, false = f"{start}-{file}-all", measured[f"false_{file}_{start}"]
        # A little of the surfaces' own colour, so that what is wholly in shadow is still seen.
        shown = run.pixels(key) + 0.05 * white * run.aov(key, "albedo")
        alt = f"In {file}, {_says(start)}: {measured[f'wrong_{file}_{start}']:v} of the pixels are wrong."
        pictures.append(run.picture(shown, alt, name=f"{start}-{file}", white=white, tones=96, noise=True))
        lost = _lost(measured[f"foot_{file}_{start}"])
        facts.append(f"false shadow {written(100 * false.value, 2)} % of lit, contact lost {lost}")
    wrong = ", ".join(f"{100 * measured[f'wrong_{file}_{start}'].value:.1f}" for file in files)
    return Frame(start, f"{_says(start)}: {wrong} % of pixels wrong", pictures, _says(start), facts=facts)


def _says(start: str) -> str:
    return {"none": "no offset", "safe": "ours"}.get(start) or f"ε = {power_of_ten(int(start))}"


def _lost(width: Quantity) -> str:
    return f"{written(width.value, 2)} mm" if width.value < 400 else "all of it"
