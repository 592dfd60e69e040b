"""What the page carries of its style and script: the same without comments and the spaces that only people need."""

from __future__ import annotations

import re
from collections.abc import Callable

# Text in quotes stays as it is.
_QUOTED = re.compile(r"""("[^"\n]*"|'[^'\n]*'|`[^`\n]*`)""")


def style(css: str) -> str:
    """CSS in one line. A colon with a space after it stands in a declaration, never in a selector.

    >>> style("/* dim */ .a, .b > i { color: red; margin: 0 1px; }")
    '.a,.b>i{color:red;margin:0 1px}'
    """

    def shorter(text: str) -> str:
        text = re.sub(r" ?([{};,>!]) ?", r"\1", re.sub(r"\s+", " ", text))
        # Before and after stand with one colon too (CSS 2).
        text = re.sub(r"::(before|after)", r":\1", text)
        return text.replace(": ", ":").replace(";}", "}")

    return _but_quoted(re.sub(r"/\*.*?\*/", "", css, flags=re.DOTALL), shorter).strip()


def script(js: str) -> str:
    """JavaScript without lines of comment and spaces beside signs; what a `const` guards was seen by people.

    A regular expression in it has neither quotes nor spaces.

    >>> script("// twice\\nconst twice = x => {\\n  return 2 * x;\\n};")
    'let twice=x=>{return 2*x};'
    """
    lines = (line.strip() for line in js.splitlines())
    kept = "\n".join(line for line in lines if line and not line.startswith("//"))
    kept = _but_quoted(kept, lambda text: re.sub(r"\bconst ", "let ", text))
    kept = _but_quoted(kept, lambda text: re.sub(r" ?([=<>&|?:,;{}()\[\]]) ?", r"\1", text))
    kept = _but_quoted(kept, lambda text: re.sub(r"(?<![+-]) ([-+*/]|!=) (?![+-])", r"\1", text))
    return re.sub(r"(?<=[{,;(])\n|\n(?=[})])", "", kept).replace(";}", "}")


def _but_quoted(text: str, change: Callable[[str], str]) -> str:
    """Changes what stands outside of quotes."""
    parts = _QUOTED.split(text)
    return "".join(part if n % 2 else change(part) for n, part in enumerate(parts))
