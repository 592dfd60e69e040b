"""The page as slides, in a real browser: steps, keys, equal pictures."""

from __future__ import annotations

import pytest
from reading import address, sign

from antumbra.lecture.page import slide


def test_slides_step_by_keyboard(open_page):
    tab = open_page("#slides/one")
    seen = {"question": "#one .q > p", "picture": "#one .strip", "number": "#one .num1"}
    frame = tab.locator("#one .frames > li.on")
    assert tab.locator(seen["question"]).is_visible() and not tab.locator(seen["picture"]).is_visible()
    tab.locator("#one .q button", has_text="large").click()
    assert sign(tab, "small") == sign(tab, "large") == ""
    tab.keyboard.press(" ")
    assert tab.locator(seen["picture"]).is_visible() and not tab.locator(seen["number"]).is_visible()
    # The readout says the value, not what it means.
    assert tab.locator("#one output").inner_text() == "i = 0" and frame.get_attribute("data-v") == "0"
    assert tab.locator("#one input[type=range]").get_attribute("aria-valuetext") == "i = 0"
    tab.keyboard.press("ArrowRight")
    assert tab.locator(seen["number"]).is_visible() and address(tab) == "#slides/one/step=2"
    assert frame.get_attribute("data-v") == "2"
    assert (sign(tab, "small"), sign(tab, "large")) == (" ✓ right", " ✗ your choice")
    tab.keyboard.press("PageDown")
    assert tab.locator("#one .eqc").is_visible() and not tab.locator("#one .claims").is_visible()
    tab.keyboard.press(" ")
    assert tab.locator("#one .claims var").first.is_visible() and address(tab) == "#slides/one/step=4"
    for back in ("PageUp", "ArrowLeft", "Shift+ "):
        tab.keyboard.press(back)
    assert address(tab) == "#slides/one/step=1" and frame.get_attribute("data-v") == "0"
    tab.keyboard.press("ArrowDown")
    assert address(tab) == "#slides/two"
    tab.keyboard.press("ArrowLeft")
    assert address(tab) == "#slides/one/step=4"
    shown = "[...e.querySelectorAll('p, button, h3, b')].filter(x => x.offsetParent)"
    sizes = f"e => {shown}.map(x => parseFloat(getComputedStyle(x).fontSize))"
    assert min(tab.locator("#one").evaluate(sizes)) >= 28
    tab.keyboard.press("Escape")
    assert address(tab) == "#one" and tab.locator(".bar").is_visible()


def test_slides_begin_with_the_title_and_each_chapter(open_page):
    tab = open_page("#slides")
    assert tab.locator("h1").is_visible() and not tab.locator(".toc").is_visible()
    tab.keyboard.press("ArrowRight")
    assert address(tab) == "#slides/ch1" and tab.locator("#ch1 h2").is_visible()
    assert tab.locator("#ch1 .num").is_visible() and tab.locator("#ch1 math").is_visible()
    tab.keyboard.press("ArrowRight")
    assert address(tab) == "#slides/one"
    tab.keyboard.press("End")
    assert address(tab) == "#slides/two"
    tab.keyboard.press("Home")
    assert address(tab) == "#slides/top" and tab.locator("#live").inner_text() == "Direct illumination"


def test_a_slider_and_a_tab_keep_their_arrows_on_a_slide(open_page):
    tab = open_page("#slides/one/step=1")
    tab.locator("#one input[type=range]").focus()
    tab.keyboard.press("ArrowRight")
    assert tab.locator("#one .frames > li.on").get_attribute("data-v") == "1"
    tab.locator("#one [role=tab]").first.focus()
    tab.keyboard.press("ArrowRight")
    assert tab.locator("#one [role=tab][aria-selected=true]").inner_text() == "owen"
    assert "step=1" in address(tab)
    # A moved slider stays where it is when the number comes.
    tab.keyboard.press(" ")
    assert "step=2" in address(tab) and "i=1" in address(tab)
    assert tab.locator("#one .frames > li.on").get_attribute("data-v") == "1"


@pytest.mark.parametrize(
    ("key", "to"), [("ArrowDown", "two"), ("ArrowUp", "ch1"), ("Home", "top"), ("End", "two")]
)
def test_other_keys_go_on_from_a_tab_on_a_slide(open_page, key, to):
    tab = open_page("#slides/one/step=1")
    tab.locator("#one [role=tab]").first.focus()
    tab.keyboard.press(key)
    assert address(tab) == f"#slides/{to}"


def test_a_tab_that_the_mouse_pressed_gives_the_keys_back(open_page):
    tab = open_page("#slides/one/step=1")
    tab.locator("#one [role=tab]").nth(1).click()
    assert tab.locator("#one [role=tab][aria-selected=true]").inner_text() == "owen"
    tab.keyboard.press("ArrowRight")
    assert "step=2" in address(tab)


@pytest.mark.parametrize("size", [(1280, 720), (1920, 1080)])
def test_pictures_of_a_long_row_are_equal_on_a_slide(open_page, size):
    tab = open_page("#slides/one/step=1", size)
    widths = "e => [...e.querySelectorAll('img')].map(i => i.getBoundingClientRect().width)"
    found = tab.locator("#one .row.many").evaluate(widths)
    assert len(found) == 4 and max(found) - min(found) < 0.5


def test_a_long_row_has_as_many_columns_as_make_its_pictures_largest():
    def best(count: int, width: int, height: int) -> int:
        return slide.columns([{"width": width, "height": height, "caption": "16 rays"}] * count)

    assert [best(n, 196, 196) for n in (4, 5, 6)] == [4, 5, 3]
    assert [best(n, 280, 196) for n in (4, 5, 6)] == [4, 3, 3]
    assert best(4, 300, 100) == 2
