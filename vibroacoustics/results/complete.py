"""Whether a dataset is a run of which a report and a score can be made, by what it must hold."""

import json
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.errors import SchemaError, StorageError
from ..base.hashing import sha256
from ..base.vocabulary import COORDINATES, REFERENCE_OPTION, VARIABLES, check

VARIABLES_OF_A_RUN: Final = (
    "natural_frequency", "mode_shape", "mount_transmissibility", "force_amplitude",
    "moment_amplitude", "foot_force_amplitude", "reported_figure",
    "transfer_vector", "order_level", "level_modelled", "level_total", "level_remainder",
    "source_level", "change_1x", "change_modelled", "change_total", "criterion_value",
    "criterion_best", "criterion_worst", "weight", "score", "rank", "first_place_share",
)  # fmt: skip
OF_FEW_SPEEDS: Final = ("force",)
"""Left out of the results of many speeds."""
EMPTY_WHERE_NONE: Final = ("reported_figure",)
"""May be NaN: an option without such a figure."""
ATTRIBUTES_OF_A_RUN: Final = ("created_utc", "parameters", "words")
OBJECTS: Final = ("package_versions", "plugins", "radiation")
"""Further attributes, JSON objects where they are there."""
WORDS_OF_A_RUN: Final = {
    "axes": str, "orders": str, "leaves_out": list, "labels": dict, "shell_bends": bool,
    "source_figures": list, "sources": dict, "sentences": dict,
}  # fmt: skip
"""Attribute `words`: its keys and their JSON types."""


def check_run(results: xr.Dataset, name: str) -> None:
    """Refuse what is no complete run.

    Parameters
    ----------
    results : from a file that fits its hash
    name : of the file, for the message

    Raises
    ------
    StorageError
        A variable, coordinate or attribute is missing, empty or cannot be right.
    """
    try:
        _check_variables(results)
        _check_attributes(results)
    except SchemaError as error:
        raise StorageError(f"{name}: holds no complete run: {error}; make it again") from None


def _check_variables(results: xr.Dataset) -> None:
    strangers = [name for name in results.data_vars if name not in VARIABLES]
    strangers += [name for name in results.coords if name not in COORDINATES]
    check(results.drop_vars(strangers), VARIABLES_OF_A_RUN)
    for name in (*VARIABLES_OF_A_RUN, *(name for name in OF_FEW_SPEEDS if name in results)):
        values = results[name]
        for dim in values.dims:
            if dim not in results.coords or not results.sizes[dim]:
                raise SchemaError(f"coordinate {dim} of {name} is missing or empty")
        if values.dtype.kind not in "iufc":
            raise SchemaError(f"variable {name} holds no numbers")
        if name not in EMPTY_WHERE_NONE and np.isnan(values.values).any():
            raise SchemaError(f"variable {name} holds values that are no number")


def _check_attributes(results: xr.Dataset) -> None:
    for name in ATTRIBUTES_OF_A_RUN:
        if not isinstance(results.attrs.get(name), str):
            raise SchemaError(f"attribute {name} is missing or no text")
    digest = sha256(results.attrs["parameters"].encode())
    if results.attrs.get("parameters_sha256", digest) != digest:
        raise SchemaError("attribute parameters does not fit its hash, parameters_sha256")
    parameters, words = _json(results, "parameters"), _json(results, "words")
    for name in OBJECTS:
        if results.attrs.get(name):
            _json(results, name)
    for key, kind in WORDS_OF_A_RUN.items():
        if not isinstance(words.get(key), kind):
            raise SchemaError(f"attribute words: {key} is missing or of another type")
    _check_names(results, parameters, words)


def _json(results: xr.Dataset, name: str) -> dict[str, Any]:
    try:
        read = json.loads(results.attrs[name])
    except (ValueError, TypeError, RecursionError):
        read = None
    if not isinstance(read, dict):
        raise SchemaError(f"attribute {name} is no JSON object")
    return read


def _check_names(results: xr.Dataset, parameters: dict[str, Any], words: dict[str, Any]) -> None:
    """Options and receivers are those of the parameters, the reference among them."""
    options, receivers = (
        {str(name) for name in results[dim].values} for dim in ("option", "receiver")
    )
    if REFERENCE_OPTION not in options:
        raise SchemaError(f"coordinate option: holds no option {REFERENCE_OPTION}")
    for known, names, attribute in (
        (parameters.get("receivers"), receivers, "parameters: receivers"),
        (words["sentences"], options, "words: sentences"),
    ):
        if not isinstance(known, dict) or not names <= known.keys():
            raise SchemaError(f"attribute {attribute} do not name those of the variables")
    if parameters.get("catalogue_receiver") not in receivers:
        raise SchemaError("attribute parameters: catalogue_receiver is no receiver")
