"""Titles in place of the names of machine and options, for what people read."""

import json
from typing import Any

import xarray as xr

from ..base.errors import ParameterError
from ..base.plain_bytes import canonical_json
from ..base.remembered import remembered


def option_titles(results: xr.Dataset) -> dict[str, str]:
    """Titles of options by their names; none of results without."""
    return dict(_titles(results).get("options", {}))


@remembered
def option_names(results: xr.Dataset) -> dict[str, str]:
    """Names of options by their titles; none of results without."""
    return {title: name for name, title in option_titles(results).items()}


def titled(results: xr.Dataset) -> xr.Dataset:
    """The results with titles for names; themselves where there are none, or where they are in.

    CSV files are made of results without.
    """
    titles, options = _titles(results), option_titles(results)
    named = {
        dimension: [options.get(str(name), str(name)) for name in results[dimension].values]
        for dimension in ("option", "shown_option")
        if dimension in results.coords
    }
    if not titles.get("machine") and all(results[d].values.tolist() == n for d, n in named.items()):
        return results
    parameters = json.loads(results.attrs["parameters"])
    parameters["machine"]["name"] = titles.get("machine") or parameters["machine"]["name"]
    parameters["options"] = _by_title(parameters["options"], options)
    attrs = {"parameters": canonical_json(parameters)}
    if "words" in results.attrs:
        words = json.loads(results.attrs["words"])
        words["sentences"] = _by_title(words["sentences"], options)
        attrs["words"] = canonical_json(words)
    return results.assign_coords(named).assign_attrs(attrs)


def chosen(results: xr.Dataset, dimension: str, value: Any) -> Any:
    """A label of a dimension; where none is given, the first; an option by name or title.

    Raises
    ------
    ParameterError
        The results have no such label.
    """
    labels = results[dimension].values.tolist()
    if dimension == "option" and value not in labels:
        value = {**option_titles(results), **option_names(results)}.get(value, value)
    if value is None:
        return labels[0]
    if value not in labels:
        raise ParameterError(
            f"{dimension} = {value}: not in these results; there are {', '.join(map(str, labels))}"
        )
    return value


def _by_title(table: dict[str, Any], options: dict[str, str]) -> dict[str, Any]:
    return {options.get(name, name): value for name, value in table.items()}


def _titles(results: xr.Dataset) -> dict[str, Any]:
    """Return the titles of the study; results of recordings have none."""
    parameters = json.loads(results.attrs.get("parameters", "{}"))
    return dict(parameters.get("titles", {})) if isinstance(parameters, dict) else {}
