"""One study while it runs: reference, then row after row, each of K renders with different seeds."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from antumbra import settings
from antumbra._made_by import ROOT, made_by
from antumbra.errors import OptionError
from antumbra.study import kinds, renders
from antumbra.study.content import content
from antumbra.study.files import check_folder, finished_rows, keep, kept_pilots, key_of, set_aside, write
from antumbra.study.plan import Plan, Variant
from antumbra.study.precise import rays_needed
from antumbra.study.renders import Step, Work
from antumbra.study.result import Study
from antumbra.study.rows import Pictures, Reference, Row, blunt, measured, untested
from antumbra.study.sources import Source

# The reference's own error, as a part of the least noise, from which on it is told: it is taken off, but not small.
_LARGE = 0.5


class StudyStopped(KeyboardInterrupt):
    """Ctrl-C during a study; `study` holds the rows that were done."""

    def __init__(self, study: Study) -> None:
        """Keeps the work so far."""
        super().__init__("stopped")
        self.study = study


class Job:
    """Made of a checked plan; `settle_reference`, then `run`."""

    def __init__(self, made: Plan, source: Source, watch: Callable[[Step], object] | None) -> None:
        """Opens the first scene: what is wrong with it is told before anything is rendered."""
        source.check(v.parameters for v in made.variants)
        self.source, self.work = source, Work(source.open, watch)
        self.given: Reference | None = None
        self.command, self.made = "", _made(made)
        self.by, self.rays, self.chooses = "", 0, False
        self.warnings: list[tuple[str, str, str]] = []
        self.pilots: dict[str, Any] = {}
        first = made.variants[0]
        opened = self.work.scene(first.parameters)._core
        # What the scene's file asks for holds, as it does for `render`, where nothing else is said.
        self.plan = made.suggested(opened.suggested())
        width, height = opened.picture_size(list(self.plan.variants[0].words.items()))
        self.size = (width, height)
        self.truths = list(dict.fromkeys(v.truth() for v in self.plan.variants))

    def settle_reference(self, given: Any, error: Any, rays: int | None) -> None:
        """Finds out what the reference is to be, and whether it fits."""
        by = given if isinstance(given, str) and not is_file(given) else ""
        if given is None:
            by = kinds.any_other(self.plan)
        if error is not None and (given is None or by):
            raise OptionError("standard errors of a reference belong to one that is a file")
        if by:
            settings.words({"estimator": by})
        renders.check_shows(self.plan, by)
        if by:
            self.by, self.rays, self.chooses = by, rays or 0, given is None
            if self.chooses:
                return
            if by in renders.estimators(self.plan):
                self._warn(
                    f"the reference is {by}, and so is a variant: a mistake that {by} makes would not show;"
                    " name another kind with --reference, or a file"
                )
            else:
                self._warn_of_parts({})
        elif given is not None:
            self.given = self._picture(given, error)
        else:
            self._warn(
                "no reference: there is no other kind of estimator to compare with, so noise is measured, and no bias"
            )

    def _choose_reference(self) -> None:
        """Of the estimators that share no part with the variants, if pilots find none wrong with one."""
        if "reference" not in self.pilots:
            self.pilots["reference"] = kinds.chosen(self.plan, self.work, self.rays)
        self.by, refused = self.pilots["reference"]
        self._warn_of_parts(refused)

    def _rays_of_reference(self) -> int:
        """As many as make its own error small, as pilots find."""
        if "rays" not in self.pilots:
            self.pilots["rays"] = rays_needed(self.plan, self.work, self.by)
        return int(self.pilots["rays"])

    def _warn_of_parts(self, refused: Mapping[str, str]) -> None:
        common = kinds.shared(self.by, self.plan)
        if not common:
            return
        why = "; ".join(f"{kind} {reason}" for kind, reason in refused.items())
        if self.by in common:
            self._warn(
                f"the reference is {self.by}, and so is a variant: a mistake that {self.by} makes would not show."
                f" No other kind could be used: {why}"
            )
            return
        what = (
            f"the reference, {self.by}, finds light partly in the way of {' and '.join(common)}: a mistake in"
            f" that part would not show{f'. Others could not be used: {why}' if why else ''}"
        )
        # Of all light there is no estimator that shares nothing.
        self.warnings.append(("warning" if kinds.apart(self.plan) else "note", "", what))

    def _warn(self, what: str) -> None:
        self.warnings.append(("warning", "", what))

    def _picture(self, given: Any, error: Any) -> Reference:
        if len(self.truths) > 1:
            raise OptionError(
                "one picture cannot be the reference of variants that show different things: name an estimator"
            )
        if isinstance(given, (str, PathLike)):
            return renders.reference_of(given, error, self.size)
        array = np.asarray(given, np.float64)
        if array.shape != (self.size[1], self.size[0], 3):
            raise OptionError(
                f"reference has shape {array.shape}: {(self.size[1], self.size[0], 3)} is needed"
            )
        return Reference("a given picture, taken as exact", array[None])

    def run(self, folder: Path | None) -> Study:
        """Renders everything that the folder does not hold already. Raises StudyStopped with what is finished."""
        new = folder is not None and not folder.exists()
        if folder is not None:
            check_folder(folder)
        asked = self._asked()
        self.pilots = {} if folder is None else kept_pilots(folder, asked)
        self.pilots = self.pilots or {"asked": asked, "costs": {}}
        done: dict[str, Row] = {}
        try:
            self.plan = renders.within_budget(self.plan, self.work, self.pilots["costs"])
            if self.chooses:
                self._choose_reference()
            if self.by and not self.rays:
                self.rays = self._rays_of_reference()
            done = self._finished(folder)
            for row in self._rows(set(done)):
                done[key_of(row)] = row
                if folder is not None:
                    self._set_aside(folder)
                    keep(self._study(done, False), folder)
        except KeyboardInterrupt:
            study = self._study(done, False)
            if folder is not None and done:
                self._set_aside(folder)
                write(study, folder)
            elif folder is not None and new:
                folder.rmdir()
            raise StudyStopped(study) from None
        if folder is not None:
            self._set_aside(folder)
        study = self._study(done, True)
        if folder is not None:
            write(study, folder)
        return study

    def _finished(self, folder: Path | None) -> dict[str, Row]:
        """Rows that need not be rendered again, by their keys; their places are those of this plan."""
        rows = [] if folder is None else finished_rows(folder, self.fingerprint())
        there = {key_of(row): row for row in reversed(rows)}
        found = {}
        for variant in self.plan.variants:
            row = there.get(key := key_of(variant))
            if row is not None:
                n = self._n(variant, row.rays, row.seconds.value)
                found[key] = replace(row, truth=self.truths.index(variant.truth()), n=n)
        return found

    def _set_aside(self, folder: Path) -> None:
        keys = {key_of(v) for v in self.plan.variants}
        if (aside := set_aside(folder, self._study({}, False), keys)) is not None:
            self.warnings.append(("note", "", f"{folder} held another study: it lies in {aside} now"))

    def _rows(self, finished: set[str]) -> Iterator[Row]:
        words = renders.reference_words(self.plan, self.by, self.rays) if self.by else None
        ahead = [v for v in self.plan.variants if key_of(v) not in finished]
        self.work.plan(renders.cost(ahead, self.plan.seeds, words))
        for number, truth in enumerate(self.truths):
            reference = self.given
            for variant in (v for v in ahead if v.truth() == truth):
                if words is not None and reference is None:
                    reference = renders.reference_by(self.plan, variant, words, self.work)
                yield self._row(variant, reference, number)

    def _row(self, variant: Variant, reference: Reference | None, truth: int) -> Row:
        said = " ".join(variant.values.values())
        pictures, seconds, rays = [], [], 0.0
        for k in range(self.plan.seeds):
            what = f"{said}, seed {k + 1} of {self.plan.seeds}"
            image = self.work.render(variant.parameters, variant.words, self.plan.seed(k), what)
            pictures.append(image.pixels)
            seconds.append(image.seconds)
            rays += renders.rays_per_pixel(image) / self.plan.seeds
        viewing, shadow = renders.numbers_of_rays(variant.words)
        n = self._n(variant, rays, sum(seconds) / len(seconds))
        return measured(
            renders.stacked(pictures), seconds, reference,
            values=variant.values, n=n, budget=variant.budget, truth=truth,
            viewing_rays=viewing, shadow_rays=shadow, rays=rays,
        )  # fmt: skip

    def _n(self, variant: Variant, rays: float, seconds: float) -> float | None:
        """Its place on the axis: of a budget, what was spent, because rounding misses what was asked for."""
        if self.plan.axis == "budget":
            return rays if self.plan.budget == "rays" else seconds
        return float(variant.values[self.plan.axis]) if self.plan.axis else None

    def fingerprint(self) -> str:
        """Equal for two studies whose rows may be mixed: the same scene, settings, seeds and reference."""
        if not self.source.identity:
            return ""
        given = [None if a is None else hashlib.sha256(a.tobytes()).hexdigest() for a in self._given_arrays()]
        whole = [
            self.made, self.source.identity, self.plan.fixed, self.plan.seeds, self.plan.first_seed, self.by,
            self._reference_rays(), sorted(self.plan.variants[0].parameters.items() - _varied(self.plan)),
            given, self.plan.budget,
        ]  # fmt: skip
        return hashlib.sha256(json.dumps(whole).encode()).hexdigest()[:16]

    def _asked(self) -> str:
        """Equal for two studies whose pilots are the same: before they are rendered, all that decides them."""
        if not self.source.identity:
            return ""
        plan = self.plan
        what = [
            self.made, self.source.identity, plan.fixed, plan.varied, plan.seeds, plan.first_seed, plan.budget,
            [v.budget for v in plan.variants], [v.parameters for v in plan.variants], self.by, self.rays,
        ]  # fmt: skip
        return hashlib.sha256(json.dumps(what).encode()).hexdigest()[:16]

    def _given_arrays(self) -> list[Pictures | None]:
        return [self.given.pictures, self.given.error] if self.given else []

    def _reference_rays(self) -> str:
        """Viewing rays of each seed of a rendered reference."""
        return renders.reference_words(self.plan, self.by, self.rays)["viewing_rays"] if self.by else ""

    def _study(self, done: Mapping[str, Row], complete: bool) -> Study:
        plan = self.plan
        rows = [done[key] for key in map(key_of, plan.variants) if key in done]
        name = renders.reference_name(self.by, self._reference_rays()) if self.by else ""
        return Study(
            scene=self.source.name,
            size=self.size,
            seeds=plan.seeds,
            axis=plan.axis,
            varied=plan.varied,
            fixed=plan.fixed,
            reference=self.given.name if self.given else name,
            rows=rows,
            messages=[*self.warnings, *self.work.messages, *_about_reference(rows)],
            complete=complete,
            budget=plan.budget,
            fingerprint=self.fingerprint(),
            command=self.command,
            pilots=self.pilots,
        )


def _made(plan: Plan) -> list[str]:
    """What decides the numbers beside scene and settings: the program itself, and the pictures that light the scene."""
    around = sorted({v.words["environment"] for v in plan.variants if "environment" in v.words})
    sources = sorted([*ROOT.glob("*.py"), *(ROOT / "study").rglob("*.py")])
    return [made_by(sources), *(content(Path(name)) for name in around if Path(name).is_file())]


def is_file(given: str) -> bool:
    """Whether a reference is meant as a file: it exists, or its name has a dot or a slash."""
    return Path(given).exists() or "." in given or "/" in given


def _varied(plan: Plan) -> set[tuple[str, float]]:
    return {(n[2:], float(v)) for n, values in plan.varied.items() if n.startswith("D.") for v in values}


def _about_reference(rows: list[Row]) -> list[tuple[str, str, str]]:
    """A warning where the test of bias is blunt, or impossible."""
    tested = [r for r in rows if r.bias is not None]
    if any(r.mean and not r.true_mean for r in tested):
        what = "the reference found no light: bias was not tested (--reference names another estimator or picture)"
        return [("warning", "", what)]
    found: list[tuple[str, str, str]] = []
    for row in (r for r in tested if r.black and r.true_mean):
        name = " ".join(row.values.values())
        what = f"{name} found no light, its reference did: more rays or seeds tell whether that is bad luck"
        found.append(("warning", "", what))
    least = min((r.variance.value for r in rows if r.noisy), default=0.0)
    own = max((r.reference_variance for r in rows), default=0.0)
    if least and own > _LARGE**2 * least:
        part = f"{100 * math.sqrt(own / least):.0f} % of the least noise"
        what = f"the reference's own error is {part}: more rays (--reference-rays) or another reference help"
        found.append(("note", "", what))
    if (share := 100 * untested(rows)) >= 0.5:
        what = f"bias was not tested in {share:.0f} % of the tiles: too few samples found light there"
        found += [("note" if all(r.tested for r in tested) else "warning", "", what)]
    if not (hidden := blunt(rows)):
        return found
    size = f"below {100 * hidden:.0f} % of the mean" if hidden < 1 else "even as large as the mean"
    what = f"a bias {size} was not testable: noise hides it; more seeds or reference rays, or another reference, help"
    return [*found, ("note", "", what)]
