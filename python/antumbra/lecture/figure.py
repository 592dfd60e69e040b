"""What a figure of the lecture says: `Figure` and its parts. Declarations only; `make.py` runs them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from antumbra.lecture.variant import Pick as Pick
from antumbra.lecture.variant import Variant as Variant

if TYPE_CHECKING:
    from antumbra.lecture.quantity import Quantity
    from antumbra.lecture.run import Run
    from antumbra.lecture.stages import Part

    Measured = Mapping[str, Quantity]


@dataclass(frozen=True)
class Question:
    """What to predict first: one or two sentences, two to four `choices`, and the number of the right one.

    `proof`: the claims, by the quantity that each is `of`, that say so: where a run does not support all of them, the
    page calls no choice right. `looks`: it asks about the pictures, which stand on its slide then.
    """

    text: str
    choices: Sequence[str]
    right: int
    proof: Sequence[str]
    looks: bool = False

    def __post_init__(self) -> None:
        """Looks at the choices."""
        if not (2 <= len(self.choices) <= 4 and 0 <= self.right < len(self.choices)):
            raise ValueError(f"{self.text!r} has {len(self.choices)} choices, the right one is {self.right}")


@dataclass(frozen=True)
class Equation:
    r"""The lecture's own equation in LaTeX, the term that the figure changes inside `\mark{…}`.

    `lines`: pairs of LaTeX and the same in words and signs, for the ear and for browsers without MathML.
    `why`: one sentence on the mark.
    """

    lines: Sequence[tuple[str, str]]
    why: str


@dataclass(frozen=True)
class Number:
    """The one big number: the quantity `of`, at most three sentences with `{quantity}` in them, a sign `before` it.

    `digits` of its error, 1 on the page.
    """

    of: str
    text: str
    before: str = ""
    digits: int = 1


@dataclass(frozen=True)
class Claim:
    """A sentence that the quantity `of` supports or does not: it is `near` ± `within`, `below` or `above` a bound.

    A bound is a number or the name of another quantity. Supported where the whole 95 % interval agrees, undecided
    where the interval holds both answers. `measured`: what stands under it, with `{quantity}`. The `main` claim of a
    figure is its test and holds at the coarse size.
    """

    text: str
    of: str
    near: float | str | None = None
    within: float = 0.0
    below: float | str | None = None
    above: float | str | None = None
    measured: str = ""
    main: bool = False

    def __post_init__(self) -> None:
        """One question, and a tolerance where it needs one."""
        asked = [bound for bound in (self.near, self.below, self.above) if bound is not None]
        if len(asked) != 1:
            raise ValueError(f"{self.text!r}: exactly one of near, below and above is needed")
        if (self.within > 0) != (self.near is not None):
            raise ValueError(f"{self.text!r}: near needs within > 0, below and above take none")


@dataclass(frozen=True)
class Figure:
    """One experiment of the lecture.

    `number`-th on the page, in `chapter`. `measure` turns the rendered pictures (and array queries) into named
    quantities; `stage` shows them. `seconds`: what it takes on two cores. `exr`: the variants whose full numbers are
    kept (default the first).
    """

    number: int
    chapter: int
    title: str
    question: Question
    variants: Sequence[Variant]
    measure: Callable[[Run], Measured]
    stage: Callable[[Run, Measured], Sequence[Part]]
    answer: Number
    equation: Equation
    claims: Sequence[Claim]
    seconds: Pick
    exr: Sequence[str] = ()

    def __post_init__(self) -> None:
        """A figure has one main claim, and its variants have names of their own."""
        if sum(claim.main for claim in self.claims) != 1:
            raise ValueError(f"{self.title!r}: exactly one claim is the main one")
        claimed = {claim.of for claim in self.claims}
        if not self.question.proof or not claimed.issuperset(self.question.proof):
            raise ValueError(f"{self.title!r}: the answer of its question needs claims that prove it")
        keys = [variant.key for variant in self.variants]
        if len(set(keys)) != len(keys):
            raise ValueError(f"{self.title!r}: two variants have the same key")


@dataclass(frozen=True)
class Chapter:
    """What opens a chapter: its title (and a `short` one for the bar), two paragraphs, an equation, two pictures.

    `pictures`: (variant, alt text, caption).
    """

    number: int
    title: str
    short: str
    paragraphs: Sequence[str]
    equation: Equation
    pictures: Sequence[tuple[Variant, str, str]]
