"""`python -m vibroacoustics` is the command line."""

from .cli import main

main()
