"""Figure 22: one scene under five skies; directions from the BRDF, from the map, from both; a sky as a wide lamp."""

from __future__ import annotations

from collections.abc import Mapping

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.skies import PARTS, SIZE, VIEW, WAYS, met_sun, noises, of_sphere, surfaces
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.skies import SKIES, SUNS, TURNS, in_sphere, lights_of, under_skies
from antumbra.lecture.sketches.skies import spheres, turned, under
from antumbra.lecture.stages import Panel, Part, Tabs
from antumbra.lecture.stages.quantities import table_of

LOOK = VIEW | {"size": SIZE, "viewing": "centre", "viewing_rays": 1, "sampler": "random"}
CHOSEN, SMOOTH = {"lights": "contribution"}, {"sampler": "owen"}
# As many directions in each: MIS has half of them from the map and half from the BRDF.
HOW = {
    "brdf": {"estimator": "hemisphere", "shadow_rays": 16},
    "map": CHOSEN | {"estimator": "area", "shadow_rays": 16},
    "mis": CHOSEN | {"estimator": "mis", "shadow_rays": 8, "aov": ["position", "normal", "albedo", "depth"]},
}
TURNED = LOOK | CHOSEN | SMOOTH | {"estimator": "mis", "shadow_rays": Pick(8, 32)}
SPHERE = LOOK | SMOOTH | {"estimator": "hemisphere", "shadow_rays": Pick(32, 64)}
RADII = [3.0, 30.0, 1e4]


def _measure(run: Run) -> Mapping[str, Quantity]:
    lamps = {"sphere": of_sphere(run, 1e4), "near": of_sphere(run, 3.0)}
    return noises(run) | met_sun(run) | lamps | {"hashes": Quantity(len(surfaces(run)))}


# fmt: off
def _stage(run: Run, found: Mapping[str, Quantity]) -> list[Part]:
    # First the one of the question.
    panels = [Panel(sky, sky, [under(run, found, sky)]) for sky in sorted(SKIES, key=lambda sky: sky != "midday")]
    tabs = Tabs("sky", "Sky", [*panels, Panel("turned", "turned", [turned(run)]), Panel("lamp", "as a lamp", [spheres(run, RADII)])])
    rows = {sky: ["no sun" if sky in SUNS and way == "brdf" else found[f"{way}-{sky}-{part}"] for part in PARTS for way in WAYS]
            for sky in SKIES}
    table = table_of(
        ("sky", "BRDF", "map", "MIS", "gold: BRDF", "map", "MIS"), rows, "Noise of 16 directions over the mean [%], all and the gold ball alone", bare=True,
        note="Standard deviation over the mean [%]: BRDF, map, MIS, then on the gold ball alone; 16 directions a pixel, MIS 8 and 8. No sun: a direction "
        f"hardly ever meets it. Hash of the scene without lights (triangles; position, normal, albedo, depth): {' / '.join(surfaces(run))}.",
    )
    return [tabs, table]
# fmt: on


FIGURE = Figure(
    number=22, chapter=6, title="Light from all around", seconds=Pick(6, 90),
    question=Question("A small midday sun in a wide sky: directions are drawn from the BRDF of the table, or from the map. How many of the first are worth one of the second?",
                      ("about 10", "about 1,000", "more than 100,000"), 2, ("worth",)),
    variants=[
        *(Variant(f"{way}-{sky}", under_skies, LOOK | how | {"light": lights_of(sky)}, 8) for sky in SKIES for way, how in HOW.items()),
        *(Variant(f"turn-{t}", under_skies, TURNED | {"light": f"turn-{t}" if t else "studio"}) for t in range(TURNS)),
        Variant("sphere-none", under_skies, SPHERE | {"light": "studio"}, Pick(3, 4)),
        *(Variant(f"sphere-{r:g}", in_sphere(r), SPHERE | {"environment": "none"}, Pick(3, 4)) for r in RADII),
    ],
    measure=_measure, stage=_stage, exr=["mis-midday", "mis-studio"],
    answer=Number("worth", "So many are worth one: only one in {rare:1} meets the sun. On gold under the painted sky it is the map that has {gilded:1} "
        "times the noise of the BRDF; MIS follows the better of the two."),
    equation=Equation([(r"L_o \approx \frac{1}{N} \sum_{j=1}^{N} \frac{f_r \, \mark{L(\omega_j)} \, V(p, \omega_j) \, \cos\theta_j}{\text{pdf}(\omega_j)}",
                        "L_o ≈ (1/N) · sum over N directions of f_r L(ω) V cos θ / pdf(ω)")],
                      "Marked: the map. Where pdf follows it, its sun cancels; where it follows f cos θ, the BRDF does."),
    claims=[
        Claim("One direction of the map is worth over 100,000 of the BRDF.", "worth", above=100, main=True, measured="{worth}"),
        # 4 standard errors: a right program fails once in 10,000 runs.
        Claim("They meet the sun as rarely as its disc is small, to 4 standard errors.", "off", near=0.0, within=4.0,
              measured="{hits:v} hits, N sin² α cos θ = {expected:v}: {off:v}"),
        Claim("Five skies, one scene: one hash.", "hashes", near=1.0, within=0.5, measured="{hashes:v} of 5"),
        Claim("MIS keeps to the better way.", "insured", below=1.5, measured="at worst {insured} times its noise"),
        Claim("A sphere of 10⁴ radii is a sky.", "sphere", near=0.0, within=0.01,
              measured="{sphere} off"),
    ],
)  # fmt: skip
