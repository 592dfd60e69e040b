"""f_r of Mitsuba's principled looks, the truth of `crates/antumbra/tests/principled.rs`.

    pip install mitsuba==3.9.1
    python tools/principled.py > crates/antumbra/tests/principled.txt

A line: the look, ω_o, ω_i (each three numbers), f_r of red, green and blue without the cosine.
"""

import mitsuba as mi
import numpy as np

BASE = [0.7, 0.4, 0.1]
LOOKS: dict[str, dict[str, float]] = {
    "plain": {},
    "metal": {"metallic": 0.7, "anisotropic": 0.6, "roughness": 0.4},
    "tinted": {"spec_tint": 0.8, "eta": 1.8, "roughness": 0.3},
    "cloth": {"sheen": 0.8, "sheen_tint": 0.6, "roughness": 0.9},
    "flat": {"flatness": 0.7, "roughness": 0.6, "metallic": 0.2},
    "coat": {"clearcoat": 0.9, "clearcoat_gloss": 0.3, "roughness": 0.6},
    "glass": {"spec_trans": 1.0, "eta": 1.33, "roughness": 0.5},
    "all": {
        "metallic": 0.3,
        "anisotropic": 0.4,
        "roughness": 0.45,
        "eta": 1.7,
        "spec_trans": 0.4,
        "spec_tint": 0.5,
        "sheen": 0.5,
        "sheen_tint": 0.3,
        "clearcoat": 0.6,
        "clearcoat_gloss": 0.2,
        "flatness": 0.25,
    },
}


def directions(rng: np.random.Generator, pair: int) -> tuple[np.ndarray, np.ndarray]:
    """A pair of directions: the first eight above the surface, two of them near the mirrored one."""
    wo, wi = rng.normal(size=(2, 3))
    if pair < 8:
        wo[2], wi[2] = abs(wo[2]), abs(wi[2])
    if pair < 2:
        wi = wo / np.linalg.norm(wo) * [-1, -1, 1] + [0.02, 0.03, 0]
    return wo / np.linalg.norm(wo), wi / np.linalg.norm(wi)


def main() -> None:
    """Prints the table."""
    mi.set_variant("scalar_rgb")
    rng = np.random.default_rng(14)
    for name, numbers in LOOKS.items():
        color = {"type": "rgb", "value": BASE}
        bsdf = mi.load_dict({"type": "principled", "base_color": color, **numbers})
        for pair in range(12):
            wo, wi = directions(rng, pair)
            at = mi.SurfaceInteraction3f()
            at.wi = mi.Vector3f(*wo)
            f = np.array(bsdf.eval(mi.BSDFContext(), at, mi.Vector3f(*wi))) / abs(wi[2])
            print(name, *(f"{x:.8g}" for x in (*wo, *wi, *f)))


if __name__ == "__main__":
    main()
