"""The page in a real browser: every kind of stage, three modes, three widths, keyboard, address."""

from __future__ import annotations

import re

import pytest
from reading import address, sign

import antumbra.lecture.page as page_module
from antumbra.lecture.keep import Folder
from antumbra.lecture.make import Lecture

WIDTHS = [(390, 844), (820, 1100), (1280, 720)]


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
    assert slider.get_attribute("aria-valuetext") == "i = 2: <half>, and more"
    lit = tab.locator("#one .hl:not(.off)")
    assert lit.all_text_contents() == ["xi"]
    tab.keyboard.press("ArrowLeft")
    tab.keyboard.press("ArrowLeft")
    assert slider.get_attribute("aria-valuetext").startswith("i = 0")
    assert tab.locator("#one output").inner_text() == "i = 0: <half>"
    assert tab.locator("#one .frames > li.on").get_attribute("data-v") == "0"
    assert tab.locator("#one .key span").first.inner_text() == "fact 0" and lit.all_text_contents() == ["1N"]
    assert tab.locator("#one .draws svg:visible").count() == 1
    assert address(tab) == "#one/answers/i=0"


def test_tabs_are_one_stop_and_answer_to_arrows(open_page):
    tab = open_page("#one")
    first = tab.locator("#one [role=tab]").first
    first.focus()
    tab.keyboard.press("ArrowRight")
    chosen = tab.locator("#one [role=tab][aria-selected=true]")
    assert chosen.inner_text() == "owen" and address(tab) == "#one/sampler=owen"
    assert tab.evaluate("document.activeElement.innerText") == "owen"
    assert tab.locator("#one [role=tab][tabindex='-1']").count() == 2
    assert tab.locator("#one .pan:visible").count() == 1


def test_a_tab_that_says_the_answer_comes_with_it(open_page):
    tab = open_page("#one")
    late = tab.locator("#one [role=tab]", has_text="told")
    assert not late.is_visible() and tab.locator("#one [role=tab]:visible").count() == 2
    tab.locator("#one .q button").first.click()
    assert late.is_visible()
    # On slides the lecturer decides.
    assert open_page("#slides/one/step=1").locator("#one [role=tab]:visible").count() == 3


def test_a_row_and_its_ray_are_one_thing(open_page):
    tab = open_page("#two/ray=1/answers")
    assert tab.locator("#two .hot").count() == 2
    tab.locator("#two tbody button").first.press("Enter")
    assert tab.locator("#two .rg1.hot").get_attribute("data-j") == "0"
    assert address(tab) == "#two/ray=0/answers"


def test_the_address_restores_what_was_seen(open_page):
    tab = open_page("#one/i=0/sampler=owen/answers")
    assert tab.locator("#one .frames > li.on").get_attribute("data-v") == "0"
    assert tab.locator("#one [role=tab][aria-selected=true]").inner_text() == "owen"
    assert tab.locator("#one .claims").is_visible() and tab.locator("#two .claims").is_visible()
    tab.evaluate("location.hash = '#two'")
    tab.wait_for_function("document.querySelector('#one .frames > li.on').dataset.v == '2'")
    tab.evaluate("location.hash = '#nothing/i=%E0%A4%A'")
    assert tab.locator("#one").is_visible()


@pytest.mark.parametrize("start", ["#nosuch", "#slides/nosuch"])
def test_a_figure_that_is_not_there_is_said(open_page, start):
    tab = open_page(start)
    said = tab.locator("[role=status].say")
    assert said.inner_text() == "There is no figure “nosuch”."
    assert said.bounding_box()["height"] > 20 and tab.locator("h1").is_visible()
    tab.evaluate("location.hash = '#one'")
    tab.wait_for_function("!document.querySelector('#live').textContent")
    assert said.bounding_box()["height"] <= 1


def test_predict_first_then_the_number(open_page):
    tab = open_page()
    # Neither equation, plots and tables nor readouts say it before.
    assert tab.locator("#one :is(.ans, .eqc, .claims, .data, .key span):visible").count() == 0
    assert tab.locator("#one output").inner_text() == "i = 0"
    slider = tab.locator("#one input[type=range]")
    assert slider.get_attribute("aria-valuetext") == "i = 0"
    tab.locator("#one .q button").nth(1).click()
    assert slider.get_attribute("aria-valuetext") == "i = 2: <half>, and more"
    assert tab.locator("#one .ans").is_visible() and tab.locator("#one .eqc").is_visible()
    assert tab.locator("#one .verdict").inner_text() == "Not so. Right: small. The number is below."
    assert not tab.locator("#two .ans").is_visible()
    tab.locator("#b-answers").click()
    assert tab.locator("#two .claims").is_visible() and address(tab).endswith("answers")


def test_the_address_keeps_all_answers_while_the_button_is_pressed(open_page):
    tab = open_page("#/answers")
    tab.evaluate("location.hash = '#two'")
    tab.wait_for_function("location.hash == '#two/answers'")
    tab.locator("#one [role=tab]").nth(1).click()
    assert address(tab) == "#one/answers/sampler=owen"
    tab.locator("#b-answers").click()
    assert address(tab) == "#one/sampler=owen" and not tab.locator("#two .claims").is_visible()


def test_all_answers_open_with_one_layout(open_page):
    tab = open_page()
    # Each equation and each table is measured, and none twice.
    asked = """() => {
      const own = Object.getOwnPropertyDescriptor(Element.prototype, 'scrollWidth').get, seen = [];
      Object.defineProperty(Element.prototype, 'scrollWidth', {get() { seen.push(this); return own.call(this) }});
      document.querySelector('#b-answers').click();
      return [seen.length, new Set(seen).size];
    }"""
    measured, different = tab.evaluate(asked)
    assert measured == different > 0


def test_the_right_choice_is_marked_once_there_is_an_answer(open_page):
    tab = open_page()
    assert sign(tab, "small") == sign(tab, "large") == ""
    tab.locator("#one .q button", has_text="large").click()
    assert (sign(tab, "small"), sign(tab, "large")) == (" ✓ right", " ✗ your choice")
    tab.locator("#one .q button", has_text="small").click()
    assert (sign(tab, "small"), sign(tab, "large")) == (" ✓ right", "")
    tab = open_page()
    tab.locator("#one .ask button").click()
    assert sign(tab, "small") == " ✓ right" and tab.locator("#one [aria-pressed=true]").count() == 0
    assert tab.locator("#one .verdict[role=status]").inner_text() == "Right: small. The number is below."


def test_the_slider_goes_to_what_the_number_is_of_unless_it_was_moved(open_page):
    tab = open_page()
    frame = tab.locator("#one .frames > li.on")
    tab.locator("#one .ask button").click()
    assert frame.get_attribute("data-v") == "2"
    tab = open_page()
    slider = tab.locator("#one input[type=range]")
    slider.press("ArrowRight")
    tab.locator("#one .ask button").click()
    assert tab.locator("#one .frames > li.on").get_attribute("data-v") == "1"
    assert slider.get_attribute("aria-valuetext") == "i = 1: <half>, and more"


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


def test_a_table_is_sorted_by_the_head_that_is_pressed(open_page):
    page = open_page("#/answers")
    table = page.locator("#one table:has(thead button)")
    heads, names = table.locator("thead th"), table.locator("tbody th")
    assert table.locator("thead button").all_inner_texts() == ["rays", "worth"]
    sorts = [head.get_attribute("aria-sort") for head in heads.all()]
    assert sorts == [None, "descending", None]
    assert names.all_inner_texts() == ["one", "two", "three"]
    worth = table.get_by_role("button", name="worth")
    worth.click()
    assert names.all_inner_texts() == ["three", "one", "two"]
    assert [head.get_attribute("aria-sort") for head in heads.all()] == [None, None, "descending"]
    worth.press("Enter")
    assert names.all_inner_texts() == ["two", "one", "three"]
    assert heads.last.get_attribute("aria-sort") == "ascending"
    table.get_by_role("button", name="rays").click()
    assert names.all_inner_texts() == ["one", "two", "three"]


def luminance(rgb) -> float:
    """Relative luminance of sRGB 0 to 1 (WCAG 2.2)."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in rgb]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize(("scheme", "brightest"), [("light", 1.0), ("dark", 0.5)])
def test_drawings_are_quieter_in_the_dark_and_still_read(open_page, scheme, brightest):
    tab = open_page("#one/i=0", color_scheme=scheme)
    fills = "['rect', 'text'].map(s => getComputedStyle(e.querySelector(s)).fill)"
    seen = f"e => [getComputedStyle(e).filter, ...{fills}]"
    dim, *colours = tab.locator("#one .draws svg.on").evaluate(seen)
    factor = float(dim[len("brightness(") : -1]) if dim != "none" else 1.0
    ground, text = (
        luminance([factor * int(c) / 255 for c in re.findall(r"\d+", colour)]) for colour in colours
    )
    assert ground < brightest and (ground + 0.05) / (text + 0.05) >= 4.5


def test_without_script_everything_is_there(open_page):
    tab = open_page(java_script_enabled=False)
    assert tab.locator("#one .frames > li:visible").count() == 3
    assert tab.locator("#one .pan:visible").count() == 3
    assert tab.locator("#one .pn").all_inner_texts() == ["random", "owen", "told"]
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
    # Drawing and key are of what the number is of; on the screen they give nothing away again.
    assert tab.locator("#one .key span").first.inner_text() == "fact 2"
    tab.emulate_media(media="screen")
    tab.wait_for_function("document.querySelector('#one .frames > li.on').dataset.v == '0'")


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


def test_style_and_script_are_small(made):
    # What a reader loads: the files themselves have comments and spaces for people.
    page = (made / "index.html").read_text()
    css, js = page_module.css(), page_module.js()
    assert css in page and js in page
    assert len(css.encode()) + len(js.encode()) <= 25_000
    assert not re.search(r"fetch\(|canvas|XMLHttpRequest", js)


def test_kept_results_make_the_same_page(made):
    before = (made / "index.html").read_text()
    assert Folder(made).kept("one", of=".quick")
    Lecture(made, {}, quick=True).write()
    assert (made / "index.html").read_text() == before
