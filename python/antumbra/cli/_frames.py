"""`render --frames A:B`: one picture for each frame of an animation; what is done is kept, the next run goes on."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import click

from antumbra import __version__
from antumbra.cli import _say
from antumbra.cli._command import Option

STOPPED = 130
MOST = 100_000


class Frames(NamedTuple):
    """From the first to the last, both rendered, `fps` of them a second; frame f stands at f / fps."""

    first: int
    last: int
    fps: float

    def time(self, frame: int) -> float:
        """When a frame is seen [s]."""
        return frame / self.fps

    def path(self, picture: Path, frame: int) -> Path:
        """walk.exr → walk.0012.exr."""
        digits = max(4, len(str(self.last)))
        return picture.with_name(f"{picture.stem}.{frame:0{digits}d}{picture.suffix}")


def options() -> list[Option]:
    """`--frames` and `--fps`."""
    return [
        Option("--frames", group="Files", metavar="A:B",
               help="frames A to B of the animations of a glTF file, as NAME.0012.exr; frame F is F/fps seconds in"),
        Option("--fps", group="Files", metavar="N", type=float, help="frames a second [24]"),
    ]  # fmt: skip


def wanted(frames: str | None, fps: float | None, scene: str, reading: Mapping[str, Any]) -> Frames | None:
    """What the options say."""
    if frames is None:
        if fps is not None:
            raise click.UsageError("--fps: it goes with --frames, as --frames 0:47 --fps 24")
        return None
    first, _, last = frames.partition(":")
    if not (first.isascii() and first.isdecimal() and last.isascii() and last.isdecimal()):
        raise click.UsageError(f"--frames {frames}: the first and the last frame are needed, as 0:47")
    if not 0 <= int(last) - int(first) < MOST:
        raise click.UsageError(
            f"--frames {frames}: the last one follows the first one, at most {MOST:,} in all"
        )
    if "at_time" in reading:
        raise click.UsageError("--at-time and --frames: one of the two says the time")
    if not (Path(scene).exists() or "." in scene or "/" in scene):
        raise click.UsageError(f'--frames is for glTF files: "{scene}" is none')
    if fps is not None and not 0 < fps < float("inf"):
        raise click.UsageError(f"--fps {fps:g}: a positive number is needed")
    return Frames(int(first), int(last), fps or 24.0)


def run(frames: Frames, picture: Path, made_from: object, one: Callable[[Path, float, bool], None]) -> int:
    """Renders what is not there yet; `one` gets the path, the time, and whether it is the first one of this run."""
    journal = picture.with_name(f"{picture.stem}.frames.json")
    done, now = _done(journal, made_from), None
    rest = [f for f in range(frames.first, frames.last + 1)
            if f not in done or not frames.path(picture, f).is_file()]  # fmt: skip
    count = frames.last - frames.first + 1
    if len(rest) < count:
        print(f"{_say.some(count - len(rest), 'frame')} of {count:,} are there already", file=sys.stderr)
    try:
        for now in rest:
            one(frames.path(picture, now), frames.time(now), now == rest[0])
            done.add(now)
            journal.write_text(json.dumps({"made_from": made_from, "frames": sorted(done)}), encoding="utf-8")
    except KeyboardInterrupt:
        written = sum(f in done for f in range(frames.first, frames.last + 1))
        print(
            f"stopped in frame {now}; {written:,} of {count:,} frames are written; the same command goes on",
            file=sys.stderr,
        )
        return STOPPED
    journal.unlink(missing_ok=True)
    return 0


def identity(scene: str, *given: object) -> list[str]:
    """What makes the frames of two runs the same: the program, the file with all it names, every option."""
    from antumbra.study.content import content

    return [__version__, content(Path(scene)), *(repr(each) for each in given)]


def _done(journal: Path, made_from: object) -> set[int]:
    """The frames that an earlier run of the same command left."""
    try:
        found = json.loads(journal.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return set()
    same = isinstance(found, dict) and found.get("made_from") == made_from
    return {f for f in found.get("frames", []) if isinstance(f, int)} if same else set()
