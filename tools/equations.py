"""Renews the line numbers of docs/equations.md: each link's title names the lines where it begins.

`[`Film::mean`](../crates/antumbra/src/film/mod.rs#L1-L9 "impl Film > pub fn mean")`: the first line that begins with
`impl Film`, behind it the first that begins with `pub fn mean`, to the end of that block; `+4`: just four more lines.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "equations.md"
MOST = 20
LINK = re.compile(r'\[`([^`]+)`\]\(\.\./([^#) ]+)#L(\d+)-L(\d+) "([^"]+)"\)')


def lines_of(path: str, title: str) -> tuple[int, int]:
    """First and last line, from 1; LookupError where the title is not found."""
    text = (ROOT / path).read_text(encoding="utf-8").splitlines()
    title, _, more = title.partition(" +")
    at = -1
    for anchor in title.split(" > "):
        found = (i for i in range(at + 1, len(text)) if text[i].strip().startswith(anchor))
        at = next(found, -1)
        if at < 0:
            raise LookupError(f'{path}: no line begins with "{anchor}"')
    return at + 1, at + 1 + (int(more) if more else _block(text, at))


def _block(text: list[str], at: int) -> int:
    """Lines behind `at` that are indented more, and the bracket that closes them; no more than the most."""
    indent = len(text[at]) - len(text[at].lstrip())
    end = at + 1
    while end < len(text) and (
        not text[end].strip() or _indent(text[end]) > indent or _closes(text[end], indent)
    ):
        if text[end].strip() == "}" and _indent(text[end]) == indent:
            return end - at
        end += 1
    while not text[end - 1].strip():
        end -= 1
    return end - 1 - at


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())


def _closes(line: str, indent: int) -> bool:
    return _indent(line) == indent and line.strip()[0] in ")]}"


def renewed(page: str) -> str:
    """The page with the numbers of today."""

    def link(found: re.Match[str]) -> str:
        name, path, _, _, title = found.groups()
        first, last = lines_of(path, title)
        return f'[`{name}`](../{path}#L{first}-L{last} "{title}")'

    return LINK.sub(link, page)


def main() -> int:
    """Writes the page; with `--check` only says whether it is as it would be written."""
    page = PAGE.read_text(encoding="utf-8")
    new = renewed(page)
    if "--check" in sys.argv[1:]:
        return int(new != page)
    PAGE.write_text(new, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
