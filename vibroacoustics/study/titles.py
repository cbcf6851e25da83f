"""Titles of machine and options: what reports and figures show in place of a name."""

from typing import Final

from pydantic import Field

from ..base.parameters import Parameters

LONGEST: Final = 60
"""Letters of a title."""


class Titles(Parameters):
    """Titles that a study gives; names stay in CSV files and results."""

    machine: str = ""
    """Title in place of the machine's name; empty for that."""
    options: dict[str, str] = Field(default={})
    """Titles by the option's name."""
