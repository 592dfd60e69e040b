r"""LaTeX to MathML at build time, with the marked term `\mark{…}`, in pieces between which a line may break."""

from __future__ import annotations

import re
from functools import cache
from html import escape
from xml.etree import ElementTree

# A colour that no equation uses stands for the mark on its way through the converter.
_MARK = "magenta"
# A line may break before these signs where they stand outside of all brackets, and after a wide space, but not
# after fewer parts than this: a short left side stays with its equals sign. A part of many signs is long by itself.
_BREAKS = set("=≠≈≲⟹⇒+⋅·")
_WIDE = ("1em", "2em")
_SHORT, _LONG = 5, 12


@cache
def mathml(latex: str, spoken: str) -> str:
    r"""A displayed equation for LaTeX; `\mark{…}` becomes a row of class `hl`; `spoken` is its aria-label."""
    from latex2mathml.converter import convert

    made = convert(_marked(latex), display="block")
    inside = re.fullmatch(r"<math[^>]*>(.*)</math>", made, re.DOTALL)
    if inside is None:
        raise ValueError(f"{latex}: no MathML came of it")
    body = re.sub(
        rf'<mstyle mathcolor="{_MARK}">(.*?)</mstyle>',
        r'<mrow class="hl">\1</mrow>',
        inside[1],
        flags=re.DOTALL,
    )
    body = _primes(body)
    # A function and its argument, with the space that belongs between them.
    body = re.sub(r"<mi>(cos|sin|tan|ln|log|arccos)</mi>", r"<mi>\1</mi><mo>&#x2061;</mo>", body)
    pieces = (f'<math><mstyle displaystyle="true">{piece}</mstyle></math>' for piece in _pieces(body))
    return f'<span class="m" role="math" aria-label="{escape(spoken)}">{"<wbr>".join(pieces)}</span>'


def _primes(body: str) -> str:
    """A prime stands beside its letter: its sign is a raised one, and would be raised twice as an exponent."""
    prime = r"<mi>&#x02032;</mi>"
    letter, sub = r"(<mi>[^<]*</mi>)", r"(<m[in]>[^<]*</m[in]>)"
    beside = r'<mrow>\1<mo lspace="0" rspace="0">&#x2032;</mo></mrow>'
    body = re.sub(rf"<msup>{letter}{prime}</msup>", beside, body)
    return re.sub(rf"<msubsup>{letter}{sub}{prime}</msubsup>", rf"<msub>{beside}\2</msub>", body)


def _pieces(body: str) -> list[str]:
    """The row in parts that stay whole; one that begins with a sign keeps the space before it."""
    groups: list[list[ElementTree.Element]] = [[]]
    depth = 0
    for part in ElementTree.fromstring(body):
        sign = (part.text or " ") if part.tag == "mo" else " "
        depth += (sign in "([{") - (sign in ")]}")
        before = groups[-1]
        after_space = bool(before) and before[-1].get("width") in _WIDE and part.tag not in ("mspace", "mo")
        if depth == 0 and (sign in _BREAKS or after_space) and _is_long(before):
            if sign in _BREAKS:
                part.set("form", "infix")
            groups.append([])
        groups[-1].append(part)
    return [f"<mrow>{''.join(map(_text, group))}</mrow>" for group in groups]


def _is_long(parts: list[ElementTree.Element]) -> bool:
    signs = sum(1 for part in parts for each in part.iter() if len(each) == 0)
    return len(parts) >= _SHORT or signs >= _LONG


def _text(part: ElementTree.Element) -> str:
    return ElementTree.tostring(part, encoding="unicode")


def _marked(latex: str) -> str:
    return latex.replace(r"\mark", rf"\textcolor{{{_MARK}}}")
