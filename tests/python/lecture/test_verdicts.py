"""Numbers as the page writes them, and the three words of a claim."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from made_up import figure

from antumbra._words import written
from antumbra.lecture.figure import Claim, Figure, Question
from antumbra.lecture.measures.ratio import excess, ratio
from antumbra.lecture.measures.replicates import median_of, of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.verdict import verdict
from antumbra.study import statistics
from antumbra.study.statistics import Interval


@pytest.mark.parametrize(
    ("quantity", "spec", "text"),
    [
        (Quantity(3.999, 0.014), "", "3.999 ± 0.014"),
        (Quantity(3.999, 0.014), "1", "4.00 ± 0.01"),
        (Quantity(-0.4987, 0.0019), "", "−0.4987 ± 0.0019"),
        (Quantity(0.0353, 0.00013, "%"), "", "3.530 ± 0.013 %"),
        (Quantity(0.0353, 0.00013, "%"), "v", "3.530 %"),
        (Quantity(0.0, 0.0, "%"), "", "0 %"),
        (Quantity(1234.4, 99.6), "1", "1,200 ± 100"),
        (Quantity(-0.0001, 0.01), "1", "0.00 ± 0.01"),
        (Quantity(4.0), "", "4"),
        (Quantity(0.5, unit="%", low=0.41, high=0.7), "r", "50 (41 … 70) %"),
    ],
)
def test_a_quantity_is_written_as_far_as_its_error(quantity, spec, text):
    assert format(quantity, spec) == text


def test_numbers_without_error_have_three_digits():
    assert [written(x) for x in (0.04123, 12.5, 1234.0, 0.0, -3.2e-6, 2.5e7)] == [
        "0.0412", "12.5", "1,234", "0", "−3.20 × 10⁻⁶", "2.50 × 10⁷",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("claim", "value", "error", "word"),
    [
        ({"near": 4.0, "within": 0.05}, 3.999, 0.014, "supported"),
        ({"near": 4.0, "within": 0.05}, 3.96, 0.014, "undecided"),
        ({"near": 4.0, "within": 0.05}, 3.9, 0.014, "not supported"),
        ({"below": 1.0}, 0.9, 0.05, "supported"),
        ({"below": 1.0}, 0.9, 0.2, "undecided"),
        ({"above": 1.0}, 0.9, 0.05, "not supported"),
        ({"above": "other"}, 2.5, 0.3, "supported"),
        ({"above": "other"}, 2.3, 0.3, "undecided"),
        ({"below": 1.0}, float("nan"), 0.1, "undecided"),
    ],
)
def test_a_claim_is_undecided_where_its_interval_holds_both_answers(claim, value, error, word):
    measured = {"x": Quantity(value, error), "other": Quantity(2.0, 0.3)}
    assert verdict(Claim("It is so.", "x", **claim), measured) == word


def test_the_ends_of_a_root_or_ratio_decide_each_for_itself():
    # Of the root of 1 (0.19 … 1.21) the lower end is further away than the upper one.
    of = of_interval(statistics.root(Interval(1.0, 0.19, 1.21)))
    assert of.interval == pytest.approx((0.19**0.5, 1.1)) and of.error == pytest.approx(1 - 0.19**0.5)
    assert verdict(Claim("It is so.", "x", below=1.15), {"x": of}) == "supported"
    assert verdict(Claim("It is so.", "x", above=0.5), {"x": of}) == "undecided"
    # The difference of two: 1 less 0.8 (0.7 … 1.0) reaches down to 0.2 − √(0.56² + 0.2²), up to 0.2 + √(0.1² + 0.1²).
    both = {"x": of, "y": Quantity(0.8, 0.2, low=0.7, high=1.0)}
    assert verdict(Claim("It is so.", "x", below="y"), both) == "undecided"
    assert excess(of).interval == pytest.approx((0.19**0.5 - 1, 0.1))
    twice = ratio(Quantity(2.0, 0.1), Quantity(1.0, 0.5))
    assert twice.interval[1] - 2 > 2 - twice.interval[0] and twice.error == twice.interval[1] - 2


def test_a_rate_that_something_disturbs_lies_between_two_of_its_ordered_calls():
    # One call of nine met something else: between the second and the second last the median is in 96 % of cases.
    calls = [1.21, 1.19, 1.2, 1.22, 0.6, 1.18, 1.2, 1.23, 1.2]
    found = median_of(calls)
    assert (found.value, *found.interval) == pytest.approx((1.2, 1.18, 1.22))
    assert format(found, "r") == "1.2 (1.18 … 1.22)"
    assert verdict(Claim("It is faster.", "x", above=1.0), {"x": found}) == "supported"
    # Of eight it is the range: the same without the first.
    assert median_of(calls[1:]).interval == pytest.approx((0.6, 1.23))
    assert verdict(Claim("It is faster.", "x", above=1.0), {"x": median_of(calls[1:])}) == "undecided"


def test_the_interval_of_a_median_holds_it():
    # 95 % or more of 2,000 medians of 21 from a lopsided law whose median is ln 2; 4 standard errors below are 93 %.
    draws = np.random.default_rng(5).exponential(size=(2000, 21))
    held = [low <= np.log(2) <= high for low, high in (median_of(each).interval for each in draws)]
    assert np.mean(held) > 0.95 - 4 * (0.05 * 0.95 / 2000) ** 0.5


def test_the_answer_of_a_question_rests_on_claims_of_its_figure():
    right = figure(1)
    with pytest.raises(ValueError, match="needs claims that prove it"):
        replace(right, question=replace(right.question, proof=("other",)))
    with pytest.raises(ValueError, match="needs claims that prove it"):
        replace(right, question=replace(right.question, proof=()))


def test_declarations_that_ask_nothing_are_refused():
    with pytest.raises(ValueError, match="exactly one"):
        Claim("It is so.", "x", below=1.0, above=0.0)
    with pytest.raises(ValueError, match="within"):
        Claim("It is so.", "x", near=1.0)
    with pytest.raises(ValueError, match="choices"):
        Question("Which?", ["one"], 0, ["x"])
    with pytest.raises(TypeError):
        Figure(1, 1, "A figure without a question")  # type: ignore[call-arg]
