"""Words about samples: the priors of unmodelled noise, and why nothing was sampled."""

import xarray as xr

from .stored_study import has_sources, parameters, words


def prior_words(results: xr.Dataset) -> list[str]:
    """Return words for the priors of unmodelled noise, after this noun; else their names."""
    words_of = words(results).get("priors", {})
    return [words_of.get(str(name), str(name)) for name in results["prior"].values]


def not_sampled_sentence(results: xr.Dataset) -> str:
    """Say that ranges are not sampled without sources; empty without ranges or with sources."""
    count = sum(record["lowest"] is not None for record in parameters(results)["records"])
    if not count or has_sources(results):
        return ""
    values = (
        "1 value has a range; it is" if count == 1 else f"{count} values have a range; they are"
    )
    return (
        f"{values} not sampled, so that no result has an interval. Values are sampled only where a "
        "study has sources of sound, tables [sources.NAME]."
    )
