"""What opens each chapter of the lecture."""

from __future__ import annotations

from antumbra.lecture.figure import Chapter, Equation, Pick, Variant
from antumbra.lecture.scenes import builtin

# Equations that several figures share: LaTeX, and the same in words and signs.
DIRECT = (
    r"L_o(p) = f_r L_e \int_{A_L} \mark{V(p, p')} \, \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A",
    "L_o(p) = f_r L_e ∫ over the light of V(p, p′) · cos θ cos θ′ / r² dA",
)
SUM = (
    r"L_o \approx \frac{f_r L_e}{N} \sum_{j=1}^{N} \mark{\frac{V(p, p'_j) \, \cos\theta_j \, \cos\theta'_j}{\text{pdf}(p'_j) \, r_j^2}}",
    "L_o ≈ (f_r L_e / N) · sum over N shadow rays of V cos θ cos θ′ / (pdf r²)",
)
SUM_OF_N = (
    r"L_o \approx \frac{f_r L_e}{\mark{N}} \sum_{j=1}^{\mark{N}} \frac{V(p, p'_j) \, \cos\theta_j \, \cos\theta'_j}{\text{pdf}(p'_j) \, r_j^2}",
    "L_o ≈ (f_r L_e / N) · sum over N shadow rays of V cos θ cos θ′ / (pdf r²)",
)
SUM_OF_PDF = (
    r"L_o \approx \frac{f_r L_e}{N} \sum_{j=1}^{N} \frac{V(p, p'_j) \, \cos\theta_j \, \cos\theta'_j}{\mark{\text{pdf}(p'_j)} \, r_j^2}",
    "L_o ≈ (f_r L_e / N) · sum over N shadow rays of V cos θ cos θ′ / (pdf r²)",
)
HEMISPHERE = (
    r"L_o(p) = \int_{\Omega} f_r \, \mark{L_i(\omega) \, \cos\theta \, \text{d}\omega}, \qquad "
    r"\text{d}\omega = \frac{\cos\theta'}{r^2} \, \text{d}A",
    "L_o(p) = ∫ over the hemisphere of f_r L_i cos θ dω, with dω = cos θ′ / r² dA",
)
SEGMENT = (
    r"V(p, p') = \begin{cases} 0 & \exists \, \mark{t \in (0, 1)} \; : \; p + t \, (p' - p) \in \text{a surface} \\ 1 & \text{else} \end{cases}",
    "V(p, p′) = 0 if p + t (p′ − p) lies on a surface for some t strictly between 0 and 1, else 1",
)

PIXEL_AND_LIGHT = (
    r"L = \int_{\text{pixel}} \int_{A_L} f_r L_e V \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A \, \text{d}x \approx \frac{1}{N} \sum_{j=1}^{N} \frac{f(\mark{x_j, p'_j})}{\text{pdf}(p'_j)}",
    "L = ∫ over the pixel of ∫ over the light of f_r L_e V cos θ cos θ′ / r² dA dx ≈ (1/N) · sum over N samples of f(x, p′) / pdf(p′)",
)
BOUNCES = (
    r"L_o(p) = L_e + \mark{\int_{A_L} f_r \, L_e \, V \, \frac{\cos\theta \, \cos\theta'}{r^2} \, \text{d}A} + \int_{\Omega} f_r \, L_o(p') \, \cos\theta \, \text{d}\omega",
    "L_o(p) = L_e + ∫ over the lights of f_r L_e V cos θ cos θ′ / r² dA + ∫ over the hemisphere of f_r L_o(p′) cos θ dω",
)

OCCLUSION = (
    r"\text{AO}(p) = \frac{1}{\pi} \int_{\Omega} \mark{V(p, \omega)} \, \cos\theta \, \text{d}\omega \approx \frac{1}{N} \sum_{j=1}^{N} \mark{V(p, \omega_j)}",
    "AO(p) = (1/π) ∫ over the hemisphere of V(p, ω) cos θ dω ≈ (1/N) · sum over N directions of V(p, ω)",
)
LATER_BOUNCES = [
    (r"L_o = \mark{L_e} + \mark{T L_e} + \mark{T^2 L_e} + \mark{\dots}", "L_o = L_e + T L_e + T² L_e + …"),
    (
        r"(T L)(p) = \int_{\Omega} f_r \, L(p') \, \cos\theta \, \text{d}\omega",
        "where (T L)(p) = ∫ over the hemisphere of f_r L(p′) cos θ dω",
    ),
]

_SIZE = Pick((280, 196), (560, 392))
_VIEW = {"size": _SIZE, "eye": (-7.4, 5.6, 5.4), "look_at": (0.3, 0.55, 0.3), "fov": 0.5}
_PILLARS = _VIEW | {"estimator": "area", "viewing_rays": Pick(2, 16), "shadow_rays": 4}
_ONE_RAY = _VIEW | {"viewing": "centre", "viewing_rays": 1, "light_points": "area", "sampler": "random"}
_OPEN = {"size": _SIZE, "estimator": "ambient-occlusion", "viewing_rays": Pick(2, 16), "shadow_rays": 16}
_BOX = {"size": Pick((196, 196), (392, 392)), "estimator": "path", "viewing_rays": Pick(8, 64)}


def _pillars(key: str, **options: object) -> Variant:
    return Variant(key, builtin("pillars"), _PILLARS | options)


def _between(key: str, **options: object) -> Variant:
    look = {"size": _SIZE, "estimator": "area", "viewing_rays": Pick(2, 16), "shadow_rays": 4}
    return Variant(key, builtin("plane-and-cylinder"), look | options)


CHAPTERS = (
    Chapter(
        number=1,
        title="Shadows",
        short="Shadows",
        paragraphs=(
            "Without shadows a ball has no place: it could lie on the floor or float above it, and the picture would "
            "be the same. The shadow decides.",
            "Two things have to be found for every point: which part of the light it sees, and how bright that part "
            "makes it. The first is geometry, a yes or no for each segment. The second is an integral. This chapter "
            "is about the first.",
        ),
        equation=Equation(
            (DIRECT,),
            "The visibility V is 1 where the segment from p to p′ is free, and 0 where something lies on it.",
        ),
        pictures=(
            (
                _pillars("off", shadows="off"),
                "Pillars on a floor, without shadows: they seem to float.",
                "V = 1 everywhere",
            ),
            (
                _pillars("on"),
                "The same pillars with soft shadows: all of them stand on the floor.",
                "V as it is",
            ),
        ),
    ),
    Chapter(
        number=2,
        title="Shadow rays",
        short="Rays",
        paragraphs=(
            "A shadow ray asks one question: is anything strictly between these two points? The first yes ends the "
            "search, whatever else lies on the segment.",
            "Strictly between is the difficult part. What lies behind the light must not count, and the surface that "
            "the ray starts from must not either. Both are easily got wrong, and both are seen at once.",
        ),
        equation=Equation(
            (SEGMENT,), "Marked: both ends are left out. p lies on the receiver, p′ on the light."
        ),
        pictures=(
            (
                _between("off", distance_test="off"),
                "A light between a plane and a cylinder, rays that do not end at it: dark where they meet the cylinder.",
                "anything on the ray",
            ),
            (
                _between("on"),
                "The same light, segments that end at it: plane and cylinder are lit.",
                "anything between",
            ),
        ),
    ),
    Chapter(
        number=3,
        title="Two integrals",
        short="Integrals",
        paragraphs=(
            "The light that arrives can be added up over directions, or over points of the lights. Both sums have the "
            "same value: dω and dA are two ways to cut up the same light.",
            "As estimators they are far apart. A random direction may miss the light, a random point of the light may "
            "be hidden. Which is worse depends on how much of the sky the light fills.",
        ),
        equation=Equation(
            (HEMISPHERE,), "Marked: what a direction brings, and what it is as a piece of the light."
        ),
        pictures=(
            (
                _pillars(
                    "hemisphere", estimator="hemisphere", viewing_rays=1, shadow_rays=16, sampler="random"
                ),
                "Sixteen random directions a pixel: black with a few bright dots, where one met the light.",
                "16 directions",
            ),
            (
                _pillars("area", viewing_rays=1, shadow_rays=16, sampler="random"),
                "Sixteen random points of the light a pixel: smooth, with some noise in the penumbra.",
                "16 points of the light",
            ),
        ),
    ),
    Chapter(
        number=4,
        title="Sampling the light",
        short="Sampling",
        paragraphs=(
            "The integral becomes a mean over points of the light. How the points are chosen decides how fast the "
            "noise goes, and whether the mean is right at all.",
            "Noise can be seen and measured. A wrong density cannot be seen: the picture is clean, and false. So each "
            "estimator here is held against another one that must agree.",
        ),
        equation=Equation(
            (SUM,), "Marked: one shadow ray. The density in which points are drawn divides it out again."
        ),
        pictures=(
            (
                Variant("one", builtin("pillars"), {**_ONE_RAY, "estimator": "area", "shadow_rays": 1}),
                "One random shadow ray a pixel: penumbras are black and white dots.",
                "1 shadow ray",
            ),
            (
                Variant("hundred", builtin("pillars"), {**_ONE_RAY, "estimator": "area", "shadow_rays": 100}),
                "A hundred random shadow rays a pixel: smooth penumbras.",
                "100 shadow rays",
            ),
        ),
    ),
    Chapter(
        number=5,
        title="Pixels and paths",
        short="Paths",
        paragraphs=(
            "A viewing ray finds what a pixel shows; shadow rays find what lights it. A pixel needs several of both, and "
            "where the rays go is a choice.",
            "What lights a surface is not only lamps: every lit wall is a lamp for the next one. A path follows the light "
            "back from wall to wall. At each of them the direct light can be computed on purpose, or left to chance.",
        ),
        equation=Equation(
            (BOUNCES,), "Marked: the direct light. The last term has Lₒ in it again: bounce after bounce."
        ),
        pictures=(
            (
                Variant("direct", builtin("cornell-box"), _BOX | {"bounces": 1}),
                "The Cornell box in direct light: the ceiling and all shadows are black.",
                "direct light",
            ),
            (
                Variant("all", builtin("cornell-box"), _BOX),
                "The Cornell box with all bounces: the ceiling is lit, shadows are soft and coloured.",
                "direct and indirect",
            ),
        ),
    ),
    Chapter(
        number=6,
        title="Environment and occlusion",
        short="Sky",
        paragraphs=(
            "Out of doors the light is all around. How bright a point is depends on how much of the sky it sees: under a "
            "white sky on that alone.",
            "That share, weighted by the cosine, is ambient occlusion. It needs no lamp and no material, only geometry: so "
            "it can be computed beforehand, and once for all.",
        ),
        equation=Equation((OCCLUSION,), "Marked: whether the sky is seen along a direction."),
        pictures=(
            (
                Variant("box", builtin("corner"), _OPEN | {"radius": 0.5}),
                "Bodies in a corner, occluders count up to half a metre: dark where they touch the floor.",
                "up to 0.5",
            ),
            (
                Variant("corner", builtin("corner"), _OPEN),
                "Bodies in a corner, ambient occlusion: dark in the corner and below them.",
                "without limit",
            ),
        ),
    ),
)
