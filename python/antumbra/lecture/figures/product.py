"""Figure 4: visibility and intensity are both needed, and their product is not the shadow."""

import numpy as np

from antumbra.lecture.figure import Claim, Equation, Figure, Number, Pick, Question, Variant
from antumbra.lecture.measures.points import fraction_at, irradiance_at
from antumbra.lecture.measures.ratio import excess, ratio, times
from antumbra.lecture.scenes import disk_over_floor
from antumbra.lecture.stages import Frame, Strip

RADII = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.75, 0.9, 1.1, 1.3, 1.6, 2.0]
AT = (0.3, 0.0, 0.0)
# CF19a, b: what the closed forms say of a light of radius 0.5 over the point `AT`.
VISIBLE, TRUE = 0.5376215, 0.0994152
LOOK = {
    "estimator": "area", "light_points": "area", "viewing_rays": Pick(64, 1024),
    "aov": "visible-fraction,unshadowed-direct", "size": Pick((112, 112), (440, 440)),
    "eye": (0.0, 0.98, 0.0), "look_at": (0.0, 0.0, 0.0), "up": (0.0, 0.0, -1.0), "fov": 2 * np.arctan(1.2 / 0.98),
}  # fmt: skip


def parts(run, radius):
    """Visible fraction, unshadowed light, their product and the true picture."""
    key = f"r{radius:.2f}"
    seen, light, true = run.aov(key, "visible-fraction"), run.aov(key, "unshadowed-direct")[..., 0], run.light(key)
    return seen, light, seen * light, true


def measure(run):
    scene, rays, seed = run.scene(disk_over_floor(0.5)), run.pick(Pick(2**21, 2**24)), run.seeded(1)
    seen = fraction_at(scene, AT, rays, seed)
    light = irradiance_at(scene, AT, rays, seed + 1, light_points="area", shadows="off")
    true = irradiance_at(scene, AT, rays, seed + 2, light_points="area")
    more = ratio(true, times(seen, light))
    outside = (0.9, 0.0, 0.9)
    lit = ratio(irradiance_at(scene, outside, rays, seed), irradiance_at(scene, outside, rays, seed + 1, shadows="off"))
    return {"seen": seen, "true": true, "more": excess(more), "lit": excess(lit)}


def stage(run, measured):
    frames = []
    for radius in RADII:
        seen, light, product, true = parts(run, radius)
        off = np.where(product > 0.02 * light.max(), true / np.maximum(product, 1e-12) - 1, 0.0)
        low, high, white, name = off.min(), off.max(), light.max(), f"r{radius:.2f}"
        span = f"{100 * low:+.0f} … {100 * high:+.0f} %".replace("-", "−")
        pictures = [
            run.map(seen, f"Visible fraction, {seen.min():.2f} to 1.", name=f"{name}-seen"),
            run.picture(light, "Unshadowed light: brightest in the middle.", name=f"{name}-light", white=white),
            run.picture(product, "Their product: a shadow.", name=f"{name}-product", white=white),
            run.picture(true, "The true picture: a shadow of another shape.", name=f"{name}-true", white=white),
            run.map(off, f"True over product, less 1: {span}.", name=f"{name}-off", ramp="signed", low=-0.15, high=0.15),
        ]
        frames.append(Frame(f"{radius:g}", f"R = {radius:g}: product off by {span}", pictures, short=f"R = {radius:g}"))
    labels = ("V, visible fraction", "E, unshadowed", "V · E", "true", "true / product − 1, ±15 %")
    return [Strip("R", "Radius R of the light, 2 over the floor; the occluder has 0.2 and hangs between", frames, 8, labels)]


FIGURE = Figure(
    number=4, chapter=1, title="Visibility times intensity", seconds=Pick(7, 120),
    question=Question(
        "The floor sees a part V of the light, and would get E without the occluder. Is V · E the light that it gets?",
        ("yes, exactly", "no, some per cent off in the penumbra", "no, off everywhere"), 1,
    ),
    variants=[Variant(f"r{r:.2f}", disk_over_floor(r), LOOK) for r in RADII],
    measure=measure, stage=stage, exr=["r0.50"],
    answer=Number("more", "more light than V · E, half a light radius inside of the penumbra (R = 0.5, x = 0.3). The part of the light that "
        "stays visible there is not its average part: it stands higher and nearer."),
    equation=Equation(
        [(r"\int_{A_L} \mark{V} \, \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A \;\neq\; \frac{1}{A_L}\int_{A_L} \mark{V} \, \text{d}A \, \cdot "
          r"\int_{A_L} \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A",
          "∫ V cos θ cos θ′ / r² dA ≠ (1/A ∫ V dA) · ∫ cos θ cos θ′ / r² dA")],
        "Marked: V stands under the integral. It may be taken out only where it is the same for all points of the light.",
    ),
    claims=[
        Claim("At x = 0.3 the true light is 4.1 % above the product.", "more", near=TRUE / 0.0955 - 1, within=0.004, main=True,
              measured="{more} (closed form 4.1 %)"),
        Claim("The visible fraction is that of two overlapping disks.", "seen", near=VISIBLE, within=0.003,
              measured="{seen} (lens formula 0.5376)"),
        Claim("Where the whole light is seen, the product is right.", "lit", near=0, within=0.002, measured="off by {lit} outside of the penumbra"),
    ],
)  # fmt: skip
