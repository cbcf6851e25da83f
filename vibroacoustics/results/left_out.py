"""Lines on what of plug-ins is omitted of results, as these keep them."""

from collections.abc import Iterable
from typing import Final

import xarray as xr

from ..base.plain_bytes import canonical_json
from .complete import read_attribute

ATTRIBUTE: Final = "left_out"


def lines_of(results: xr.Dataset) -> list[str]:
    """Return a line on everything that is omitted."""
    return read_attribute(results, ATTRIBUTE, list[str]) if ATTRIBUTE in results.attrs else []


def keep_lines(results: xr.Dataset, lines: Iterable[str]) -> xr.Dataset:
    """Return the results with these lines, each once."""
    unique = list(dict.fromkeys(lines))
    kept = results.copy(deep=False)
    kept.attrs.pop(ATTRIBUTE, None)
    return kept.assign_attrs({ATTRIBUTE: canonical_json(unique)}) if unique else kept
