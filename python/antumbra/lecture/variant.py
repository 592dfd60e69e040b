"""One picture of a figure: a scene and ordinary options (`Variant`); values that depend on the time (`Pick`)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from antumbra.scene import Scene


# Replicates of one seed of a lecture get seeds of their own, so many of the 2³² that a render has.
SEEDS = 4096
LARGEST_SEED = (1 << 32) // SEEDS - 1


class Pick(NamedTuple):
    """A value that depends on how long the lecture may take."""

    quick: Any
    full: Any


def edition(quick: bool, seed: int) -> str:
    """What stands after a figure's name in its files: figures of another size or seed lie beside each other."""
    return (".quick" if quick else "") + (f".seed-{seed}" if seed else "")


@dataclass(frozen=True)
class Variant:
    """One picture of a figure: a scene and ordinary options of `Scene.render`.

    `key` names it in the figure and in its files. `scene` is called to build it. An option may be a `Pick`.
    `replicates`: how often it is rendered, each with a seed of its own; variants share them, so that what two of them
    have in common cancels, but for a `truth`: what others are judged by has random numbers of its own.
    """

    key: str
    scene: Callable[[], Scene]
    options: Mapping[str, Any] = field(default_factory=dict)
    replicates: int | Pick = 1
    truth: bool = False
