"""An `Explanation` as people read it in a terminal: 80 columns, one row a ray to a light."""

from __future__ import annotations

from antumbra._pixel import LightRay, Pixel, Triple, ViewingRay
from antumbra._words import significant, some
from antumbra.settings import table

_COLUMN = 25


def explained(e: Pixel) -> str:
    """Scene and pixel; per viewing ray its receiver and its table; the sum."""
    mis = e.settings.get("estimator") == "mis"
    lines = [f"{e.name}, pixel {e.pixel[0]},{e.pixel[1]} of {e.size[0]} × {e.size[1]} · {_plan(e)}"]
    for k, ray in enumerate(e.viewing_rays):
        lines += ["", *_viewing_ray(e, k, ray, mis)]
    lines += ["", _fact("pixel", f"{_color(e.value)}, the sum, as in the picture")]
    if e.light_rays:
        share = "weight · " if mis else ""
        lines += [
            _fact("brings", f"V · {share}L_e · f_r · cos θ / pdf,"),
            _fact("", "over shadow rays × viewing rays; luminances"),
            _fact("pdf", "per solid angle [1/sr]; per area of the light,"),
            _fact("", f"pdf · cos θ′ / r², {_areas(e)}"),
        ]
    return "\n".join(lines)


def _plan(e: Pixel) -> str:
    value = {name: e.settings.get(name, setting.default) for name, setting in table().items()}
    shadow = some(int(value["shadow_rays"]), "shadow ray")
    return f"{value['estimator']}, {value['viewing_rays']} viewing × {shadow}"


def _viewing_ray(e: Pixel, k: int, ray: ViewingRay, mis: bool) -> list[str]:
    of = f"viewing ray {k + 1} of {len(e.viewing_rays)}"
    at = ray.receiver
    lines = [_fact(of, f"from {_vector(ray.origin)} along {_vector(ray.direction)}")]
    if at is None:
        lines.append(_fact("meets", "nothing"))
    else:
        what = " of ".join(f'"{name}"' for name in (at.object, at.material) if name) or "a surface"
        lines += [
            _fact("meets", f"{what} after {significant(at.distance)}, ρ {_color(at.albedo)}"),
            _fact("receiver", f"{_vector(at.position)}, normal {_vector(at.normal)}"),
        ]
    if any(ray.emission):
        lines.append(_fact("light seen itself", _color(ray.emission)))
    if ray.light_rays:
        third = "weight" if mis else "r²"
        head = ("cos θ", "cos θ′", third, "pdf", "L_e", "f_r", "V", "brings")
        lines += ["", _row("light", "point, or direction", head)]
        lines += [_light_ray(e, row, mis) for row in ray.light_rays]
        lines.append(_fact("its sum", _color(ray.brings)))
    return lines


def _light_ray(e: Pixel, row: LightRay, mis: bool) -> str:
    light = "none" if row.light is None else e.lights[row.light]
    place = row.point or row.direction
    where = "".join(f"{_short(c):>7}" for c in place)
    third = row.weight if mis else row.distance2
    numbers = [row.cos, row.cos_light, third, row.pdf, _grey(row.radiance), _grey(row.brdf)]
    free = {True: "1", False: "0", None: "–"}[row.visible]
    return _row(light, where, (*map(_short, numbers), free, _short(_grey(row.brings))))


def _areas(e: Pixel) -> str:
    """What the densities per area are, all in all."""
    found = [area for row in e.light_rays if (area := row.pdf_area) is not None]
    if not found:
        return "where it has one"
    low, high = significant(min(found)), significant(max(found))
    return f"{low} / m²" if low == high else f"{low} to {high} / m²"


def _row(light: str, where: str, rest: tuple[str, ...]) -> str:
    widths = (6, 6, 6, 6, 6, 6, 1, 7)
    cells = " ".join(f"{cell:>{width}}" for cell, width in zip(rest, widths, strict=True))
    return f"{light[:7]:<7}{where:<21} {cells}".rstrip()


def _fact(name: str, text: str) -> str:
    return f"{name:<{_COLUMN}}{text}"


def _short(x: float) -> str:
    """Three digits in at most six characters."""
    if x != x or abs(x) == float("inf"):
        return "–" if x != x else "∞"
    text = significant(x).replace(",", "")
    return text if len(text) <= 6 else f"{x:.0e}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def _vector(v: Triple) -> str:
    return f"({', '.join(significant(c) for c in v)})"


def _color(c: Triple) -> str:
    return " ".join(significant(x) for x in c)


def _grey(c: Triple) -> float:
    """Luminance (Rec. 709)."""
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]
