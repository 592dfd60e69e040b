"""Figure 23: ambient occlusion; how many directions, which ones, and how far they look."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.chapters import OCCLUSION
from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.open_sky import compared
from antumbra.lecture.measures.ratio import ratio, squared, times
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.measures.slopes import Errors
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import white_box
from antumbra.lecture.sketches.open_sky import identity_panel, sky_panel
from antumbra.lecture.sketches.samplers import at_radius, counts, reference
from antumbra.lecture.stages import Panel, Part, Plot, Row, Strip, Tabs
from antumbra.lecture.stages.quantities import table_of
from antumbra.study.plot import error_curves

COUNTS = [1, 4, 16, 64, 256]
SHOWN = [1, 16, 64, 256]
SAMPLERS = {"random": {"sampler": "random"}, "regular": {"sampler": "regular"}, "turned": {"sampler": "regular", "rotate": "on"}, "owen": {"sampler": "owen"}}  # fmt: skip
FITTED = dict.fromkeys(SAMPLERS, COUNTS)
# The edge of the box is 555 long.
RADII = [10, 20, 40, 60, 80, 120, 160, 240, 320, 480, 640, 1000]
ONE = {"size": Pick((44, 44), (200, 200)), "viewing": "centre", "viewing_rays": 1}
OPEN = ONE | {"estimator": "ambient-occlusion"}
# The same number as light: white walls under a sky of radiance 1, by directions of another density.
WHITE = ONE | {"estimator": "hemisphere", "light": "white"}
TRUTH = WHITE | {"directions": "uniform", "clay": 1.0, "sampler": "owen", "shadow_rays": Pick(1024, 4096)}
LAYERS = {"sampler": "owen", "shadow_rays": 64, "aov": "albedo,emission"}


def _errors(run: Run) -> Errors:
    errors: Errors = run.once("errors", lambda: Errors(run, FITTED))
    return errors


def _measure(run: Run) -> Mapping[str, Quantity]:
    errors = _errors(run)
    gain = errors.divided("random", 64, "owen", 64)
    mine, truth = (mean_of(luminances(run, key).mean((1, 2))) for key in ("owen-256", "truth"))
    near = {f"open-{r}": mean_of(luminances(run, f"radius-{r}").mean((1, 2)), "%") for r in RADII}
    worth = {"worth": times(Quantity(64.0), squared(gain)), "same": ratio(mine, truth)}
    return errors.slopes(FITTED) | near | worth | compared(run)


# fmt: off
def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    errors, truth = _errors(run), reference(run, "smooth", 1.0)
    strip = Strip("radius", "How far the rays look", [at_radius(run, found, r) for r in RADII], ("up to R", "fading, 1 − t/R"))
    rows_of = {s: [Row([*counts(run, errors, s, SHOWN, 1.0), truth])] for s in SAMPLERS}
    short = Panel("short", "radius", [strip])
    tabs = Tabs("directions", "Directions", [*(Panel(s, s, row) for s, row in rows_of.items()), short, sky_panel(run), identity_panel(run, found)])
    svg = error_curves(
        [errors.curve(s, FITTED) for s in SAMPLERS], x_title="directions per point, N", y_title="RMSE, one random one is 1", chosen="random",
        x_ticks=COUNTS, y_ticks=[1, 1 / 3, 1 / 10, 1 / 30, 1 / 100], label="RMSE against the number of directions for four samplers.",
    )  # fmt: skip
    rows = {str(n): [errors.relative(s, n) for s in SAMPLERS] for n in COUNTS}
    table = table_of(("N", *SAMPLERS), rows, "RMSE against the number of directions, one random one is 100 %", bare=True)
    note = f"Bars and band: 95 %, {len(run.images('owen-1'))} replicates. Regular directions are the same everywhere: bands, not noise."
    return [tabs, Plot(svg, note, table)]
# fmt: on


FIGURE = Figure(
    number=23, chapter=6, title="How open is a point", seconds=Pick(4, 150),
    question=Question("64 directions for each point, random or well spread (owen). How many random ones are worth 64 well spread ones?",
                      ("64", "about 130", "about 500"), 2, ("worth",)),
    variants=[
        Variant("truth", white_box, TRUTH, 4, truth=True),
        *(Variant(f"{s}-{n}", white_box, OPEN | how | {"shadow_rays": n}, 1 if s == "regular" else 4) for s, how in SAMPLERS.items() for n in COUNTS),
        *(Variant(f"{k}-{r}", white_box, OPEN | {"sampler": "owen", "shadow_rays": 64, "radius": r, "falloff": how}, 3)
          for k, how in (("radius", "none"), ("faded", "linear")) for r in RADII),
        Variant("identity-ao", white_box, OPEN | LAYERS, 4),
        *(Variant(f"identity-{name}", white_box, WHITE | LAYERS | {"directions": how}, 4, truth) for name, how, truth in (("same", "cosine", False), ("other", "uniform", True))),
    ],
    measure=_measure, stage=_stage, exr=["truth", "owen-256"],
    answer=Number("worth", "So many random directions are worth 64 well spread ones. The slope of random ones is {random}, of owen {owen}."),
    equation=Equation([OCCLUSION], "Marked: V along a direction. With directions of density cos θ/π, AO is the share of rays that get away."),
    claims=[
        Claim("64 well spread directions are worth more than 256 random ones.", "worth", above=256, main=True, measured="{worth} are worth 64"),
        Claim("AO is the light of white walls under a white sky.", "same", near=1.0, within=0.01, measured="ratio {same} of the means"),
        Claim("With colours, the picture is albedo × L × AO.", "off", near=0.0, within=0.01, measured="{off} off in the mean; {identical} at most by the same rays"),
        Claim("Random directions: the error falls as N to the −½.", "random", near=-0.5, within=0.03, measured="slope {random}"),
    ],
)  # fmt: skip
