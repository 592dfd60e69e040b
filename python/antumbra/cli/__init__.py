"""The command `antumbra`: one verb per file of this folder, each imported when it is called."""

from __future__ import annotations

import sys
from collections.abc import Sequence


def main(arguments: Sequence[str] | None = None) -> None:
    """Runs the command and ends the process: 0 done, 1 a failure of ours, 2 bad input, 130 stopped by Ctrl-C."""
    from antumbra.cli._run import run

    sys.exit(run(list(sys.argv[1:] if arguments is None else arguments)))
