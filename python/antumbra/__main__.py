"""`python -m antumbra`: the command, where its script is not on the path."""

from antumbra.cli import main

main()
