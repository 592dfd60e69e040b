"""What a browser shows of the page of two made-up figures."""

from __future__ import annotations


def address(tab) -> str:
    return tab.evaluate("location.hash")


def sign(tab, choice: str) -> str:
    """What the page adds to a choice of figure `one`."""
    after = "e => getComputedStyle(e, '::after').content.replaceAll('\"', '')"
    return tab.locator("#one .q button", has_text=choice).evaluate(after).replace("none", "")
