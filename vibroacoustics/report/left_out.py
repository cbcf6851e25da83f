"""What a report says of a stranger's section or column that it cannot show."""

import json

import xarray as xr

_LONGEST = 200


def failure(what: str, error: Exception) -> str:
    """One line: it failed, and how."""
    reason = " ".join(f"{type(error).__name__}: {error}".split())
    return f"{what} is left out: {reason[:_LONGEST]}"


def missing(results: xr.Dataset, noun: str, attribute: str) -> dict[str, str]:
    """Lines on things that were registered when the results were made and were not kept, by name.

    Parameters
    ----------
    results : of a run
    noun : what such a thing is called, `section` or `column`
    attribute : of the results that holds the kept ones
    """
    if attribute in results.attrs:
        return {}
    plugins = json.loads(results.attrs.get("plugins") or "{}")
    return {
        name: f"{noun} {name} is left out: {origin['file']} is not loaded, and the results do "
        "not hold it"
        for key, origin in plugins.items()
        for kind, _, name in [key.partition(" ")]
        if kind == noun
    }
