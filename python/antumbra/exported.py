"""A scene as files for other programs. What `Scene` inherits of it."""

from __future__ import annotations

from os import PathLike

from antumbra import _core
from antumbra._values import text
from antumbra.messages import Message


class Exported:
    """A scene that can be written."""

    _core: _core.Scene

    def export(self, path: str | PathLike[str]) -> list[Message]:
        """Writes the scene for other programs: `.glb` or `.gltf` (glTF 2.0), `.xml` (Mitsuba 3).

        What does not fit into one file lies beside it: `NAME.bin`, `NAME-environment.exr`, `NAME-files/`. The files
        take their places when all of them are on the disk.

        Returns what the format cannot hold, and what was written in its place; nothing if it holds the whole scene.
        Raises OptionError for another ending, OSError where nothing can be written.

        >>> import antumbra as am
        >>> am.builtin("pillars").export("pillars.glb")  # doctest: +SKIP
        []
        """
        _, said = self._core.export(text("path", path))
        return [Message(*each) for each in said]
