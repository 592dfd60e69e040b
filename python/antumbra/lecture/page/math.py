r"""LaTeX to MathML at build time, with the marked term `\mark{…}`."""

from __future__ import annotations

import re
from functools import cache
from html import escape

# A colour that no equation uses stands for the mark on its way through the converter.
_MARK = "magenta"


@cache
def mathml(latex: str, spoken: str) -> str:
    r"""A displayed `<math>` for LaTeX; `\mark{…}` becomes a row of class `hl`; `spoken` is its aria-label."""
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
    # A function and its argument, with the space that belongs between them.
    body = re.sub(r"<mi>(cos|sin|tan|ln|log|arccos)</mi>", r"<mi>\1</mi><mo>&#x2061;</mo>", body)
    return f'<math aria-label="{escape(spoken)}"><mstyle displaystyle="true">{body}</mstyle></math>'


def _marked(latex: str) -> str:
    return latex.replace(r"\mark", rf"\textcolor{{{_MARK}}}")
