"""Lines of a report on things of plug-ins that it cannot show."""

import json
from collections.abc import Sequence
from typing import Any

import xarray as xr

from ..base.registry import Registry
from ..results.left_out import keep_lines, lines_of


def with_lines(
    results: xr.Dataset, lines: Sequence[str], registries: Sequence[Registry[Any]]
) -> xr.Dataset:
    """Return the results with these lines on things that are loaded, in place of older ones."""
    loaded = [f"{each.noun} {name} is omitted:" for each in registries for name in each.origins()]
    older = [line for line in lines_of(results) if not line.startswith(tuple(loaded))]
    return keep_lines(results, [*older, *lines])


def missing(results: xr.Dataset, noun: str, attribute: str) -> dict[str, str]:
    """Lines on things that were registered when the results were made and were not kept, by name.

    The noun is `section` or `column`; the attribute of the results holds the kept ones.
    """
    if attribute in results.attrs:
        return {}
    plugins = json.loads(results.attrs.get("plugins") or "{}")
    return {
        name: f"{noun} {name} is missing: {origin['file']} is not loaded, and the results do "
        "not hold it"
        for key, origin in plugins.items()
        if (name := key.removeprefix(f"{noun} ")) != key
    }
