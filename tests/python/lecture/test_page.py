"""The page in a real browser: every kind of stage, three modes, three widths, keyboard, address."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from made_up import figure

import antumbra.lecture.page as page_module
from antumbra.lecture import catalog
from antumbra.lecture.keep import Folder
from antumbra.lecture.make import Lecture

WIDTHS = [(390, 844), (820, 1100), (1280, 720)]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The page of two figures, made once."""
    patch = pytest.MonkeyPatch()
    figures = {"one": figure(1), "two": figure(2)}
    patch.setattr(catalog, "names", lambda: list(figures))
    patch.setattr(catalog, "ordered", lambda: figures)
    folder = tmp_path_factory.mktemp("lecture")
    Lecture(folder, figures, quick=True).run()
    yield folder
    patch.undo()


@pytest.fixture
def open_page(browser, made):
    """Opens the page at an address and width; every console error and every failed request ends the test."""
    wrong = []
    contexts = []

    def opened(address="", size=(1280, 720), **context):
        contexts.append(browser.new_context(viewport={"width": size[0], "height": size[1]}, **context))
        tab = contexts[-1].new_page()
        tab.on("console", lambda said: wrong.append(said.text) if said.type in ("error", "warning") else None)
        tab.on("pageerror", lambda problem: wrong.append(str(problem)))
        tab.on("requestfailed", lambda request: wrong.append(request.url))
        tab.goto(f"{(made / 'index.html').as_uri()}{address}")
        return tab

    yield opened
    for context in contexts:
        context.close()
    assert wrong == []


def address(tab) -> str:
    return tab.evaluate("location.hash")


@pytest.mark.parametrize("size", WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_all_pictures_load_and_nothing_scrolls_sideways(open_page, size, scheme):
    tab = open_page("#/answers", size, color_scheme=scheme)
    tab.evaluate("document.querySelectorAll('img').forEach(i => i.loading = 'eager')")
    tab.wait_for_function("[...document.images].every(i => i.complete)")
    assert (
        tab.evaluate(
            "[...document.images].filter(i => !i.naturalWidth || (!i.alt && !i.closest('[aria-hidden]'))).length"
        )
        == 0
    )
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")
    paper = tab.evaluate("getComputedStyle(document.documentElement).backgroundColor")
    assert paper == ("rgb(251, 250, 246)" if scheme == "light" else "rgb(17, 19, 25)")


def test_a_slider_moves_by_keyboard_and_says_its_value(open_page):
    tab = open_page("#one/answers")
    slider = tab.locator("#one input[type=range]")
    slider.focus()
    assert slider.get_attribute("aria-valuetext") == "i = 1: <half>, and more"
    tab.keyboard.press("ArrowRight")
    assert slider.get_attribute("aria-valuetext").startswith("i = 2")
    assert tab.locator("#one output").inner_text() == "i = 2: <half>"
    assert tab.locator("#one .frames > li.on").get_attribute("data-v") == "2"
    assert tab.locator("#one .key span").first.inner_text() == "fact 2"
    assert tab.locator("#one .draws svg:visible").count() == 1
    assert address(tab) == "#one/answers/i=2"


def test_tabs_are_one_stop_and_answer_to_arrows(open_page):
    tab = open_page("#one")
    first = tab.locator("#one [role=tab]").first
    first.focus()
    tab.keyboard.press("ArrowRight")
    chosen = tab.locator("#one [role=tab][aria-selected=true]")
    assert chosen.inner_text() == "owen" and address(tab) == "#one/sampler=owen"
    assert tab.evaluate("document.activeElement.innerText") == "owen"
    assert tab.locator("#one [role=tab][tabindex='-1']").count() == 1
    assert tab.locator("#one .pan:visible").count() == 1


def test_a_row_and_its_ray_are_one_thing(open_page):
    tab = open_page("#two/ray=1/answers")
    assert tab.locator("#two .hot").count() == 2
    tab.locator("#two tbody button").first.press("Enter")
    assert tab.locator("#two .rg1.hot").get_attribute("data-j") == "0"
    assert address(tab) == "#two/ray=0/answers"


def test_the_address_restores_what_was_seen(open_page):
    tab = open_page("#one/i=2/sampler=owen/answers")
    assert tab.locator("#one .frames > li.on").get_attribute("data-v") == "2"
    assert tab.locator("#one [role=tab][aria-selected=true]").inner_text() == "owen"
    assert tab.locator("#one .claims").is_visible() and tab.locator("#two .claims").is_visible()
    tab.evaluate("location.hash = '#two'")
    tab.wait_for_function("document.querySelector('#one .frames > li.on').dataset.v == '1'")
    tab.evaluate("location.hash = '#nothing/i=%E0%A4%A'")
    assert tab.locator("#one").is_visible()


def test_predict_first_then_the_number(open_page):
    tab = open_page()
    assert not tab.locator("#one .ans").is_visible()
    # Neither plots and tables nor readouts say it before.
    assert tab.locator("#one :is(.data, .key span):visible").count() == 0
    assert tab.locator("#one output").inner_text() == "i = 1"
    slider = tab.locator("#one input[type=range]")
    assert slider.get_attribute("aria-valuetext") == "i = 1"
    tab.locator("#one .q button").nth(1).click()
    assert slider.get_attribute("aria-valuetext") == "i = 1: <half>, and more"
    assert tab.locator("#one .ans").is_visible()
    assert tab.locator("#one .verdict").inner_text().startswith("Not so")
    assert not tab.locator("#two .ans").is_visible()
    tab.locator("#b-answers").click()
    assert tab.locator("#two .claims").is_visible() and address(tab).endswith("answers")


def test_an_answer_that_the_run_does_not_support_is_not_asserted(open_page):
    tab = open_page()
    tab.locator("#one .q button").first.click()
    assert tab.locator("#one .verdict").inner_text() == "Yes. The number is below."
    for choice in tab.locator("#two .q button").all():
        choice.click()
        assert tab.locator("#two .verdict").inner_text() == "This run leaves it open. The number is below."
    said = tab.locator("#two .ans p").first.inner_text()
    assert said == "This run leaves the question open. It does not support: It is <large>."
    assert tab.locator("#two .num1").is_visible() and tab.locator("#one .ans p").first.inner_text() != said


def test_a_table_that_goes_on_says_so(open_page):
    wide = "#one .scroll:has(th:nth-child(6))"
    hint = f"getComputedStyle(document.querySelector('{wide}'), '::before').content"
    assert "slide the table" in open_page("#/answers", (390, 844)).evaluate(hint)
    assert open_page("#/answers").evaluate(hint) == "none"
    phone = open_page("", (390, 844))
    bar = "[...document.querySelectorAll('.bar nav a')].every(a => a.getBoundingClientRect().right <= innerWidth)"
    assert phone.evaluate(bar)


def test_slides_step_by_keyboard_and_nothing_leaves_the_screen(open_page):
    tab = open_page("#slides/one")
    seen = {"question": "#one .q > p", "picture": "#one .strip", "number": "#one .num1"}
    assert tab.locator(seen["question"]).is_visible() and not tab.locator(seen["picture"]).is_visible()
    tab.keyboard.press(" ")
    assert tab.locator(seen["picture"]).is_visible() and not tab.locator(seen["number"]).is_visible()
    # The readout says the value, not what it means.
    assert tab.locator("#one output").inner_text() == "i = 1"
    assert tab.locator("#one input[type=range]").get_attribute("aria-valuetext") == "i = 1"
    tab.keyboard.press(" ")
    assert tab.locator(seen["number"]).is_visible() and address(tab) == "#slides/one/step=2"
    tab.keyboard.press(" ")
    assert tab.locator("#one .eqc").is_visible() and tab.locator("#one .claims var").first.is_visible()
    tab.keyboard.press("PageUp")
    tab.keyboard.press("PageUp")
    assert address(tab) == "#slides/one/step=1"
    tab.keyboard.press("ArrowRight")
    assert address(tab) == "#slides/two"
    shown = "[...e.querySelectorAll('p, button, h3, b')].filter(x => x.offsetParent)"
    sizes = f"e => {shown}.map(x => parseFloat(getComputedStyle(x).fontSize))"
    assert min(tab.locator("#two").evaluate(sizes)) >= 28
    tab.keyboard.press("Escape")
    assert address(tab) == "#two" and tab.locator(".bar").is_visible()


def test_without_script_everything_is_there(open_page):
    tab = open_page(java_script_enabled=False)
    assert tab.locator("#one .frames > li:visible").count() == 3
    assert tab.locator("#one .pan:visible").count() == 2
    assert tab.locator("#one .pn").all_inner_texts() == ["random", "owen"]
    for slot in (".ans", ".claims", ".draws svg.on"):
        assert tab.locator(f"#one {slot}").is_visible()
    assert not tab.locator("#one .slide").is_visible()


def test_print_shows_strips_and_answers(open_page):
    tab = open_page("#one")
    tab.emulate_media(media="print")
    assert tab.locator("#one .claims").is_visible() and tab.locator("#one .num1").is_visible()
    assert tab.locator("#one .frames > li:visible").count() == 3
    assert not tab.locator(".bar").is_visible() and not tab.locator("#one .slide").is_visible()
    assert tab.locator("#one .pan:visible").count() == 1
    assert tab.locator("#one .pn:visible").all_inner_texts() == ["random"]


def test_a_map_says_what_its_colours_mean(open_page):
    tab = open_page()
    bar = tab.locator("#one .row .cb").last
    assert bar.get_attribute("aria-label") == "Colours from 0 to ≥ 1: free, blocked, boxes"
    assert bar.locator("i").count() == 2 and bar.locator("span").all_inner_texts() == ["free", "blocked"]
    frame = tab.locator("#one .frames > li.on .cb")
    assert frame.locator("b").all_inner_texts() == ["0", "50", "100\u202f%"] and frame.is_visible()
    tab.emulate_media(media="print")
    assert not frame.is_visible() and tab.locator("#one .bars .cb").is_visible()


def test_everything_has_a_name_for_the_ear(open_page):
    tab = open_page()
    named = "[...document.querySelectorAll('svg[role=img], [role=math], .cb')].map(e => e.getAttribute('aria-label'))"
    assert all(tab.evaluate(named))
    assert tab.locator("h1").count() == 1
    assert tab.evaluate(
        "[...document.querySelectorAll('table')].every(t => t.caption && t.querySelector('th[scope=col]'))"
    )
    assert tab.evaluate(
        "(all => new Set(all.map(e => e.id)).size == all.length)([...document.querySelectorAll('[id]')])"
    )


def test_style_and_script_are_small():
    here = Path(page_module.__file__).parent
    assert sum((here / name).stat().st_size for name in ("page.css", "page.js")) <= 25_000
    assert not re.search(r"fetch\(|canvas|XMLHttpRequest", (here / "page.js").read_text())


def test_kept_results_make_the_same_page(made):
    before = (made / "index.html").read_text()
    assert Folder(made).kept("one", of=".quick")
    Lecture(made, {}, quick=True).write()
    assert (made / "index.html").read_text() == before
