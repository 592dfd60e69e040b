"""Figure 19: direct and indirect light, bounce by bounce, and where a path may end."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import LATER_BOUNCES
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.bounces import after, cut_off, shares
from antumbra.lecture.measures.ends import End, compared, end
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.sketches.ends import bounce, ends_compared, parts_of_light, shares_plot
from antumbra.lecture.stages import Panel, Part, Plot, Strip, Tabs
from antumbra.lecture.stages.quantities import table_of

DEPTHS = range(13)
LAST = DEPTHS[-1]
# The same random numbers for every depth: what a bounce more adds is its light alone.
ONE = {"estimator": "path", "viewing": "centre", "size": Pick((44, 44), (200, 200))}
LOOK = ONE | {"roulette": "off", "viewing_rays": Pick(16, 32)}
# Where a path may end, and the reflections after which light is lost; the work at which errors are compared [rays a pixel].
ENDS = {"short": "4 reflections", "roulette": "roulette", "long": "12 reflections"}
DEPTH = {"short": 4, "roulette": LAST, "long": LAST}
HOW: dict[str, dict[str, object]] = {"short": {"bounces": 4, "roulette": "off"}, "roulette": {"bounces": 64}, "long": {"bounces": LAST, "roulette": "off"}}  # fmt: skip
PATHS, WORK = 8, [10 * 2**n for n in range(12)]


def _ends(run: Run) -> dict[str, End]:
    found: dict[str, End] = run.once("ends", lambda: {way: end(run, way, PATHS, DEPTH[way], LAST) for way in ENDS})  # fmt: skip
    return found


def _measure(run: Run) -> Mapping[str, Quantity]:
    return shares(run, LAST) | after(run, LAST) | cut_off(run, "roulette", LAST) | compared(run, _ends(run))


def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    white, light = run.white(f"depth-{LAST}", share=95), float(run.light(f"depth-{LAST}").mean())
    ends = ends_compared(run, _ends(run), list(ENDS.values()), light, WORK)
    strip = Strip("reflections", "Reflections on the way to the eye", [bounce(run, found, k, white) for k in DEPTHS],
                  ("this alone", "all up to here"), tells=1, begins=LAST)  # fmt: skip
    tabs = Tabs("show", "What is shown", [
        Panel("bounces", "Bounce by bounce", [strip]), Panel("sum", "Direct + indirect", [parts_of_light(run, LAST, white)], late=True),
        Panel("ends", "Where a path ends", [ends]),
    ])  # fmt: skip
    rows = {str(k): (found[f"share-{k}"], found[f"left-{k}"]) for k in (1, 2, 4, 8)}
    cost = ", ".join(f"{words} {found[f'rays-{way}'].value:.1f}" for way, words in ENDS.items())
    table = table_of(("k", "share", "still to come"), rows, "Reflected light by number of reflections",
                     note=f"Roulette ends paths at random and makes up for it: it leaves nothing to come. Rays of a path: {cost}.")  # fmt: skip
    note = f"Bars: 95 %, {len(run.images('depth-1'))} independent replicates. The line: the mean rate from k = 4 on."
    return [tabs, Plot(shares_plot(found, LAST), note, table)]


FIGURE = Figure(
    number=19, chapter=5, title="After the first bounce", seconds=Pick(5, 120),
    question=Question("Direct light is reflected once. How much of all the light that the walls of this box reflect to the eye is direct?",
                      ("about a quarter", "about a half", "nearly all"), 1, ("share-1",)),
    variants=[
        *(Variant(f"depth-{k}", builtin("cornell-box"), LOOK | {"bounces": k}, 4) for k in DEPTHS),
        Variant("roulette", builtin("cornell-box"), LOOK | {"bounces": 64, "roulette": "on"}, 4),
        *(Variant(f"end-{way}", builtin("cornell-box"), ONE | {"sampler": "random", "viewing_rays": PATHS} | how, 16) for way, how in HOW.items()),
    ],
    measure=_measure, stage=_stage, exr=[f"depth-{LAST}"],
    answer=Number("share-1", "So much of the reflected light is direct. From the fourth on, each bounce brings {rate:1} of the one before; paths "
        "that end after 4 reflections lose {left-4:1} of it."),
    equation=Equation(LATER_BOUNCES, "Marked: light by its reflections, on a screen that of the picture. T: what a reflection does to light."),
    claims=[
        Claim("About half of the reflected light is direct.", "share-1", near=0.5, within=0.1, main=True, measured="{share-1}"),
        Claim("Roulette ends paths early and loses no light.", "kept", near=1.0, within=0.02, measured="ratio {kept} of the means"),
        Claim("At equal work roulette has less variance than 12 reflections.", "worth", above=1.0, measured="1 / {worth} of it, counted in rays; by the clock 1 / {clock:r}"),
        Claim("4 reflections have less noise still, and their bias outweighs it from 1,000 rays a pixel on, if not before.", "level", below=1000, measured="equal errors at {level:1} rays a pixel"),
    ],
)  # fmt: skip
