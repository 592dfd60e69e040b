"""What antumbra raises beside ValueError and TypeError."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from antumbra.image import Image


class SceneError(Exception):
    """A file that cannot be used as it is, or a scene that cannot be made of it.

    Attributes: `what` is wrong, in which `file`, at which `place` in it (both may be empty), and a `hint` what to do.
    """

    def __init__(self, what: str, file: str = "", place: str = "", hint: str = "") -> None:
        """Keeps the four parts; `str()` joins them as the command line does."""
        super().__init__(what, file, place, hint)
        self.what, self.file, self.place, self.hint = what, file, place, hint

    def __str__(self) -> str:
        """`file: place: what`, the hint on its own line."""
        line = ": ".join(part for part in (self.file, self.place, self.what) if part)
        return f"{line}\n{self.hint}" if self.hint else line


class OptionError(ValueError):
    """A setting that does not exist, or a value that it does not take."""


class RenderStopped(KeyboardInterrupt):
    """Ctrl-C during a render; `image` holds the passes that were done, or is None if there were none."""

    def __init__(self, image: Image | None) -> None:
        """Keeps the work so far."""
        super().__init__("stopped")
        self.image = image
