"""Every figure runs coarsely with seed 0 and its main claim holds; then the real page in a browser."""

from __future__ import annotations

import json

import pytest

from antumbra.lecture import catalog
from antumbra.lecture.chapters import CHAPTERS
from antumbra.lecture.make import Lecture


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where all figures of this file are kept."""
    return tmp_path_factory.mktemp("lecture")


@pytest.mark.parametrize("name", catalog.names())
def test_a_figure_runs_and_its_main_claim_holds(name, folder, monkeypatch):
    # The page is written once there are all.
    monkeypatch.setattr(Lecture, "write", lambda self, **how: None)
    lecture = Lecture(folder, {name: catalog.figure(name)}, quick=True)
    lecture.run()
    result = lecture.kept(name)
    assert result and result["exr"], "full numbers are kept"
    main = next(claim for claim in result["claims"] if claim["main"])
    assert main["verdict"] == "supported", main
    refuted = [claim for claim in result["claims"] if claim["verdict"] == "not supported"]
    assert not refuted, refuted


def test_numbers_and_chapters_are_in_order():
    figures = catalog.ordered()
    numbers = [figure.number for figure in figures.values()]
    assert numbers == sorted(set(numbers))
    chapters = [figure.chapter for figure in figures.values()]
    assert chapters == sorted(chapters)
    assert set(chapters) <= {chapter.number for chapter in CHAPTERS}


@pytest.mark.parametrize("name", catalog.names())
def test_a_figure_is_a_declaration(name):
    file = catalog.sources(name)[-1]
    assert file.stem == name.replace("-", "_")
    lines = file.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 90
    # The declaration ends the file (decision 8).
    assert len(lines) - lines.index("FIGURE = Figure(") <= 40


def test_questions_ask_and_answers_are_short():
    for name, figure in catalog.ordered().items():
        assert figure.question.text.rstrip().endswith("?"), name
        assert len(figure.answer.text.split(". ")) <= 3, name


def strips(parts):
    """All sliders of a stage, however deep."""
    for part in parts if isinstance(parts, list) else []:
        if part["kind"] == "strip":
            yield part
        yield from strips(part.get("panels") or part.get("parts"))


# Where its slider begins, or its sliders begin, at their left end: in the undisturbed state, or where nothing of the
# answer is seen.
NEUTRAL = {
    "shadows": "1.0", "regions": "0.5", "eclipse": "356500", "product": "0.1", "between": "0.5",
    "self-intersection": "safe", "solid-angle": "-3", "formulations": "0.1", "area-light": "0", "light-size": "1",
    "direct-indirect": {"12", "10"}, "occlusion": {"10", "20"}, "environment": "0", "budget": "100x1",
    "occlusion-vertices": "1", "many-lights": "10", "summary": "even", "fast-occlusion": "0",
}  # fmt: skip


@pytest.mark.parametrize("name", catalog.names())
def test_sliders_have_a_dozen_frames_and_begin_before_the_answer(name, folder):
    found = json.loads((folder / "kept" / f"{name}.quick.json").read_text(encoding="utf-8"))
    sliders = list(strips(found["stage"]))
    for strip in sliders:
        assert 12 <= len(strip["frames"]) <= 16
    begins = {strip["frames"][strip["begins"]]["value"] for strip in sliders}
    neutral = NEUTRAL.get(name, set())
    assert begins == ({neutral} if isinstance(neutral, str) else neutral)


# What of a slide is seen and lies outside of the screen, as text for the message.
OUTSIDE = """() => [...document.querySelectorAll('.fig.cur *')].filter(e => {
  const looked = 'p, b, span, img, button, td, th, output, input, small, figcaption, var, svg, text';
  if (!e.checkVisibility() || e.closest('.sr') || !e.matches(looked)) return false;
  const b = e.getBoundingClientRect();
  return b.width && (b.right > innerWidth + 1 || b.left < -1 || b.bottom > innerHeight + 1 || b.top < -1);
}).map(e => `${e.tagName} ${e.className} ${e.innerText || e.alt || ''}`)"""


# Text of a slide that is seen smaller than 28 px: of drawings, their size times their scale; not what is raised.
SMALL = """() => [...document.querySelectorAll('.fig.cur *')].filter(e => {
  const own = [...e.childNodes].some(n => n.nodeType == 3 && n.textContent.trim());
  if (!own || e.closest('.sr, datalist, math') || !e.checkVisibility({visibilityProperty: true})) return false;
  const box = e.ownerSVGElement, scale = box ? box.getBoundingClientRect().width / box.viewBox.baseVal.width : 1;
  return parseFloat(getComputedStyle(e).fontSize) * scale < 27.9;
}).map(e => `${e.tagName} ${e.textContent}`)"""
# Labels of one drawing that lie on each other on a slide, by more than the air over and under a line of text (0.3).
ON_EACH_OTHER = """() => [...document.querySelectorAll('.fig.cur svg')].filter(s => s.checkVisibility()).flatMap(s => {
  const seen = [...s.querySelectorAll('text')].filter(e => e.checkVisibility({visibilityProperty: true}));
  const all = seen.map(e => [e.textContent, e.getBoundingClientRect()]);
  const wide = (p, q) => Math.min(p.right, q.right) - Math.max(p.left, q.left);
  const high = (p, q) => Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
  const on = (p, q) => wide(p, q) > 0 && high(p, q) > 0.3 * Math.min(p.height, q.height);
  return all.flatMap(([a, p], i) => all.slice(i + 1).filter(([, q]) => on(p, q)).map(([b]) => `${a} / ${b}`));
})"""
# Least size of the text of a figure's plots on paper [pt].
PLOTTED = """name => {
  const seen = [...document.querySelectorAll(`#${name} .plot`)].filter(p => p.checkVisibility());
  return Math.min(...seen.map(p => parseFloat(getComputedStyle(p.querySelector('text')).fontSize) * 0.75
    * p.getBoundingClientRect().width / p.viewBox.baseVal.width));
}"""
# Goes to another place of the page as an address does, and waits for the page to have read it.
GO = """to => new Promise((done, failed) => {
  if (location.hash == to) return done();
  addEventListener('hashchange', () => done(), {once: true});
  setTimeout(failed, 30000, `${location.hash} does not become ${to}`);
  location.hash = to;
})"""


@pytest.fixture(scope="module")
def opened(folder, browser):
    """Opens the page of all figures once at each size: loading it is what takes long, not looking at a figure."""
    tabs = {}
    Lecture(folder, {}, quick=True).write()

    def tab(width, height, address):
        if (width, height, address) not in tabs:
            tabs[width, height, address] = made = browser.new_page(
                viewport={"width": width, "height": height}
            )
            made.goto(f"{(folder / 'index.html').as_uri()}#{address}")
        return tabs[width, height, address]

    yield tab
    for made in tabs.values():
        made.close()


@pytest.mark.parametrize("name", catalog.names())
def test_a_figure_fits_its_page(name, folder, opened):
    found = json.loads((folder / "kept" / f"{name}.quick.json").read_text(encoding="utf-8"))
    for width, height in ((390, 844), (820, 1100), (1280, 720)):
        tab = opened(width, height, "/answers")
        assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth"), width
        assert tab.locator(f"#{name} .num1").inner_text().startswith(found["answer"]["value"])
    # A4 less its margins; two of 138 mm and what is between them fill it.
    tab = opened(round(182 * 96 / 25.4), 1000, "")
    tab.emulate_media(media="print")
    height = tab.locator(f"#{name}").bounding_box()["height"] * 25.4 / 96
    assert height <= 138, f"{height:.0f} mm on paper"
    assert tab.evaluate(PLOTTED, name) >= 7.5


@pytest.mark.parametrize("name", catalog.names())
def test_a_figure_fits_its_slides(name, opened):
    tab = opened(1280, 720, "slides")
    for step in range(5):
        tab.evaluate(GO, f"#slides/{name}/step={step}")
        assert tab.locator(".fig.cur").get_attribute("id") == name
        assert tab.evaluate(OUTSIDE) == [], f"step {step} of the slide"
        assert tab.evaluate(SMALL) == [], f"step {step} of the slide"
        assert tab.evaluate(ON_EACH_OTHER) == [], f"step {step} of the slide"
