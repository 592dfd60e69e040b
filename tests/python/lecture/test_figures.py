"""Every figure runs coarsely with a fixed seed, and its main claim holds."""

from __future__ import annotations

import pytest

from antumbra.lecture import catalog
from antumbra.lecture.chapters import CHAPTERS
from antumbra.lecture.make import examine
from antumbra.lecture.run import Run


@pytest.mark.parametrize("name", catalog.names())
def test_a_figure_runs_and_its_main_claim_holds(name, tmp_path):
    result = examine(catalog.figure(name), Run(name, tmp_path, quick=True, seed=0))
    main = next(claim for claim in result["claims"] if claim["main"])
    assert main["verdict"] == "supported", main
    for file in result["files"]:
        assert (tmp_path / file).stat().st_size > 0
    assert result["exr"], "full numbers are kept"


def test_numbers_and_chapters_are_in_order():
    figures = catalog.ordered()
    numbers = [figure.number for figure in figures.values()]
    assert numbers == sorted(set(numbers))
    chapters = [figure.chapter for figure in figures.values()]
    assert chapters == sorted(chapters)
    assert set(chapters) <= {chapter.number for chapter in CHAPTERS}


def test_a_title_does_not_give_the_answer_away_and_a_question_asks():
    for figure in catalog.ordered().values():
        assert figure.question.text.rstrip().endswith("?")
        assert len(figure.answer.text.split(". ")) <= 4
        assert 2 <= len(figure.question.choices) <= 4
