"""Figure 19: direct and indirect light, bounce by bounce, and where a path may end."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import LATER_BOUNCES
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.bounces import after, cut_off, light_of, shares
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.stages import Frame, Part, Plot, Strip
from antumbra.lecture.stages.quantities import curve_of, table_of
from antumbra.study.plot import error_curves

DEPTHS = range(13)
LAST = DEPTHS[-1]
# The same random numbers for every depth: what a bounce more adds is its light alone.
LOOK = {
    "estimator": "path",
    "roulette": "off",
    "viewing": "centre",
    "size": Pick((44, 44), (200, 200)),
    "viewing_rays": Pick(32, 64),
}


def _frame(run: Run, found: Mapping[str, Quantity], k: int, white: float) -> Frame:
    what = "emitted light" if k == 0 else "direct light" if k == 1 else f"light after {k} reflections"
    says = f"{k}: {what}, {found[f'share-{k}']:1} of all" if k else "0: the lamp alone"
    pictures = [
        run.picture(light_of(run, k), f"Only {what}.", name=f"only-{k}", white=white, colour=True),
        run.picture(
            f"depth-{k}", f"All light of up to {k} reflections.", name=f"sum-{k}", white=white, colour=True
        ),
    ]
    return Frame(str(k), says, pictures, short=str(k))


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    white = run.white(f"depth-{LAST}", share=95)
    strip = Strip("reflections", "Reflections on the way to the eye", [_frame(run, found, k, white) for k in DEPTHS],
                  0, ("this alone", "all up to here"), tells=2)  # fmt: skip
    bounces = [float(k) for k in DEPTHS[1:]]
    own = [found[f"share-{k}"] for k in DEPTHS[1:]]
    rate, first = found["rate"].value, own[5].value
    curve = curve_of("light of k", bounces, own, lambda k: first * rate ** (k - 6), f"× {rate:.2f} each")
    svg = error_curves(
        [curve], x_title="reflections k", y_title="share of the reflected light", logarithmic=(False, True), x_ticks=[1, 2, 4, 6, 8, 10, 12],
        y_ticks=[1, 0.1, 0.01, 0.001], label="Share of the reflected light by number of reflections: a straight line on a logarithmic scale.",
    )  # fmt: skip
    rows = {str(k): (found[f"share-{k}"], found[f"left-{k}"]) for k in (1, 2, 4, 8)}
    table = table_of(("k", "share", "still to come"), rows, "Reflected light by number of reflections",
                     note="Roulette ends paths at random and makes up for it: it leaves nothing to come.")  # fmt: skip
    note = f"Bars: 95 %, {len(run.images('depth-1'))} independent replicates. The line: the mean rate from k = 4 on."
    return [strip, Plot(svg, note, table)]


FIGURE = Figure(
    number=19, chapter=5, title="After the first bounce", seconds=Pick(6, 90),
    question=Question("Direct light is reflected once. How much of all the light that the walls of this box reflect to the eye is direct?",
                      ("about a quarter", "about a half", "nearly all"), 1, ("share-1",)),
    variants=[
        *(Variant(f"depth-{k}", builtin("cornell-box"), LOOK | {"bounces": k}, 4) for k in DEPTHS),
        Variant("roulette", builtin("cornell-box"), LOOK | {"bounces": 64, "roulette": "on"}, 4),
    ],
    measure=lambda run: shares(run, LAST) | after(run, LAST) | cut_off(run, "roulette", LAST), stage=_stage, exr=[f"depth-{LAST}"],
    answer=Number("share-1", "So much of the reflected light is direct. From the fourth on, each bounce brings {rate:1} of the one before; paths "
        "that end after 4 reflections lose {left-4:1} of it."),
    equation=Equation([LATER_BOUNCES], "Marked: what a reflection does to light. L_o is the light of the lamps, plus once reflected, plus twice …"),
    claims=[
        Claim("About half of the reflected light is direct.", "share-1", near=0.5, within=0.1, main=True, measured="{share-1}"),
        Claim("From the fourth on, each bounce brings about half of the one before.", "rate", near=0.5, within=0.05, measured="{rate}"),
        Claim("Roulette ends paths early and loses no light.", "kept", near=1.0, within=0.02, measured="ratio {kept} of the means"),
    ],
)  # fmt: skip
