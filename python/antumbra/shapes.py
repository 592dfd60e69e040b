"""Single shapes for `Scene.add_shape`: `Sphere`, `Disk`, `Cylinder`, `Rectangle`. World space; both sides block."""

from __future__ import annotations

from dataclasses import dataclass

from antumbra._values import Described, Fields, Vector, direction, length, vector


@dataclass(frozen=True)
class Sphere(Described):
    """A sphere about `center` (3,) with `radius`."""

    center: Vector
    radius: float

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {"center": vector("center", self.center), "radius": [length("radius", self.radius)]}


@dataclass(frozen=True)
class Disk(Described):
    """A flat disk about `center` (3,) across `normal` (3,) of any length, with `radius`."""

    center: Vector
    normal: Vector
    radius: float

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "center": vector("center", self.center),
            "normal": direction("normal", self.normal),
            "radius": [length("radius", self.radius)],
        }


@dataclass(frozen=True)
class Cylinder(Described):
    """The side of a cylinder, without caps, around the axis from `p0` (3,) to `p1` (3,), with `radius`."""

    p0: Vector
    p1: Vector
    radius: float

    def fields(self) -> Fields:
        """Its numbers by name."""
        p0, p1 = vector("p0", self.p0), vector("p1", self.p1)
        if p0 == p1:
            raise ValueError(f"p0 and p1 are both {self.p0}: a cylinder has a length")
        return {"p0": p0, "p1": p1, "radius": [length("radius", self.radius)]}


@dataclass(frozen=True)
class Rectangle(Described):
    """The parallelogram corner + s·u + t·v, s and t in [0, 1]; `corner`, `u`, `v` (3,). Its front is u × v."""

    corner: Vector
    u: Vector
    v: Vector

    def fields(self) -> Fields:
        """Its numbers by name."""
        return {
            "corner": vector("corner", self.corner),
            "u": direction("u", self.u),
            "v": direction("v", self.v),
        }


Shape = Sphere | Disk | Cylinder | Rectangle
