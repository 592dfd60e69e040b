"""The help: a snapshot of each verb, 80 columns, and the one table of settings behind command line and Python."""

from __future__ import annotations

import os
import re
from pathlib import Path

import numpy as np
import pytest

import antumbra as am
from antumbra import _core, settings
from antumbra.cli._run import verb, verbs

SNAPSHOTS = Path(__file__).parent / "snapshots"


@pytest.mark.parametrize("name", ["", *verbs()])
def test_help_is_as_it_was(name, antumbra, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    text = antumbra(*([name, "--help"] if name else ["--help"])).out
    file = SNAPSHOTS / f"help{'-' + name if name else ''}.txt"
    if os.environ.get("ANTUMBRA_WRITE_SNAPSHOTS") == "1":
        file.write_text(text, encoding="utf-8")
    assert text == file.read_text(encoding="utf-8"), "ANTUMBRA_WRITE_SNAPSHOTS=1 accepts the new text"
    assert text == antumbra(*([name, "-h"] if name else ["-h"])).out


@pytest.mark.parametrize("name", verbs())
def test_help_fits_80_columns_and_has_three_examples(name):
    page = verb(name).page(80)
    assert max(map(len, page.splitlines())) <= 80
    assert len(re.findall(rf"^  antumbra {name} ", page, re.MULTILINE)) == 3


@pytest.mark.parametrize("name", verbs())
def test_every_example_of_the_help_is_a_command_line_that_parses(name):
    for example, _ in verb(name).examples:
        words = example.split()
        assert words[:2] == ["antumbra", name]
        verb(name).make_context(name, words[2:])


def test_every_setting_is_an_option_of_render_and_a_word_of_python():
    page = verb("render").page(80)
    for setting in settings.table().values():
        assert f"  {setting.option}" in page
        if setting.default:
            _core.check_settings([(setting.name, setting.default)])
        for word in setting.choices:
            assert word in page
            assert settings.words({setting.name: word}) == {setting.name: word}


def test_python_values_become_the_words_that_people_type():
    words = settings.words(
        {
            "size": (640, 480),
            "eye": [1, 2.5, 0],
            "roulette": False,
            "clay": 0.5,
            "fov": 1.5707963267948966,
            "seed": 7,
        }
    )
    assert words == {
        "size": "640,480", "eye": "1,2.5,0", "roulette": "off", "clay": "0.5", "fov": "90.0", "seed": "7",
    }  # fmt: skip
    assert settings.words({"light": ["a", "b, c"]}) == {"light": "a\nb, c"}
    assert settings.words({"crop": None}) == {}
    assert settings.words({"environment": Path("sky.hdr")}) == {"environment": "sky.hdr"}
    numbers = {"shadow_rays": np.int64(9), "rotate": np.True_, "clay": np.float32(0.5)}
    assert settings.words(numbers) == {"shadow_rays": "9", "rotate": "on", "clay": "0.5"}


def test_values_that_are_no_values_are_told():
    with pytest.raises(TypeError, match="seed is of type dict"):
        settings.words({"seed": {}})
    with pytest.raises(am.OptionError, match='did you mean "shadow_rays"'):
        settings.words({"shadow_ray": 1})
    with pytest.raises(ValueError, match="at least 1"):
        settings.words({"shadow_rays": 0})
    with pytest.raises(am.OptionError, match=r"fov = 40: an angle above 0 and below π is needed, in radians"):
        settings.words({"fov": 40})
    with pytest.raises(TypeError, match="fov is of type list: an angle in radians is needed"):
        settings.words({"fov": [1]})
