"""Runs the figures of a lecture, keeps what they find, and writes the page: `Lecture`."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple

from antumbra import __version__
from antumbra.lecture import catalog, page
from antumbra.lecture.chapters import CHAPTERS
from antumbra.lecture.figure import Chapter, Figure, Pick
from antumbra.lecture.keep import Folder, key
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Report, Run
from antumbra.lecture.stages import Picture, plain
from antumbra.lecture.variant import edition
from antumbra.lecture.verdict import expected, verdict

# What the two pictures of a chapter's opening take.
_OPENING = Pick(0.7, 6.0)
# Where measuring begins in the progress of a figure that renders pictures, and where drawing the page's pictures does.
_MEASURES, _DRAWS = 0.8, 0.9
# Bytes that a figure takes in its folder, half more than the largest of this lecture, and the page with its numbers.
_ROOM, _PAGE = Pick(500_000, 2_000_000), 2_000_000
# What is stated counts like so many seconds of this machine, until more are known.
_BELIEVED = 1.0


class Step(NamedTuple):
    """How far a lecture is: the figure at work and what is done of it, how many are `done` of `all`, the share of it,
    seconds left.
    """

    name: str
    doing: str
    done: int
    all: int
    share: float
    left: float


class Lecture:
    """A lecture in a folder: `figures` by name, coarse (`quick`) or full, with a `seed`."""

    def __init__(
        self,
        folder: Path,
        figures: Mapping[str, Figure],
        *,
        quick: bool = False,
        seed: int = 0,
        single: bool = False,
    ) -> None:
        """Nothing runs yet."""
        self.folder, self.figures = Folder(folder), figures
        self.quick, self.seed, self.single = quick, seed, single
        self.edition = edition(quick, seed)
        self._stated_seconds = self._took = 0.0

    # ---- what there is to do ----

    def waiting(self) -> list[str]:
        """Names of openings (`chapter-1`) and figures that are not finished; those that are set the pace."""
        openings = [
            _opening(c) for c in CHAPTERS if any(f.chapter == c.number for f in self.figures.values())
        ]
        self._stated_seconds = self._took = 0.0
        found = []
        for name in (*openings, *self.figures):
            if kept := self.folder.kept(name, self._key(name), self.edition):
                self._learn(name, kept)
            else:
                found.append(name)
        return found

    def kept(self, name: str) -> dict[str, Any] | None:
        """What a figure found at this size and seed, with the sources of now or older ones."""
        return self.folder.kept(name, of=self.edition)

    def seconds(self, names: Sequence[str]) -> float:
        """How long these will take: what is stated on two cores, at the pace that finished figures had here."""
        return self._pace() * sum(self._stated(name) for name in names)

    def room(self) -> int:
        """Bytes that must be free in the folder for what is waiting, and for the page."""
        each = _ROOM.quick if self.quick else _ROOM.full
        return int(each * len(self.waiting()) + _PAGE + (page.LARGEST if self.single else 0))

    def _pace(self, stated: float = 0.0, took: float = 0.0) -> float:
        """What figures took for each second stated: those that are finished, and what is given of the one at work."""
        return (self._took + took + _BELIEVED) / (self._stated_seconds + stated + _BELIEVED)

    def _learn(self, name: str, result: Mapping[str, Any]) -> None:
        self._stated_seconds += self._stated(name)
        self._took += result["seconds"]

    def _stated(self, name: str) -> float:
        cost = self.figures[name].seconds if name in self.figures else _OPENING
        return float(cost.quick if self.quick else cost.full)

    def _key(self, name: str) -> str:
        return key(name, self.quick, self.seed)

    # ---- doing it ----

    def run(
        self,
        step: Callable[[Step], object] = lambda at: None,
        finished: Callable[[Mapping[str, Any]], object] = lambda result: None,
        failed: Callable[[str, Exception], object] | None = None,
    ) -> None:
        """Runs what is waiting, in order; after each the page is written anew. `finished` gets what a figure found.

        `failed` gets the name of a figure that raised and what it raised, and the others go on; without it, nor where
        a file cannot be written, they do not.
        """
        waiting = self.waiting()
        for n, name in enumerate(waiting):
            try:
                result = self._one(name, self._reporter(step, waiting, n))
            except Exception as problem:
                if failed is None or isinstance(problem, OSError):
                    raise
                failed(name, problem)
                continue
            self._learn(name, result)
            self.write(single=False)
            finished(result)
        self.write()

    def _reporter(self, step: Callable[[Step], object], waiting: Sequence[str], n: int) -> Report:
        """Tells `step` how far the n-th is, and how long the rest will take at the pace so far."""
        name, began = waiting[n], time.perf_counter()
        own, rest = self._stated(name), sum(map(self._stated, waiting[n + 1 :]))

        def report(share: float, doing: str) -> None:
            pace = self._pace(share * own, time.perf_counter() - began)
            step(Step(name, doing, n, len(waiting), share, pace * (rest + (1 - share) * own)))

        report(0.0, "")
        return report

    def _one(self, name: str, report: Report) -> dict[str, Any]:
        key_of_it, began = self._key(name), time.perf_counter()
        with self.folder.beside() as beside:
            run = Run(name, beside, quick=self.quick, seed=self.seed, report=report)
            if name in self.figures:
                result = examine(self.figures[name], run)
            else:
                result = open_chapter(next(c for c in CHAPTERS if _opening(c) == name), run)
            seconds = time.perf_counter() - began
            result |= {"key": key_of_it, "antumbra": __version__, "seconds": seconds}
            self.folder.finish(beside, result)
        return result

    # ---- the page ----

    def write(self, *, single: bool | None = None) -> None:
        """Writes index.html and lecture.json with everything that is finished in the folder.

        Of this lecture's size and seed where it is there, else of another; what older sources made is marked.
        """
        found = [
            {**result, "older": result["key"] != key(name, result["quick"], result["seed"])}
            for name in catalog.ordered()
            if (result := self.folder.best(name, self.edition))
        ]
        chapters = []
        for chapter in CHAPTERS:
            inside = [result for result in found if result["chapter"] == chapter.number]
            opening = self.folder.best(_opening(chapter), self.edition)
            if inside:
                pictures = opening["stage"] if opening else []
                chapters.append({**_words(chapter), "pictures": pictures, "figures": inside})
        data = {"antumbra": __version__, "figures": [_numbers(result) for result in found]}
        self.folder.write("lecture.json", _json(data))
        contents, foot = self._contents(found), _foot(found)
        text = (
            page.single(chapters, contents, data, foot, self.folder.path)
            if (self.single if single is None else single)
            else page.html(chapters, contents, data, foot)
        )
        self.folder.write("index.html", text)

    def _contents(self, found: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
        here = {result["name"] for result in found}
        return [
            {
                "number": chapter.number,
                "title": chapter.title,
                "figures": [
                    {"number": each.number, "name": name, "title": each.title, "here": name in here}
                    for name, each in catalog.ordered().items()
                    if each.chapter == chapter.number
                ],
            }
            for chapter in CHAPTERS
        ]


def examine(figure: Figure, run: Run) -> dict[str, Any]:
    """Renders and measures a figure; what it found, as plain data for `kept/` and the page."""
    begins = _MEASURES if figure.variants else 0.0
    run.phase(0.0, begins)
    run.render(list(figure.variants))
    run.phase(begins, _DRAWS, "measuring")
    measured = figure.measure(run)
    run.phase(_DRAWS, 1.0, "drawing")
    stage = plain(figure.stage(run, measured))
    for source in figure.exr or [variant.key for variant in figure.variants[:1]]:
        run.exr(source, "" if len(figure.exr) < 2 else source)
    claims = [
        {
            "text": claim.text.format(**measured),
            "verdict": verdict(claim, measured),
            "measured": (claim.measured or "measured {" + claim.of + "}").format(**measured)
            + f" ({expected(claim, measured)})",
            "of": claim.of,
            "main": claim.main,
        }
        for claim in figure.claims
    ]
    return {
        "name": run.name,
        "number": figure.number,
        "chapter": figure.chapter,
        "title": figure.title,
        "question": {**asdict(figure.question), "open": _unproved(figure, claims)},
        "stage": stage,
        "answer": _answer(figure, measured),
        "equation": asdict(figure.equation),
        "claims": claims,
        "numbers": {name: quantity.facts() for name, quantity in measured.items()},
        "command": f"antumbra lecture {run.name} -o lecture"
        + (" --quick" if run.quick else "")
        + (f" --seed {run.seed}" if run.seed else ""),
        "exr": [file for file in run.files if file.startswith("exr/")],
        "quick": run.quick,
        "seed": run.seed,
        "rays": run.rays,
        "files": run.files,
    }


def open_chapter(chapter: Chapter, run: Run) -> dict[str, Any]:
    """Renders the pictures that open a chapter, all exposed as the last one is."""
    variants = [variant for variant, _, _ in chapter.pictures]
    run.render(variants)
    white = run.white(variants[-1].key)
    stage: list[Picture] = [
        run.picture(variant.key, alt, caption, white=white) for variant, alt, caption in chapter.pictures
    ]
    return {
        "name": run.name,
        "stage": plain(stage),
        "quick": run.quick,
        "seed": run.seed,
        "rays": run.rays,
        "files": run.files,
    }


def _json(data: Any) -> str:
    return json.dumps(data, ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def _answer(figure: Figure, measured: Mapping[str, Quantity]) -> dict[str, str]:
    quantity = measured[figure.answer.of]
    value, error = quantity.number(figure.answer.digits)
    return {
        "value": f"{figure.answer.before}{value}",
        "error": error,
        "unit": quantity.sign,
        "text": figure.answer.text.format(**measured),
    }


def _unproved(figure: Figure, claims: Sequence[Mapping[str, Any]]) -> list[str]:
    """Claims that the answer of the question rests on and that this run does not support."""
    return [
        claim["text"]
        for claim in claims
        if claim["of"] in figure.question.proof and claim["verdict"] != "supported"
    ]


def _opening(chapter: Chapter) -> str:
    return f"chapter-{chapter.number}"


def _words(chapter: Chapter) -> dict[str, Any]:
    return {
        "number": chapter.number,
        "title": chapter.title,
        "short": chapter.short,
        "paragraphs": chapter.paragraphs,
        "equation": asdict(chapter.equation),
    }


def _numbers(result: Mapping[str, Any]) -> dict[str, Any]:
    """What lecture.json says of a figure."""
    kept = (
        "name",
        "number",
        "chapter",
        "title",
        "numbers",
        "claims",
        "quick",
        "seed",
        "seconds",
        "rays",
        "exr",
        "antumbra",
        "key",
        "older",
    )
    return {name: result[name] for name in kept}


def _foot(found: Sequence[Mapping[str, Any]]) -> str:
    rays = sum(result["rays"] for result in found)
    coarse = sum(result["quick"] for result in found)
    size = (
        ""
        if not coarse
        else " Coarse pictures and numbers (--quick)."
        if coarse == len(found)
        else (f" {coarse} of {len(found)} figures are coarse (--quick).")
    )
    return (
        f"antumbra {__version__}. All pictures and numbers come from {rays:,} rays of the renderer; "
        f"± is half of a 95 % interval.{size}"
    )
