"""The page of a study in a real browser: nothing is loaded, nothing is wrong, nothing scrolls sideways."""

from __future__ import annotations

import pytest

import antumbra as am


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("study")
    am.study.run(
        "pillars", vary={"mistake": ["none", "no-cos-light"], "shadow_rays": [1, 4]}, estimator="area",
        viewing_rays=4, size=(24, 18), seeds=4, folder=made, command="antumbra study pillars " + "--vary x=1 " * 20,
    )  # fmt: skip
    return made


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 820, 1280])
def test_the_page_is_whole_at_every_width(browser, folder, width, scheme):
    context = browser.new_context(viewport={"width": width, "height": 800}, color_scheme=scheme)
    tab = context.new_page()
    wrong, asked = [], []
    tab.on("console", lambda said: wrong.append(said.text))
    tab.on("pageerror", lambda problem: wrong.append(str(problem)))
    tab.on("request", lambda request: asked.append(request.url))
    tab.goto((folder / "index.html").as_uri())
    assert wrong == [] and [url for url in asked if not url.startswith(("file:", "data:"))] == []
    assert len([url for url in asked if url.startswith("file:")]) == 1
    assert tab.evaluate("document.documentElement.scrollWidth") <= width
    assert tab.locator("svg[role=img]").count() == 2 and tab.locator("h1").count() == 1
    ends = tab.evaluate(
        "[...document.querySelectorAll('svg text')].map(t => t.getBoundingClientRect().right)"
    )
    assert max(ends) <= width
    assert "✗ biased" in tab.inner_text("main")
    context.close()


def test_wide_numbers_do_not_cut_the_last_column(browser, folder):
    tab = browser.new_page(viewport={"width": 1400, "height": 800})
    tab.goto((folder / "index.html").as_uri())
    # The widest that are written.
    tab.evaluate(
        "[...document.querySelectorAll('tbody td')].forEach(t => t.textContent = '× 0.00123 (0.00045 … 0.00345)')"
    )
    assert tab.evaluate(
        "[...document.querySelectorAll('.scroll')].every(s => s.scrollWidth <= s.clientWidth)"
    )
    head = tab.locator(".words thead th").all_inner_texts()
    assert head == ["variant", "slope of the variance", "slope of the noise (in the plot)", "it falls"]
    tab.close()


def test_no_number_has_a_programmer_s_exponent(folder):
    import re

    text = re.sub(
        r"<style>.*?</style>|<svg.*?</svg>", "", (folder / "index.html").read_text("utf-8"), flags=re.DOTALL
    )
    assert not re.search(r"\d(e[+-]?\d)", re.sub(r"<[^>]*>", " ", text))
