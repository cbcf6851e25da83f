"""Names of files from names of channels, microphones and curves."""

import re

import xarray as xr


def file_name(name: str) -> str:
    """Return a name that is safe in a path."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", name)


def numbered(results: xr.Dataset, dimension: str) -> list[tuple[str, str]]:
    """Return labels of a dimension, each with the name of its file without ending.

    The number makes the name of a file unique; it has at most about 60 letters.
    """
    names = map(str, results[dimension].values)
    return [(name, f"{number}_{file_name(name)[:60]}") for number, name in enumerate(names, 1)]
