"""`python -m vibroacoustics` is the command line."""

from .commands.cli import main

main()
